# SPDX-License-Identifier: Apache-2.0
"""Laws that the pictures of scripts/plot obey."""
import csv
import math
import os
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from types import SimpleNamespace

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "scripts"))

from plotting import ground, space_scene, svg, time_histories, training_curves  # noqa: E402
from plotting.axes import Panel, in_words, ticks  # noqa: E402
from plotting.flights import unwrapped  # noqa: E402
from plotting.projection import View, body_axes, dot  # noqa: E402
from plotting.records import PlotError, read_autopilot  # noqa: E402

ROUNDING = 1e-12  # of a few operations in float64 on numbers near 1
PIXELS_ROUNDING = 0.1  # places are written in tenths of pixels
FLIGHT_COLUMNS = ["episode", "time_s", "north_ft", "east_ft", "altitude_ft", "roll_deg", "pitch_deg", "yaw_deg",
                  "action_roll", "target_altitude_ft", "target_yaw_deg", "error_altitude_ft", "error_yaw_deg",
                  "termination"]


def flight_rows(episode, target_yaw):
    """A climbing turn at 1000 ft/s across the heading of 180 degrees."""
    for k in range(101):
        yaw, t = 150 + 0.6 * k, 0.1 * k
        wrapped = math.remainder(yaw, 360)
        yield [episode, t, -1000 * t, 100 * t, 20000 + 200 * t, 60, 5, wrapped, "" if k == 0 else 0.5,
               22000, target_yaw, 2000 - 200 * t, math.remainder(target_yaw - yaw, 360),
               "target_reached" if k == 100 else ""]


class Folder(unittest.TestCase):
    """Tests that write files."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, rows):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(rows)
        return self.path(name)

    def write_flights(self, name, columns=FLIGHT_COLUMNS, episodes=(0, 1)):
        rows = [row for episode in episodes for row in flight_rows(episode, -160.0)]
        return self.write(name, [columns] + rows)

    def flight_options(self, files, **more):
        options = {"files": files, "names": None, "episodes": [], "tolerance": {}, "title": None, "azimuth": 20.0,
                   "elevation": 25.0, "interval": 2.0, "size": 30.0, "out": self.path("out.svg")}
        return SimpleNamespace(**{**options, **more})

    def picture(self):
        """The picture's root, and all its words."""
        root = xml.parse(self.path("out.svg")).getroot()
        return root, [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]


class Axes(unittest.TestCase):
    def test_ticks_are_round_and_within(self):
        for low, high in ((0, 1), (-3.2, 17.9), (19000, 23456), (0, 1e8), (1e-4, 3e-4)):
            marks = ticks(low, high)
            self.assertTrue(2 <= len(marks) <= 7, marks)
            self.assertTrue(low - 1e-9 * high <= marks[0] and marks[-1] <= high * (1 + 1e-9), marks)
            for mark in marks:
                self.assertLessEqual(len(f"{mark:.12g}".rstrip("0").lstrip("-0.").replace(".", "")), 4)

    def test_units_are_words(self):
        self.assertEqual(in_words("true_airspeed_fps"), "true airspeed, ft/s")
        self.assertEqual(in_words("p_deg_s"), "p, deg/s")

    def test_panels_place_the_corners(self):
        panel = Panel(10, 20, 100, 50, (0.0, 2.0), (-1.0, 1.0))
        self.assertEqual((panel.x(0.0), panel.y(-1.0)), (10, 70))
        self.assertEqual((panel.x(2.0), panel.y(1.0)), (110, 20))


class Lines(unittest.TestCase):
    def test_simplified_lines_stay_near_all_points(self):
        points = [(0.5 * x, 40 * math.sin(0.02 * x) + 3 * math.sin(0.3 * x)) for x in range(1000)]
        kept = svg.simplified(points)
        self.assertLess(len(kept), len(points) / 2)
        for point in points:
            nearest = min(svg.distance_from_chord(point, a, b) for a, b in zip(kept, kept[1:])
                          if a[0] <= point[0] <= b[0])
            self.assertLessEqual(nearest, svg.TOLERATED_PIXELS)

    def test_path_data_add_up_to_the_points(self):
        points = [(3.14159, 2.71828), (10.05, -7.77), (9.0, 100.123), (9.0, 100.123)]
        begin, steps = svg.path_data(points)[1:].split("l")
        x, y = map(float, begin.split())
        numbers = [float(number) for number in steps.split()]
        for (dx, dy), point in zip(zip(numbers[::2], numbers[1::2]), points[1:]):
            x, y = x + dx, y + dy
            self.assertLess(max(abs(x - point[0]), abs(y - point[1])), PIXELS_ROUNDING)

    def test_angles_lose_their_jumps(self):
        self.assertEqual(unwrapped([170, -170, 170, None, -10]), [170, 190, 170, None, -10])


