"""Saturated senders of 802.11n and newer round a receiver: aggregation and Block Ack."""
import intervals
import peer
from chart import GREY, Chart, Panel, axis
from document import Row
from runs import ROOT, SCENARIOS

NAME = "aggregation"
TITLE = "Aggregation and Block Ack"
FILES = ("ht_saturation_ns3.csv", "ht_blockack_ns3.csv", "ht_more_ns3.csv", "ht_ampdu_ns3.csv", "vht_he_ns3.csv")
TEXT = """Goodput in Mb/s of MAC payload of saturated senders on a circle (*m*: its radius) round a receiver (`config/scenarios/saturation.yaml`, measured from
1 s to 4 s, several senders of A-MPDUs to 11 s), best effort, without TXOPs, with 95 % intervals of the seeds. *A-MPDU* and *A-MSDU*: longest in bytes, 0: none;
*loss*: share of MPDUs that the receiver drops after they have arrived. Tolerances: one sender 0.5 %; several, single MPDUs 1.5 %, but 2.5 % with 200 bytes and
MCS 7, where an EIFS is as long as several frames (without any, 0.2 % off: `tests/analytic/radio/ht_cell.h`); A-MPDUs: the 95 % interval of the difference
within 4 %, ten seeds on each side; of twenty senders of 802.11n at MCS 4 6 %: ten runs of 3 s of ns-3's spread that much. The window is 64 for ax, too, as in
ns-3.37."""
COLUMNS = ["", "GHz", "MHz", "guard, ns", "MCS", "streams", "m", "bytes", "A-MPDU", "A-MSDU", "loss", "n", "ours", "ns-3", "off"]
KEYS = ("phy", "band_ghz", "width_mhz", "gi_ns", "mcs", "streams", "radius_m", "payload_be", "max_ampdu", "max_amsdu",
        "post_loss", "n_be")
# Of columns that not every table has.
ABSENT = {"streams": "1", "radius_m": "5"}
LEAST_SEEDS = 10


def is_spread(row):
    """Several senders of A-MPDUs, whose goodput differs from seed to seed."""
    return row["n_be"] != "1" and row["max_ampdu"] != "0"


def is_plain(row):
    """Best effort only, with neither TXOPs nor another detector of preambles."""
    usual = {"n_be": row["n_be"], "n_vi": "0", "n_vo": "0", "txop_be_us": "-1", "preamble_db": "4"}
    return row["n_be"] != "0" and all(row.get(key, value) == value for key, value in usual.items())


def cells():
    """Rows of one cell each, which differ by seed; several senders of A-MPDUs with enough seeds only."""
    found = {}
    for file in FILES:
        for row in peer.rows(file):
            if is_plain(row):
                row = {**ABSENT, **row}
                found.setdefault((tuple(place(row)), is_spread(row) and row["seconds"]), []).append(row)
    return [group for (_, _), group in sorted(found.items(), key=lambda one: (one[0][0], str(one[0][1])))
            if not is_spread(group[0]) or len(group) >= LEAST_SEEDS]


def place(row):
    return [row["phy"], *(float(row[key]) for key in KEYS[1:])]


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
            "radio.streams": row["streams"], "agents.sources.circle.radius": f"{row['radius_m']} m", "radio.mcs": row["mcs"], "radio.width": f"{row['width_mhz']} MHz", "radio.guard_interval": f"{row['gi_ns']} ns",
            "radio.aggregation.max_ampdu": row["max_ampdu"], "radio.aggregation.max_amsdu": row["max_amsdu"],
            **({"radio.loss.links": [{"from": "s*", "to": "sink", "probability": loss}]} if loss else {}),
            "agents.sources.circle.count": int(row["n_be"]),
            "agents.sources.controller.parameters.size": int(row["payload_be"]) - 7,
            "radio.aggregation.block_ack_window": 64,  # also of ax
            # As many as one A-MPDU of A-MSDUs can hold.
            "agents.sources.controller.parameters.backlog": 450 if int(row["max_ampdu"]) > 65535 and row["max_amsdu"] != "0" else 200}


def seeds_of(row):
    if row["n_be"] == "1":
        return range(1, 3)
    return range(1, 1 + (LEAST_SEEDS if is_spread(row) else 5))


def tolerance(row):
    if row["n_be"] == "1":
        return 0.5
    if is_spread(row):
        return 6 if (row["phy"], row["mcs"], row["n_be"]) == ("n", "4", "20") else 4
    return 2.5 if (row["mcs"], row["payload_be"]) == ("7", "200") else 1.5


def told(values):
    middle, half = intervals.mean(values)
    return f"{middle:.3f}" + (f" ± {half:.3f}" if len(values) > 2 else "")


def measure(runs, group):
    row = group[0]
    until = 11 if is_spread(row) else 4
    ours = [runs.play(SCENARIOS / "saturation.yaml", settings(row), seed, until).goodput("sink") for seed in seeds_of(row)]
    theirs = [float(one["goodput_mbps"]) for one in group]
    middle = intervals.mean(theirs)[0]
    off = 100 * (intervals.mean(ours)[0] / middle - 1)
    is_interval = len(ours) > 2 and len(theirs) > 2
    half = 100 * intervals.difference(ours, theirs)[1] / middle if is_interval else 0
    what = ", ".join(f"{key} {row[key]}" for key in KEYS)
    most = abs(off) + (half if is_spread(row) else 0)
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
