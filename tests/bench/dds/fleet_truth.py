#!/usr/bin/env python3
"""Is the answer of `baraka fleet` from a recording that of the programs themselves?

    cmake --build build/release --target baraka baraka-holder baraka-topics-cyclonedds cyclone_load
    tests/bench/dds/fleet_truth.py [--fleets N...] [--runs N] [--seconds S] [--warm-up S]
                                   [--again] [--free] [--details] [--out DIR]

Ten fleets: three mixes of topics, 802.11g, n and ac, one and two access points. Of each, one robot's programs (Cyclone DDS, a
process for each topic) run with a base for `--recorded` seconds, and what the robot's radio sends and receives is captured. Then
the fleet is asked twice for the same numbers of robots, until neither holds: with the topics of the capture, played by
baraka-topics-cyclonedds, and with those programs in every robot. Compared are the largest numbers of robots and, where both
hold, shares and medians of the latency; with --details each of them.

When within their periods robots send decides whether a small sample waits behind a large one. It is drawn once in a run, so
latencies of a few runs differ for that reason alone. Therefore the programs write in the phases that the played topics of the
same run had, as that run's record has them; --free leaves them as they come. With --again the first answer is that of the
programs, too, with other seeds: what differs otherwise.
"""
import argparse
import collections
import csv
import json
import pathlib
import re
import sqlite3
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
G, N, AC = "ieee80211g", "ieee80211n", "ieee80211ac"
# Name, payload in bytes, Hz, reliable.
MIXES = {"camera": [("odom", 700, 30, True), ("scan", 3000, 10, False), ("image", 30_000, 10, False)],
         "small": [("odom", 700, 50, True), ("imu", 320, 100, False), ("tf", 1000, 20, True)],
         "lidar": [("odom", 700, 30, True), ("points", 20_000, 15, True)]}
# Mix, radio, its keys, access points, numbers of robots. Written before any of them was run.
FLEETS = [("camera", G, {}, 1, [2, 3, 4, 5]),
          ("small", G, {}, 1, [4, 6, 8, 10, 12]),
          ("lidar", G, {}, 1, [2, 3, 4, 5, 6]),
          ("camera", N, {}, 1, [4, 6, 8, 10, 12]),
          ("small", N, {}, 1, [6, 8, 10, 12]),
          ("lidar", N, {}, 1, [4, 6, 8, 10, 12]),
          ("camera", AC, {"width": "20 MHz", "mcs": 4}, 1, [4, 6, 8, 10, 12]),
          ("lidar", AC, {"width": "20 MHz", "mcs": 4}, 1, [4, 6, 8, 10, 12]),
          ("camera", G, {}, 2, [3, 4, 5, 6]),
          ("lidar", N, {}, 2, [6, 8, 10, 12])]
NEED = [{"topic": "rt/*", "delivered": "99 %", "p95": "100 ms"}]


# Robots are not switched on at the same instant: each program starts within a second, which its agent and the run decide.
BEGIN = 'sleep $(printf %s "$0" | cksum | awk \'{print ($1 % 1000) / 1000}\'); '


def begin(phases):
    """@param phases  by run, agent and name of a program, s"""
    cases = "".join(f"*/{run}/{agent}/{name}) exec \"$@\" --phase {phase:.9f};; " for (run, agent, name), phase in phases.items())
    return BEGIN + f'case "$0" in {cases}esac; exec "$@"'


def load(options, writer, name, phases, *more):
    program = [str(options.build / "tests/cyclone_load"), "--writer", str(writer), "--csv", "{results}/{agent}." + name + ".csv",
               "--patience", "0", "--settle", "0.5", "--for", "1000", *map(str, more)]
    return {"name": name, "on_exit": "fail", "command": ["/bin/sh", "-c", begin(phases), "{results}/{agent}/" + name, *program]}


def reliability(is_reliable):
    return ["--reliable", "--keep-last", 10] if is_reliable else ["--best-effort"]


