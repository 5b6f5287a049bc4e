#!/usr/bin/env python3
"""What it costs that N programs with DDS find each other over the air when all come up at once: Cyclone DDS and Fast DDS
by multicast, and Fast DDS through a discovery server.

    cmake --build build/release --target baraka baraka-holder cyclone_load fastdds_load
    tests/bench/dds/discovery_storm.py [--participants N...] [--runs N] [--factor F] [--store FILE] [--short]

Stations on a circle of 5 m, 54 Mb/s, group frames at 6 Mb/s; each program writes and reads one topic. Time until every
program knows the writers and readers of all others, air time by what it was for, and the exponent of its growth.
"""
import collections
import statistics

import figures
import journals
import own
from store import Store

KINDS = {"cyclone, multicast": ("cyclone", None), "fastdds, multicast": ("fastdds", None),
         "fastdds, server": ("fastdds", "fastdds_discovery_client")}
SERVER = "fastdds_discovery_server"


def command(vendor, number, count, options, *more):
    return [options.build / f"tests/{vendor}_load", "--writer", number, "--csv", f"{{results}}/{number}.csv", "--reliable",
            "--for", options.seconds, *more]


def stations_of(case, options):
    """The server, where there is one, has 10.77.0.1: the first agent's address."""
    vendor, profile = KINDS[case["discovery"]]
    count = case["participants"]
    stations = []
    if profile:
        stations.append(own.Station("server", 0, 0, [own.Program(
            "server", command("fastdds", count, count, options, "--subscribe", "none"),
            own.environment("fastdds", SERVER))]))
    for i, (x, y) in enumerate(own.circle(count)):
        one = command(vendor, i, count, options, "--publish", "t", "--subscribe", "t", "--until-matched", count - 1,
                      "--rate", 1, "--settle", options.seconds,
                      "--patience", options.seconds - 0.5)  # not to know all by then is no failure
        stations.append(own.Station(f"s{i}", x, y, [own.Program("load", one, own.environment(vendor, profile), start=0.5)]))
    return stations


def measure(case, options):
    seconds = options.seconds + 2
    written = own.scenario(stations_of(case, options), seconds, own.radio())
    with own.played(options.build, written, options.factor, seed=1 + case["run"], kept=options.kept) as run:
        found = {i: run.folder / f"{i}.csv" for i in range(case["participants"])}
        return {"status": run.status, **run.cost(), "matched_s": journals.matched_after(found, case["participants"] - 1),
                "air": air_by_kind(run), "summary": run.out}


def air_by_kind(run):
    """{what for: [frames, s of air]} of the whole run."""
    return {kind: [frames, air * 1e-9] for kind, frames, air in run.query(
        "SELECT CASE purpose WHEN 'network' THEN kind ELSE purpose END, sum(frames), sum(airtime_ns) FROM air_accounts "
        "GROUP BY 1 ORDER BY 1")}


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--participants", type=int, nargs="+", default=[5, 10, 20, 40])
    parser.add_argument("--discovery", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    own.add_factor(parser)
    parser.add_argument("--seconds", type=float, default=30, help="simulated, from the start of the programs")
    parser.add_argument("--short", action="store_true", help="two small cases, to see that it works")
    options = parser.parse_args()
    if options.short:
        options.participants, options.runs, options.seconds = [2, 4], 1, 4
        options.discovery = ["cyclone, multicast"]
    store = Store(options.store)
    cases = [{"discovery": kind, "participants": count} for kind in options.discovery for count in options.participants]
    rows = store.get_all([{**case, "run": run} for case in cases for run in range(options.runs)],
                         lambda case: measure(case, options), options.parallel)
    kinds = sorted({kind for row in rows for kind in row["air"]})
    lines, growth = [], collections.defaultdict(list)
    for case in cases:
        some = [row for row in rows if all(row[key] == case[key] for key in case)]
        times = [row["matched_s"] for row in some if row["matched_s"] is not None]
        air = {kind: statistics.median(row["air"].get(kind, [0, 0])[1] for row in some) for kind in kinds}
        total = sum(air.values())
        growth[case["discovery"]].append((case["participants"], total))
        lines.append([case["discovery"], case["participants"], statistics.median(times) if times else None,
                      len(some) - len(times), total, *(air[kind] for kind in kinds)])
    print(figures.table(["discovery", "participants", "all matched, s", "never", "air time, s", *kinds], lines))
    print(own.costs(rows))
    for kind, points in growth.items():
        if len(points) > 1 and all(air > 0 for _, air in points):
            slope, error = figures.growth_exponent(points)
            print(f"{kind}: air time grows as N^{slope:.2f}",
                  f"(standard error {error:.2f})" if error is not None else "")


if __name__ == "__main__":
    main()