class Space(unittest.TestCase):
    def test_body_axes_are_orthonormal_and_not_mirrored(self):
        for angles in ((0, 0, 0), (60, 20, -130), (-170, -80, 179)):
            axes = forward, right, up = body_axes(*angles)
            for i in range(3):
                for k in range(3):
                    self.assertAlmostEqual(dot(axes[i], axes[k]), float(i == k), delta=ROUNDING)
            cross = [forward[1] * right[2] - forward[2] * right[1], forward[2] * right[0] - forward[0] * right[2],
                     forward[0] * right[1] - forward[1] * right[0]]
            # Forward x right is down in north, east, down; with its last axis turned, the product is up.
            self.assertAlmostEqual(dot(cross, up), 1.0, delta=ROUNDING)

    def test_a_right_bank_lowers_the_right_wing(self):
        self.assertLess(body_axes(30, 0, 45)[1][2], 0)
        self.assertGreater(body_axes(0, 30, 45)[0][2], 0)

    def test_views_keep_lengths_across_and_shorten_along(self):
        view = View(30.0, 25.0)
        origin = view.flat((0.0, 0.0, 0.0))
        self.assertAlmostEqual(math.dist(origin, view.flat(view.right)), 1.0, delta=ROUNDING)
        self.assertAlmostEqual(math.dist(origin, view.flat(view.to_viewer)), 0.0, delta=ROUNDING)
        self.assertLess(view.place((0.0, 0.0, 100.0))[1], view.place((0.0, 0.0, 0.0))[1])

    def test_views_fit(self):
        view, corners = View(-40.0, 20.0), [(0, 0, 0), (5000, 0, 0), (0, 7000, 0), (100, 200, 9000)]
        height = view.fit(corners, 50, 60, 800)
        xs, ys = zip(*map(view.place, corners))
        self.assertAlmostEqual(min(xs), 50)
        self.assertAlmostEqual(max(xs), 850)
        self.assertAlmostEqual(min(ys), 60)
        self.assertAlmostEqual(max(ys), 60 + height)

    def test_the_ground_lies_under_all_points(self):
        points = [(0.0, 0.0, 19000.0), (12000.0, -7000.0, 23100.0)]
        plane = ground.Ground(points)
        for north, east, up in points:
            self.assertTrue(plane.north[0] <= north <= plane.north[1] and plane.east[0] <= east <= plane.east[1])
            self.assertTrue(plane.floor < up <= plane.ceiling)


