"""Many stations that broadcast to their neighbours."""
import collections
import math
import random
import statistics

import peer
from chart import Chart, Panel, axis
from document import Row, percent, within
from runs import OWN

NAME = "beacons"
TITLE = "Beacons in a dense field"
FILE = "beacons_ns3.csv"
TEXT = """300 stations, placed uniformly at random, broadcast 64 bytes ten times a second at 1 Mb/s for 3 s, with 12 to 96 neighbours
within the range of 51.3 m (log-distance, exponent 3; `tests/validation/beacons.yaml`). The table shows beacons received per
beacon sent, mean of three fields, which are the same on both sides. Stock ns-3 (its CcaEdThreshold, -62 dBm, applies only
while no frame is on the air) compares the sum of all power with -82 dBm as soon as there is a frame, as
`energy_detection: -82 dBm` does; with that key the tolerance is 1 %. The default is the standard's -70 dBm (16.3.8.5), with
which stations sense fewer distant transmissions, and lose more beacons to them."""
COLUMNS = ["neighbours", "ns-3", "-82 dBm", "off", "-70 dBm, the default", "off"]
STATIONS = 300
RANGE = 10 ** ((16.0206 - 46.6777 + 82) / 30)  # m
SECONDS = 3


def field(neighbours, seed):
    """(x, y, phase) of each station: m, s."""
    chance = random.Random(1000 * neighbours + seed)
    side = math.sqrt(STATIONS * math.pi / neighbours) * RANGE
    return [(round(chance.random() * side, 3), round(chance.random() * side, 3), round(0.1 * chance.random(), 6))
            for _ in range(STATIONS)]


def cases(short):
    groups = collections.defaultdict(list)
    for row in peer.rows(FILE):
        if row["energy_dbm"] == "-62":
            groups[int(row["neighbours"])].append(row)
    return [group for group in groups.items() if not short or group[0] == 12]


def settings(places, energy):
    return {"radio.energy_detection": energy,
            "agents.stations.poses": [{"x": f"{x} m", "y": f"{y} m"} for x, y, _ in places],
            "agents.stations.controller.overrides": [
                {"agents": f"s{i}", "parameters": {"phase": f"{phase} s"}}
                for i, (_, _, phase) in enumerate(places)]}


def per_sent(runs, neighbours, energy):
    shares = []
    for seed in (1, 2, 3):
        run = runs.play(OWN / "beacons.yaml", settings(field(neighbours, seed), energy), seed, SECONDS)
        (received,), = run.query("SELECT sum(count) FROM receptions WHERE verdict = 'delivered'")
        (sent,), = run.query("SELECT sum(count) FROM frames_sent")
        shares.append(received / sent)
    return statistics.mean(shares)


def measure(runs, case):
    neighbours, rows = case
    theirs = statistics.mean(float(row["per_sent"]) for row in rows)
    like_them = per_sent(runs, neighbours, "-82 dBm")
    standard = per_sent(runs, neighbours, "-70 dBm")
    return Row([str(neighbours), f"{theirs:.3f}", f"{like_them:.3f}", percent(like_them, theirs), f"{standard:.3f}",
                percent(standard, theirs)],
               within(like_them, theirs, 0.01, what=f"{neighbours} neighbours"),
               (neighbours, theirs, like_them, standard))


def draw(rows):
    neighbours, theirs, like_them, standard = zip(*(row.data for row in rows))
    panel = Panel(x=axis("neighbours"), y=axis("received per sent", limits=(0, None)))
    panel.line(neighbours, like_them, curve=0, label="ours, -82 dBm")
    panel.line(neighbours, standard, curve=1, dash="dashed", label="ours, -70 dBm")
    panel.marks(neighbours, theirs, "cross", curve=2, label="ns-3")
    return Chart(panel, title=TITLE)
