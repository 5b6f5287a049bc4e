#!/usr/bin/env python3
"""How fast runs with programs are in lock-step: simulated seconds per second of wall time, and what a delivery costs.

    cmake --build build/release --target baraka baraka-holder cyclone_load fastdds_load
    tests/bench/dds/lockstep_speed.py [--load NAME...] [--seconds S] [--hour] [--beside F] [--store FILE]

Stations on a circle of 5 m, 802.11g at 54 Mb/s. Loads: ddsperf of Cyclone DDS, of which one pings ten times a second and
the others answer; Fast DDS, of which each writes 100 B ten times a second to the next one; forty programs of Cyclone DDS
that come up at once; ten robots that drive, of which each sends 1 kB to the next one ten times a second (--hour: for an
hour). The run and its programs share one processor and are never idle in lock-step: on a quiet machine the wall time is the
processor's. A delivery is a frame of a program that reaches a receiver; a broadcast counts once for each. --beside: each load
at this factor of real time, too, and what part of its frames were late.
"""
import pathlib
import sys

import figures
import own
from store import Store

SIZES = {"cyclone ping": (2, 10, 20, 40), "fastdds ring": (2, 10, 20, 40), "cyclone storm": (40,), "robots": (10,)}
SENDER = pathlib.Path(__file__).resolve().parent / "send_to_next.py"
DRIVING = {"robot": {"include": str(own.ROOT / "config/robots/robertino.yaml")},
           "controller": {"program": "wanderer", "parameters": {"speed": "0.5 m/s"}}}
WALLS = [{"name": f"wall {x} {y}", "size": [f"{20 if x == 0 else 0.1} m", f"{20 if y == 0 else 0.1} m", "0.5 m"],
          "position": [f"{x} m", f"{y} m"]} for x, y in ((0, 10), (0, -10), (10, 0), (-10, 0))]
COLUMNS = ["load", "stations", "pace", "simulated, s", "wall time, s", "processor, s", "speed", "deliveries", "us per delivery", "turns",
           "us per turn", "retransmitted", "late"]


def cyclone_ping(number, count, options):
    role = ["ping", "10Hz"] if number == 0 else ["pong"]
    return own.Program("load", ["ddsperf", "-D", options.seconds + 5, *role])


def fastdds_ring(number, count, options):
    return own.Program("load", [
        options.build / "tests/fastdds_load", "--publish", f"t{number}", "--subscribe", f"t{(number + 1) % count}", "--writer",
        number, "--rate", 10, "--size", 100, "--until-matched", 1, "--for", options.seconds, "--csv", "{results}/%d.csv" % number])


def cyclone_storm(number, count, options):
    return own.Program("load", [
        options.build / "tests/cyclone_load", "--writer", number, "--reliable", "--publish", "t", "--subscribe", "t",
        "--until-matched", count - 1, "--rate", 1, "--for", options.seconds, "--settle", options.seconds, "--csv",
        "{results}/%d.csv" % number], start=0.5)


def robots(number, count, options):
    return own.Program("load", [sys.executable, SENDER, f"10.77.0.{(number + 1) % count + 1}", "1000", "10"])


PROGRAMS = {"cyclone ping": cyclone_ping, "fastdds ring": fastdds_ring, "cyclone storm": cyclone_storm, "robots": robots}


def stations_of(case, options):
    count = case["stations"]
    stations = []
    for i, (x, y) in enumerate(own.circle(count)):
        kind = DRIVING if case["load"] == "robots" else {"station": {}}
        stations.append(own.Station(f"s{i}", x, y, [PROGRAMS[case["load"]](i, count, options)], kind))
    return stations


def seconds_of(case, options):
    return 3600 if case["load"] == "robots" and options.hour and case["factor"] is None else options.seconds


def measure(case, options):
    walls = {"world": {"walls": WALLS}} if case["load"] == "robots" else {}
    written = own.scenario(stations_of(case, options), seconds_of(case, options), own.radio(), **walls)
    with own.played(options.build, written, case["factor"], kept=options.kept) as run:
        if run.status != 0:
            raise SystemExit(str(run))
        sent, again = run.query("SELECT sum(frames), sum(retries) FROM air_accounts")[0]
        (delivered,), = run.query("SELECT coalesce(sum(count), 0) FROM packets")
        wall = float(run.line("wall_s"))
        processor = wall * (float(run.line("cpu_load")) + float(run.line("cpu_load_programs")))
        return {**run.cost(), "wall": wall, "processor": processor, "deliveries": delivered, "retransmitted": again / sent,
                "turns": int(run.line("program_turns", "0")), "late": run.line("program_frames_late", "")}


def shown(row):
    wall = row["wall"]
    return [row["load"], row["stations"], own.pace(row["factor"]), figures.number(row["simulated"]), figures.number(wall),
            figures.number(row["processor"]), figures.number(row["simulated"] / wall), row["deliveries"],
            figures.number(1e6 * wall / row["deliveries"]) if row["deliveries"] else "-", row["turns"] or "-",
            figures.number(1e6 * wall / row["turns"]) if row["turns"] else "-", figures.number(row["retransmitted"]),
            row["late"] or "-"]


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--load", nargs="+", choices=SIZES, default=list(SIZES))
    parser.add_argument("--stations", type=int, nargs="+", help="only these numbers of stations")
    parser.add_argument("--seconds", type=float, default=30, help="simulated")
    parser.add_argument("--hour", action="store_true", help="robots for an hour")
    parser.add_argument("--beside", type=float, help="factor of real time")
    options = parser.parse_args()
    store = Store(options.store)
    cases = [{"load": load, "stations": count, "factor": factor} for load in options.load for count in SIZES[load]
             if not options.stations or count in options.stations
             for factor in ([None, options.beside] if options.beside else [None])]
    rows = [store.get(case, lambda case=case: measure(case, options)) for case in cases]
    print(figures.table(COLUMNS, [shown(row) for row in rows]))
    print(own.costs(rows))


if __name__ == "__main__":
    main()
