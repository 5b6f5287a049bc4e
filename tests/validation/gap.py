"""What became of the reports in runs of bridge_the_gap.yaml."""
from chart import Chart, Panel, axis
from runs import SCENARIOS

FAILS = 60   # s: the relay
SETTLED = 10  # s after the robot is there: routes have to be found again
NEAR = 20     # s before: some metres from its place it is within reach of both sides already


def bridged_at(run):
    """{robot: s}, of those that took the place of the relay."""
    return {name: ns / 1e9 for name, ns in run.query(
        "SELECT name, MIN(at_ns) FROM states JOIN agents USING (agent) WHERE state = 'BRIDGE' GROUP BY name")}


def reports(run, motes):
    """(time sent in s, whether it got to the sink) of the reports of some motes."""
    names = ", ".join(f"'{one}'" for one in motes)
    return [(ns / 1e9, verdict == "delivered") for ns, verdict in run.query(
        f"SELECT sent_ns, verdict FROM messages JOIN agents ON agent = sender WHERE topic = 'report' AND name IN ({names}) "
        "ORDER BY sent_ns")]


def delivery(run, motes):
    """Shares of their reports that got to the sink: before the failure, until the robot was near, and after."""
    there = min(bridged_at(run).values())
    end = run.query("SELECT value FROM run WHERE key = 'simulated_s'")[0][0]
    shares = []
    for start, stop in ((5, FAILS - 2), (FAILS, there - NEAR), (there + SETTLED, end - 2)):
        got = [arrived for at, arrived in reports(run, motes) if start <= at < stop]
        shares.append(sum(got) / len(got))
    return shares


WINDOW = 10  # s, of a point in the figure


def bridge_the_gap(runs):
    """Share of the reports of the motes beyond the gap that got to the sink, with robots and without."""
    panel = Panel(x=axis("time, s"), y=axis("share of the reports of m3, m4, m5 delivered", limits=(-0.03, 1.03)))
    end = [{"at": "220 s", "result": "done"}]
    for curve, (name, settings) in enumerate((("two robots", {}), ("both without energy", {
            "agents.rested.controller.parameters": {"reserve": "1 J"}, "agents.tired.controller.parameters": {"reserve": "1 J"}}))):
        run = runs.play(SCENARIOS / "bridge_the_gap.yaml", {"end": end, "expect": [], **settings})
        sent = reports(run, ("m3", "m4", "m5"))
        points = {}
        for at, arrived in sent:
            points.setdefault(int(at / WINDOW), []).append(arrived)
        panel.line_and_marks([(one + 0.5) * WINDOW for one in points], [sum(got) / len(got) for got in points.values()],
                             curve=curve, label=name)
        for robot, at in bridged_at(run).items():
            panel.vertical(at, curve=curve, dash="dashed")
            panel.text(at, 0.9, f"{robot} is there", curve=curve)
    panel.vertical(FAILS, dash="dotted")
    panel.text(FAILS, 0.9, "m2 fails")
    return Chart(panel, title="What became of the reports")
