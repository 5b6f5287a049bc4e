"""The closed form of config/scenarios/teleop_behind_a_wall.yaml, and the figure of its page. It needs the right to make user
namespaces."""
import bisect
import pathlib
import subprocess

from chart import Chart, Panel, axis, series
from runs import SCENARIOS, Run

LANE, WALL = 8, ((-2, 3.85), (2, 4.15))  # m north of the operator's way; corners
OPERATOR, ROBOT = 1, 2                   # addresses
STEP = 0.05                              # s: how finely times are looked for


def operator_at(t):
    """m east; it walks along the x axis and then stands."""
    return -13 + min(1.2 * t, 22)


def is_behind_the_wall(operator, robot):
    """Whether the straight line from (operator, 0) to (robot, LANE) meets the wall."""
    xs = [operator + (robot - operator) * y / LANE for y in (WALL[0][1], WALL[1][1])]
    return max(xs) > WALL[0][0] and min(xs) < WALL[1][0]


class Drive:
    """What became of the robot in a run."""

    def __init__(self, run):
        self.commands = run.query("SELECT at_ns / 1e9, value FROM recorded WHERE name = 'commands' "
                                  f"AND agent = {ROBOT} ORDER BY at_ns")
        self.states = run.query(f"SELECT at_ns / 1e9, state FROM states WHERE agent = {ROBOT} ORDER BY at_ns")
        self.way = run.query(f"SELECT at_ns / 1e9, x_m FROM poses WHERE agent = {ROBOT} ORDER BY at_ns")
        self.end = run.query("SELECT value FROM run WHERE key = 'ended_ns'")[0][0]
        self.end = int(self.end) / 1e9

    def place(self, t):
        """m east, at a time: poses are recorded while it moves."""
        k = bisect.bisect_right([at for at, _ in self.way], t)
        if k in (0, len(self.way)):
            return self.way[max(k - 1, 0)][1]
        (before, x), (after, further) = self.way[k - 1:k + 1]
        return x + (further - x) * (t - before) / (after - before)

    def received(self, begin, end):
        """Commands within a time, s."""
        until = [[0] + [n for t, n in self.commands if t <= limit] for limit in (begin, end)]
        return until[1][-1] - until[0][-1]

    def shadow(self):
        """From when to when, s, the wall is between the two; none: never."""
        times = [i * STEP for i in range(int(self.end / STEP))]
        behind = [t for t in times if is_behind_the_wall(operator_at(t), self.place(t))]
        return (behind[0], behind[-1]) if behind else None


def teleop_behind_a_wall(runs):
    folder = pathlib.Path(runs.folder.name) / "teleop"
    scenario = SCENARIOS / "teleop_behind_a_wall.yaml"
    subprocess.run([runs.program, "run", scenario, "--no-inspect", "--out", folder, "--log", "error"], check=True,
                   capture_output=True)
    return figure_of(Drive(Run(folder)))


def figure_of(drive):
    received = Panel(x=axis(limits=(0, drive.end)), y=axis("commands per second"))
    seconds = range(int(drive.end))
    received.span(*drive.shadow(), label="the wall is between them")
    received.bars([second + 0.5 for second in seconds], series("", [drive.received(one, one + 1) for one in seconds], 0))
    way = Panel(x=axis("time, s", limits=(0, drive.end)), y=axis("way east, m"))
    way.span(*drive.shadow())
    times = [i / 10 for i in range(int(10 * drive.end))]
    way.line(times, [drive.place(t) for t in times], curve=0, label="robot")
    way.line(times, [operator_at(t) for t in times], curve=1, label="operator")
    for at, state in drive.states[1:]:
        way.vertical(at, curve=0, dash="dotted")
        way.text(at, 9, state, curve=0)
    return Chart(received, way, title="A robot that is driven by hand behind a wall", size=(640, 480))
