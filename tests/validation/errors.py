"""Packet error rates."""
import collections
import math

import peer
from chart import Chart, Panel, axis
from document import Row

NAME = "errors"
TITLE = "Packet error rates"
FILE = "per_ns3.csv"
TEXT = """The library's error models (`tests/validation/radio_probe.cpp`) compared with ns-3.37's DsssErrorRateModel and
NistErrorRateModel at every SNR of the table (0.5 dB steps, 20 MHz), and the SNR at which half of the packets are lost, by linear
interpolation. Tolerance: 0.005."""
COLUMNS = ["model", "mode", "bytes", "SNRs", "dB at PER 0.5", "ns-3", "largest difference of PER"]


def cases(short):
    del short  # all of it takes a second
    groups = collections.defaultdict(list)
    for row in peer.rows(FILE):
        groups[row["model"], row["mode"], row["bytes"]].append(row)
    return list(groups.items())


def half(points):
    for (x, y), (x_next, y_next) in zip(points, points[1:]):
        if y >= 0.5 > y_next:
            return x + (x_next - x) * (y - 0.5) / (y - y_next)
    return math.nan


def measure(runs, case):
    (model, mode, size), rows = case
    ours = runs.ask([("per", model, float(mode[1:]) * 1e6, size, row["snr_db"]) for row in rows])
    theirs = [float(row["per"]) for row in rows]
    snrs = [float(row["snr_db"]) for row in rows]
    largest = max(abs(a - b) for a, b in zip(ours, theirs))
    return Row([model, mode, size, str(len(rows)), f"{half(list(zip(snrs, ours))):.2f}",
                f"{half(list(zip(snrs, theirs))):.2f}", "below 1e-6" if largest < 1e-6 else f"{largest:.0e}"],
               "" if largest <= 0.005 else f"{mode}, {size} bytes: off by {largest:.3g}", (mode, size, snrs, ours, theirs))


LEAST = 1e-6  # of the error rates that are drawn


def draw(rows):
    panels = [Panel(title, axis("SNR, dB"), axis("packet error rate", log=True, limits=(LEAST, 1.5)))
              for title in ("DSSS, 1000 bytes", "OFDM, 1000 bytes")]
    curves = collections.Counter()
    for mode, size, snrs, ours, theirs in (row.data for row in rows):
        if size != "1000":
            continue
        family = int(mode[0] == "g")
        curve, panel = curves[family], panels[family]
        panel.line(*zip(*(one for one in zip(snrs, ours) if one[1] > 0)), curve=curve, label=mode)
        panel.marks(*zip(*(one for one in zip(snrs, theirs) if one[1] >= LEAST)), "cross", curve=curve)
        curves[family] += 1
    return Chart(*panels, title=TITLE, columns=2)
