"""What `ros_endpoints`, a program on Cyclone DDS that knows only ROS 2's names, sees of a robot's base in a run."""
import collections
import dataclasses
import json
import os

from baraka import BIN, ROOT

SCENARIO = ROOT / "tests/e2e/ros_base.yaml"
ENDPOINTS = BIN.parent / "tests/ros_endpoints"
PROGRAMS = {"PATH": f"{BIN.parent / 'tests'}:{os.environ['PATH']}"}
RELIABILITY, DURABILITY, DEADLINE = 11, 2, 4  # numbers of policies, OMG DDS 1.4, 2.3.3


@dataclasses.dataclass(frozen=True)
class Qos:
    """The policies of a ROS 2 profile that decide whether two endpoints match (OMG DDS 1.4, 2.2.3). Deadline: ms."""
    reliable: bool = True
    kept: bool = False
    deadline: int = None

    def words(self):
        return ["reliable" if self.reliable else "best_effort", "transient_local" if self.kept else "volatile",
                *([str(self.deadline)] if self.deadline else [])]


def refused(offered, requested):
    """The policies by which a reader that requests one does not match a writer that offers the other; none: they match."""
    infinite = float("inf")
    policies = []
    if requested.reliable and not offered.reliable:
        policies.append(RELIABILITY)
    if requested.kept and not offered.kept:
        policies.append(DURABILITY)
    if (offered.deadline or infinite) > (requested.deadline or infinite):
        policies.append(DEADLINE)
    return policies


def reader(kind, topic, qos=Qos()):
    return ("reader", kind, topic, qos)


def writer(kind, topic, qos=Qos()):
    return ("writer", kind, topic, qos)


class Ears:
    """The lines of a `ros_endpoints` that has run, by endpoint."""

    def __init__(self, file, endpoints):
        self.lines = [json.loads(line) for line in file.read_text().splitlines() if line.startswith("{")]
        self.endpoints = endpoints

    def of(self, number, key):
        return [line for line in self.lines if line.get("endpoint") == number and key in line]

    def samples(self, topic):
        """Of the first reader of the topic."""
        (number, *_) = [i for i, one in enumerate(self.endpoints) if one[0] == "reader" and one[2] == topic]
        return self.of(number, "written")

    def peers(self, topic):
        return [peer for i, one in enumerate(self.endpoints) if one[2] == topic for peer in self.of(i, "peer")]

    def user_data(self):
        return {line["participant"]: bytes.fromhex(line["user_data"]) for line in self.lines if "user_data" in line}


def program_of(name, words, start=None):
    command = ", ".join(json.dumps(str(word)) for word in words)
    return f"{{name: {name}, command: [{command}]{f', start: {start}' if start else ''}}}"


def listen(case, endpoints, *, settings=(), more=(), scenario=SCENARIO, start=None):
    """Runs the scenario with a listener that has these endpoints, and gives what it heard."""
    words = [",".join([kind, message, topic, *qos.words()]) for kind, message, topic, qos in endpoints]
    programs = ", ".join([program_of("ears", ["ros_endpoints", "0", *words], start), *more])
    changes = [f"agents.listener.programs=[{programs}]", *settings]
    case.run_baraka(scenario, "--no-inspect", *(word for change in changes for word in ("--set", change)), env=PROGRAMS)
    return Ears(case.out / "listener.ears.log", endpoints)


class Tree:
    """Frames by /tf and /tf_static: what is in what, at each time."""

    def __init__(self, moving, fixed):
        self.parents, self.at = collections.defaultdict(set), collections.defaultdict(dict)
        for one in (transform for sample in moving for transform in sample["transforms"]):
            self.parents[one["child"]].add(one["parent"])
            self.at[one["child"]][one["t"]] = one
        self.fixed = {one["child"]: one for sample in fixed for one in sample["transforms"]}
        for one in self.fixed.values():
            self.parents[one["child"]].add(one["parent"])

    def chain(self, frame):
        """From a frame to the root."""
        way = [frame]
        while way[-1] in self.parents:
            (parent,) = self.parents[way[-1]]
            assert parent not in way, f"{way} comes back to {parent}"
            way.append(parent)
        return way

    def transform(self, frame, t):
        """Of a frame in its parent at a time; None: there is a gap."""
        return self.fixed.get(frame) or self.at[frame].get(t)
