# SPDX-License-Identifier: Apache-2.0
"""Axes: round numbers, words with units, and a panel that places values on the paper."""
import math

from plotting import svg

UNITS = (("_deg_s", "deg/s"), ("_fps", "ft/s"), ("_deg", "deg"), ("_ft", "ft"), ("_g", "g"), ("_s", "s"))


def in_words(column):
    """true_airspeed_fps -> "true airspeed, ft/s"."""
    for ending, unit in UNITS:
        if column.endswith(ending):
            return f"{column[:-len(ending)].replace('_', ' ')}, {unit}"
    return column.replace("_", " ")


def ticks(low, high, count=5):
    """Round numbers between low and high, about `count` of them."""
    rough = (high - low) / count or 1.0
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(m * power for m in (1, 2, 5, 10) if m * power >= rough * 0.999)
    return [i * step for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def padded(values, share=0.06):
    low, high = min(values, default=0.0), max(values, default=0.0)
    pad = share * (high - low) or 1.0
    return low - pad, high + pad


class Panel:
    """A rectangle at (left, top), in pixels, on which values of two ranges are drawn."""

    def __init__(self, left, top, width, height, x_range, y_range):
        self.left, self.top, self.width, self.height = left, top, width, height
        self.right, self.bottom = left + width, top + height
        self.x_range, self.y_range = x_range, y_range
        self.elements = []

    def x(self, value):
        low, high = self.x_range
        return self.left + self.width * (value - low) / ((high - low) or 1.0)

    def y(self, value):
        low, high = self.y_range
        return self.bottom - self.height * (value - low) / ((high - low) or 1.0)

    def grid(self, x_ticks, y_ticks):
        path = "".join(f"M{self.left:.1f} {self.y(y):.1f}H{self.right:.1f}" for y in y_ticks)
        path += "".join(f"M{self.x(x):.1f} {self.top:.1f}V{self.bottom:.1f}" for x in x_ticks)
        self.elements.append(f'<path d="{path}" stroke="{svg.GRID}" fill="none"/>')

    def label_left(self, y_ticks, size=12):
        for y in y_ticks:
            self.elements.append(svg.text(self.left - 7, self.y(y) + 4, f"{y:,.5g}", "end", size))

    def label_bottom(self, x_ticks, size=12):
        for x in x_ticks:
            self.elements.append(svg.text(self.x(x), self.bottom + 17, f"{x:,.5g}", "middle", size))

    def frame_bottom(self):
        self.elements.append(svg.line([(self.left, self.bottom), (self.right, self.bottom)], svg.GREY, 1))

    def curve(self, points, colour, width=1.5, more=""):
        if points:
            placed = svg.simplified([(self.x(x), self.y(y)) for x, y in points])
            self.elements.append(svg.line(placed, colour, width, more))

    def band(self, lows, highs, colour, opacity):
        """Between two curves over the same x."""
        outline = [(self.x(x), self.y(y)) for x, y in lows + highs[::-1]]
        self.elements.append(svg.polygon(outline, colour, f' fill-opacity="{opacity}"'))
