"""AODV on a grid and of stations that move, beside ns-3's."""
import math
import pathlib
import statistics

import peer
from aodv_fields import Field
from chart import Chart, Panel, around, axis
from document import Row, percent, within
from runs import OWN, ROOT

NAME = "aodv"
TITLE = "AODV"
FILE = "aodv_ns3.csv"
TEXT = """25 stations with AODV are in a grid, 40 m apart, in which adjacent stations hear each other (51.3 m at 1 Mb/s, log-distance,
exponent 3), or on random waypoint paths in 200 x 60 m, each at a constant speed between 1 and 5 m/s with 5 s of pause,
the same paths on both sides; 2 to 8 flows of 64 bytes at 4 Hz between stations drawn at random, from 5 to 10 s until 100
s (`tests/validation/aodv.yaml`, `tests/validation/aodv_fields.py`, `tests/peer/ns3/aodv.cc`). Ten draws, the same on both
sides; means of the delivery, of the medians of the delays (searches included) and of the transmissions of AODV, with the
interval of 95 % of the mean (Student's t). The last row is three stations in a row without hellos, of which one moves
away after 20 s.

The third column states how many hellos in a row ns-3 may miss (AllowedHelloLoss; stock 2) and who answers a search: any
node that knows a route, as by default, or the destination only (`destination_only` on both sides). In rows with 6 and the
destination both behave alike, so their messages are compared, too; in the others the counts show the effect of the
defaults. Tolerances: 3 points of the delivery, 6 for the moving stations with the defaults, where single flows of ns-3
fail (its intervals are 4 points to either side); 20 % of the delay; where both behave alike, 15 % of the RREQ, 20 % of the
RREP, 40 % and 2 messages of the RERR: for the moving stations ns-3's intervals are 21, 31 and 32 % to either side, and on
the grid a lost hello of ours causes up to two RERR. In the last row there is one RERR on either side.

Equal on both sides: 1 Mb/s for all frames, no RTS, 7 tries, a queue of 500 frames with a lifetime of 500 ms, the energy
threshold, the length of data frames, flows and starts, and AODV's parameters, those of RFC 3561, section 10 (in
ns-3 MyRouteTimeout is set to the RFC's 6 s, stock is 11.2 s); hellos, gratuitous replies and feedback of the link on,
local repair off; rebroadcasts of requests wait up to 10 ms; messages wait up to 30 s for a route. ns-3 has no ARP
here: each station has a permanent entry of each other one.

Differences, and their effects:

- *Feedback of the link.* ns-3's AODV determines the receiver of a frame that the MAC gave up by its MAC address in ARP's
  entries, of which it uses those that are alive or permanent. Those that `NeighborCacheHelper::PopulateNeighborCache`
  makes are neither. With them, as on this page earlier, no frame that is given up reaches AODV: in
  the last row its relay then gives up 313 frames and sends no RERR, with permanent entries 1 and 1. On the grid no link
  breaks and little changes; of the moving stations' packets 70.0 ± 7.3 % arrived then, and 82.0 ± 6.3 % with ARP (defaults
  of AODV, `tests/analytic/radio/aodv_ns3.csv`).

- *Lost hellos.* ns-3 regards a neighbour as lost after 2 s without a hello (AllowedHelloLoss 2), ours after 2.5
  intervals without any frame of it, data included. Hellos collide, so ns-3 reports (RERR) and repairs
  (RREQ, RREP) routes that are not broken: with `--hello_loss=6` its means of 2 flows are 0.2 RERR, 24.1 RREQ and 10.5
  RREP.

- *Who answers.* A node increments the sequence number of a destination when the route to it breaks (RFC 3561, 6.11), so
  that only nodes with newer information can answer the next search. ns-3 does not, and nodes with an old route
  answer, often over the broken link, each with a gratuitous reply in addition: 953 RREP of the moving stations where ours
  send 132, and 113 and 99 where only destinations answer.

- *A relay* of ns-3 sends DIFS after its own acknowledgment: it gets the packet in the SIFS
  before, when its medium is idle, and draws no backoff. Ours finds the medium busy with its own acknowledgment and
  draws one. With `cw_min: 1` the difference vanishes (last columns): three hops of draw 1 of 2 flows take 5.00 ms
  (median), with `cw_min: 1` 4.40 ms, in ns-3 4.43 ms.

- *A loop.* In draw 2 of 8 flows a flow of ns-3 loses 260 of 379 packets: source and next hop name each other as the
  next hop to the destination for 64 s, and the source drops its own packets that come back. It has no such loop with
  `--seed=3`, nor with `--hello_loss=3`. In ours a route is never replaced by one that is older, or as old and longer (RFC
  3561, 6.2; `aodv_loops_test.cpp`).

- *Hellos.* ns-3's stations always send them; ours only on active routes (RFC 3561, 6.9), and therefore fewer, especially with
  few flows. Without hellos a comparison is impossible: ns-3's list of neighbours expires, which it regards as broken links.

- *Lengths.* Messages of AODV are 25 bytes shorter than over UDP and IP: 0.2 ms at 1 Mb/s."""
COLUMNS = ["stations", "flows", "ns-3's losses of hellos; who answers", "delivered, ns-3", "ours", "points off",
           "median delay, ns-3, ms", "ours, ms", "off", "RREQ, ns-3", "ours", "RREP, ns-3", "ours", "RERR, ns-3", "ours",
           "hellos, ns-3", "ours", "median delay, `cw_min: 1`, ms", "off"]
