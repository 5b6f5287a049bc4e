#!/usr/bin/env python3
"""Plays the base field of AntHocNet (docs/scenarios/anthocnet_base_field.md) with several algorithms and seeds, and
prints a table with 95 % intervals (Student-t over seeds), the verdicts of what was lost, and the protocols' events.

    tests/bench/routing/base_field.py [--build DIR] [--seeds 1-10] [--until 900] [--csv FILE] [--set KEY=VALUE]...
                                      [--benchmark] [--disk NAME] [NAME...]

NAME is one of those of ALGORITHMS; default: all that this build knows. The runs follow each other, each at a
low priority; FILE gets a line for each, from which the scenario's figure is drawn (docs/scenarios). With --benchmark, speeds
and the beginnings of the flows are those of the benchmark that the page quotes, and of tests/peer/ns3/field: 1 to 20
m/s, and at random in the first half, or in 180 s if that is less.
"""
import argparse
import contextlib
import csv
import math
import pathlib
import random
import sqlite3
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENARIO = ROOT / "config/scenarios/anthocnet_base_field.yaml"
ALGORITHMS = {name: f"{{algorithm: {name}}}" for name in ("anthocnet", "aodv", "ants", "flooding")}
MEASURES = ("delivery", "delay_mean", "delay_median", "delay_p99", "hops", "frames")
# Quantiles 0.975 of Student's t, by degrees of freedom.
STUDENT = (12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, 2.2010, 2.1788, 2.1604,
           2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930)


WINDOW = 180  # s, in which flows begin
# Two laws of the air with the same range: any overlap is a collision, or what DSSS makes of one of equal power, as in ns-3.
DISKS = {"collisions": "mobility_framework", "dsss": "dsss"}


