"""AODV on a grid, beside ns-3's."""
import collections
import random
import statistics

import peer
from document import Row, percent, pyplot, within
from runs import OWN

NAME = "aodv"
TITLE = "AODV on a grid"
FILE = "aodv_ns3.csv"
TEXT = """25 stations in a grid, 40 m apart, of which those side by side hear each other (51.3 m at 1 Mb/s, log-distance, exponent
3), with AODV; 2 to 8 flows of 64 bytes at 4 Hz between stations drawn at random, from 5 to 10 s until 100 s
(`tests/validation/aodv.yaml`, `tests/peer/ns3/aodv.cc`). Five draws, the same on both sides; mean of what arrived and of the medians
of the delays, searches included. Asked for: 3 points, and 20 %. The frames of data are equally long, those of AODV 25 bytes
shorter than over UDP and IP; ours sends hellos only on active routes (RFC 3561, 6.9), ns-3 always; ns-3 has no ARP here."""
COLUMNS = ["flows", "delivered, ns-3", "ours", "points off", "median delay, ns-3", "ours", "off"]
STATIONS = 25
STOP = 100  # s
FLOWS = (2, 4, 6, 8)
SEEDS = (1, 2, 3, 4, 5)


def flows(count, seed):
    """(source, destination, start [s]) of each flow; no station is the source of two."""
    chance = random.Random(1000 * count + seed)
    sources = chance.sample(range(STATIONS), count)
    result = []
    for source in sources:
        destination = chance.choice([one for one in range(STATIONS) if one != source])
        result.append((source, destination, round(5 + chance.random() * 5, 6)))
    return result


def cases(short):
    groups = collections.defaultdict(list)
    for row in peer.rows(FILE):
        groups[int(row["flows"])].append(row)
    return [group for group in groups.items() if not short or group[0] == FLOWS[0]]


def settings(count, seed):
    return {"agents.stations.controller.overrides": [
        {"agents": f"s{source}", "parameters": {"to": f"s{destination}", "start": f"{start} s", "phase": "0 s",
                                                "stop": f"{STOP} s"}}
        for source, destination, start in flows(count, seed)]}


def figures(runs, count, seed):
    """Share that arrived, and the median of the delays in ms."""
    run = runs.play(OWN / "aodv.yaml", settings(count, seed), seed)
    (sent,), = run.query("SELECT count(*) FROM messages")
    delays = [delay / 1e6 for delay, in run.query("SELECT delay_ns FROM deliveries")]
    return len(delays) / sent, statistics.median(delays)


def measure(runs, case):
    count, rows = case
    theirs = [statistics.mean(float(row[key]) for row in rows) for key in ("per_sent", "median_ms")]
    ours = [statistics.mean(one) for one in zip(*(figures(runs, count, seed) for seed in SEEDS))]
    what = f"{count} flows"
    return Row([str(count), f"{100 * theirs[0]:.2f} %", f"{100 * ours[0]:.2f} %", f"{100 * (ours[0] - theirs[0]):+.2f}",
                f"{theirs[1]:.2f} ms", f"{ours[1]:.2f} ms", percent(ours[1], theirs[1])],
               within(ours[0], theirs[0], absolute=0.03, what=f"{what}, delivered") or
               within(ours[1], theirs[1], 0.2, what=f"{what}, median delay"),
               (count, theirs, ours))


def draw(rows):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2)
    data = [row.data for row in rows]
    for axis, which, scale, label in ((axes[0], 0, 100, "delivered, %"), (axes[1], 1, 1, "median delay, ms")):
        axis.plot([one[0] for one in data], [scale * one[2][which] for one in data], "-", label="ours")
        axis.plot([one[0] for one in data], [scale * one[1][which] for one in data], "x", label="ns-3")
        axis.set(xlabel="flows", ylabel=label, ylim=(0, None))
        axis.legend()
    return figure
