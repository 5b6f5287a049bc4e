"""Cells that are in no list of what was asked for."""
import itertools
import statistics

import hidden
import peer
from chart import GREY, Chart, Panel, axis
from document import Row, percent, within
from runs import OWN, SCENARIOS, cell_seconds, radio_like

NAME = "more"
TITLE = "More cells"
FILE = "cells_ns3.csv"
TEXT = """Further cases, from the same scenario files with other `--set`: other rates, lengths, numbers of senders
and preambles; n senders around a receiver (n), or two hidden from each other (hidden, -59 dBm at the receiver). Five seeds
on both sides. Tolerance: 1.5 % from 1000 bytes on, 2.5 % below, or half of the spread of ns-3's seeds where that is more. (At 2 Mb/s
ns-3.37 never uses the short preamble, so frames of rows with short preambles are answered at 5.5 Mb/s.)"""
COLUMNS = ["case", "slot, us", "preamble", "bytes", "RTS", "cell", "ours", "ns-3", "off", "spread of ns-3"]
KEYS = ("layout", "data", "control", "slot_us", "rts", "short", "size", "n")


def cases(short):
    rows = peer.rows(FILE)
    groups = [list(group) for _, group in itertools.groupby(rows, lambda row: [row[key] for key in KEYS])]
    if short:
        return [group for group in groups if group[0]["data"] in ("b5.5", "g48") and int(group[0]["n"]) <= 3]
    return groups


def settings(row):
    size = int(row["size"]) - 7
    radio = {**radio_like(row["data"], row["control"], row["slot_us"], rts=row["rts"] == "1"),
             "radio.preamble": "short" if row["short"] == "1" else "long"}
    if row["layout"] == "hidden":
        level = {"rx_dbm_A": "-58.9794", "rx_dbm_C": "-58.9794", "hidden": "1", "senders": "2",
                 "payload": row["size"], "data": row["data"], "ctl": row["control"], "rtscts": row["rts"]}
        return {**hidden.settings(level), **radio}
    return {**radio, "radio.propagation": [{"model": "log_distance"}],
            "agents.sink.controller.parameters.start": "1 s",
            "agents.sources.circle.count": int(row["n"]), "agents.sources.controller.parameters.size": size}


def measure(runs, group):
    row = group[0]
    is_hidden = row["layout"] == "hidden"
    scenario, sink = (OWN / "hidden.yaml", "b") if is_hidden else (SCENARIOS / "saturation.yaml", "sink")
    until = 10.2 if is_hidden else cell_seconds(int(row["size"]), int(row["n"]), row["data"][0] == "g")
    mbps, = runs.means(scenario, settings(row), lambda run: (run.goodput(sink),), until=until)
    seeds = [float(one["goodput_mbps"]) for one in group]
    theirs, spread = statistics.mean(seeds), max(seeds) - min(seeds)
    cells = [f"{row['data']}, ACK {float(row['control'][1:]):g}", f"{float(row['slot_us']):g}",
             "short" if row["short"] == "1" else "long" if row["data"][0] == "b" else "", row["size"],
             "yes" if row["rts"] == "1" else "no", "hidden" if is_hidden else f"n = {row['n']}"]
    share = 0.015 if int(row["size"]) >= 1000 else 0.025
    return Row([*cells, f"{mbps:.3f}", f"{theirs:.3f}", percent(mbps, theirs), f"{100 * spread / theirs:.1f} %"],
               within(mbps, theirs, absolute=max(share * theirs, spread / 2), what=", ".join(cells)),
               (" ".join([row["data"], row["size"] + " B", cells[5], "RTS" * (row["rts"] == "1")]), mbps / theirs,
                spread / theirs / 2))


def draw(rows):
    data = [row.data for row in rows][::-1]
    panel = Panel(x=axis("goodput beside ns-3's mean, %", limits=(-5, 5)), y=axis(names=[one[0] for one in data]))
    for place, (_, _, spread, *_) in enumerate(data):
        panel.line([-100 * spread, 100 * spread], [place, place], curve=GREY, stroke=10, opacity=0.3,
                   label="spread of ns-3's seeds")
    panel.marks([100 * (one[1] - 1) for one in data], range(len(data)), curve=0, label="ours")
    panel.vertical(0)
    return Chart(panel, title=TITLE, size=(640, 460))