SEEDS = range(1, 11)
T_QUANTILE = 2.262157  # 97.5 %, 9 degrees of freedom
# Of a run: delivered [1], median delay [ms], transmissions.
FIGURES = ("delivered", "median", "rreq", "rrep", "rerr", "hellos")
EVENTS = {"rreq": ("rreq sent", "rreq forwarded"), "rerr": ("rerr sent",), "hellos": ("hello sent",),
          "rrep": ("rrep sent", "rrep sent for another", "gratuitous rrep sent", "rrep forwarded")}
# Of rows in which the two do the same: share of what ns-3 sends, and messages.
TOLERANCES = {"rreq": (0.15, 0), "rrep": (0.2, 0), "rerr": (0.4, 2)}
# Field, AllowedHelloLoss and DestinationOnly of ns-3, in the order of the table.
KINDS = (("grid", 2, 0), ("grid", 6, 1), ("moving", 2, 0), ("moving", 6, 0), ("moving", 6, 1), ("leaving", 2, 0))
WORDS = {"grid": "25 in a grid", "moving": "25 that move", "leaving": "3, one leaves"}


def kind(row):
    return row["field"], int(row["hello_loss"]), int(row["destination_only"])


def cases(short):
    """(kind, flows, rows) in which ns-3's link tells AODV of failures."""
    rows = [row for row in peer.rows(FILE) if row["addresses"] == "permanent"]
    groups = [(one, int(flows), [row for row in rows if kind(row) == one and row["flows"] == flows])
              for one in KINDS for flows in dict.fromkeys(row["flows"] for row in rows if kind(row) == one)]
    return [group for group in groups if not short or group[:2] in ((KINDS[0], 2), (KINDS[1], 2), (KINDS[5], 1))]


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
    return statistics.mean(values), T_QUANTILE * statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0


def play(runs, field, seeds, more):
    file, found = OWN / "aodv.yaml", []
    for seed in seeds:
        if field.name == "grid":
            settings = field.overrides(seed)
        else:
            settings, file = {}, pathlib.Path(runs.folder.name) / "aodv.yaml"
            text = (OWN / "aodv.yaml").read_text(encoding="utf-8").replace("../../config", str(ROOT / "config"))
            file.write_text(field.scenario(text, seed), encoding="utf-8")
        found.append(of_run(runs.play(file, {**settings, **more}, seed)))
    return found


def mistakes(what, name, only, theirs, ours):
    """Of a row: which tolerances it leaves."""
    points = 0.06 if name == "moving" and not only else 0.03
    compared = TOLERANCES if only else {"rerr": (0, 0)} if name == "leaving" else {}
    found = [within(ours["delivered"][0], theirs["delivered"][0], absolute=points, what=f"{what}, delivered"),
             within(ours["median"][0], theirs["median"][0], 0.2, what=f"{what}, median delay")]
    found += [within(ours[one][0], theirs[one][0], share, absolute, what=f"{what}, {one}")
              for one, (share, absolute) in compared.items()]
    return "; ".join(one for one in found if one)


def measure(runs, case):
    (name, loss, only), count, rows = case
    field, seeds = Field(name, count), [int(row["seed"]) for row in rows]
    assert name == "leaving" or sorted(seeds) == list(SEEDS)
    settings = {"routing.destination_only": True} if only else {}
    settings |= {"routing.hello": False} if name == "leaving" else {}
    both = [[of_peer(row) for row in rows], play(runs, field, seeds, settings)]
    theirs, ours = ({one: mean(side, one) for one in FIGURES} for side in both)
    quick = mean(play(runs, field, seeds, {**settings, "radio.cw_min": 1}), "median")[0] if name == "grid" and not only else None
    shares = [f"{100 * side['delivered'][0]:.2f} ± {100 * side['delivered'][1]:.2f} %" for side in (theirs, ours)]
    medians = [f"{side['median'][0]:.2f} ± {side['median'][1]:.2f}" for side in (theirs, ours)]
    counters = [f"{side[one][0]:.1f} ± {side[one][1]:.1f}" for one in FIGURES[2:] for side in (theirs, ours)]
    delivered, median = ([side[one][0] for side in (theirs, ours)] for one in FIGURES[:2])
    said = "no hellos" if name == "leaving" else f"{loss}; {'the destination' if only else 'any'}"
    return Row([WORDS[name], str(count), said, *shares, f"{100 * (delivered[1] - delivered[0]):+.2f}", *medians,
                percent(median[1], median[0]), *counters,
                *((f"{quick:.2f}", percent(quick, median[0])) if quick else ("-", "-"))],
               mistakes(f"{name}, {count} flows, {said}", name, only, theirs, ours),
               (name, only, loss, count, theirs, ours))


def draw(rows):
    data = [row.data[3:] for row in rows if row.data[:2] == ("grid", 0)]
    panels = []
    for name, scale, label in (("delivered", 100, "delivered, %"), ("median", 1, "median delay, ms")):
        panel = Panel(x=axis("flows on the grid"), y=axis(label, limits=(0, None)))
        for curve, (side, shift, shape, whose) in enumerate(((2, -0.1, "circle", "ours"), (1, 0.1, "cross", "ns-3"))):
            means, halves = zip(*((scale * mean, scale * half) for mean, half in (one[side][name] for one in data)))
            panel.marks([one[0] + shift for one in data], means, shape, around(means, halves), curve=curve, label=whose)
        panels.append(panel)
    return Chart(*panels, title=TITLE, columns=2)
