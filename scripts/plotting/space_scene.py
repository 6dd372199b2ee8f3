# SPDX-License-Identifier: Apache-2.0
"""A picture of flights in space: the first file's with aircraft and the sweep of their wings, the others' as lines."""
import math

from plotting import aircraft_glyph, ground as grounds, svg, tracks
from plotting.flights import episodes_of, read_recordings
from plotting.ground import Ground
from plotting.projection import View
from plotting.tracks import COLUMNS, Track

WIDTH, LEFT, RIGHT, TOP = 1000, 70, 100, 62
OTHERS_SIZE = 0.75  # of the aircraft of further files
RIBBON_SPAN = 0.5  # width of the ribbon in wing spans
LABEL_WEIGHT = 10  # of covering a label, an aircraft or an arrow, where a point of a path counts 1
LABEL_PLACES = [(dx * reach, dy * reach + 4, anchor) for reach in (1, 1.5, 2.2)
                for dx, dy, anchor in ((20, 0, "start"), (-20, 0, "end"), (16, -16, "start"), (-16, -16, "end"),
                                       (16, 18, "start"), (-16, 18, "end"), (0, -20, "middle"), (0, 26, "middle"))]
ARROW_HEAD = ('<defs><marker id="arrow" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="7" markerHeight="7" '
              f'orient="auto"><path d="M0 1L10 5L0 9z" fill="{svg.INK}"/></marker></defs>')


class Labels:
    """Words beside points, where they cover least."""

    def __init__(self, taken):
        """`taken` are (x, y, reach, weight) of what words shall not cover."""
        self.boxes = [(x - reach, y - reach, x + reach, y + reach, weight) for x, y, reach, weight in taken]

    def place(self, point, words, colour):
        width = svg.text_width(words)
        chosen = min(LABEL_PLACES, key=lambda place: self.cost(self.box(point, place, width), place))
        self.boxes.append((*self.box(point, chosen, width), LABEL_WEIGHT))
        dx, dy, anchor = chosen
        return svg.haloed(point[0] + dx, point[1] + dy, words, anchor, fill=colour)

    @staticmethod
    def box(point, place, width):
        dx, dy, anchor = place
        left = point[0] + dx - {"start": 0, "middle": width / 2, "end": width}[anchor]
        return left, point[1] + dy - 12, left + width, point[1] + dy + 3

    def cost(self, box, place):
        """What is covered, and the way to the point."""
        covered = sum(weight for x0, y0, x1, y1, weight in self.boxes
                      if x0 < box[2] and box[0] < x1 and y0 < box[3] and box[1] < y1)
        is_outside = box[0] < 0 or box[2] > WIDTH or box[1] < TOP - 24
        return covered + math.hypot(*place[:2]) / 10 + LABEL_WEIGHT * is_outside


def end_words(flight):
    return f"{flight.duration:.1f} s" + ("" if flight.end == "target reached" else f" ({flight.end})")


def draw_flights(view, all_tracks, enlarged, interval):
    """All aircraft, ribbons and lines, those farthest from the viewer first."""
    pieces = []
    for track in all_tracks:
        if track.is_first:
            pieces += tracks.ribbon(view, track, RIBBON_SPAN * aircraft_glyph.HALF_SPAN_FT * enlarged)
            pieces += tracks.aircraft(view, track, enlarged, track.instants(interval)[1:])
        else:
            pieces += tracks.path(view, track)
            pieces += tracks.aircraft(view, track, OTHERS_SIZE * enlarged, [len(track.points) - 1])
    return [element for _, piece in sorted(pieces, key=lambda piece: piece[0]) for element in piece]


def draw_starts(view, ground, all_tracks):
    """Dots, and one word for all of them, as episodes begin near each other."""
    starts = {track.points[0] for track in all_tracks}
    lowest = min((view.place(point) for point in starts), key=lambda place: -place[1])
    elements = [tracks.draw_post(view, ground, max(starts, key=lambda point: point[2]), svg.INK)]
    elements += [svg.circle(view.place(point), 3, svg.INK) for point in sorted(starts)]
    return elements + [svg.haloed(lowest[0], lowest[1] + 20, "start", "middle")]


