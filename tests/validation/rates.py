"""A sender that chooses its rates."""
import itertools

import intervals
import peer
from chart import Chart, Panel, around, axis
from document import Row
from runs import OWN, radio_like

NAME = "rates"
TITLE = "Rate control"
FILE = "rates_ns3.csv"
SEEDS = range(1, 11)
TEXT = """Goodput in Mb/s, 1500 bytes, of a saturated sender with rate control (`tests/validation/rates.yaml`; log-distance, exponent 3,
frames received at every level; 802.11g up to 54 Mb/s with slot 9 us, 802.11b up to 11 Mb/s): ten seeds of 10 s, 95 % intervals. *ns-3* is
stock ns-3.37, *changed* is a copy with one change, which shows where it deviates from the published algorithm; ours is compared
with the last column that the row has. Tolerance: the interval of the difference within 5 %.

AARF: stock ns-3 increases its rates in the order in which a station announced them, 11 Mb/s before 6 Mb/s, and so alternates below
11 Mb/s where that rate fails (*ascending*: announced in ascending order). Its threshold grows to 60, the paper's to 50, and its timer doubles
without limit; at 105 m a threshold of 50 changes goodput by 0.1 % and a timer that does not grow by 2.3 % (`threshold_50` and `timer_1` in the table of ns-3).
With the stock basic rates of its ad hoc networks, where ACKs use up to 11 Mb/s, ns-3 has 6.37 Mb/s at 60 m and 1.70 at 105 m (three
seeds), ours with `basic_rates: [1 Mb/s, 2 Mb/s, 5.5 Mb/s, 11 Mb/s]` 6.38 and 1.70 (one seed).

Minstrel: ns-3 does not count frames that sample a slower rate but succeed before they reach it, so it continues to sample, at faster
rates as often as permitted: at 28 m in 8 of 100 frames at 48 and 54 Mb/s, which fail. Linux counts each sampling frame (*counted*: a copy of ns-3
in which `UpdatePacketCounters` does), as ours does. Frames at rates down to 1 Mb/s sample rates not tried in 20 intervals: both have them."""
COLUMNS = ["radio", "rates", "m", "ours", "ns-3", "off", "changed", "ns-3 changed", "off"]
KEYS = ("phy", "manager", "distance_m")
CHANGED = {("g", "aarf"): "ascending", ("g", "minstrel"): "counted", ("b", "minstrel"): "counted"}
OFF = 5  # per cent
# No detector of preambles.
EVERY_FRAME = {"radio.sensitivity": "-101 dBm", "radio.cca_threshold": "-101 dBm", "radio.min_sinr": "-20 dB"}


def cases(short):
    rows = sorted(peer.rows(FILE), key=lambda row: [row["phy"], row["manager"], float(row["distance_m"])])
    groups = [list(group) for _, group in itertools.groupby(rows, lambda row: [row[key] for key in KEYS])]
    return [group for group in groups if group[0]["phy"] == "b" or not short]


def goodputs(runs, row):
    is_g = row["phy"] == "g"
    settings = {**radio_like("g54" if is_g else "b11", row["control"], row["slot_us"]),
                **EVERY_FRAME, "radio.rate_control": row["manager"],
                "agents.receiver.poses": [{"x": f"{row['distance_m']} m", "y": "0 m"}]}
    return [runs.play(OWN / "rates.yaml", settings, seed, 11).goodput("receiver") for seed in SEEDS]


def told(values):
    middle, half = intervals.mean(values)
    return f"{middle:.3f} ± {half:.3f}"


def off(ours, theirs):
    middle = intervals.mean(theirs)[0]
    return [100 * value / middle for value in intervals.difference(ours, theirs)]


def measure(runs, group):
    row = group[0]
    ours = goodputs(runs, row)
    changed = CHANGED.get((row["phy"], row["manager"]))
    by_peer = {name: [float(one["goodput_mbps"]) for one in group if one["peer"] == name] for name in ("stock", changed)}
    differences = {name: off(ours, theirs) for name, theirs in by_peer.items() if theirs}
    words = {name: f"{middle:+.1f} ± {half:.1f} %" for name, (middle, half) in differences.items()}
    middle, half = differences[changed or "stock"]
    what = f"802.11{row['phy']}, {row['manager']}, {row['distance_m']} m"
    mistake = "" if abs(middle) + half <= OFF else f"{what}: off by up to {abs(middle) + half:.1f} %"
    return Row([f"802.11{row['phy']}", row["manager"], row["distance_m"], told(ours), told(by_peer["stock"]),
                words["stock"], changed or "-", told(by_peer[changed]) if changed else "-",
                words[changed] if changed else "-"], mistake,
               (row, intervals.mean(ours), *(intervals.mean(by_peer[name]) for name in ("stock", changed or "stock"))))


def draw(rows):
    panels = []
    for manager in ("aarf", "minstrel"):
        some = [one.data for one in rows if one.data[0]["phy"] == "g" and one.data[0]["manager"] == manager]
        panel = Panel(f"802.11g, {manager}", axis("distance, m"), axis("goodput, Mb/s", limits=(0, None)))
        distances = [float(one[0]["distance_m"]) for one in some]
        panel.line(distances, [one[1][0] for one in some], curve=0, label="ours")
        for curve, (column, name, shape) in enumerate(((1, "ours", "circle"), (2, "ns-3", "cross"), (3, "ns-3 changed", "plus"))):
            means, halves = zip(*(one[column] for one in some))
            panel.marks(distances, means, shape, around(means, halves), curve=curve, label=name)
        panels.append(panel)
    return Chart(*panels, title=TITLE, columns=2, shares="y")
