#!/usr/bin/env python3
"""Latency over the air: stations with a Cyclone DDS participant each, that publish small samples to all others, over our
radio in lock-step; beside it, if asked, at factors of real time, and over ns-3's in real time (tap_peer.py), in one run.

    cmake --build build/release --target baraka baraka-holder cyclone_load
    make -C tests/peer/ns3
    tests/bench/dds/air_latency.py [--stations N...] [--factors F...] [--peer-stations N...] [--seconds S] [--store FILE]
Does not measure again what is in the store. All stations are on a circle of 5 m and hear each other, 54 Mb/s, group
frames at 6 Mb/s; they come up one after the other and announce themselves every 500 ms. A latency is from the call of
write to the reading program, in the programs' time. With factors or ns-3: lateness is that of frames at the edges between
programs and radio in simulated time, of ns-3 that of events; CPU is in processors. In lock-step there is no lateness.
"""
import argparse
import math
import os
import pathlib

import figures
import journals
import own
import tap_peer
from store import Store

LEAST_SAMPLES = 1000
QUANTILES = 0.5, 0.99
COLUMNS = ["stations", "radio", "pace", "samples", "delivered", "p50, ms", "p99, ms", "simulated, s", "wall time, s"]
LATE_COLUMNS = ["late in, p50, us", "late in, p99, us", "late out, p50, us", "late out, p99, us", "CPU of the radio",
                "CPU of programs"]


def seconds_of(stations, options):
    """Long enough for so many samples."""
    return max(options.seconds, LEAST_SAMPLES / (stations * (stations - 1) * options.rate))


def stations_of(count, options):
    seconds = seconds_of(count, options)
    common = [options.build / "tests/cyclone_load", "--best-effort", "--publish", "t", "--subscribe", "t", "--size",
              options.size, "--rate", options.rate, "--count", max(1, round(seconds * options.rate)), "--until-matched",
              count - 1, "--patience", options.discovery,
              "--settle", 3, "--for", seconds + options.discovery + 10]
    stations = []
    for i, (x, y) in enumerate(own.circle(count)):
        # The last one to start ends the run, when the others have ended.
        is_last = i == count - 1
        command = [*common, "--writer", i, "--csv", f"{{results}}/{i}.csv", "--linger", 3 if is_last else 1.5]
        stations.append(own.Station(f"s{i}", x, y, [own.Program(
            "load", command, own.environment("cyclone", tap_peer.PROFILE), "end" if is_last else "ignore",
            tap_peer.STAGGER * i)]))
    return stations


def latencies(found):
    """{name: [value, low, high]} in ms, of all samples; intervals by pairs of writer and reader."""
    if not found.received:
        return {}
    blocks = list(found.latencies.values())
    pooled = found.pooled()
    return {f"p{share}": [1e3 * figures.quantile(pooled, share),
                          *(1e3 * end for end in figures.blocks_interval(
                              blocks, lambda values, s=share: figures.quantile(values, s), resamples=200))]
            for share in QUANTILES}


def measure_ours(count, factor, options):
    seconds = seconds_of(count, options) + options.discovery + 15
    written = own.scenario(stations_of(count, options), seconds, own.radio())
    with own.played(options.build, written, factor, kept=options.kept) as run:
        found = journals.totals({i: run.folder / f"{i}.csv" for i in range(count)})
        return {"status": run.status, **run.cost(), "samples": found.received, "delivered": found.delivered,
                **latencies(found), "summary": run.out}


def measure_peer(count, options):
    return tap_peer.measure(count, argparse.Namespace(
        build=options.build, peer=options.peer, size=options.size, rate=options.rate,
        seconds=seconds_of(count, options), discovery=options.discovery))


def measure(case, options):
    if case["radio"] == "ours":
        return measure_ours(case["stations"], case["factor"], options)
    return measure_peer(case["stations"], options)


def of_summary(row, key):
    for line in row.get("summary", "").splitlines():
        if line.startswith(key + ": "):
            return float(line.split(": ")[1])
    return None


def shown(row):
    def of(share):
        value = row.get(f"p{share}")
        return figures.with_interval(value[0], value[1:]) if value else "-"
    return [row["stations"], row["radio"], row["factor"], row["samples"], row["delivered"], of(0.5), of(0.99),
            row.get("simulated"), row.get("wall")]


def shown_late(row):
    def late(edge, quantile):
        value = of_summary(row, f"{edge}_lateness_{quantile}_s")
        return 1e6 * value if value is not None else None
    if row["factor"] == own.LOCKSTEP:
        return [None] * len(LATE_COLUMNS)
    is_ours = row["radio"] == "ours"
    return [late("entering", "median"), late("entering", "p99"), late("leaving", "median"),
            late("leaving", "p99") if is_ours else 1e3 * row["late_ms_99"],
            of_summary(row, "cpu_load") if is_ours else row["cpu"], of_summary(row, "cpu_load_programs")]


def halved(rows):
    """Whether the median still moves when the factor is halved: lines of text."""
    ours = {(row["stations"], row["factor"]): row for row in rows
            if row["radio"] == "ours" and row["factor"] != own.LOCKSTEP and "p0.5" in row}
    for (stations, factor), row in sorted(ours.items()):
        half = ours.get((stations, factor / 2))
        if half is None:
            continue
        moved = half["p0.5"][0] / row["p0.5"][0] - 1
        within = row["p0.5"][1] <= half["p0.5"][0] <= row["p0.5"][2]
        yield (f"{stations} stations: from {factor:g} to {factor / 2:g} the median moves by {100 * moved:.2f} %, "
               f"{'within' if within else 'outside'} its interval")


def slowness(case):
    """For sorting: the factor of real time; lock-step comes before all of them in tables."""
    return math.inf if case["factor"] == own.LOCKSTEP else case["factor"]


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--peer", type=pathlib.Path, default=own.ROOT / "build/peers/tap")
    parser.add_argument("--stations", type=int, nargs="+", default=[2, 10, 20, 40])
    parser.add_argument("--peer-stations", type=int, nargs="*", default=[], help="for which ns-3 runs, too")
    parser.add_argument("--factors", type=float, nargs="*", default=[], help="of real time, beside lock-step")
    parser.add_argument("--seconds", type=float, default=20, help="simulated, of publishing")
    parser.add_argument("--discovery", type=float, default=20,
                        help="s after which they begin though not all know each other")
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--rate", type=float, default=10)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time; above 1 they disturb each other")
    options = parser.parse_args()
    options.peer = options.peer.resolve()
    store = Store(options.store)
    cases = [{"stations": count, "radio": "ours", "factor": factor}
             for count in options.stations for factor in [own.LOCKSTEP, *options.factors]]
    if options.peer_stations and not os.access(options.peer, os.X_OK):
        raise SystemExit(f"no {options.peer}: make -C tests/peer/ns3 (needs libns3-dev)")
    cases += [{"stations": count, "radio": "ns-3", "factor": 1} for count in options.peer_stations]
    # The longest first, so that those at a time end together.
    cases.sort(key=slowness)
    rows = store.get_all(cases, lambda case: measure(case, options), options.parallel)
    rows.sort(key=lambda row: (row["stations"], row["radio"] != "ours", -slowness(row)))
    are_late = any(row["factor"] != own.LOCKSTEP for row in rows)
    print(figures.table(COLUMNS + LATE_COLUMNS * are_late, [shown(row) + shown_late(row) * are_late for row in rows]))
    for line in halved(rows):
        print(line)


if __name__ == "__main__":
    main()
