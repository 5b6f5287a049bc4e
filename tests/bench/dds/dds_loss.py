#!/usr/bin/env python3
"""What frames that get lost do to reliable samples, of Fast DDS and Cyclone DDS, without and with the retries of 802.11:
the traffic of OSRF's TSC-RMW report (2020), over our radio. There a datagram passes two links that lose, and discovery
counts: dds_links.py has that.

    cmake --build build/release --target baraka baraka-holder cyclone_load fastdds_load
    tests/bench/dds/dds_loss.py [--runs N] [--parallel N] [--store FILE] [--short]

One writer, one reader, 10 m apart, 54 Mb/s; reliable, keep last 10. Each frame that the physics let in is lost with the
probability given, acknowledgements, too. 'sent' are writes that succeeded; a call of write that waits for room delays
the next ones, so that there may be fewer than the rate says. From the ledger of the run: samples that came at first try,
samples or fragments that were sent again, and the share of time in which the air was used. Medians of the runs, with 95 %
intervals.
"""
import statistics

import figures
import journals
import own
from store import Store

LOSSES = 0, 0.1, 0.2, 0.3, 0.4
# Bytes, Hz: 512 kB at 30 Hz is 126 Mb/s, more than the radio has.
TRAFFIC = (1_000, 30), (512_000, 30), (512_000, 3)
RETRIES = {"none": {"short_retry_limit": 1, "long_retry_limit": 1}, "802.11's": {}}
# Received/sent of the report, by loss per link, of which there are two: reliable, keep last 10, 30 Hz; Fast RTPS with synchronous writes. 20 % and more of
# 512 kB were 0 as well.
PUBLISHED = {("fastdds", 1_000): {0: 0.992, 0.1: 0.912, 0.2: 0.297, 0.3: 0.000},
             ("cyclone", 1_000): {0: 0.992, 0.1: 0.974, 0.2: 0.732, 0.3: 0.022},
             ("fastdds", 512_000): {0: 0.99, 0.1: 0.00}, ("cyclone", 512_000): {0: 0.99, 0.1: 0.00}}
COLUMNS = ["vendor", "size, B", "rate, Hz", "retries", "loss", "received/sent", "calls, Hz", "written, Hz", "p50, ms",
           "p99, ms", "first try", "repairs per sample", "air", "of it ACKNACK", "not matched", "published"]


def load(vendor, case, options, writes):
    command = [options.build / f"tests/{vendor}_load", "--reliable", "--keep-last", 10, "--until-matched", 1, "--settle",
               0.5, "--for", options.discovery + options.seconds + options.linger]
    if writes:
        command += ["--publish", "t", "--size", case["size"], "--rate", case["rate"], "--count",
                    round(options.seconds * case["rate"]), "--linger", options.linger]
    else:
        command += ["--subscribe", "t", "--patience", options.discovery]  # not to know the writer by then is no failure
    name = "writer" if writes else "reader"
    command += ["--writer", 0 if writes else 1, "--csv", f"{{results}}/{0 if writes else 1}.csv"]
    return own.Program(name, command, on_exit="end" if writes else "ignore")


def of_ledger(run):
    """What the run's ledger says of the topic: shares of its samples, and of the time that the air is used."""
    [(samples, first_try, repairs)] = run.query(
        "select sum(samples), sum(first_try), sum(repairs) from air_topics where samples > 0")
    air = dict(run.query("select kind, 1e-9 * sum(airtime_ns) from air_accounts group by 1"))
    simulated = float(run.line("simulated_s"))
    return {"first_try": first_try / samples if samples else None, "repairs": repairs / samples if samples else None,
            "air": sum(air.values()) / simulated, "acknack": air.get("ACKNACK", 0) / simulated,
            "losses": dict(run.query("select verdict, sum(count) from sample_losses group by 1"))}


def measure(case, options):
    stations = [own.Station("writer", 0, 0, [load(case["vendor"], case, options, True)]),
                own.Station("reader", 10, 0, [load(case["vendor"], case, options, False)])]
    radio = own.radio(loss={"probability": case["loss"]}, **RETRIES[case["retries"]])
    seconds = options.discovery + options.seconds + options.linger + 2
    with own.played(options.build, own.scenario(stations, seconds, radio), options.factor, seed=1 + case["run"],
                    kept=options.kept) as run:
        found = journals.totals({i: run.folder / f"{i}.csv" for i in range(2)})
        pooled = found.pooled()
        wrote = [int(row["mono_ns"]) for row in journals.rows(run.folder / "0.csv") if row["event"] == "write"]
        span = 1e-9 * (max(wrote) - min(wrote)) if len(wrote) > 1 else None
        return {"status": run.status, **run.cost(), "offered": found.offered, "written": found.written, "received": found.received,
                "span": span, "p50": 1e3 * figures.quantile(pooled, 0.5) if pooled else None,
                "p99": 1e3 * figures.quantile(pooled, 0.99) if pooled else None, **of_ledger(run), "summary": run.out}


def shown(case, rows):
    """A line of the table from the runs of a case."""
    matched = [row for row in rows if row["written"] > 0]
    shares = sorted(row["received"] / row["written"] for row in matched)

    def middle(key):
        values = [row[key] for row in matched if row[key] is not None]
        return statistics.median(values) if values else None

    def rate(key):
        values = [(row[key] - 1) / row["span"] for row in matched if row["span"]]
        return statistics.median(values) if values else None
    share = figures.with_interval(figures.median(shares), figures.interval(shares, figures.median)) if shares else "-"
    published = PUBLISHED[case["vendor"], case["size"]].get(case["loss"]) if case["rate"] == 30 else None
    return [case["vendor"], case["size"], case["rate"], case["retries"], case["loss"], share, rate("offered"),
            rate("written"), *(middle(key) for key in ("p50", "p99", "first_try", "repairs", "air", "acknack")),
            len(rows) - len(matched), published]


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    own.add_factor(parser)
    parser.add_argument("--seconds", type=float, default=10, help="of publishing")
    parser.add_argument("--linger", type=float, default=3, help="s for the last repairs")
    parser.add_argument("--discovery", type=float, default=40, help="s that may pass until they know each other")
    parser.add_argument("--losses", type=float, nargs="+", default=LOSSES)
    parser.add_argument("--sizes", type=int, nargs="+", default=sorted({size for size, _ in TRAFFIC}), help="bytes")
    parser.add_argument("--vendors", nargs="+", default=["fastdds", "cyclone"])
    parser.add_argument("--short", action="store_true", help="two cases, to see that it works")
    options = parser.parse_args()
    traffic = [one for one in TRAFFIC if one[0] in options.sizes]
    if options.short:
        options.runs, options.seconds, options.linger, options.losses, traffic = 1, 2, 1, [0.2], TRAFFIC[:1]
        options.vendors = ["cyclone"]
    store = Store(options.store)
    cases = [{"vendor": vendor, "size": size, "rate": rate, "retries": retries, "loss": loss}
             for size, rate in traffic for vendor in options.vendors for retries in RETRIES for loss in options.losses]
    whole = [{**case, "run": run} for case in cases for run in range(options.runs)]
    rows = store.get_all(whole, lambda case: measure(case, options), options.parallel)
    print(figures.table(COLUMNS, [shown(case, [row for row in rows if all(row[key] == case[key] for key in case)])
                                  for case in cases]))
    print(own.costs(rows))


if __name__ == "__main__":
    main()
