# SPDX-License-Identifier: Apache-2.0
"""SVG elements as text, in pixels from the upper left corner."""
import html
import math

from plotting.records import PlotError

# Okabe and Ito (2008), distinguishable with every kind of colour blindness.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
INK, GREY, GRID = "#222222", "#666666", "#DDDDDD"

TITLE_SIZE = 16
TOLERATED_PIXELS = 0.25  # how far a simplified line may lie from the samples
WIDTH_PER_SIZE = 0.58  # of a letter, in font sizes, in the mean over wide sans-serif fonts


def text_width(text, size=13):
    """A cautious estimate, as nobody knows the reader's font."""
    return WIDTH_PER_SIZE * size * len(text)


def text(x, y, words, anchor="start", size=13, fill=INK, more=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" fill="{fill}"{more}>'
            f"{html.escape(words)}</text>")


def bold(x, y, words, anchor="start", size=13):
    return text(x, y, words, anchor, size, more=' font-weight="bold"')


def haloed(x, y, words, anchor="start", size=13, fill=INK):
    """Text that stays legible on top of lines."""
    halo = ' stroke="white" stroke-width="4" stroke-linejoin="round" paint-order="stroke"'
    return text(x, y, words, anchor, size, fill, halo)


def tenths(count):
    """A number of tenths without what SVG does not need."""
    return f"{count / 10:.1f}".removesuffix(".0")


def path_data(points):
    """A path by its steps, in tenths of pixels, which takes half as many letters as a list of places."""
    whole = [(round(10 * x), round(10 * y)) for x, y in points]
    steps = [(x - x0, y - y0) for (x0, y0), (x, y) in zip(whole, whole[1:])]
    return f"M{tenths(whole[0][0])} {tenths(whole[0][1])}l" + " ".join(f"{tenths(x)} {tenths(y)}" for x, y in steps)


def line(points, colour, width=1.5, more=""):
    if len(points) == 1:
        return f'<circle cx="{points[0][0]:.1f}" cy="{points[0][1]:.1f}" r="2.5" fill="{colour}"/>'
    return f'<path fill="none" stroke="{colour}" stroke-width="{width}"{more} d="{path_data(points)}"/>'


def polygon(points, fill, more=""):
    return f'<path fill="{fill}"{more} d="{path_data(points)}z"/>'


def circle(centre, radius, fill, more=""):
    return f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius}" fill="{fill}"{more}/>'


def distance_from_chord(point, begin, end):
    (x0, y0), (x1, y1) = begin, end
    length = math.hypot(x1 - x0, y1 - y0)
    if length == 0:
        return math.hypot(point[0] - x0, point[1] - y0)
    return abs((point[0] - x0) * (y1 - y0) - (point[1] - y0) * (x1 - x0)) / length


def simplified(points):
    """The points that a polyline needs to stay within TOLERATED_PIXELS of all (Douglas and Peucker)."""
    if len(points) < 3:
        return points
    keep, spans = {0, len(points) - 1}, [(0, len(points) - 1)]
    while spans:
        begin, end = spans.pop()
        inner = range(begin + 1, end)
        far = max(inner, key=lambda i: distance_from_chord(points[i], points[begin], points[end]), default=None)
        if far is not None and distance_from_chord(points[far], points[begin], points[end]) > TOLERATED_PIXELS:
            keep.add(far)
            spans += [(begin, far), (far, end)]
    return [points[i] for i in sorted(keep)]


def legend(x, y, entries, right):
    """Lines of (sample, words) from left to right, from (x, y) on, wrapped at `right`; the elements and the last y.

    A sample is a function of the left end and the middle's height of a space of 28 pixels.
    """
    elements, left = [], x
    for sample, words in entries:
        width = 28 + 8 + text_width(words) + 22
        if left > x and left + width > right + 22:
            left, y = x, y + 22
        elements += sample(left, y - 4)
        elements.append(text(left + 36, y, words))
        left += width
    return elements, y


def line_sample(colour, width=2.0, more=""):
    return lambda x, y: [line([(x, y), (x + 28, y)], colour, width, more)]


def band_sample(colour, opacity):
    return lambda x, y: [polygon([(x, y - 6), (x + 28, y - 6), (x + 28, y + 6), (x, y + 6)], colour,
                                 f' fill-opacity="{opacity}"')]


def write(path, width, height, title, elements):
    """Writes a picture with its title on a white ground, whatever the page behind it."""
    width = max(width, 40 + text_width(title, TITLE_SIZE))
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" '
            f'height="{height:.0f}" role="img" font-family="Helvetica, Arial, \'DejaVu Sans\', sans-serif">',
            f"<title>{html.escape(title)}</title>", '<rect width="100%" height="100%" fill="#FFFFFF"/>',
            bold(20, 28, title, size=TITLE_SIZE)]
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(head + elements + ["</svg>", ""]))
    except OSError as error:
        raise PlotError(f"{path}: {error.strerror}") from error
