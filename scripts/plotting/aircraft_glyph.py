# SPDX-License-Identifier: Apache-2.0
"""A little aircraft in its attitude: an F-16's outline, enlarged."""
from plotting import svg
from plotting.projection import dot, moved

LENGTH_FT, HALF_SPAN_FT = 49.0, 15.5
# The right half from nose to tail, (forward, right) of the middle, ft; and the fin, (forward, up).
OUTLINE = [(25, 0), (20, 1.4), (13, 2.2), (8, 3.4), (4, 4.4), (-6, HALF_SPAN_FT), (-10, HALF_SPAN_FT), (-10.5, 4.4),
           (-14.5, 4.2), (-20.5, 9.2), (-23.5, 9.2), (-22.5, 2.4), (-24, 1.8)]
FIN = [(-6, 1.5), (-16.5, 11.5), (-22.5, 11.5), (-20.5, 1.5)]
CANOPY = [(16, 0), (14, 1.1), (9, 1.3), (6, 0)]


def mixed(colour, other, share):
    """A colour between two, `share` of the second."""
    pairs = ((int(colour[i:i + 2], 16), int(other[i:i + 2], 16)) for i in (1, 3, 5))
    return "#" + "".join(f"{round(a + (b - a) * share):02X}" for a, b in pairs)


def both_halves(half):
    return half + [(x, -y) for x, y in half[::-1]]


def draw(view, position, axes, colour, enlarged):
    """The outline as seen: from above filled with the colour, from below with a pale one."""
    forward, right, up = axes

    def placed(points, sideways):
        return [view.place(moved(position, (x * enlarged, forward), (y * enlarged, sideways))) for x, y in points]

    is_seen_from_above = dot(up, view.to_viewer) > 0
    edge = f' stroke="{mixed(colour, "#000000", 0.45)}" stroke-width="0.7" stroke-linejoin="round"'
    body = [svg.polygon(placed(both_halves(OUTLINE), right),
                        colour if is_seen_from_above else mixed(colour, "#FFFFFF", 0.6), edge)]
    fin = [svg.polygon(placed(FIN, up), mixed(colour, "#000000", 0.25), edge)]
    if not is_seen_from_above:
        return fin + body
    return body + [svg.polygon(placed(both_halves(CANOPY), right), mixed(colour, "#FFFFFF", 0.75))] + fin
