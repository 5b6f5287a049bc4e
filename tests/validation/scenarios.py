"""Figures of the pages of docs/scenarios, from runs of the scenarios as they are shipped."""
import csv
import math

import air_scenarios
import labour
from chart import Chart, Panel, axis, series
from gap import bridge_the_gap
from runs import OWN, SCENARIOS
from teleop import teleop_behind_a_wall

RTS = {"radio.rts_threshold": 0}


def saturation(runs):
    senders = (1, 2, 5, 10, 20, 50)
    panel = Panel(x=axis("senders", log=True, ticks=senders), y=axis("goodput, Mb/s", limits=(0, None)))
    for curve, (name, more) in enumerate((("without", {}), ("with RTS/CTS", RTS))):
        panel.line_and_marks(senders, [runs.play(SCENARIOS / "saturation.yaml", {"agents.sources.circle.count": n, **more})
                                       .goodput("sink") for n in senders], curve=curve, label=name)
    return Chart(panel, title="Goodput of saturated senders")


def hidden_terminal(runs):
    rates = ("1", "2", "5.5", "11")
    panel = Panel(x=axis(names=[f"{one} Mb/s" for one in rates]), y=axis("goodput of both, Mb/s"))
    panel.bars(range(len(rates)), *(
        series(name, [runs.play(SCENARIOS / "hidden_terminal.yaml", {"radio.data_rate": f"{one} Mb/s", **more})
                      .goodput("receiver") for one in rates], curve)
        for curve, (name, more) in enumerate((("without", {}), ("with RTS/CTS", RTS)))))
    return Chart(panel, title="Goodput of two senders that do not hear each other")


def range_(runs):
    panel = Panel(x=axis("distance, m"), y=axis("share received"))
    reach = 299792458 / 2.412e9 / (4 * math.pi) * math.sqrt(40 / 10 ** -8.2)
    for curve, (name, settings) in enumerate((("-82 dBm", {}), ("exponent 2.5", {"radio.path_loss_exponent": 2.5}))):
        recorded = runs.play(SCENARIOS / "range.yaml", settings).recorded()
        panel.line_and_marks([50 * (i + 1) for i in range(20)],
                             [recorded[f"p{i}"]["received"] / recorded["sender"]["sent"] for i in range(20)],
                             curve=curve, label=name)
    panel.vertical(reach, dash="dotted", label=f"Friis: {reach:.1f} m")
    panel.vertical(reach ** (2 / 2.5), curve=1, dash="dotted")
    return Chart(panel, title="Share of the frames received by distance")


def near_far(runs):
    margins = ("none", "15 dB", "10 dB", "5 dB")
    played = [runs.play(SCENARIOS / "near_far.yaml", {"radio.capture_margin": margin}).recorded() for margin in margins]
    panel = Panel(x=axis(names=[f"capture {one}" for one in margins]), y=axis("frames acknowledged in 8.2 s"))
    counts = {station: [one[station]["handed_over"] for one in played] for station in ("near", "far")}
    panel.bars(range(len(margins)), *(series(station, some, curve, texts=[f"{one:.0f}" for one in some])
                                      for curve, (station, some) in enumerate(counts.items())))
    return Chart(panel, title="Frames of a near and of a far station")


WALL = ((-5, 4.85), (5, 5.15))     # m: behind_a_wall.yaml
POWER, REFERENCE, EXPONENT = 10 * math.log10(5), 46.6777, 3
PER_CROSSING, PER_METRE = 15, 0.4  # dB, dB/m


def inside(end, box):
    """Length of the way from the origin to `end` inside a box, m (slabs)."""
    low, high = 0.0, 1.0
    for to, least, most in zip(end, *box):
        if to == 0:
            if not least <= 0 <= most:
                return 0.0
            continue
        first, last = sorted((least / to, most / to))
        low, high = max(low, first), min(high, last)
    return max(0.0, high - low) * math.hypot(*end)


def rssi_behind_a_wall(place, has_wall=True):
    """Closed form, dBm: of a frame of the post at the origin."""
    length = inside(place, WALL) if has_wall else 0
    wall = PER_CROSSING + PER_METRE * length if length > 0 else 0
    return POWER - REFERENCE - 10 * EXPONENT * math.log10(math.hypot(*place)) - wall