def quantile(ordered, share):
    """Type 7 of R."""
    place = share * (len(ordered) - 1)
    low = math.floor(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def half_width(values):
    """Of the 95 % interval of the mean; None of a single value."""
    if len(values) < 2:
        return None
    return STUDENT[min(len(values) - 2, len(STUDENT) - 1)] * statistics.stdev(values) / math.sqrt(len(values))


def measured(database):
    """({measure: value}, {verdict: share of all messages}, {event: count}) of a run."""
    query = database.execute
    verdicts = dict(query("SELECT coalesce(verdict, 'on its way'), count(*) FROM messages GROUP BY verdict"))
    sent = sum(verdicts.values())
    delays = sorted(delay / 1e6 for delay, in query("SELECT delay_ns FROM deliveries"))
    frames, = query("SELECT sum(count) FROM frames_sent WHERE class IN ('unicast', 'broadcast')").fetchone()
    hops, = query("SELECT avg(transmissions) FROM deliveries").fetchone()
    has_events = query("SELECT 1 FROM sqlite_master WHERE name = 'routing_events'").fetchone()
    events = dict(query("SELECT event, sum(count) FROM routing_events GROUP BY event")) if has_events else {}
    got = len(delays)
    values = {"delivery": 100 * got / sent, "delay_mean": statistics.mean(delays),
              "delay_median": quantile(delays, 0.5), "delay_p99": quantile(delays, 0.99), "hops": hops,
              "frames": frames / got}
    return values, {verdict: count / sent for verdict, count in verdicts.items()}, events


def of_benchmark(options, seed):
    """Settings: its speeds, and 20 flows from random times on."""
    chance = random.Random(seed)
    starts = [round(chance.uniform(0, min(WINDOW, options.until / 2)), 3) for _ in range(20)]
    flows = ", ".join(f"{{agents: s{i}, parameters: {{to: t{i}, start: {start} s}}}}" for i, start in enumerate(starts))
    return [f"agents.sources.controller.overrides=[{flows}]",
            *(f"agents.{group}.station.path.random_waypoint.speed=[1 m/s, 20 m/s]" for group in ("sources", "sinks", "relays"))]


def of_disk(name):
    return (f"radio={{include: {ROOT}/config/radios/equal_power_disk.yaml, error_model: {DISKS[name]}, data_rate: 2 Mb/s, "
            "control_rate: 2 Mb/s, broadcast_rate: 2 Mb/s, basic_rates: [1 Mb/s, 2 Mb/s]}")


def play(options, algorithm, seed):
    with tempfile.TemporaryDirectory(prefix="baraka-base-field-") as folder:
        command = ["nice", "-n", "10", options.build / "bin/baraka", "run", SCENARIO, "--controllers", "in-process",
                   "--no-inspect", "--seed", seed, "--out", pathlib.Path(folder) / "run", "--log", "error",
                   "--set", f"routing={ALGORITHMS[algorithm]}",
                   "--set", f"end=[{{at: {options.until} s, result: done}}]"]
        given = [of_disk(options.disk)] if options.disk else []
        given += of_benchmark(options, seed) if options.benchmark else []
        for setting in given + options.set:
            command += ["--set", setting]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
        file = pathlib.Path(folder) / "run/run.sqlite"
        with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as database:
            return measured(database)


def is_known(options, algorithm):
    done = subprocess.run([str(options.build / "bin/baraka"), "check", str(SCENARIO), "--set",
                           f"routing={ALGORITHMS[algorithm]}"], capture_output=True, text=True)
    return done.returncode == 0


def interval(values, digits=1):
    width = half_width(values)
    text = f"{statistics.mean(values):.{digits}f}"
    return text if width is None else f"{text} ± {width:.{digits}f}"


def mean_by_name(parts):
    names = sorted({name for part in parts for name in part})
    return {name: statistics.mean(part.get(name, 0) for part in parts) for name in names}


def seeds_of(text):
    low, _, high = text.partition("-")
    return range(int(low), int(high or low) + 1)


def print_table(results):
    print("| algorithm | runs | delivered, % | delay, mean, ms | median, ms | 99 %, ms | transmissions of a message |"
          " frames per message delivered |\n|---|---|---|---|---|---|---|---|")
    for algorithm, runs in results.items():
        cells = [interval([values[name] for values, _, _ in runs], 2 if name in ("hops", "delay_median") else 1)
                 for name in MEASURES]
        print(f"| {algorithm} | {len(runs)} | {' | '.join(cells)} |")
    for algorithm, runs in results.items():
        lost = mean_by_name([verdicts for _, verdicts, _ in runs])
        print(f"\n{algorithm}: " + ", ".join(f"{verdict} {100 * share:.1f} %" for verdict, share in lost.items()))
        events = mean_by_name([events for _, _, events in runs])
        print("  " + ", ".join(f"{event} {count:.0f}" for event, count in events.items() if count))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--seeds", type=seeds_of, default=range(1, 11))
    parser.add_argument("--until", type=int, default=900, help="s")
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--benchmark", action="store_true")
    parser.add_argument("--disk", choices=DISKS, help="the radio config/radios/equal_power_disk.yaml, with that error model")
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_intermixed_args()
    unknown = [name for name in options.names if name not in ALGORITHMS]
    if unknown:
        parser.error(f"no such algorithm: {', '.join(unknown)}; there are {', '.join(ALGORITHMS)}")
    names = options.names or [name for name in ALGORITHMS if is_known(options, name)]
    results = {name: [] for name in names}
    for seed in options.seeds:
        for name in names:
            results[name].append(play(options, name, seed))
            print(f"{name}, seed {seed}: {results[name][-1][0]['delivery']:.1f} %", file=sys.stderr, flush=True)
    if options.csv:
        with options.csv.open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(("algorithm", "seed", *MEASURES))
            for name, runs in results.items():
                for seed, (values, _, _) in zip(options.seeds, runs):
                    writer.writerow((name, seed, *(f"{values[measure]:.6g}" for measure in MEASURES)))
    print_table(results)


if __name__ == "__main__":
    main()
