"""Two saturated senders that do not hear each other."""
import itertools
import math
import statistics

import peer
from chart import Chart, Panel, axis, series
from document import Row, percent, within
from runs import OWN, radio_like

NAME = "hidden"
TITLE = "Hidden terminals"
FILE = "hidden_ns3.csv"
TEXT = """Goodput in Mb/s, 1000 bytes, of two saturated senders A and C towards B between them; hidden: a wall between A and C
(`tests/validation/hidden.yaml`). Levels are those at B; slot 9 us with OFDM. Mean of five seeds, compared with that of
ns-3.37's two or three. Tolerance: 1.5 %, or half of the spread of ns-3's own seeds where that is more (goodput of such pairs
comes from rare gaps without a collision)."""
COLUMNS = ["case", "A and C", "senders", "RTS", "dBm at B", "ours", "ns-3", "off", "spread of ns-3"]
KEYS = ("data", "ctl", "hidden", "senders", "rtscts", "payload", "rx_dbm_A", "rx_dbm_C")


def cases(short):
    """Rows that differ in nothing but the seed, together."""
    rows = sorted(enumerate(peer.rows(FILE)), key=lambda one: [one[1][key] for key in KEYS])
    groups = [[row for _, row in group]
              for _, group in itertools.groupby(rows, lambda one: [one[1][key] for key in KEYS])]
    if short:
        return [group for group in groups if group[0]["hidden"] == "1" and group[0]["senders"] == "2" and
                group[0]["rx_dbm_C"] == "-58.9794" and group[0]["rx_dbm_A"] == "-58.9794"]
    return groups


def distance(level):
    """Where 16.0206 dBm arrive so by Friis at 2.412 GHz, m."""
    return 299792458 / 2.412e9 / (4 * math.pi) * 10 ** ((16.0206 - float(level)) / 20)


def settings(row):
    where = {}
    for name, side, level in (("a", -1, row["rx_dbm_A"]), ("c", 1, row["rx_dbm_C"])):
        along = distance(level) / math.sqrt(2)
        where[f"agents.{name}.poses"] = [{"x": f"{side * along:.6f} m", "y": f"{along:.6f} m"}]
    alone = {"agents.c.controller.parameters.start": "1000 s"} if row["senders"] == "1" else {}
    slot = 9 if row["data"][0] == "g" else 20
    return {**radio_like(row["data"], row["ctl"], slot, rts=row["rtscts"] == "1"), **where, **alone,
            "radio.obstacles": row["hidden"] == "1",
            "agents.a.controller.parameters.size": int(row["payload"]) - 7,
            "agents.c.controller.parameters.size": int(row["payload"]) - 7}


def measure(runs, group):
    row = group[0]
    mbps, = runs.means(OWN / "hidden.yaml", settings(row), lambda run: (run.goodput("b"),), until=10.2)
    seeds = [float(one["goodput_mbps"]) for one in group]
    theirs, spread = statistics.mean(seeds), max(seeds) - min(seeds)
    levels = f"{float(row['rx_dbm_A']):.1f}, {float(row['rx_dbm_C']):.1f}"
    cells = [f"{row['data']}, ACK {row['ctl'][1:]}", "hidden" if row["hidden"] == "1" else "in range", row["senders"],
             "yes" if row["rtscts"] == "1" else "no", levels]
    told = f"{100 * spread / theirs:.1f} %" if len(seeds) > 1 else "one seed"
    return Row([*cells, f"{mbps:.3f}", f"{theirs:.3f}", percent(mbps, theirs), told],
               within(mbps, theirs, absolute=max(0.015 * theirs, spread / 2), what=", ".join(cells)),
               (row, mbps, theirs))


def draw(rows):
    data = [one.data for one in rows]
    bars = [one for one in data if one[0]["senders"] == "2" and one[0]["hidden"] == "1" and
            one[0]["rx_dbm_A"] == one[0]["rx_dbm_C"] == "-58.9794"]
    names = [f"{row['data']}{' RTS' if row['rtscts'] == '1' else ''}" for row, _, _ in bars]
    equal = Panel("hidden, equal levels", axis(names=names), axis("goodput, Mb/s", log=True))
    equal.bars(range(len(bars)), series("ours", [one[1] for one in bars], 0), series("ns-3", [one[2] for one in bars], 1))
    captured = Panel("hidden, b11", axis("A stronger than C at B, dB"), axis("goodput, Mb/s", limits=(0, None)))
    stronger, ours, theirs = zip(*sorted((float(row["rx_dbm_A"]) - float(row["rx_dbm_C"]), ours, theirs)
                                         for row, ours, theirs in data if row["rx_dbm_A"] == "-48.9794"))
    captured.line(stronger, ours, curve=0, label="ours")
    captured.marks(stronger, theirs, "cross", curve=1, label="ns-3")
    return Chart(equal, captured, title=TITLE, columns=2)