class Pictures(Folder):
    def test_agents_of_the_same_episodes_share_columns(self):
        files = [self.write_flights("a.policy.csv"), self.write_flights("a.autopilot.csv")]
        time_histories.draw(self.flight_options(files, tolerance={"altitude_ft": 100.0}))
        _, words = self.picture()
        self.assertEqual([w for w in words if w.startswith("flight ")], ["flight 1", "flight 2"])
        self.assertEqual(words.count("target reached after 10.0 s"), 4)
        for word in ("policy", "autopilot", "altitude, ft", "time, s", "tolerance", "roll action"):
            self.assertIn(word, words)

    def test_scenes_show_each_end_and_their_scales(self):
        files = [self.write_flights(f"a.{agent}.csv", episodes=(0,)) for agent in ("policy", "autopilot")]
        space_scene.draw(self.flight_options(files))
        _, words = self.picture()
        self.assertEqual(words.count("10.0 s"), 2)
        for word in ("N", "start", "altitude, 1000 ft", "north, 1000 ft", "east, 1000 ft"):
            self.assertIn(word, words)

    def test_everything_lies_on_the_white_ground(self):
        space_scene.draw(self.flight_options([self.write_flights("f.csv", episodes=(0,))]))
        root, _ = self.picture()
        width, height = float(root.get("width")), float(root.get("height"))
        self.assertEqual(root.find("{http://www.w3.org/2000/svg}rect").get("fill"), "#FFFFFF")
        for element in root.iter("{http://www.w3.org/2000/svg}text"):
            self.assertTrue(0 <= float(element.get("x")) <= width and 0 <= float(element.get("y")) <= height)

    def test_flights_of_several_tasks_are_not_mixed(self):
        other = [column.replace("altitude", "height") for column in FLIGHT_COLUMNS]
        files = [self.write_flights("a.csv"), self.write_flights("b.csv", other)]
        with self.assertRaisesRegex(PlotError, "b.csv: flights of another task"):
            time_histories.draw(self.flight_options(files))

    def test_tolerances_are_those_of_targets(self):
        files = [self.write_flights("a.csv")]
        with self.assertRaisesRegex(PlotError, "speed has no target; altitude_ft, yaw_deg has"):
            space_scene.draw(self.flight_options(files, tolerance={"speed": 20.0}))


class Curves(Folder):
    def write_run(self, name, values, task="heading"):
        rows = [["env_steps", "evaluation_success_rate"]] + [[1e6 * (k + 1), v] for k, v in enumerate(values)]
        self.write(os.path.join(name, "metrics.csv"), rows)
        self.write(os.path.join(name, "timing.csv"), [["env_steps", "rollout_s", "update_s", "evaluation_s"],
                                                      [1e6, 10, 20, 0], [2e6, 10, 20, 60]])
        with open(self.path(os.path.join(name, "config.toml")), "w", encoding="utf-8") as file:
            file.write(f'[env]\ntask = "{task}"  # what is flown\n')
        return self.path(name)

    def options(self, runs, **more):
        options = {"runs": runs, "column": "evaluation_success_rate", "seeds": None, "names": None, "autopilot": [],
                   "comparison": [], "minutes": [], "machine": None, "title": None, "out": self.path("out.svg")}
        return SimpleNamespace(**{**options, **more})

    def test_mean_and_band_are_those_of_the_seeds(self):
        runs = [self.write_run("a", [0.1, "", 0.5]), self.write_run("b", [0.3, 0.4, 0.9])]
        setting = training_curves.Setting(runs, "", "evaluation_success_rate", 100.0)
        for curve, wanted in ((setting.mean, [20, 35, 70]), (setting.low, [10, 30, 50]), (setting.high, [30, 40, 90])):
            for (_, value), expected in zip(curve, wanted, strict=True):
                self.assertAlmostEqual(value, expected)
        self.assertAlmostEqual(setting.minutes_per_million(), 1.0)  # 120 s for two million

    def test_seeds_of_several_tasks_are_not_averaged(self):
        runs = [self.write_run("a", [0.1, 0.5]), self.write_run("b", [0.2, 0.7], "control")]
        with self.assertRaisesRegex(PlotError, "b: of another task"):
            training_curves.draw(self.options(runs, seeds=2))

    def test_each_task_has_a_panel(self):
        runs = [self.write_run("a", [0.1, 0.5]), self.write_run("b", [0.2, 0.7], "control")]
        training_curves.draw(self.options(runs, autopilot=["heading=99.5"], minutes=["control=8"]))
        _, words = self.picture()
        for title in ("heading", "control"):
            self.assertIn(training_curves.TASK_TITLES[title], words)
        self.assertEqual([w for w in words if "autopilot" in w], ["autopilot: 99.5 %"])
        self.assertIn("8", words)

    def test_comparisons_give_the_autopilots_figure(self):
        path = self.path("c.json")
        with open(path, "w", encoding="utf-8") as file:
            file.write('{"task": "heading", "agents": [{"name": "policy:x", "success_rate": 1.0},'
                       ' {"name": "autopilot", "success_rate": 0.75}]}')
        self.assertEqual(read_autopilot(path), ("heading", "autopilot", 0.75))


if __name__ == "__main__":
    unittest.main()
