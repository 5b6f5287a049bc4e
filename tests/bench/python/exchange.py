#!/usr/bin/env python3
"""What an exchange costs with the wanderer in C++ and in Python, for 1 and for 37 agents of one process.

Usage: exchange.py BIN     prints user and wall microseconds of an exchange, the runs interleaved, medians of five.
"""
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
HERE = pathlib.Path(__file__).resolve().parent
SCENARIO = """version: 1
name: exchange
seed: 1
control_phase: aligned
radio: {{profile: ideal}}
agents:
  robots:
    name: r{{}}
    robot: {{include: {root}/config/robots/robertino.yaml}}
    grid: {{columns: {side}, rows: {rows}, spacing: [2 m, 2 m]}}
    controller: {{program: wanderer, processes: 1}}
end:
  - {{at: {until} s, result: done}}
"""


def play(binary, scenario, program, mode):
    """User and wall seconds, exchanges."""
    with tempfile.TemporaryDirectory() as folder:
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.monotonic()
        out = subprocess.run([binary / "baraka", "run", scenario, "--controllers", mode, "--out", f"{folder}/out", "--set",
                              f"agents.robots.controller.program={program}"], check=True, capture_output=True, text=True,
                             env={**os.environ, "BARAKA_CONTROLLER_PATH": f"{HERE}:{binary}"}).stdout
        wall = next(float(line.split()[1]) for line in out.splitlines() if line.startswith("wall_s"))
        exchanges = next(int(line.split()[1]) for line in out.splitlines() if line.startswith("exchanges"))
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, wall, exchanges, time.monotonic() - began


def main():
    binary = pathlib.Path(sys.argv[1])
    for side, rows, until in ((1, 1, 600), (37, 1, 60)):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write(SCENARIO.format(root=ROOT, side=side, rows=rows, until=until))
            file.flush()
            for mode in ("in-process", "spawn"):
                runs = {"wanderer": [], "wanderer.py": []}
                for _ in range(5):
                    for program, seen in runs.items():
                        seen.append(play(binary, file.name, program, mode))
                for program, seen in runs.items():
                    count = seen[0][2]
                    user, wall = (statistics.median(one[i] for one in seen) / count * 1e6 for i in (0, 1))
                    print(f"{side * rows:3} agents, {mode:10}, {program:11}: {count} exchanges, user {user:7.1f} us, wall {wall:7.1f} us")


if __name__ == "__main__":
    main()
