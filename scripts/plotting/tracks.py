# SPDX-License-Identifier: Apache-2.0
"""Flights as tracks in space: paths, the sweep of the wings, little aircraft, shadows and targets."""
from plotting import aircraft_glyph, svg
from plotting.ground import UP
from plotting.projection import body_axes, dot, moved
from plotting.records import PlotError

COLUMNS = ["north_ft", "east_ft", "altitude_ft", "roll_deg", "pitch_deg", "yaw_deg"]
SHADOW = "#8C8C8C"
RIBBON_INTERVAL_S = 0.1
ARROW_PIXELS = 46.0  # length of the arrow into a target's direction
FRONT_OF_RIBBON = 1.2  # lengths of an aircraft by which it is drawn nearer than the wings' own sweep


class Track:
    """A flight in space: points (north, east, up; ft), attitudes (roll, pitch, yaw; deg) and times."""

    def __init__(self, flight, colour, is_first):
        self.flight, self.colour, self.is_first = flight, colour, is_first
        columns = [flight.values[column] for column in COLUMNS]
        rows = [row for row in zip(*columns, flight.times) if None not in row]
        if not rows:
            raise PlotError(f"{flight.path}: episode {flight.episode} has no position")
        self.points = [row[:3] for row in rows]
        self.attitudes = [row[3:6] for row in rows]
        self.times = [row[6] for row in rows]

    def instants(self, interval):
        """Row numbers `interval` seconds apart, and the last one."""
        result, due = [], 0.0
        for index, time in enumerate(self.times):
            if time >= due - 1e-6:
                result.append(index)
                due += interval
        last = len(self.times) - 1
        if len(result) > 1 and self.times[last] - self.times[result[-1]] < 0.4 * interval:
            result.pop()
        return result if result[-1] == last else result + [last]

    def asked(self, quantity):
        """The target of a quantity; None if the task asks for none."""
        return self.flight.values.get("target_" + quantity, [None])[-1]

    def has_target_in_space(self):
        return self.asked("north_ft") is not None and self.asked("east_ft") is not None

    def target_point(self):
        """A target in space, or else the target's altitude, if any, at the last place."""
        asked = [self.asked(column) for column in COLUMNS[:3]]
        return tuple(last if value is None else value for value, last in zip(asked, self.points[-1]))

    def target_axes(self):
        """Forward, right and up of the target's heading and pitch; None if the task asks for no heading."""
        yaw = self.asked("yaw_deg")
        return None if yaw is None else body_axes(0.0, self.asked("pitch_deg") or 0.0, yaw)


def draw_shadow(view, ground, track):
    points = svg.simplified([view.place(ground.below(point)) for point in track.points])
    return svg.line(points, SHADOW if track.is_first else track.colour, 1.2, ' stroke-opacity="0.5"')


def draw_post(view, ground, point, colour):
    return svg.line([view.place(point), view.place(ground.below(point))], colour, 0.8, ' stroke-opacity="0.5"')


def ribbon(view, track, half_span):
    """[(nearness, elements)] of the area that the wings sweep, darker from above and paler from below."""
    sides = []
    for index in track.instants(RIBBON_INTERVAL_S):
        _, right, up = body_axes(*track.attitudes[index])
        point = track.points[index]
        sides.append((moved(point, (-half_span, right)), moved(point, (half_span, right)), up))
    pieces = []
    for (left, right, up), (next_left, next_right, _) in zip(sides, sides[1:]):
        fill = aircraft_glyph.mixed(track.colour, "#FFFFFF", 0.5 if dot(up, view.to_viewer) > 0 else 0.78)
        corners = [view.place(corner) for corner in (left, right, next_right, next_left)]
        pieces.append((view.nearness(left) / 2 + view.nearness(next_right) / 2,
                       [svg.polygon(corners, fill, f' stroke="{fill}" stroke-width="0.6"')]))
    return pieces


def aircraft(view, track, enlarged, instants):
    pieces = []
    for index in instants:
        nearness = view.nearness(track.points[index]) + FRONT_OF_RIBBON * aircraft_glyph.LENGTH_FT * enlarged
        axes = body_axes(*track.attitudes[index])
        pieces.append((nearness, aircraft_glyph.draw(view, track.points[index], axes, track.colour, enlarged)))
    return pieces


def path(view, track):
    """A plain line, cut so that what is nearer covers it."""
    length = max(1, len(track.points) // 12)
    pieces = []
    for begin in range(0, len(track.points) - 1, length):
        part = track.points[begin:begin + length + 1]
        placed = svg.simplified([view.place(point) for point in part])
        pieces.append((view.nearness(part[len(part) // 2]), [svg.line(placed, track.colour, 1.8)]))
    return pieces


def draw_box(view, middle, half_sizes):
    """The outline of a box of tolerances: its edges, as seen through."""
    corners = {(i, j, k): view.place(tuple(m + s * h for m, s, h in zip(middle, (i, j, k), half_sizes)))
               for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)}
    edges = [(a, b) for a in corners for b in corners if a < b and sum(p != q for p, q in zip(a, b)) == 1]
    return [svg.line([corners[a], corners[b]], svg.INK, 1) for a, b in edges]


def target_tip(view, track):
    """Where the arrow into the target's direction ends, or the target in space is."""
    axes = None if track.has_target_in_space() else track.target_axes()
    target = track.target_point()
    return view.place(moved(target, (ARROW_PIXELS / view.scale, axes[0])) if axes else target)


def draw_target_direction(view, target, axes, tolerance):
    """An arrow; with known tolerances the sector and the height into which the flight has to come."""
    forward, _, _ = axes
    length = ARROW_PIXELS / view.scale
    tip = view.place(moved(target, (length, forward)))
    elements = []
    if "yaw_deg" in tolerance:
        yaws = [tolerance["yaw_deg"] * k / 4 for k in range(-4, 5)]
        arc = [turned(axes, yaw) for yaw in yaws]
        sector = [view.place(target)] + [view.place(moved(target, (length, direction))) for direction in arc]
        elements.append(svg.polygon(sector, svg.INK, ' fill-opacity="0.3"'))
    if "altitude_ft" in tolerance:
        ends = [view.place(moved(target, (side * tolerance["altitude_ft"], UP))) for side in (-1, 1)]
        elements.append(svg.line(ends, svg.INK, 3))
    return elements + [svg.line([view.place(target), tip], svg.INK, 1.4, ' marker-end="url(#arrow)"')]


def turned(axes, yaw_deg):
    """The forward direction, turned in its own plane."""
    along, across, _ = body_axes(0.0, 0.0, yaw_deg)[0]
    return tuple(along * f + across * r for f, r in zip(axes[0], axes[1]))


def draw_target(view, ground, track, tolerance):
    target = track.target_point()
    if track.has_target_in_space():
        ring = svg.circle(view.place(target), 8, "none", f' stroke="{svg.INK}" stroke-width="1.5"')
        sizes = [tolerance.get(column, 0.0) for column in COLUMNS[:3]]
        return [draw_post(view, ground, target, svg.INK), ring] + draw_box(view, target, sizes)
    post = draw_post(view, ground, track.points[-1], track.colour)
    axes = track.target_axes()
    return [post] + (draw_target_direction(view, target, axes, tolerance) if axes else [])
