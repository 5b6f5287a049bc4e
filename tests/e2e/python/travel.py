"""To an agent, around walls and past others: travel.h, avoidance.h and way_past.h of controllers/help in Python.

Vectors of the body's frame are complex numbers: x ahead, y to the left.
"""
import math

import baraka
from baraka import Parameter
from baraka.math import atan2, cos, pi, sin, wrap_angle

dot = lambda a, b: a.real * b.real + a.imag * b.imag
cross = lambda a, b: a.real * b.imag - a.imag * b.real
left = lambda v: complex(-v.imag, v.real)
length = lambda v: math.sqrt(dot(v, v))
unit = lambda v: 1 / length(v) * v
clamp = lambda x, low, high: max(low, min(x, high))
ns = lambda seconds: int(seconds * 1e9 + 0.5)


class Avoidance:
    """Towards a point and around walls, by infrared: controllers/help/avoidance.h."""

    def __init__(self, speed, radius, gap, clear_for):
        self.speed, self.radius, self.width, self.clear_for = speed, radius, radius + gap, ns(clear_for)
        self.following, self.normal, self.side, self.last = False, 0j, 1, None
        self.since = self.blocked = self.side_since = self.patience = 0

    def steer(self, way, infrared, now):
        seen = sorted(((self.radius + r) * cos(h) + 1j * ((self.radius + r) * sin(h))
                       for h, r in infrared if not math.isnan(r)), key=length)
        self.update(way, seen, now)
        v = self.along(way, seen, now) if self.following else self.towards(way, seen)
        for gap, point in ((length(p) - self.radius, p) for p in seen):
            v = v - 0.5 * (0.2 - gap) / 0.2 * unit(point) if gap < 0.2 else v
        fast = length(v) / self.speed
        v = 1 / fast * v if fast > 1 else v
        off = pi
        for angle in (wrap_angle(atan2(v.imag, v.real) - heading) for heading, _ in infrared):
            off = angle if abs(angle) < abs(off) else off
        return v.real, v.imag, 0 if length(v) < 1e-3 or not infrared else clamp(off, -0.4, 0.4)

    def gap_along(self, way, seen, width):
        return min((dot(way, p) - self.radius for p in seen if dot(way, p) > 0 and abs(cross(way, p)) < width),
                   default=None)

    def update(self, way, seen, now):
        gap = self.gap_along(way, seen, self.width)
        if not self.following:
            return self.follow(way, seen, now) if gap is not None and gap < 0.4 else None
        self.last, self.blocked = now, self.blocked if gap is None else now
        self.look(way, seen)
        self.following = now - self.blocked < self.clear_for
        if now - self.side_since >= self.patience:
            self.side, self.side_since, self.patience = -self.side, now, 2 * self.patience

    def follow(self, way, seen, now):
        self.following, self.since, self.blocked = True, now, now
        self.normal = complex(dot(way, -1 * unit(seen[0])), cross(way, -1 * unit(seen[0])))
        self.look(way, seen)
        same, self.last = self.last is not None and now - self.last < 5 * 10**9, now
        if not same:
            self.side, self.side_since = 1 if left(self.normal).real >= 0 else -1, now
            self.patience = ns(30 / self.speed)

    def look(self, way, seen):
        if len(seen) > 1:
            normal = unit(left(seen[1] - seen[0]))
            normal = -1 * normal if dot(normal, seen[0]) > 0 else normal
            self.normal = complex(dot(way, normal), cross(way, normal))
        elif seen:
            back = complex(dot(way, -1 * unit(seen[0])), cross(way, -1 * unit(seen[0])))
            self.normal = back if dot(back, self.normal) < 0.3 else self.normal

    def towards(self, way, seen):
        gap = self.gap_along(way, seen, self.width)
        return (self.speed if gap is None else min(math.sqrt(max(0, gap - (0.4 - 0.05))), self.speed)) * way

    def along(self, way, seen, now):
        normal = self.normal.real * way + self.normal.imag * left(way)
        ahead = self.gap_along(self.side * left(normal), seen, self.radius + 0.05)
        room = 1.0 if ahead is None else clamp((ahead - 0.1) / 0.4, 0, 1)
        keep = clamp(self.width + dot(normal, seen[0]), -0.25, 0.25) if seen else 0
        return min(room, 1, (now - self.since) / 8e8) * self.speed * (self.side * left(normal)) + keep * normal


def past(way, known, clearance):
    agents = [a for a in map(complex, known[1::3], known[2::3])
              if 0 < dot(way, a) <= 1.5 and abs(dot(left(way), a)) < clearance]
    if not agents:
        return way
    nearest = min(agents, key=lambda a: dot(way, a))
    return unit(nearest + (-1 if dot(left(way), nearest) > 0 else 1) * clearance * left(way))


class Travel:
    """Drives a robot to another agent."""

    parameters = {"speed": Parameter(0.94, "m/s", 0.01, 5, "Speed of travel."),
                  "body_radius": Parameter(0.185, "m", 0.01, 2, "From the middle to the infrared sensors."),
                  "wall_gap": Parameter(0.265, "m", 0.1, 2, "Between the body and a wall it follows."),
                  "clear_for": Parameter(1.2, "s", 0, 60, "Time the way is clear before it is taken again.")}

    def __init__(self, robot, p):
        self.robot, self.limits = robot, (p["speed"], p["body_radius"], p["wall_gap"], p["clear_for"])
        self.aim_anew()

    def aim_anew(self):
        self.avoidance = Avoidance(*self.limits)

    def drive(self, to, distance):
        try:
            infrared, known = self.robot.infrared(), self.robot.reading("localisation").tolist()
        except baraka.NotAvailable:
            return self.robot.set_body_velocity()
        way = past(1 / distance * to, known, self.avoidance.radius + 0.15)
        return self.robot.set_body_velocity(*self.avoidance.steer(way, infrared, self.robot.now_ns()))
