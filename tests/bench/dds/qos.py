#!/usr/bin/env python3
"""Which profile of config/dds for which radio: every profile on every radio condition, one table. Of each condition the
profiles are marked that no other beats: more delivered, sooner (99 %), or with less air time.

    cmake --build build/release --target baraka baraka-holder cyclone_load fastdds_load
    tests/bench/dds/qos.py [--traffic NAME...] [--runs N] [--factor F] [--parallel N] [--store FILE] [--short]

A robot sends to two others 10 m and 15 m away. Reliability is the profile's; Cyclone's, which has none in its
configuration, is tried both ways.
"""
import statistics

import figures
import journals
import own
from store import Store

# Vendor, file of config/dds, options of the load.
PROFILES = {
    "fastdds best effort": ("fastdds", "fastdds_best_effort", []),
    "fastdds reliable": ("fastdds", "fastdds_reliable", []),
    "fastdds fast heartbeat": ("fastdds", "fastdds_fast_heartbeat", []),
    "fastdds fragments 1400": ("fastdds", "fastdds_fragments_1400", []),
    "fastdds fragments 64k": ("fastdds", "fastdds_fragments_64k", []),
    "cyclone best effort": ("cyclone", None, ["--best-effort"]),
    "cyclone reliable": ("cyclone", None, ["--reliable"]),
    "cyclone slow heartbeat": ("cyclone", "cyclone_slow_heartbeat", ["--reliable"]),
    "cyclone one frame": ("cyclone", "cyclone_one_frame", ["--reliable"]),
    "cyclone fragments 64k": ("cyclone", "cyclone_fragments_64k", ["--reliable"]),
    "cyclone unicast data": ("cyclone", "cyclone_multicast_for_discovery", ["--reliable"]),
}
CONDITIONS = {
    "54 Mb/s, clear": {},
    "54 Mb/s, 20 % lost": {"loss": {"probability": 0.2}},
    "11 Mb/s, clear": {"standard": "ieee80211b"},
    "11 Mb/s, 20 % lost": {"standard": "ieee80211b", "loss": {"probability": 0.2}},
}
TRAFFIC = {"commands": (1_000, 30), "images": (100_000, 3)}  # bytes, Hz
READERS = (10, 0), (-15, 0)  # m
COLUMNS = ["traffic", "radio", "profile", "delivered", "p50, ms", "p99, ms", "air time, share", "not dominated"]


def load(case, number, options):
    vendor, profile, quality = PROFILES[case["profile"]]
    size, rate = TRAFFIC[case["traffic"]]
    command = [options.build / f"tests/{vendor}_load", "--keep-last", 10, *quality, "--writer", number, "--csv",
               f"{{results}}/{number}.csv", "--settle", 0.5, "--for", options.discovery + options.seconds + options.linger]
    if number == 0:
        command += ["--publish", "t", "--size", size, "--rate", rate, "--count", round(options.seconds * rate), "--linger",
                    options.linger, "--until-matched", len(READERS)]
    else:
        command += ["--subscribe", "t", "--until-matched", 1]
    return own.Program("load", command, own.environment(vendor, profile), on_exit="ignore" if number else "end")


def measure(case, options):
    places = [(0, 0), *READERS]
    stations = [own.Station(f"s{i}", *place, [load(case, i, options)]) for i, place in enumerate(places)]
    seconds = options.discovery + options.seconds + options.linger + 2
    written = own.scenario(stations, seconds, own.radio(**CONDITIONS[case["radio"]]))
    with own.played(options.build, written, options.factor, seed=1 + case["run"], kept=options.kept) as run:
        found = journals.totals({i: run.folder / f"{i}.csv" for i in range(len(places))})
        pooled = found.pooled()
        (air,), = run.query("SELECT sum(airtime_ns) FROM air_accounts")
        return {"status": run.status, **run.cost(), "delivered": found.delivered,
                "p50": 1e3 * figures.quantile(pooled, 0.5) if pooled else None,
                "p99": 1e3 * figures.quantile(pooled, 0.99) if pooled else None,
                "air": air * 1e-9 / float(run.line("simulated_s")), "summary": run.out}


def middle(rows, key):
    values = [row[key] for row in rows if row[key] is not None]
    return statistics.median(values) if values else None


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--traffic", nargs="+", choices=TRAFFIC, default=list(TRAFFIC))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    own.add_factor(parser)
    parser.add_argument("--seconds", type=float, default=10, help="of publishing")
    parser.add_argument("--linger", type=float, default=3, help="s for the last repairs")
    parser.add_argument("--discovery", type=float, default=40, help="s that may pass until they know each other")
    parser.add_argument("--short", action="store_true", help="two small cases, to see that it works")
    options = parser.parse_args()
    profiles, conditions = list(PROFILES), list(CONDITIONS)
    if options.short:
        options.runs, options.seconds, options.linger, options.traffic = 1, 2, 1, ["commands"]
        profiles, conditions = ["cyclone best effort", "cyclone unicast data"], ["54 Mb/s, 20 % lost"]
    groups = [(traffic, radio) for traffic in options.traffic for radio in conditions]
    cases = [{"traffic": traffic, "radio": radio, "profile": profile} for traffic, radio in groups for profile in profiles]
    rows = Store(options.store).get_all([{**case, "run": run} for case in cases for run in range(options.runs)],
                                        lambda case: measure(case, options), options.parallel)
    lines = []
    for traffic, radio in groups:
        means = []
        for case in cases:
            if (case["traffic"], case["radio"]) == (traffic, radio):
                some = [row for row in rows if all(row[key] == case[key] for key in case)]
                means.append({**case, **{key: middle(some, key) for key in ("delivered", "p50", "p99", "air")}})
        best = figures.not_dominated(means, {"delivered": 1, "p99": -1, "air": -1})
        lines += [[row["traffic"], row["radio"], row["profile"], row["delivered"], row["p50"], row["p99"], row["air"],
                   "yes" if row in best else ""] for row in means]
    print(figures.table(COLUMNS, lines))
    print(own.costs(rows))


if __name__ == "__main__":
    main()
