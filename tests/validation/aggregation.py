"""Saturated senders of 802.11n and newer round a receiver: aggregation and Block Ack."""
import itertools

import intervals
import peer
from chart import GREY, Chart, Panel, axis
from document import Row
from runs import ROOT, SCENARIOS

NAME = "aggregation"
TITLE = "Aggregation and Block Ack"
FILES = ("ht_saturation_ns3.csv", "ht_blockack_ns3.csv", "ht_more_ns3.csv")
TEXT = """Goodput in Mb/s of MAC payload of saturated senders on a circle of 5 m round a receiver (`config/scenarios/saturation.yaml`, measured from
1 s to 4 s), best effort, without TXOPs, with 95 % intervals of the seeds. *A-MPDU* and *A-MSDU*: longest in bytes, 0: none; *loss*:
share of MPDUs that the receiver drops after they have arrived. Tolerances: one sender 0.5 %; several, single MPDUs 1.5 %; A-MPDUs 4 %."""
COLUMNS = ["", "GHz", "MHz", "guard, ns", "MCS", "bytes", "A-MPDU", "A-MSDU", "loss", "n", "ours", "ns-3", "off"]
KEYS = ("phy", "band_ghz", "width_mhz", "gi_ns", "mcs", "payload_be", "max_ampdu", "max_amsdu", "post_loss", "n_be")


def cells():
    """Rows of one cell each, which differ by seed."""
    rows = [row for file in FILES for row in peer.rows(file)]

    def place(row):
        return [row["phy"], *(float(row[key]) for key in KEYS[1:])]

    return [list(group) for _, group in itertools.groupby(sorted(rows, key=place), place)]


def cases(short):
    if not short:
        return cells()
    return [group for group in cells() if group[0]["mcs"] == "7" and group[0]["n_be"] == "1" and
            group[0]["width_mhz"] == "20" and group[0]["gi_ns"] == "800"]


def settings(row):
    """What stock ns-3 has where it differs from the standard (docs/models.md, 10)."""
    channel = {} if row["band_ghz"] == "2.4" or row["phy"] != "n" else {"radio.channel": 36}
    loss = float(row["post_loss"])
    return {"radio.include": ROOT / f"config/radios/ieee80211{row['phy']}.yaml", **channel,
            "radio.propagation": [{"model": "log_distance"}],
            "radio.energy_detection": "-82 dBm", "radio.bits_at_risk": "payload_time", "radio.ppdu_times": "ns3",
            "radio.mcs": row["mcs"], "radio.width": f"{row['width_mhz']} MHz", "radio.guard_interval": f"{row['gi_ns']} ns",
            "radio.aggregation.max_ampdu": row["max_ampdu"], "radio.aggregation.max_amsdu": row["max_amsdu"],
            **({"radio.loss.links": [{"from": "s*", "to": "sink", "probability": loss}]} if loss else {}),
            "agents.sources.circle.count": int(row["n_be"]),
            "agents.sources.controller.parameters.size": int(row["payload_be"]) - 7,
            "agents.sources.controller.parameters.backlog": 200}


def seeds_of(row):
    if row["n_be"] == "1":
        return range(1, 3)
    return range(1, 11 if row["max_ampdu"] != "0" else 6)


def tolerance(row):
    if row["n_be"] == "1":
        return 0.5
    return 4 if row["max_ampdu"] != "0" else 1.5


def told(values):
    middle, half = intervals.mean(values)
    return f"{middle:.3f}" + (f" ± {half:.3f}" if len(values) > 2 else "")


def measure(runs, group):
    row = group[0]
    ours = [runs.play(SCENARIOS / "saturation.yaml", settings(row), seed, 4).goodput("sink") for seed in seeds_of(row)]
    theirs = [float(one["goodput_mbps"]) for one in group]
    middle = intervals.mean(theirs)[0]
    off = 100 * (intervals.mean(ours)[0] / middle - 1)
    is_interval = len(ours) > 2 and len(theirs) > 2
    half = 100 * intervals.difference(ours, theirs)[1] / middle if is_interval else 0
    what = ", ".join(f"{key} {row[key]}" for key in KEYS)
    # The interval where there are ten seeds on each side, else the mean.
    most = abs(off) + (half if len(theirs) >= 10 else 0)
    mistake = "" if most <= tolerance(row) else f"{what}: off by {most:.2f} %"
    return Row([f"802.11{row['phy']}", *(f"{float(row[key]):g}" for key in KEYS[1:]), told(ours), told(theirs),
                f"{off:+.2f}" + (f" ± {half:.2f}" if is_interval else "") + " %"], mistake,
               (row, intervals.mean(ours)[0], middle))


def draw(rows):
    panels = []
    for size in ("1500", "200"):
        panel = Panel(f"802.11n, MCS 7, 20 MHz, {size} bytes", axis("senders", ticks=(1, 5)),
                      axis("goodput, Mb/s", limits=(0, None)))
        for curve, most in enumerate(("0", "65535")):
            some = [one.data for one in rows if one.data[0]["payload_be"] == size and one.data[0]["max_ampdu"] == most and
                    one.data[0]["mcs"] == "7" and one.data[0]["width_mhz"] == "20" and one.data[0]["band_ghz"] == "2.4" and
                    one.data[0]["gi_ns"] == "800" and one.data[0]["max_amsdu"] == "0" and float(one.data[0]["post_loss"]) == 0]
            n = [int(one[0]["n_be"]) for one in some]
            panel.line(n, [one[1] for one in some], curve=curve, label="single MPDUs" if most == "0" else "A-MPDU")
            panel.marks(n, [one[2] for one in some], "cross", curve=curve)
        panel.line([], [], curve=GREY, label="ours")
        panel.marks([], [], "cross", curve=GREY, label="ns-3")
        panels.append(panel)
    return Chart(*panels, title=TITLE, columns=2, size=(760, 340))
