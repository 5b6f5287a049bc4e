#!/usr/bin/env python3
"""Reliable samples over two lossy links, beside what OSRF's TSC-RMW report (2020) measured with mininet.

    cmake --build build/release --target baraka baraka-holder cyclone_load fastdds_load
    tests/bench/dds/dds_links.py [--runs N] [--parallel N] [--store FILE] [--short]

As there: two hosts; a datagram passes two links and is lost on each with the probability given, so that (1 - p)^2 arrive;
54 Mb/s; reliable, keep last 10, 1 kB at 30 Hz; the writer writes for 15 s from its start on, so that what it writes before
the two know each other counts as lost; 'first second' is the first one, counted from the start of the reader, at the end
of which it has a sample, as perf_test prints them; 'inside' whether our median lies within the published ones; 'after it'
is the share from the first sample on. Here the two links are one: a radio that loses 1 - (1 - p)^2 of the frames and does
not repeat them. Medians of the runs, with 95 % intervals of the shares, least and most of the times.
"""
import csv
import math
import pathlib
import statistics

import figures
import journals
import own
from store import Store

SIZE, RATE, SECONDS = 1_000, 30, 15
PUBLISHED = pathlib.Path(__file__).with_name("mininet_2020.csv")
COLUMNS = ["vendor", "loss per link", "received/sent", "published", "first second", "published", "inside", "first sample, s",
           "after it", "published", "never", "published"]


def published():
    with PUBLISHED.open(encoding="utf-8", newline="") as file:
        return {(row["vendor"], float(row["loss"])): row
                for row in csv.DictReader(line for line in file if not line.startswith("#"))}


def load(vendor, options, writes):
    command = [options.build / f"tests/{vendor}_load", "--reliable", "--keep-last", 10, "--for", options.seconds + 1]
    number = 0 if writes else 1
    if writes:
        command += ["--publish", "t", "--size", SIZE, "--rate", RATE, "--count", round(options.seconds * RATE)]
    else:
        command += ["--subscribe", "t"]
    return own.Program("writer" if writes else "reader", command + ["--writer", number, "--csv", f"{{results}}/{number}.csv"],
                       on_exit="end" if writes else "ignore")


def measure(case, options):
    stations = [own.Station("writer", 0, 0, [load(case["vendor"], options, True)]),
                own.Station("reader", 10, 0, [load(case["vendor"], options, False)])]
    radio = own.radio(loss={"probability": 1 - (1 - case["loss"]) ** 2}, short_retry_limit=1, long_retry_limit=1)
    with own.played(options.build, own.scenario(stations, options.seconds + 5, radio), options.factor, seed=1 + case["run"],
                    kept=options.kept) as run:
        files = {number: run.folder / f"{number}.csv" for number in range(2)}
        found = journals.totals(files)
        wrote = [int(row["wall_ns"]) for row in journals.rows(files[0]) if row["event"] == "write"]
        came = [int(row["wall_ns"]) for row in journals.rows(files[1]) if row["event"] == "receive"]
        [began] = [int(row["wall_ns"]) for row in journals.rows(files[1]) if row["event"] == "created"]
        return {"status": run.status, **run.cost(), "written": found.written, "received": found.received,
                "first": 1e-9 * (min(came) - min(wrote)) if came and wrote else None,
                "second": math.ceil(1e-9 * (min(came) - began)) if came else None}


def spread(values):
    return f"{statistics.median(values):.1f} ({min(values):.1f} … {max(values):.1f})" if values else "-"


def is_inside(value, there):
    """Within the published least and most, which are times of lines that perf_test printed, up to 0.3 s late."""
    return math.floor(float(there["first_least"])) <= value <= float(there["first_most"])


def after_first(row):
    """Received/sent from the first sample on."""
    return row["received"] / max(1, row["written"] - RATE * row["first"])


def shown(case, rows, there):
    """A line of the table from the runs of a case."""
    shares = sorted(row["received"] / row["written"] for row in rows)
    first = [row["first"] for row in rows if row["first"] is not None]
    second = [row["second"] for row in rows if row["second"] is not None]
    after = [after_first(row) for row in rows if row["first"] is not None]
    beside = f"{there['first_median']} ({there['first_least']} … {there['first_most']})" if there["first_median"] else "-"
    inside = ("yes" if is_inside(statistics.median(second), there) else "no") if second and there["first_median"] else "-"
    return [case["vendor"], case["loss"],
            figures.with_interval(figures.median(shares), figures.interval(shares, figures.median)), there["share"],
            spread(second), beside, inside, spread(first), f"{statistics.median(after):.3f}" if after else "-",
            there["after_first"] or "-", f"{len(rows) - len(first)} of {len(rows)}", f"{there['never']} of {there['runs']}"]


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    own.add_factor(parser)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="of writing")
    parser.add_argument("--vendors", nargs="+", default=["fastdds", "cyclone"])
    parser.add_argument("--losses", type=float, nargs="+", default=[0, 0.1, 0.2, 0.3, 0.4])
    parser.add_argument("--short", action="store_true", help="two cases, to see that it works")
    options = parser.parse_args()
    if options.short:
        options.runs, options.seconds, options.losses, options.vendors = 1, 5, [0, 0.4], ["cyclone"]
    store, there = Store(options.store), published()
    cases = [{"vendor": vendor, "loss": loss} for vendor in options.vendors for loss in options.losses]
    whole = [{**case, "run": run} for run in range(options.runs) for case in cases]
    rows = store.get_all(whole, lambda case: measure(case, options), options.parallel)
    print(figures.table(COLUMNS, [shown(case, [row for row in rows if all(row[key] == case[key] for key in case)],
                                        there[case["vendor"], case["loss"]]) for case in cases]))
    print(own.costs(rows))


if __name__ == "__main__":
    main()