def draw_end_labels(view, all_tracks, size):
    """How long each flight was, beside its end, where no flight passes."""
    taken = [(*view.place(point), 5, 1) for track in all_tracks for point in track.points[::25]]
    taken += [(*view.place(track.points[-1]), size / 2, LABEL_WEIGHT) for track in all_tracks]
    for track in all_tracks:
        (x0, y0), (x1, y1) = view.place(track.target_point()), tracks.target_tip(view, track)
        taken += [(x0 + share * (x1 - x0), y0 + share * (y1 - y0), 4, LABEL_WEIGHT) for share in (0.3, 0.6, 1.0)]
    labels = Labels(taken)
    return [labels.place(view.place(t.points[-1]), end_words(t.flight), t.colour) for t in all_tracks]


def aircraft_sample(colour):
    """A little aircraft from above, flying to the right."""
    view = View(0.0, 90.0)
    axes = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))

    def sample(x, y):
        view.origin = (x + 14, y)
        return aircraft_glyph.draw(view, (0.0, 0.0, 0.0), axes, colour, 26 / aircraft_glyph.LENGTH_FT)
    return sample


def target_sample(is_in_space):
    if is_in_space:
        return lambda x, y: [svg.circle((x + 14, y), 8, "none", f' stroke="{svg.INK}" stroke-width="1.5"')]
    return svg.line_sample(svg.INK, 1.4, ' marker-end="url(#arrow)"')


def target_words(all_tracks, tolerance):
    track = all_tracks[0]
    if track.has_target_in_space():
        return "target" + (f", box ±{tolerance['altitude_ft']:g} ft" if "altitude_ft" in tolerance else "")
    words = "target heading" + ("" if track.asked("pitch_deg") is None else " and pitch")
    words += "" if track.asked("altitude_ft") is None else " at target altitude"
    known = [f"±{tolerance[column]:g}{unit}" for column, unit in (("yaw_deg", "°"), ("altitude_ft", " ft"))
             if column in tolerance]
    return words + (f" ({', '.join(known)})" if known else "")


def legend_entries(recordings, all_tracks, options, enlarged, ground):
    entries = [(aircraft_sample(recordings[0].colour),
                f"{recordings[0].name}: an aircraft every {options.interval:g} s, {enlarged:.0f} times its size, "
                "pale from below")]
    entries += [(svg.line_sample(recording.colour, 1.8), recording.name) for recording in recordings[1:]]
    entries.append((target_sample(all_tracks[0].has_target_in_space()), target_words(all_tracks, options.tolerance)))
    entries.append((lambda x, y: [svg.text(x + 28, y + 4, "12 s", "end", 12)], "time to the target"))
    entries.append((svg.line_sample(tracks.SHADOW, 1.2), f"shadow at {ground.floor:,.0f} ft"))
    return entries


def draw(options):
    recordings = read_recordings(options, COLUMNS)
    all_tracks = [Track(flight, recording.colour, recording is recordings[0])
                  for episode in episodes_of(recordings) for recording, flight in episode.items()]
    view = View(options.azimuth, options.elevation)
    ends = [track.target_point() for track in all_tracks]
    points = ends + [point for track in all_tracks for point in track.points[::10]]
    ground = Ground(points)
    height = view.fit(ground.outline(view) + points, LEFT, TOP, WIDTH - LEFT - RIGHT)
    enlarged = options.size / aircraft_glyph.LENGTH_FT / view.scale
    elements = [ARROW_HEAD] + grounds.draw(view, ground)
    elements += [tracks.draw_shadow(view, ground, track) for track in all_tracks]
    for track in all_tracks:
        elements += tracks.draw_target(view, ground, track, options.tolerance)
    elements += draw_flights(view, all_tracks, enlarged, options.interval)
    elements += draw_starts(view, ground, all_tracks) + draw_end_labels(view, all_tracks, options.size)
    title = options.title or "Recorded flights in space"
    entries = legend_entries(recordings, all_tracks, options, enlarged, ground)
    lines, bottom = svg.legend(LEFT, TOP + height + 62, entries, WIDTH - 40)
    svg.write(options.out, WIDTH, bottom + 20, title, elements + lines)
