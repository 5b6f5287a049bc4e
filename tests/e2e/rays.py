"""Rays and boxes in the plane, by formulas of the tests' own."""
import math


def turned(theta, x, y):
    return math.cos(theta) * x - math.sin(theta) * y, math.sin(theta) * x + math.cos(theta) * y


def ray_to_box(origin, angle, box):
    """Distance along a ray to a box (x, y, yaw, size_x, size_y): slabs in the box's own frame."""
    x, y, yaw, *size = box
    at = turned(-yaw, origin[0] - x, origin[1] - y)
    along = turned(-yaw, math.cos(angle), math.sin(angle))
    first, last = 0.0, math.inf
    for position, direction, extent in zip(at, along, size):
        if abs(direction) < 1e-12:
            if abs(position) > extent / 2:
                return math.inf
            continue
        ends = sorted((side * extent / 2 - position) / direction for side in (-1, 1))
        first, last = max(first, ends[0]), min(last, ends[1])
    return first if first <= last else math.inf