def writers(options, mix, phases):
    return [load(options, i, name, phases, "--publish", f"rt/{name}", "--size", size, "--rate", rate, *reliability(reliable))
            for i, (name, size, rate, reliable) in enumerate(MIXES[mix])]


def readers(options, mix):
    return [load(options, 50 + i, name, {}, "--subscribe", f"rt/{name}", *reliability(reliable))
            for i, (name, _, _, reliable) in enumerate(MIXES[mix])]


def scenario(fleet, robots, base):
    """Access points that are 10 m apart, robots around them on a circle, a base beside the first one."""
    mix, radio, keys, points, _ = fleet
    names = [f"ap{i}" for i in range(points)]
    agents = {name: {"name": name, "station": {}, "poses": [{"x": f"{10 * i} m", "y": "0 m"}]} for i, name in enumerate(names)}
    if points > 1:
        agents["ap1"]["radio"] = {"channel": 6 if radio in (G, N) else 44}
    return {"version": 1, "routing": "none", "end": [{"at": "1000 s", "result": "over"}],
            "radio": {"include": str(ROOT / f"config/radios/{radio}.yaml"), "bss": {"access_point": names}, **keys,
                      "propagation": [{"model": "log_distance", "exponent": 3}]},
            "agents": {**agents,
                       "base": {"name": "base", "station": {}, "poses": [{"x": "-2 m", "y": "1 m"}], "network": {}, **base},
                       "robots": {"name": "r{}", "station": {}, "network": {}, **robots,
                                  "circle": {"count": 1, "radius": "6 m", "centre": [f"{5 * (points - 1)} m", "0 m"]}}}}


def write(file, content):
    file.write_text(json.dumps(content, indent=1))
    return file


