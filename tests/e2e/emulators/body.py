"""What the emulated devices sit on: a body that moves as its wheels do, and what stands around it.

Times are those of time.monotonic(), which on Linux all processes of a machine share.
"""
import json
import math
import os
import pathlib
import threading
import time


def wheel_rows(bearings, distance, radius):
    """Rows that turn a body velocity (vx, vy [m/s], omega [rad/s]) into wheel speeds [rad/s].

    Omnidirectional wheels at these bearings [rad], axles pointing outward; positive speeds turn
    the body counter-clockwise.
    """
    return [[-math.sin(b) / radius, math.cos(b) / radius, distance / radius] for b in bearings]


def wheel_speeds(rows, velocity):
    return [sum(a * b for a, b in zip(row, velocity)) for row in rows]


def body_velocity(rows, speeds):
    """The velocity that three wheel speeds make: Cramer's rule."""
    def determinant(m):
        return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))
    whole = determinant(rows)
    columns = []
    for column in range(3):
        replaced = [row[:column] + [speed] + row[column + 1:] for row, speed in zip(rows, speeds)]
        columns.append(determinant(replaced) / whole)
    return columns


class Body:
    """Takes on every velocity at once and keeps it until the next one, or until the device's rule
    stops it: `silence` seconds after the last command. Thread-safe."""

    def __init__(self, pose, silence, log=None):
        self.lock = threading.RLock()
        self.pose = list(pose)  # m, m, rad: the truth, world frame
        self.velocity = [0.0, 0.0, 0.0]
        self.silence = silence
        self.log = log or Log(None)
        self.now = time.monotonic()
        self.last_command = None
        self.commands = 0
        self.stopped_at = self.now
        self.stops_by_rule = 0
        self.longest_gap = 0.0  # between commands while the wheels turned, s

    def moving(self):
        return any(self.velocity)

    def command(self, velocity, now=None):
        with self.lock:
            now = self.advance(now)
            if self.last_command is not None and self.moving():
                self.longest_gap = max(self.longest_gap, now - self.last_command)
            if self.moving() and not any(velocity):
                self.stopped_at = now
            self.velocity = list(velocity)
            self.last_command = now
            self.commands += 1
            self.log.write(now, "command", velocity=self.velocity)

    def advance(self, now=None):
        """Moves the body up to now."""
        with self.lock:
            now = time.monotonic() if now is None else now
            deadline = math.inf if self.last_command is None else self.last_command + self.silence
            if self.moving() and now > deadline:
                self._drive(max(0.0, deadline - self.now))
                self.velocity = [0.0, 0.0, 0.0]
                self.stopped_at = deadline
                self.stops_by_rule += 1
                self.log.write(deadline, "stopped by rule", pose=self.pose)
            else:
                self._drive(max(0.0, now - self.now))
            self.now = now
            return now

    def _drive(self, seconds):
        vx, vy, omega = self.velocity
        x, y, theta = self.pose
        turned = omega * seconds
        # On an arc the chord is shorter than the way, and turned by half of the angle.
        shrink = math.sin(turned / 2) / (turned / 2) if abs(turned) > 1e-9 else 1.0
        middle = theta + turned / 2
        x += shrink * seconds * (vx * math.cos(middle) - vy * math.sin(middle))
        y += shrink * seconds * (vx * math.sin(middle) + vy * math.cos(middle))
        theta += turned
        self.pose = [x, y, math.atan2(math.sin(theta), math.cos(theta))]

    def state(self):
        with self.lock:
            now = self.advance()
            return {"now": now, "pose": list(self.pose), "velocity": list(self.velocity),
                    "moving": self.moving(), "stopped_at": self.stopped_at,
                    "last_command": self.last_command, "commands": self.commands,
                    "stops_by_rule": self.stops_by_rule, "longest_gap": self.longest_gap}


class World:
    """Walls and cylinders, from a JSON file:
    {"walls": [[x1, y1, x2, y2], …], "cylinders": [[x, y, radius], …]}, metres."""

    def __init__(self, file=None):
        text = json.loads(pathlib.Path(file).read_text()) if file else {}
        self.walls = text.get("walls", [])
        self.cylinders = text.get("cylinders", [])

    def distance(self, x, y, angle):
        """To the nearest surface along a ray; infinity if there is none."""
        dx, dy = math.cos(angle), math.sin(angle)
        hits = [math.inf]
        for x1, y1, x2, y2 in self.walls:
            ex, ey = x2 - x1, y2 - y1
            cross = dx * ey - dy * ex
            if abs(cross) < 1e-12:
                continue
            along = ((x1 - x) * ey - (y1 - y) * ex) / cross
            part = ((x1 - x) * dy - (y1 - y) * dx) / cross
            if along >= 0 and 0 <= part <= 1:
                hits.append(along)
        for cx, cy, radius in self.cylinders:
            towards = (cx - x) * dx + (cy - y) * dy
            off = (cx - x) ** 2 + (cy - y) ** 2 - towards ** 2
            if towards >= 0 and off <= radius ** 2:
                hits.append(max(0.0, towards - math.sqrt(radius ** 2 - off)))
        return min(hits)

    def ranges(self, pose, radius, headings):
        """From the edge of a round body, per sensor heading [rad]."""
        x, y, theta = pose
        return [self.distance(x + radius * math.cos(theta + h), y + radius * math.sin(theta + h),
                              theta + h) for h in headings]


class Log:
    """JSON lines: {"t": …, "event": …, …}; nothing without a file."""

    def __init__(self, file):
        self.lock = threading.Lock()
        self.stream = open(file, "a", buffering=1, encoding="utf-8") if file else None

    def write(self, now, event, **values):
        if self.stream:
            with self.lock:
                self.stream.write(json.dumps({"t": now, "event": event, **values}) + "\n")


def write_whole(file, text):
    """Readers see the old text or the new one, never a part."""
    file = pathlib.Path(file)
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    part.write_text(text)
    os.replace(part, file)


def keep_state_file(file, state, period=0.02):
    """Writes state() to a file again and again, from a thread of its own."""
    def work():
        while True:
            write_whole(file, json.dumps(state()))
            time.sleep(period)
    if file:
        threading.Thread(target=work, daemon=True).start()
