"""Stations and flows of the comparison of AODV, the same on both sides: drawn from a seed."""
import dataclasses
import math
import random

STATIONS = 25
STOP = 100   # s, of the flows
END = 115    # s, of the runs
SIDES = 200, 60     # m, of the field of those that move
SPEEDS = 1, 5       # m/s, one of each station
PAUSE = 5           # s, at each point


@dataclasses.dataclass
class Walk:
    """From point to point at one speed."""
    points: list  # m; the first is where it begins
    speed: float  # m/s
    pause: float  # s

    def waypoints(self):
        """[(s, x, y)] at which it arrives and leaves, straight on between."""
        at, found = 0.0, [(0.0, *self.points[0])]
        for here, there in zip(self.points, self.points[1:]):
            at += math.dist(here, there) / self.speed
            found.append((at, *there))
            at += self.pause
            found.append((at, *there))
        return found


def flows(count, seed):
    """(source, destination, start [s]) of each flow; no station is the source of two."""
    chance = random.Random(1000 * count + seed)
    sources = chance.sample(range(STATIONS), count)
    result = []
    for source in sources:
        destination = chance.choice([one for one in range(STATIONS) if one != source])
        result.append((source, destination, round(5 + chance.random() * 5, 6)))
    return result


def walks(seed):
    """Random waypoint paths, until the run ends."""
    chance = random.Random(5000 + seed)

    def point():
        return tuple(round(chance.uniform(0, side), 2) for side in SIDES)
    found = []
    for _ in range(STATIONS):
        walk = Walk([point()], 0, PAUSE)
        walk.speed = round(chance.uniform(*SPEEDS), 2)
        while walk.waypoints()[-1][0] < END:
            walk.points.append(point())
        found.append(walk)
    return found


def leaving():
    """Three in a row, 40 m apart; the last one goes after 20 s."""
    return [Walk([(0, 0)], 1, 0), Walk([(40, 0)], 1, 0), Walk([(80, 0), (80, 1), (400, 1)], 8, 20)]


class Field:
    """A kind of field: where its stations are and what they send."""

    def __init__(self, name, count):
        self.name, self.count = name, count

    def flows(self, seed):
        return [(0, 2, 5.0)] if self.name == "leaving" else flows(self.count, seed)

    def walks(self, seed):
        """None: the grid."""
        if self.name == "grid":
            return None
        return leaving() if self.name == "leaving" else walks(seed)

    def for_peer(self, seed):
        """Lines for tests/peer/ns3/aodv."""
        lines = [f"flow {source} {destination} {start}" for source, destination, start in self.flows(seed)]
        for walk in self.walks(seed) or []:
            lines.append("path " + " ".join(f"{at:.9f} {x} {y}" for at, x, y in walk.waypoints()))
        return "\n".join(lines) + "\n"

    def scenario(self, text, seed):
        """Ours: the text of aodv.yaml with these stations and flows in place of its grid."""
        head, _, rest = text.partition("agents:\n")
        groups = [_group(i, walk, self.flows(seed)) for i, walk in enumerate(self.walks(seed))]
        return f"{head}agents:\n{''.join(groups)}\n{rest[rest.index('end:'):]}"

    def overrides(self, seed):
        """Settings for aodv.yaml itself."""
        return {"agents.stations.controller.overrides": [{"agents": f"s{source}", "parameters": _parameters(destination, start)}
                                                         for source, destination, start in self.flows(seed)]}


def _parameters(destination, start):
    return {"to": f"s{destination}", "start": f"{start} s", "phase": "0 s", "stop": f"{STOP} s"}


def _group(number, walk, sent):
    x, y = walk.points[0]
    points = ", ".join(f"{{x: {one} m, y: {other} m}}" for one, other in walk.points[1:])
    path = f"path: {{waypoints: {{points: [{points}], speed: {walk.speed} m/s, pause: {walk.pause} s}}}}" if points else ""
    own = [_parameters(destination, start) for source, destination, start in sent if source == number]
    given = own[0] if own else {"to": "neighbours", "start": "100000 s"}
    parameters = ", ".join(f"{key}: {value}" for key, value in given.items())
    return (f"  g{number}:\n    name: s{number}\n    station: {{{path}}}\n    poses: [{{x: {x} m, y: {y} m}}]\n    controller:\n"
            f"      program: traffic_source\n      parameters: {{pattern: periodic, rate: 4 Hz, topic: t, size: 76, {parameters}}}\n")