def baraka(options, *arguments):
    done = subprocess.run([options.build / "bin/baraka", *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"baraka {' '.join(map(str, arguments))}: status {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def record(options, fleet, folder):
    """What one robot's programs send. @return the capture."""
    file = write(folder / "one.yaml", {**scenario(fleet, {"programs": writers(options, fleet[0], {})},
                                                  {"programs": readers(options, fleet[0])}),
                                       "record": {"air": "robot.pcapng", "air_heard_by": "r0"}})
    baraka(options, "run", file, "--until", options.recorded, "--out", folder / "one", "--overwrite")
    return folder / "one" / "robot.pcapng"


def ask(options, fleet, folder, number, robots, base, *, seed=1):
    """Whether so many robots hold, the rows of the table by topic, and the cause if they do not."""
    folder.mkdir(parents=True, exist_ok=True)
    write(folder / "fleet_scenario.yaml", scenario(fleet, robots, base))
    file = write(folder / "fleet.yaml", {
        "version": 1, "scenario": "fleet_scenario.yaml", "need": NEED, "replications": options.runs, "seed": seed,
        "robots": {"group": "robots", "from": number, "to": number, "step": 1},
        "warm_up": f"{options.warm_up} s", "until": f"{options.warm_up + options.seconds} s"})
    out = baraka(options, "fleet", file, "--out", folder / "runs")
    with open(folder / "runs/fleet.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    if all(row["holds"] == "1" for row in rows):
        return True, {row["topic"]: row for row in rows}, "-"
    return False, {row["topic"]: row for row in rows}, re.search(r"Cause: ([^(]+) \(", out).group(1)


def phases_in(folder, mix):
    """Of the samples of each run, robot and topic within the topic's period, s. In lock-step it is the same for all of them."""
    periods = {f"rt/{name}": (name, 1e9 / rate) for name, _, rate, _ in MIXES[mix]}
    phases = {}
    for database in sorted((folder / "runs/runs").glob("*/run.sqlite")):
        with sqlite3.connect(database) as record:
            samples = record.execute(
                "SELECT a.name, e.topic, s.entered_ns FROM samples s JOIN dds_endpoints e ON e.guid = s.writer "
                "JOIN agents a ON a.agent = e.agent WHERE e.topic IN (?, ?, ?)", [*periods, ""][:3]).fetchall()
        times = collections.defaultdict(list)
        for agent, topic, entered in samples:
            name, period = periods[topic]
            times[database.parent.name, agent, name].append(entered % period / 1e9)
        phases |= {key: statistics.median_low(some) for key, some in times.items()}
    return phases


def milliseconds(row):
    return [1000 * float(row[of]) if row[of] else None for of in ("p50_s", "p50_low_s", "p50_high_s")]


def differences(number, one, other, details):
    """Of the shares of each topic (points), and of the median latencies: how far apart, and which they are."""
    found = []
    for topic in sorted(one.keys() & other.keys()):
        (ours, *our_interval), (theirs, *their_interval) = milliseconds(one[topic]), milliseconds(other[topic])
        share = 100 * abs(float(one[topic]["delivered"]) - float(other[topic]["delivered"]))
        found.append((abs(ours / theirs - 1), share, f"{number} x {topic}: {ours:.2f}, {theirs:.2f} ms"))
        if details:
            shares = one[topic]["delivered"], other[topic]["delivered"]
            print(number, topic, *shares, ours, our_interval, theirs, their_interval, file=sys.stderr, flush=True)
    return found


def ask_programs(options, fleet, folder, number, phases, seed=1):
    return ask(options, fleet, folder, number, {"programs": writers(options, fleet[0], phases)},
               {"programs": readers(options, fleet[0])}, seed=seed)


def ask_recording(options, fleet, folder, number, capture):
    names = {f"rt/{name}": f"rt/{name}" for name, *_ in MIXES[fleet[0]]}
    items = [{"from": str(capture), "name": name, "rename": {name: name}, "readers": ["base"], "history": 10} for name in names]
    return ask(options, fleet, folder, number, {"topics": items}, {})


def compared(options, index, folder):
    """A row of the table."""
    fleet = FLEETS[index - 1]
    capture = None if options.again else record(options, fleet, folder)
    largest, causes, found = [0, 0], ["-", "-"], []
    for number in fleet[4]:
        at = folder / f"{number}"
        first = (ask_programs(options, fleet, at / "again", number, {}, 1001) if options.again else
                 ask_recording(options, fleet, at / "recording", number, capture))
        phases = {} if options.free else phases_in(at / ("again" if options.again else "recording"), fleet[0])
        second = ask_programs(options, fleet, at / "programs", number, phases)
        for i, (holds, _, cause) in enumerate((first, second)):
            if holds and causes[i] == "-":
                largest[i] = number
            elif not holds and causes[i] == "-":
                causes[i] = cause
        if "-" not in causes:
            break
        if first[0] and second[0]:
            found += differences(number, first[1], second[1], options.details)
    steps = [0, *fleet[4]]
    off = abs(steps.index(largest[0]) - steps.index(largest[1]))
    share, medians = "-", ["-", "-"]
    if found:
        share = f"{max(one[1] for one in found):.1f}"
        medians = [f"{sum(one[0] <= 0.15 for one in found)} of {len(found)}", "{0:.0%} ({2})".format(*max(found))]
    return [index, fleet[0], fleet[1], fleet[3], *largest, off, share, *medians, *causes]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--fleets", type=int, nargs="+", default=range(1, len(FLEETS) + 1))
    parser.add_argument("--runs", type=int, default=6)
    parser.add_argument("--warm-up", type=float, default=4)
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--recorded", type=float, default=60)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--free", action="store_true")
    parser.add_argument("--details", action="store_true")
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    first = "the programs, other seeds" if options.again else "the recording"
    print(f"| fleet | topics | radio | access points | from {first} | from the programs | numbers off | share, points | "
          f"medians within 15 % | the farthest | cause, {first} | cause, programs |\n" + "|---" * 12 + "|", flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        for number in options.fleets:
            folder = (options.out or pathlib.Path(temporary)) / f"fleet{number}"
            folder.mkdir(parents=True, exist_ok=True)
            print("| " + " | ".join(map(str, compared(options, number, folder))) + " |", flush=True)


if __name__ == "__main__":
    main()
