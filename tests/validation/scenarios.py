"""Figures of the pages of docs/scenarios, from runs of the scenarios as they are shipped."""
import csv
import math

import air_scenarios
import labour
from document import pyplot
from gap import bridge_the_gap
from runs import OWN, SCENARIOS
from teleop import teleop_behind_a_wall

RTS = {"radio.rts_threshold": 0}


def saturation(runs):
    senders = (1, 2, 5, 10, 20, 50)
    plt = pyplot()
    figure, axis = plt.subplots()
    for name, more in (("without", {}), ("with RTS/CTS", RTS)):
        axis.plot(senders, [runs.play(SCENARIOS / "saturation.yaml", {"agents.sources.circle.count": n, **more})
                            .goodput("sink") for n in senders], "o-", label=name)
    axis.set(xscale="log", xlabel="senders", ylabel="goodput, Mb/s", ylim=(0, None))
    axis.set_xticks(senders, [str(n) for n in senders])
    axis.legend()
    return figure


def hidden_terminal(runs):
    rates = ("1", "2", "5.5", "11")
    plt = pyplot()
    figure, axis = plt.subplots()
    for shift, name, more in ((-0.2, "without", {}), (0.2, "with RTS/CTS", RTS)):
        axis.bar([i + shift for i in range(len(rates))],
                 [runs.play(SCENARIOS / "hidden_terminal.yaml", {"radio.data_rate": f"{one} Mb/s", **more})
                  .goodput("receiver") for one in rates], 0.4, label=name)
    axis.set_xticks(range(len(rates)), [f"{one} Mb/s" for one in rates])
    axis.set(ylabel="goodput of both, Mb/s")
    axis.legend()
    return figure


def range_(runs):
    plt = pyplot()
    figure, axis = plt.subplots()
    reach = 299792458 / 2.412e9 / (4 * math.pi) * math.sqrt(40 / 10 ** -8.2)
    for name, settings in (("-82 dBm", {}), ("exponent 2.5", {"radio.path_loss_exponent": 2.5})):
        recorded = runs.play(SCENARIOS / "range.yaml", settings).recorded()
        axis.plot([50 * (i + 1) for i in range(20)],
                  [recorded[f"p{i}"]["received"] / recorded["sender"]["sent"] for i in range(20)], "o-", label=name)
    axis.axvline(reach, color="0.5", linestyle=":", label=f"Friis: {reach:.1f} m")
    axis.axvline(reach ** (2 / 2.5), color="C1", linestyle=":")
    axis.set(xlabel="distance, m", ylabel="share received")
    axis.legend()
    return figure


def near_far(runs):
    plt = pyplot()
    figure, axis = plt.subplots()
    margins = ("none", "15 dB", "10 dB", "5 dB")
    played = [runs.play(SCENARIOS / "near_far.yaml", {"radio.capture_margin": margin}).recorded() for margin in margins]
    for shift, station in ((-0.2, "near"), (0.2, "far")):
        bars = axis.bar([i + shift for i in range(len(margins))], [one[station]["handed_over"] for one in played], 0.4,
                        label=station)
        axis.bar_label(bars, fmt="%d", fontsize=7)
    axis.set_xticks(range(len(margins)), [f"capture {one}" for one in margins])
    axis.set(ylabel="frames acknowledged in 8.2 s")
    axis.legend()
    return figure


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
    plt = pyplot()
    figure, axis = plt.subplots()
    for colour, settings in (("C0", {}), ("C1", {"radio.obstacles": False})):
        way = way_of_the_robot(runs.play(SCENARIOS / "behind_a_wall.yaml", settings))
        name = "without" if settings else "with"
        axis.plot([one[0] for one in way], [rssi_behind_a_wall(one[:2], not settings) for one in way], "-", color=colour,
                  alpha=0.6, label=f"closed form, {name} the wall")
        for delivered, mark in ((True, "o"), (False, "x")):
            some = [one for one in way if one[3] == delivered][::8]
            axis.plot([one[0] for one in some], [one[2] for one in some], mark, color=colour, markersize=3,
                      label=f"{'received' if delivered else 'lost'}, {name}" if some else None)
    axis.axhline(-82, color="0.5", linestyle=":")
    axis.set(xlabel="x of the robot, m", ylabel="RSSI, dBm")
    axis.legend(fontsize=7)
    return figure


def handover(runs):
    """Longest gap in each half second between the messages that the server gets, and when the walker changes over. Without a
    scan and without keys: a lower bound."""
    plt = pyplot()
    figure, axis = plt.subplots()
    for colour, hysteresis in (("C0", "4 dB"), ("C1", "40 dB")):
        run = runs.play(SCENARIOS / "handover.yaml", {"radio.bss.hysteresis": hysteresis})
        arrived = [at / 1e9 for at, in run.query("SELECT d.at_ns FROM deliveries d JOIN agents a ON a.agent = d.receiver "
                                                 "WHERE a.name = 'server' ORDER BY d.at_ns")]
        longest = {}
        for here, there in zip(arrived, arrived[1:]):
            half = int(2 * here) / 2
            longest[half] = max(longest.get(half, 0), 1e3 * (there - here))
        axis.plot(list(longest), list(longest.values()), ".", color=colour, label=f"hysteresis {hysteresis}")
        for at, name in run.query("SELECT s.at_ns, a.name FROM associations s JOIN agents w ON w.agent = s.station "
                                  "LEFT JOIN agents a ON a.agent = s.access_point WHERE w.name = 'walker'"):
            axis.axvline(at / 1e9, color=colour, linestyle=":", alpha=0.7)
            axis.text(at / 1e9, 1500, f" {name or 'none'}", color=colour, fontsize=7, rotation=90, va="top")
    axis.set(xlabel="time, s", ylabel="longest gap between messages, ms", yscale="log", ylim=(1, 2000))
    axis.legend(fontsize=7, loc="center right")
    return figure


def anthocnet_base_field(runs):
    """From the rows that tests/bench/routing/base_field.py left: the runs take an hour."""
    with (OWN / "anthocnet_base_field.csv").open(newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    names = list(dict.fromkeys(row["algorithm"] for row in rows))
    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(8, 3), layout="constrained")
    for axis, measure, label in zip(axes, ("delivery", "delay_mean", "frames"),
                                    ("delivered, %", "mean delay, ms", "frames per message delivered")):
        for place, name in enumerate(names):
            values = [float(row[measure]) for row in rows if row["algorithm"] == name]
            axis.plot([place] * len(values), values, "o", markersize=3, alpha=0.5, color=f"C{place}")
            axis.plot(place, sum(values) / len(values), "_", markersize=18, color=f"C{place}")
        axis.set_xticks(range(len(names)), names, fontsize=7)
        axis.set(ylabel=label, xlim=(-0.5, len(names) - 0.5))
    return figure


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