def way_of_the_robot(run):
    """[(x, y, rssi, delivered)] of each frame of the post; places interpolated between recorded poses. m, dBm."""
    poses = run.query("SELECT p.at_ns, p.x_m, p.y_m FROM poses p JOIN agents a USING (agent) WHERE a.name = 'robot' "
                      "ORDER BY p.at_ns")
    heard = run.query("SELECT f.at_ns, e.rssi_dbm, e.verdict FROM frame_ends e JOIN frames f USING (frame) "
                      "JOIN agents a ON a.agent = e.agent WHERE a.name = 'robot' ORDER BY f.at_ns")
    way, i = [], 0
    for at, rssi, verdict in heard:
        while i + 2 < len(poses) and poses[i + 1][0] <= at:
            i += 1
        (t, x, y), (t_next, x_next, y_next) = poses[i], poses[i + 1]
        share = (at - t) / (t_next - t)
        way.append((x + share * (x_next - x), y + share * (y_next - y), rssi, verdict == "delivered"))
    return way


def behind_a_wall(runs):
    panel = Panel(x=axis("x of the robot, m"), y=axis("RSSI, dBm"))
    for curve, (name, settings) in enumerate((("with", {}), ("without", {"radio.obstacles": False}))):
        way = way_of_the_robot(runs.play(SCENARIOS / "behind_a_wall.yaml", settings))
        panel.line([one[0] for one in way], [rssi_behind_a_wall(one[:2], not settings) for one in way], curve=curve,
                   opacity=0.6, label=f"closed form, {name} the wall")
        for delivered, shape in ((True, "circle"), (False, "cross")):
            some = [one for one in way if one[3] == delivered][::8]
            if some:
                panel.marks([one[0] for one in some], [one[2] for one in some], shape, curve=curve, scale=0.7,
                            label=f"{'received' if delivered else 'lost'}, {name}")
    panel.horizontal(-82, dash="dotted")
    return Chart(panel, title="RSSI of a robot behind a wall")


def handover(runs):
    """Longest gap in each half second between the messages that the server gets, and when the walker changes over. Without a
    scan and without keys: a lower bound."""
    panel = Panel(x=axis("time, s"), y=axis("longest gap between messages, ms", log=True, limits=(1, 2000)))
    for curve, hysteresis in enumerate(("4 dB", "40 dB")):
        run = runs.play(SCENARIOS / "handover.yaml", {"radio.bss.hysteresis": hysteresis})
        arrived = [at / 1e9 for at, in run.query("SELECT d.at_ns FROM deliveries d JOIN agents a ON a.agent = d.receiver "
                                                 "WHERE a.name = 'server' ORDER BY d.at_ns")]
        longest = {}
        for here, there in zip(arrived, arrived[1:]):
            half = int(2 * here) / 2
            longest[half] = max(longest.get(half, 0), 1e3 * (there - here))
        panel.marks(list(longest), list(longest.values()), scale=0.5, curve=curve, label=f"hysteresis {hysteresis}")
        for at, name in run.query("SELECT s.at_ns, a.name FROM associations s JOIN agents w ON w.agent = s.station "
                                  "LEFT JOIN agents a ON a.agent = s.access_point WHERE w.name = 'walker'"):
            panel.vertical(at / 1e9, curve=curve, dash="dotted", opacity=0.7)
            panel.text(at / 1e9, 1500, name or "none", curve=curve)
    return Chart(panel, title="Gaps between the messages of a station that changes over")


def anthocnet_base_field(runs):
    """From the rows that tests/bench/routing/base_field.py left: the runs take an hour."""
    with (OWN / "anthocnet_base_field.csv").open(newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    names = list(dict.fromkeys(row["algorithm"] for row in rows))
    panels = []
    for measure, label in (("delivery", "delivered, %"), ("delay_mean", "mean delay, ms"),
                           ("frames", "frames per message delivered")):
        panel = Panel(x=axis(names=names), y=axis(label))
        for place in range(len(names)):
            values = [float(row[measure]) for row in rows if row["algorithm"] == names[place]]
            panel.marks([place] * len(values), values, scale=0.7, opacity=0.5, curve=place)
            panel.line([place - 0.25, place + 0.25], [sum(values) / len(values)] * 2, curve=place, stroke=2)
        panels.append(panel)
    return Chart(*panels, title="AntHocNet and AODV", columns=3, size=(800, 320))


PAGES = {"saturation": saturation, "hidden_terminal": hidden_terminal, "range": range_, "near_far": near_far,
         "behind_a_wall": behind_a_wall, "bridge_the_gap": bridge_the_gap,
         "handover": handover, "anthocnet_base_field": anthocnet_base_field, "teleop_behind_a_wall": teleop_behind_a_wall,
         "division_of_labour": labour.division_of_labour}


def figures(runs, only):
    """(name, figure) of each scenario that is there, or of those in `only`; of what runs in real time only these."""
    for name, draw in {**PAGES, **air_scenarios.PAGES}.items():
        is_asked = name in only if only else name in PAGES
        if is_asked and (SCENARIOS / f"{name}.yaml").exists():
            yield name, draw(runs)
