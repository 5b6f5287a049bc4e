#!/usr/bin/env python3
"""Is the answer of `baraka fleet` from a recording that of the programs themselves?

    cmake --build build/release --target baraka baraka-holder baraka-topics-cyclonedds cyclone_load
    tests/bench/dds/fleet_truth.py [--fleets N...] [--runs N] [--seconds S] [--warm-up S]
                                   [--again] [--out DIR]

Ten fleets: three mixes of topics, 802.11g, n and ac, one and two access points. Of each, one robot's programs (Cyclone DDS, a
process for each topic) run with a base for `--recorded` seconds, and what the robot's radio sends and receives is captured. Then
the fleet is asked twice for the same numbers of robots, up to the first that does not hold: with the topics of the capture, played
by baraka-topics-cyclonedds, and with those programs in every robot. Compared are the largest numbers of robots and, where both
hold, shares and medians of the latency. `within` counts the medians that differ by at most 15 %, and `intervals` those whose 95 %
intervals overlap: how topics lie to each other in time is drawn once in a run, so few runs say little about latencies.
With --again the first answer is that of the programs, too, with other seeds: what the numbers of few runs are worth.
"""
import argparse
import csv
import json
import pathlib
import re
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
BEGIN = 'sleep $(printf %s "$0" | cksum | awk \'{print ($1 % 1000) / 1000}\'); exec "$@"'


def load(options, writer, name, *more):
    program = [str(options.build / "tests/cyclone_load"), "--writer", str(writer), "--csv", "{results}/{agent}." + name + ".csv",
               "--patience", "0", "--settle", "0.5", "--for", "1000", *map(str, more)]
    return {"name": name, "on_exit": "fail", "command": ["/bin/sh", "-c", BEGIN, "{results} {agent} " + name, *program]}


def reliability(is_reliable):
    return ["--reliable", "--keep-last", 10] if is_reliable else ["--best-effort"]


def writers(options, mix):
    return [load(options, i, name, "--publish", f"rt/{name}", "--size", size, "--rate", rate, *reliability(reliable))
            for i, (name, size, rate, reliable) in enumerate(MIXES[mix])]


def readers(options, mix):
    return [load(options, 50 + i, name, "--subscribe", f"rt/{name}", *reliability(reliable))
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
    file = write(folder / "one.yaml", {**scenario(fleet, {"programs": writers(options, fleet[0])},
                                                  {"programs": readers(options, fleet[0])}),
                                       "record": {"air": "robot.pcapng", "air_heard_by": "r0"}})
    baraka(options, "run", file, "--until", options.recorded, "--out", folder / "one", "--overwrite")
    return folder / "one" / "robot.pcapng"


def ask(options, fleet, folder, kind, robots, base, *, seed=1):
    """The largest number of robots up to which all hold, and the rows of the table by number and topic."""
    write(folder / f"{kind}_scenario.yaml", scenario(fleet, robots, base))
    largest, cause, rows = 0, "-", []
    for number in fleet[4]:
        file = write(folder / f"{kind}.yaml", {
            "version": 1, "scenario": f"{kind}_scenario.yaml", "need": NEED, "replications": options.runs, "seed": seed,
            "robots": {"group": "robots", "from": fleet[4][0], "to": number, "step": fleet[4][1] - fleet[4][0]},
            "warm_up": f"{options.warm_up} s", "until": f"{options.warm_up + options.seconds} s"})
        out = baraka(options, "fleet", file, "--out", folder / kind)
        with open(folder / kind / "fleet.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        if any(row["holds"] == "0" for row in rows):
            cause = re.search(r"Cause: ([^(]+) \(", out).group(1)
            break
        largest = number
    return largest, {(int(row["robots"]), row["topic"]): row for row in rows}, cause


def milliseconds(row):
    return [1000 * float(row[of]) if row[of] else None for of in ("p50_s", "p50_low_s", "p50_high_s")]


def differences(from_recording, from_programs, largest):
    """Up to the largest number of both: the greatest difference of shares (points), and of the median latencies how many
    there are, how many are within 15 % and overlap, and which differs most."""
    shares, medians = [0], []
    for key, one in sorted(from_recording.items()):
        other = from_programs.get(key)
        if other is None or key[0] > largest or not (one["p50_s"] and other["p50_s"]):
            continue
        shares.append(100 * abs(float(one["delivered"]) - float(other["delivered"])))
        (ours, low, high), (theirs, their_low, their_high) = milliseconds(one), milliseconds(other)
        overlaps = None in (low, their_low) or (low <= their_high and their_low <= high)
        print(f"  {key[0]} {key[1]}: {ours:.2f} ms ({low} … {high}), {theirs:.2f} ms ({their_low} … {their_high})", file=sys.stderr)
        medians.append((abs(ours / theirs - 1), overlaps, f"{key[0]} x {key[1]}: {ours:.2f}, {theirs:.2f} ms"))
    worst = max(medians, default=(0, True, "-"))
    within = sum(off <= 0.15 for off, _, _ in medians)
    overlapping = sum(overlaps for _, overlaps, _ in medians)
    return max(shares), f"{within} of {len(medians)}", overlapping, f"{100 * worst[0]:.0f} % ({worst[2]})"


def ask_programs(options, fleet, folder, kind, seed=1):
    return ask(options, fleet, folder, kind, {"programs": writers(options, fleet[0])}, {"programs": readers(options, fleet[0])},
               seed=seed)


def ask_recording(options, fleet, folder):
    capture = record(options, fleet, folder)
    names = {f"rt/{name}": f"rt/{name}" for name, *_ in MIXES[fleet[0]]}
    items = [{"from": str(capture), "name": name, "rename": {name: name}, "readers": ["base"], "history": 10} for name in names]
    return ask(options, fleet, folder, "recording", {"topics": items}, {})


def compared(options, number, folder):
    fleet = FLEETS[number - 1]
    ran = ask_programs(options, fleet, folder, "programs")
    played = ask_programs(options, fleet, folder, "again", 1001) if options.again else ask_recording(options, fleet, folder)
    both = min(played[0], ran[0])
    share, *medians = differences(played[1], ran[1], both)
    steps = [0, *fleet[4]]
    off = abs(steps.index(played[0]) - steps.index(ran[0]))
    return [number, fleet[0], fleet[1], fleet[3], played[0], ran[0], off, f"{share:.1f}", *medians, played[2], ran[2]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--fleets", type=int, nargs="+", default=range(1, len(FLEETS) + 1))
    parser.add_argument("--runs", type=int, default=6)
    parser.add_argument("--warm-up", type=float, default=4)
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--recorded", type=float, default=60)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    first = "the programs, other seeds" if options.again else "the recording"
    print(f"| fleet | topics | radio | access points | from {first} | from the programs | numbers off | share, points | "
          f"medians within | intervals | worst median | cause, {first} | cause, programs |\n" + "|---" * 13 + "|", flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        for number in options.fleets:
            folder = (options.out or pathlib.Path(temporary)) / f"fleet{number}"
            folder.mkdir(parents=True, exist_ok=True)
            print("| " + " | ".join(map(str, compared(options, number, folder))) + " |", flush=True)


if __name__ == "__main__":
    main()
