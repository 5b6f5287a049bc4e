"""Saturated senders of 802.11ax round a receiver, beside Bianchi's closed form."""
import statistics

import peer
from chart import GREY, Chart, Panel, axis
from document import Row
from runs import ROOT, SCENARIOS

NAME = "he"
TITLE = "802.11ax beside Bianchi's form"
FILE = "bianchi_he.csv"
SEEDS = (1, 2, 3)
TEXT = """Goodput in Mb/s of MAC payload, 1500 bytes in single MPDUs, mean of three seeds, beside Bianchi's closed form (IEEE JSAC 2000) with the times
of HE. As the form assumes, frames are sent again (up to 255 times), and no EIFS follows a collision (`min_sinr: 30 dB`). The form is of the DCF; stations of
802.11ax count slots as EDCA does. With AIFSN 2, which is DIFS, a backoff that is interrupted is a slot ahead of the DCF's, because the slot in which the medium
becomes busy counts; with AIFSN 3 one that is not interrupted is a slot behind. *off*: by how much the form is not between the two; at most 2 %, of 50
stations 3 %. With the DCF itself, which no file can choose here, `tests/slow/radio/bianchi_he_test.cpp` is within 2 % (MCS 0, 20 stations 2.4 %).
The form does not say which guard interval and which rates of the ACK it had; 0.8 us and the highest of 6, 12 and 24 Mb/s by the frame's reference rate fit all
its rows."""
COLUMNS = ["MCS", "MHz", "n", "AIFSN 3", "Bianchi", "AIFSN 2", "off"]


def cases(short):
    rows = [row for row in peer.rows(FILE) if row["n"] in ("5", "20", "50")]
    return [row for row in rows if mode_of(row) == (11, 80) and row["n"] == "20"] if short else rows


def mode_of(row):
    """MCS and width, of HeMcs7_80MHz."""
    mcs, width = row["mode"].removeprefix("HeMcs").removesuffix("MHz").split("_")
    return int(mcs), int(width)


def settings(row, aifsn):
    mcs, width = mode_of(row)
    return {"radio.include": ROOT / "config/radios/ieee80211ax.yaml", "radio.propagation": [{"model": "log_distance"}],
            "radio.mcs": mcs, "radio.width": f"{width} MHz", "radio.ppdu_times": "ns3", "radio.min_sinr": "30 dB",
            "radio.aggregation.max_ampdu": 0, "radio.edca.best_effort.aifsn": aifsn, "radio.short_retry_limit": 255,
            "agents.sources.circle.count": int(row["n"]), "agents.sources.controller.parameters.backlog": 20}


def measure(runs, row):
    mcs, width = mode_of(row)
    seconds = 21 if mcs == 0 and width == 20 else 5

    def goodput(aifsn):
        return statistics.mean(runs.play(SCENARIOS / "saturation.yaml", settings(row, aifsn), seed, seconds).goodput("sink")
                               for seed in SEEDS)

    low, high = goodput(3), goodput(2)
    form = float(row["Mbps"])
    off = 100 * max(0, low / form - 1, 1 - high / form)
    most = 3 if row["n"] == "50" else 2
    return Row([str(mcs), str(width), row["n"], f"{low:.3f}", f"{form:.3f}", f"{high:.3f}", f"{off:.2f} %"],
               "" if off <= most else f"802.11ax, {row['mode']}, n = {row['n']}: off by {off:.2f} %",
               (mcs, width, int(row["n"]), low, high, form))


def draw(rows):
    panel = Panel("", axis("senders", log=True, ticks=(5, 20, 50)), axis("goodput, Mb/s", limits=(0, None)))
    for curve, mode in enumerate(sorted({row.data[:2] for row in rows})):
        some = [row.data for row in rows if row.data[:2] == mode]
        panel.marks([one[2] for one in some], [(one[3] + one[4]) / 2 for one in some],
                    intervals=[one[3:5] for one in some], curve=curve, label=f"MCS {mode[0]}, {mode[1]} MHz")
        panel.line([one[2] for one in some], [one[5] for one in some], curve=curve, dash="dotted")
    panel.line([], [], curve=GREY, dash="dotted", label="Bianchi")
    return Chart(panel, title=TITLE)
