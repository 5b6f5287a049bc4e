#!/usr/bin/env python3
"""Pings between two stations while forty others, on a channel that does not reach them, end their DDS programs: what still
comes for these is answered with ICMP errors. What the kernel of p1 did not send is its OutErrors; the rest of
what is lost came too late on a computer that was too slow. In real time: what is measured are limits of the kernel, by the
wall clock. For each seed:

    together   all in one run; the programs end after 7.2 s
    control    the same, and the programs do not end
    apart      three runs on one processor: in one, of forty stations, one has to tell a hundred senders a second, none of
               which has that address, that its port is closed; in the two others two stations ping

    tests/bench/icmp.py [--seeds N] [--only NAME...] [--show]

Needs ddsperf and ping. Some 45 s a seed. BARAKA_BIN is the folder of the programs; default: build/release/bin.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("BARAKA_BIN", ROOT / "build/release/bin"))
SCENARIO = """
version: 1
radio: {{include: {root}/config/radios/ieee80211g.yaml, propagation: [{{model: log_distance, exponent: 3}}]}}
routing: none
agents:
{agents}end: [{{at: 12.8 s, result: done}}]
"""
SNMP = '{name: snmp, start: 12.3 s, command: [sh, -c, "cat /proc/net/snmp /proc/net/snmp6"]}'
PINGS = f"""
  pinger:
    name: p0
    station: {{}}
    radio: {{channel: 6}}
    poses: [{{x: 0 m, y: 0 m}}]
    network: {{}}
    programs: [{{name: ping, start: 5 s, command: [ping, -q, -i, "0.03", -w, "7", p1]}}]
  ponger:
    name: p1
    station: {{}}
    radio: {{channel: 6}}
    poses: [{{x: 5 m, y: 0 m}}]
    network: {{}}
    programs: [{SNMP}]
"""
ROBOTS = f"""
  robots:
    name: r{{}}
    station: {{}}
    radio: {{channel: 1}}
    circle: {{count: 40, radius: 5 m}}
    network: {{}}
    programs: [{{name: talk, start: 0.5 s, command: [ddsperf, -D, "SECONDS", pub, 1Hz, size, 64, sub]}}, {SNMP}]
"""
ENDING, STAYING = ROBOTS.replace("SECONDS", "7.2"), ROBOTS.replace("SECONDS", "60")
STRANGERS = """
import socket, struct, time
s = socket.socket(socket.AF_INET, socket.SOCK_RAW, socket.IPPROTO_RAW)
to = socket.inet_aton("10.77.0.2")
for i in range(700):
    header = struct.pack("!BBHHHBBH4s4s", 0x45, 0, 1028, i, 0, 64, 17, 0, bytes([10, 77, 1 + i // 250, 1 + i % 250]), to)
    s.sendto(header + struct.pack("!HHHH", 7000, 7000, 1008, 0) + bytes(1000), ("10.77.0.2", 0))
    time.sleep(0.01)
"""
ASKED = f"""
  asker:
    name: asker
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    network: {{}}
    programs: [{{name: ask, start: 5 s, command: [python3, -c, {json.dumps(STRANGERS)}]}}]
  asked:
    name: asked
    station: {{}}
    poses: [{{x: 0 m, y: 1 m}}]
    network: {{}}
    programs: [{SNMP}]
  others: {{name: "r{{}}", station: {{}}, circle: {{count: 38, radius: 5 m}}, network: {{}}}}
"""
RUNS = {"together": [PINGS + ENDING], "control": [PINGS + STAYING], "apart": [ASKED, PINGS, PINGS]}


def start(folder, number, agents, seed, words):
    file = folder / f"{number}.yaml"
    file.write_text(SCENARIO.format(root=ROOT, agents=agents))
    log = open(folder / f"{number}.log", "w", encoding="utf-8")
    with log:
        return subprocess.Popen([*words, BIN / "baraka", "run", file, "--seed", str(seed), "--out", folder / str(number),
                                 "--no-inspect", "--pace", "realtime"], stdout=log, stderr=log)


def errors(text):
    """OutErrors of ICMP and ICMPv6."""
    names, values = (line.split() for line in text.splitlines() if line.startswith("Icmp:"))
    six = re.search(r"^Icmp6OutErrors\s+(\d+)", text, re.M)
    return int(values[names.index("OutErrors")]) + (int(six[1]) if six else 0)


def measure(name, seed):
    """@return what is to be added to the sums of `name`."""
    words = ["taskset", "-c", str(min(os.sched_getaffinity(0)))] if name == "apart" else []
    with tempfile.TemporaryDirectory() as path:
        folder = pathlib.Path(path)
        for run in [start(folder, i, agents, seed, words) for i, agents in enumerate(RUNS[name])]:
            run.wait()
        sums = dict.fromkeys(("sent", "lost", "not_sent", "errors", "warned"), 0)
        for log in folder.glob("*/p0.ping.log"):
            sent, came = re.search(r"(\d+) packets transmitted, (\d+) received", log.read_text()).groups()
            sums["sent"] += int(sent)
            sums["lost"] += int(sent) - int(came)
        for log in folder.glob("*/*.snmp.log"):
            sums["not_sent" if log.name.startswith("p1") else "errors"] += errors(log.read_text())
        sums["warned"] = sum("the kernel never sent" in log.read_text() for log in folder.glob("*.log"))
        return sums


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--only", nargs="+", choices=RUNS, default=list(RUNS))
    parser.add_argument("--show", action="store_true", help="each seed")
    options = parser.parse_args()
    print("| what | seeds | pings | lost | never sent by p1 | seeds with such | errors never sent by the others | warnings |")
    print("|---|---|---|---|---|---|---|---|")
    for name in options.only:
        rows = []
        for seed in range(1, options.seeds + 1):
            rows.append(measure(name, seed))
            if options.show:
                print(name, seed, rows[-1], flush=True)
        sums = {key: sum(row[key] for row in rows) for key in rows[0]}
        print(f"| {name} | {len(rows)} | {sums['sent']} | {sums['lost']} | {sums['not_sent']} |"
              f" {sum(row['not_sent'] > 0 for row in rows)} | {sums['errors']} | {sums['warned']} |", flush=True)


if __name__ == "__main__":
    main()
