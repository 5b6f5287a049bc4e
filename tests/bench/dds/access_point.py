#!/usr/bin/env python3
"""Robots with DDS on one access point: small samples of each to all others beside one large reliable stream, over 802.11g
and over n and ac with their aggregation.

    cmake --build build/release --target baraka baraka-holder cyclone_load
    tests/bench/dds/access_point.py [--stations N] [--radios NAME...] [--runs N] [--store FILE] [--short]

Stations on a circle of 5 m around the access point, on which each byte is twice on the air: from the sender to it, and from
it to the receivers, group frames at the radio's broadcast rate. All publish 64 B ten times a second to all others, best
effort; the first one sends 60 kB forty times a second to the one opposite, reliable, keep last 10, 19.2 Mb/s without
headers. Cyclone DDS. Medians of the runs, which differ by seed; latencies from the call of write to the program that reads,
of all runs' samples.
"""
import statistics

import figures
import journals
import own
from store import Store

# Keys of the radio over the file of config/radios.
RADIOS = {"g, 54 Mb/s": ("ieee80211g", {}),
          "g, EDCA": ("ieee80211g", {"qos": True}),
          "n, 20 MHz": ("ieee80211n", {}),
          "ac, 20 MHz": ("ieee80211ac", {"width": "20 MHz", "mcs": 8}),
          "ac, 80 MHz": ("ieee80211ac", {}),
          "ac, 80 MHz, single MPDUs": ("ieee80211ac", {"aggregation": {"max_ampdu": 0}})}
PROFILE = "cyclone_spdp_500ms"
SMALL, STREAM = "small", "stream"
SHARES = 0.5, 0.95, 0.99
COLUMNS = ["radio", "topic", "samples", "delivered", *(f"p{share:.0%}, ms".replace("%", "") for share in SHARES),
           "written, Hz", "first try", "repairs per sample", "air of the topic", "air", "wall time, s"]


class AccessPoint(own.Station):
    """A station without a network of its own: it only relays."""

    def section(self):
        return {key: value for key, value in super().section().items() if key not in ("network", "programs")}


def journal(number):
    return f"{number}.csv"


def load(name, number, options, *more, **keys):
    command = [options.build / "tests/cyclone_load", "--writer", number, "--csv", f"{{results}}/{journal(number)}",
               "--patience", options.discovery, "--settle", 1, "--for", options.seconds + options.discovery + 5, *more]
    return own.Program(name, command, own.environment("cyclone", PROFILE), **keys)


def count_of(rate, options):
    return ["--rate", rate, "--count", round(rate * options.seconds)]


def stations_of(options):
    """The access point, and the stations; numbers from `stations` on are the stream's writer and reader."""
    stations = [AccessPoint("ap", 0, 0, [])]
    for i, (x, y) in enumerate(own.circle(options.stations)):
        programs = [load(SMALL, i, options, "--best-effort", "--publish", SMALL, "--subscribe", SMALL, "--size", 64,
                         *count_of(10, options), "--until-matched", options.stations - 1, "--linger", 2,
                         start=0.2 + 0.05 * i)]
        if i == 0:
            programs.append(load(STREAM, options.stations, options, "--reliable", "--keep-last", 10, "--publish", STREAM,
                                 "--size", 60_000, *count_of(40, options), "--until-matched", 1, "--linger", 2,
                                 on_exit="end", start=1 + 0.05 * options.stations))
        elif i == options.stations // 2:
            programs.append(load(STREAM, options.stations + 1, options, "--reliable", "--keep-last", 10, "--subscribe", STREAM,
                                 start=1 + 0.05 * options.stations))
        stations.append(own.Station(f"s{i}", x, y, programs))
    return stations


def measure(case, options):
    standard, keys = RADIOS[case["radio"]]
    radio = own.radio(standard, bss={"access_point": "ap"}, **keys)
    seconds = options.seconds + options.discovery + 10
    with own.played(options.build, own.scenario(stations_of(options), seconds, radio), options.factor, seed=1 + case["run"],
                    kept=options.kept) as run:
        files = {i: run.folder / journal(i) for i in range(options.stations + 2)}
        return {"status": run.status, **run.cost(), "air": air_of(run),
                "topics": {topic: of_topic(run, files, topic) for topic in (SMALL, STREAM)}}


def of_topic(run, files, topic):
    found = journals.totals(files, {topic})
    times = [int(row["mono_ns"]) for file in files.values() for row in journals.rows(file)
             if row["event"] == "write" and row["topic"] == topic]
    span = 1e-9 * (max(times) - min(times)) if len(times) > 1 else None
    [ledger] = run.query(f"select sum(samples), sum(first_try), sum(repairs) from air_topics where topic = '{topic}'")
    return {"written": found.written, "received": found.received, "delivered": found.delivered,
            "rate": found.written / span if span else None, "latencies": found.pooled(), "ledger": ledger,
            "air": air_of(run, f"where topic = '{topic}'")}


def air_of(run, where=""):
    """Share of the simulated time in which there is something on the air."""
    [(air,)] = run.query(f"select 1e-9 * sum(airtime_ns) from air_accounts {where}")
    return (air or 0) / float(run.line("simulated_s"))


def middle(values):
    """Median of those that there are."""
    known = [value for value in values if value is not None]
    return statistics.median(known) if known else None


def shown(radio, rows):
    """A line of the table for each topic."""
    lines = []
    for topic in (SMALL, STREAM):
        some = [row["topics"][topic] for row in rows]
        pooled = sorted(late for one in some for late in one["latencies"])
        samples, first_try, repairs = (sum(one["ledger"][i] or 0 for one in some) for i in range(3))
        lines.append([radio, topic, len(pooled), middle(one["delivered"] for one in some),
                      *(1e3 * figures.quantile(pooled, share) if pooled else None for share in SHARES),
                      middle(one["rate"] for one in some),
                      first_try / samples if samples else None, repairs / samples if samples else None,
                      middle(one["air"] for one in some), *(middle(row[key] for row in rows) for key in ("air", "wall"))])
    return lines


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--stations", type=int, default=20)
    parser.add_argument("--radios", nargs="+", choices=RADIOS, default=list(RADIOS))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    parser.add_argument("--seconds", type=float, default=10, help="simulated, from the first sample on")
    parser.add_argument("--discovery", type=float, default=10, help="simulated seconds at most until all know each other")
    own.add_factor(parser)
    parser.add_argument("--short", action="store_true", help="a small case, to see that it works")
    options = parser.parse_args()
    if options.short:
        options.stations, options.runs, options.seconds, options.discovery = 3, 1, 2, 5
        options.radios = ["g, 54 Mb/s", "ac, 80 MHz"]
    store = Store(options.store)
    rows = store.get_all([{"radio": radio, "run": run} for radio in options.radios for run in range(options.runs)],
                         lambda case: measure(case, options), options.parallel)
    lines = [line for radio in options.radios for line in shown(radio, [row for row in rows if row["radio"] == radio])]
    print(figures.table(COLUMNS, lines))
    print(own.costs(rows))


if __name__ == "__main__":
    main()
