"""AODV on a grid, beside ns-3's."""
import collections
import math
import random
import statistics

import peer
from document import Row, percent, pyplot, within
from runs import OWN

NAME = "aodv"
TITLE = "AODV on a grid"
FILE = "aodv_ns3.csv"
TEXT = """25 stations in a grid, 40 m apart, of which those side by side hear each other (51.3 m at 1 Mb/s, log-distance,
exponent 3), with AODV; 2 to 8 flows of 64 bytes at 4 Hz between stations drawn at random, from 5 to 10 s until 100 s
(`tests/validation/aodv.yaml`, `tests/peer/ns3/aodv.cc`). Ten draws, the same on both sides; means of what arrived, of
the medians of the delays (searches included) and of the transmissions of AODV, with the interval of 95 % of the mean
(Student's t). Tolerances: 3 points, and 20 %.

Equal on both sides: 1 Mb/s for all frames, no RTS, 7 tries, 500 frames of queue and 500 ms of life there, the energy
threshold, the length of frames of data, flows and starts, and AODV's parameters, those of RFC 3561, section 10 (in
ns-3 MyRouteTimeout is set to the RFC's 6 s, stock is 11.2 s); hellos, gratuitous replies and feedback of the link on,
local repair off; rebroadcasts of requests wait up to 10 ms; messages wait up to 30 s for a route. ns-3 has no ARP
here.

What differs, and what it does:

- *A relay.* ns-3's sends DIFS after the acknowledgment that it sent itself: it is handed the packet in the SIFS
  before, when its medium is idle, and draws no backoff. Ours finds the medium busy with its own acknowledgment and
  draws one. With `cw_min: 1` the excess is gone (last columns): three hops of draw 1 of 2 flows take 5.00 ms
  (median), with `cw_min: 1` 4.40 ms, in ns-3 4.43 ms.

- *Lost hellos.* ns-3 takes a neighbour for lost after 2 s without a hello (AllowedHelloLoss 2), ours after 2.5
  intervals in which it heard nothing of it at all, data included. Hellos collide, so ns-3 reports (RERR) and repairs
  (RREQ, RREP) routes that are not broken: with `--hello_loss=6` its means of 2 flows are 0.2 RERR, 24.1 RREQ and 10.5
  RREP.

- *A loop.* In draw 2 of 8 flows a flow of ns-3's loses 260 of 379 packets: source and next hop name each other as the
  next hop to the destination for 64 s, and the source drops its own packets that come back. It has no such loop with
  `--seed=3`, nor with `--hello_loss=3`. In ours a route is exchanged for none that is older or as old and longer (RFC
  3561, 6.2; `aodv_loops_test.cpp`).

- *Hellos.* ns-3's stations send them always; ours only on active routes (RFC 3561, 6.9), hence fewer, most so with
  few flows.

- *Lengths.* Messages of AODV are 25 bytes shorter than over UDP and IP: 0.2 ms at 1 Mb/s."""
COLUMNS = ["flows", "delivered, ns-3", "ours", "points off", "median delay, ns-3, ms", "ours, ms", "off", "RREQ, ns-3", "ours",
           "RREP, ns-3", "ours", "RERR, ns-3", "ours", "hellos, ns-3", "ours", "median delay, `cw_min: 1`, ms", "off"]
STATIONS = 25
STOP = 100  # s
FLOWS = (2, 4, 6, 8)
SEEDS = range(1, 11)
T_QUANTILE = 2.262157  # 97.5 %, 9 degrees of freedom
# Of a run: delivered [1], median delay [ms], transmissions.
FIGURES = ("delivered", "median", "rreq", "rrep", "rerr", "hellos")
EVENTS = {"rreq": ("rreq sent", "rreq forwarded"), "rerr": ("rerr sent",), "hellos": ("hello sent",),
          "rrep": ("rrep sent", "rrep sent for another", "gratuitous rrep sent", "rrep forwarded")}


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


def of_peer(row):
    """Figures of a run of ns-3."""
    return {"delivered": float(row["per_sent"]), "median": float(row["median_ms"]),
            "rreq": int(row["rreq"]) + int(row["rreq_relayed"]),
            **{name: int(row[name]) for name in ("rrep", "rerr", "hellos")}}


def of_run(run):
    (sent,), = run.query("SELECT count(*) FROM messages")
    delays = [delay / 1e6 for delay, in run.query("SELECT delay_ns FROM deliveries")]
    events = dict(run.query("SELECT event, sum(count) FROM routing_events GROUP BY event"))
    return {"delivered": len(delays) / sent, "median": statistics.median(delays),
            **{name: sum(events.get(event, 0) for event in parts) for name, parts in EVENTS.items()}}


def mean(runs_of, name):
    """Of one figure over runs, and half the interval of it."""
    values = [one[name] for one in runs_of]
    return statistics.mean(values), T_QUANTILE * statistics.stdev(values) / math.sqrt(len(values))


def play(runs, count, more):
    return [of_run(runs.play(OWN / "aodv.yaml", {**settings(count, seed), **more}, seed)) for seed in SEEDS]


def measure(runs, case):
    count, rows = case
    assert sorted(int(row["seed"]) for row in rows) == list(SEEDS)
    both = [[of_peer(row) for row in rows], play(runs, count, {})]
    theirs, ours = ({name: mean(side, name) for name in FIGURES} for side in both)
    quick, _ = mean(play(runs, count, {"radio.cw_min": 1}), "median")
    shares = [f"{100 * side['delivered'][0]:.2f} ± {100 * side['delivered'][1]:.2f} %" for side in (theirs, ours)]
    medians = ["{:.2f} ± {:.2f}".format(*side["median"]) for side in (theirs, ours)]
    counters = ["{:.1f} ± {:.1f}".format(*side[name]) for name in FIGURES[2:] for side in (theirs, ours)]
    delivered, median = ([side[name][0] for side in (theirs, ours)] for name in FIGURES[:2])
    what = f"{count} flows"
    return Row([str(count), *shares, f"{100 * (delivered[1] - delivered[0]):+.2f}", *medians,
                percent(median[1], median[0]), *counters, f"{quick:.2f}", percent(quick, median[0])],
               within(delivered[1], delivered[0], absolute=0.03, what=f"{what}, delivered") or
               within(median[1], median[0], 0.2, what=f"{what}, median delay"),
               (count, theirs, ours))


def draw(rows):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2)
    data = [row.data for row in rows]
    for axis, name, scale, label in ((axes[0], "delivered", 100, "delivered, %"),
                                     (axes[1], "median", 1, "median delay, ms")):
        for side, shift, style, whose in ((2, -0.1, "o", "ours"), (1, 0.1, "x", "ns-3")):
            axis.errorbar([one[0] + shift for one in data], [scale * one[side][name][0] for one in data],
                          [scale * one[side][name][1] for one in data], fmt=style, label=whose)
        axis.set(xlabel="flows", ylabel=label, ylim=(0, None))
        axis.legend()
    return figure
