# SPDX-License-Identifier: Apache-2.0
"""The ground under flights in space: a grid on which shadows fall, with numbers, altitudes and north."""
import math

from plotting import svg
from plotting.axes import ticks
from plotting.projection import moved

ARROW_PIXELS = 60.0  # length of the arrow to the north if it were seen from above
FILL, GRID = "#F4F2EC", "#D5D0C2"
NORTH, EAST, UP = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def widened(low, high, step):
    """From the multiple of step below `low` to the one above `high`."""
    first = math.floor(low / step)
    return first * step, max(math.ceil(high / step), first + 1) * step


class Ground:
    """A level rectangle under all `points` (north, east, up; ft), and the altitudes up to the highest."""

    def __init__(self, points):
        self.points = points
        spans = [(min(p[i] for p in points), max(p[i] for p in points)) for i in range(3)]
        self.step = ticks(0.0, max(high - low for low, high in spans[:2]) or 1.0, 7)[1]
        self.north, self.east = [widened(*span, self.step) for span in spans[:2]]
        low, high = spans[2]
        self.rise = ticks(0.0, (high - low) or 1.0, 4)[1]
        self.floor, self.ceiling = widened(low - 0.5 * self.rise, high, self.rise)

    def below(self, point):
        return point[0], point[1], self.floor

    def corners(self):
        """South-west, north-west, north-east, south-east."""
        (south, north), (west, east) = self.north, self.east
        return [(n, e, self.floor) for n, e in ((south, west), (north, west), (north, east), (south, east))]

    def leftmost_corner(self, view):
        return min(self.corners(), key=lambda corner: view.place(corner)[0])

    def outline(self, view):
        """The corners, and the top of the post of altitudes at the leftmost of them."""
        north, east, _ = self.leftmost_corner(view)
        return self.corners() + [(north, east, self.ceiling)]

    def marks(self, span):
        return ticks(*span, (span[1] - span[0]) / self.step)


def thousands(value):
    return f"{value / 1000:,.5g}"


def inward(end, span):
    """The sign of the way from an end of a span into it."""
    return 1.0 if end == span[0] else -1.0


def draw_grid(view, ground):
    (south, north), (west, east), floor = ground.north, ground.east, ground.floor
    lines = [((n, west, floor), (n, east, floor)) for n in ground.marks(ground.north)]
    lines += [((south, e, floor), (north, e, floor)) for e in ground.marks(ground.east)]
    sheet = svg.polygon([view.place(corner) for corner in ground.corners()], FILL)
    return [sheet] + [svg.line([view.place(a), view.place(b)], GRID, 1) for a, b in lines]


def outside(view, point, direction, pixels):
    """The place `pixels` away from a point into a direction, and how words are anchored there."""
    foot, beyond = view.place(point), view.place(moved(point, (1.0, direction)))
    x, y = beyond[0] - foot[0], beyond[1] - foot[1]
    length = math.hypot(x, y) or 1.0
    anchor = "start" if x > 0.4 * length else "end" if x < -0.4 * length else "middle"
    return foot[0] + pixels * x / length, foot[1] + pixels * y / length + 4, anchor


def draw_edge(view, ends, marks, outward, words):
    """Numbers at the marks of an edge, points by number, and beyond its middle what they are."""
    elements = []
    for value, point in marks:
        x, y, _ = outside(view, point, outward, 18)
        elements.append(svg.text(x, y, thousands(value), "middle", 12))
    middle = tuple((a + b) / 2 for a, b in zip(*ends))
    x, y, anchor = outside(view, middle, outward, 42)
    return elements + [svg.text(x, y, words, anchor, 12, svg.GREY)]


def draw_numbers(view, ground):
    """Along the two edges that are nearest to the viewer; none at the foot of the post of altitudes."""
    floor, foot = ground.floor, ground.leftmost_corner(view)
    north = max(ground.north, key=lambda n: view.nearness((n, 0.0, 0.0)))
    east = max(ground.east, key=lambda e: view.nearness((0.0, e, 0.0)))
    along_north = [(n, (n, east, floor)) for n in ground.marks(ground.north)]
    along_east = [(e, (north, e, floor)) for e in ground.marks(ground.east)]
    to_east, to_north = (0.0, -inward(east, ground.east), 0.0), (-inward(north, ground.north), 0.0, 0.0)
    elements = []
    for marks, outward, words in ((along_north, to_east, "north, 1000 ft"), (along_east, to_north, "east, 1000 ft")):
        ends = marks[0][1], marks[-1][1]
        free = [(value, point) for value, point in marks if point != foot]
        elements += draw_edge(view, ends, free, outward, words)
    return elements


def draw_altitudes(view, ground):
    """A post at the leftmost corner."""
    north, east, _ = ground.leftmost_corner(view)
    x, bottom = view.place((north, east, ground.floor))
    top = view.place((north, east, ground.ceiling))[1]
    elements = [svg.line([(x, bottom), (x, top)], svg.GREY, 1)]
    for level in ticks(ground.floor, ground.ceiling, (ground.ceiling - ground.floor) / ground.rise):
        y = view.place((north, east, level))[1]
        elements += [svg.line([(x - 5, y), (x, y)], svg.GREY, 1), svg.text(x - 8, y + 4, thousands(level), "end", 12)]
    return elements + [svg.text(x - 40, top - 14, "altitude, 1000 ft", "start", 12, svg.GREY)]


def draw_north_arrow(view, ground):
    """Flat on the ground, in the corner that is farthest from all shadows."""
    size = ARROW_PIXELS / 2 / view.scale
    places = [moved(corner, (2.0 * size * inward(corner[0], ground.north), NORTH),
                    (1.5 * size * inward(corner[1], ground.east), EAST)) for corner in ground.corners()]
    middle = max(places, key=lambda place: min(math.dist(place[:2], point[:2]) for point in ground.points))
    shape = [(1.0, 0.0), (-0.9, 0.42), (-0.5, 0.0), (-0.9, -0.42)]
    points = [view.place(moved(middle, (size * x, NORTH), (size * y, EAST))) for x, y in shape]
    x, y = view.place(moved(middle, (1.75 * size, NORTH)))
    return [svg.polygon(points, svg.GREY), svg.text(x, y + 5, "N", "middle", 13, svg.GREY, ' font-weight="bold"')]


def draw(view, ground):
    return (draw_grid(view, ground) + draw_numbers(view, ground) + draw_altitudes(view, ground)
            + draw_north_arrow(view, ground))
