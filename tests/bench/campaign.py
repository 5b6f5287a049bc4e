#!/usr/bin/env python3
"""Runs a campaign, kills it twice on the way, goes on, and shows in its database that nothing was lost or done
twice; tells the rate, and how long more runs would take.

    tests/bench/campaign.py                              24 runs of config/campaigns/many_robots.yaml, an hour each
    tests/bench/campaign.py --replications 20            all 240
    tests/bench/campaign.py --until "60 s"               a short form
    tests/bench/campaign.py --overhead 100               what a run costs besides its simulation

BARAKA_BIN is the folder of the programs; default: build/release/bin.
"""
import argparse
import os
import pathlib
import signal
import sqlite3
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("BARAKA_BIN", ROOT / "build/release/bin"))
CAMPAIGN = ROOT / "config/campaigns/many_robots.yaml"


def ask(folder, sql):
    database = sqlite3.connect(f"file:{folder / 'campaign.sqlite'}?mode=ro", uri=True, timeout=30)
    try:
        return database.execute(sql).fetchall()
    finally:
        database.close()


def done(folder):
    try:
        return ask(folder, "SELECT COUNT(*) FROM runs WHERE state = 'done'")[0][0]
    except sqlite3.OperationalError:
        return 0


def command(options, folder):
    words = [BIN / "baraka", "campaign", options.file, "--out", folder,
             "--set", f"replications={options.replications}"]
    if options.jobs:
        words += ["--jobs", str(options.jobs)]
    if options.until:
        words += ["--set", f"until={options.until}"]
    return [str(word) for word in words]


def killed_after(count, options, folder):
    process = subprocess.Popen(command(options, folder), stdout=subprocess.DEVNULL)
    while process.poll() is None and done(folder) < count:
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    rows = ask(folder, "SELECT run, attempts, fingerprint, ended FROM runs WHERE state = 'done' ORDER BY run")
    print(f"killed with {len(rows)} runs done")
    return rows


def twice_killed(options, folder):
    points = len(ask_points(options))
    total = points * options.replications
    begin = time.monotonic()
    first = killed_after(max(1, total // 3), options, folder)
    second = killed_after(max(2, 2 * total // 3), options, folder)
    subprocess.run(command(options, folder), check=True)
    wall = time.monotonic() - begin
    rows = {row[0]: row for row in ask(folder, "SELECT run, attempts, fingerprint, ended FROM runs")}
    kept = all(rows[row[0]] == row for row in [*first, *second])
    state = ask(folder, "SELECT state, COUNT(*) FROM runs GROUP BY state")
    again = ask(folder, "SELECT COUNT(*) FROM runs WHERE attempts > 1")[0][0]
    simulated, processor = ask(folder, "SELECT SUM(simulated_s), SUM(user_s) FROM runs")[0]
    print(f"runs: {len(rows)} of {total}; states: {dict(state)}")
    print(f"those done before a kill are as they were then, row by row: {kept}")
    print(f"runs that a kill cut short and that were done again: {again}")
    print(f"integrity of the database: {ask(folder, 'PRAGMA integrity_check')[0][0]}")
    print(f"wall time, what the kills cost included: {wall:.1f} s; simulated: {simulated:.0f} s; "
          f"processor time of the runs that count: {processor:.1f} s")
    print(f"simulated seconds per second: {simulated / wall:.1f}; per second of one processor: "
          f"{simulated / processor:.1f}")
    hours = 240 * 3600 * wall / simulated / 3600
    print(f"240 runs of one hour at this rate: {hours:.2f} h")
    return kept and state == [("done", total)]


def ask_points(options):
    """Points of the campaign, by a campaign that ends at once."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([BIN / "baraka", "campaign", options.file, "--out", out, "--set", "replications=1", "--set",
                        "until=0 s"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return ask(out, "SELECT label FROM points")


def overhead(options):
    """Of runs that simulate nothing: what remains is the process, its folder and the database."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "nothing.yaml"
        file.write_text(f"version: 1\nscenario: {ROOT}/config/scenarios/case_study.yaml\nuntil: 0 s\n"
                        f"replications: {options.overhead}\n")
        out = pathlib.Path(folder) / "out"
        begin = time.monotonic()
        subprocess.run([BIN / "baraka", "campaign", file, "--out", out, "--jobs", str(options.jobs or 1)], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wall = time.monotonic() - begin
        processor, process = ask(out, "SELECT AVG(user_s), AVG(wall_s) FROM runs")[0]
    print(f"{options.overhead} runs of no simulated time: {1e3 * wall / options.overhead:.0f} ms each; of these "
          f"the process {1e3 * process:.0f} ms, its processor time {1e3 * processor:.0f} ms")
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--file", default=CAMPAIGN)
    parser.add_argument("--replications", type=int, default=2)
    parser.add_argument("--until", default="")
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--overhead", type=int)
    options = parser.parse_args()
    if options.overhead:
        return 0 if overhead(options) else 1
    with tempfile.TemporaryDirectory() as folder:
        return 0 if twice_killed(options, options.out or pathlib.Path(folder) / "out") else 1


if __name__ == "__main__":
    raise SystemExit(main())
