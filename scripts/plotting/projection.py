# SPDX-License-Identifier: Apache-2.0
"""From north, east, up (ft) to the paper: a parallel projection, equal scales on all three axes."""
import math


class View:
    """Seen from afar, looking toward compass direction `azimuth_deg` and down by `elevation_deg`."""

    def __init__(self, azimuth_deg, elevation_deg):
        azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
        self.right = (-math.sin(azimuth), math.cos(azimuth), 0.0)
        self.ahead = (math.cos(azimuth), math.sin(azimuth), 0.0)
        self.sine, self.cosine = math.sin(elevation), math.cos(elevation)
        self.to_viewer = (-self.ahead[0] * self.cosine, -self.ahead[1] * self.cosine, self.sine)
        self.scale, self.origin = 1.0, (0.0, 0.0)

    def flat(self, point):
        """In feet on the paper, to the right and up."""
        return dot(self.right, point), self.cosine * point[2] + self.sine * dot(self.ahead, point)

    def fit(self, corners, left, top, width):
        """Lets the corners fill a width in pixels from (left, top) on; the height that it takes."""
        flats = [self.flat(corner) for corner in corners]
        low_x, high_x = min(x for x, _ in flats), max(x for x, _ in flats)
        low_y, high_y = min(y for _, y in flats), max(y for _, y in flats)
        self.scale = width / (high_x - low_x)
        self.origin = (left - low_x * self.scale, top + high_y * self.scale)
        return (high_y - low_y) * self.scale

    def place(self, point):
        """Pixels of a point in space."""
        x, y = self.flat(point)
        return self.origin[0] + self.scale * x, self.origin[1] - self.scale * y

    def nearness(self, point):
        """Larger is nearer to the viewer."""
        return dot(self.to_viewer, point)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def body_axes(roll_deg, pitch_deg, yaw_deg):
    """The body's forward, right and up directions in north, east, up."""
    sr, cr = math.sin(math.radians(roll_deg)), math.cos(math.radians(roll_deg))
    sp, cp = math.sin(math.radians(pitch_deg)), math.cos(math.radians(pitch_deg))
    sy, cy = math.sin(math.radians(yaw_deg)), math.cos(math.radians(yaw_deg))
    forward = (cp * cy, cp * sy, sp)
    right = (sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp)
    up = (-(cr * sp * cy + sr * sy), -(cr * sp * sy - sr * cy), cr * cp)
    return forward, right, up


def moved(point, *steps):
    """The point, moved by (distance, direction) of each step."""
    return tuple(p + sum(distance * direction[i] for distance, direction in steps) for i, p in enumerate(point))
