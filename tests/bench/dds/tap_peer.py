#!/usr/bin/env python3
"""Programs with a Cyclone DDS participant each, over ns-3's radio in real time.

    make -C tests/peer/ns3            (libns3-dev)
    cmake --build build/release --target cyclone_load
    tests/bench/dds/tap_peer.py [--build DIR] [--stations N...] [--seconds S] [--size B] [--rate HZ]

Prints, for each number of stations: delivered share, quantiles of the latency with 95 % intervals (bootstrap over pairs
of writer and reader), CPU of the peer in processors, and how late its events were. air_latency.py has the same of ours.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/e2e"))

os.environ.setdefault("BARAKA_BIN", str(ROOT / "build/release/bin"))
import dds_loads  # noqa: E402
import figures  # noqa: E402
import journals  # noqa: E402
from private_network import PrivateNetwork  # noqa: E402

# Discovery is not what is measured: announcements that collide are soon repeated.
PROFILE = "cyclone_spdp_500ms"
STAGGER = 0.1  # s from one program's start to the next one's
RADIO = ["--data=g54", "--control=g24", "--broadcast=g6", "--slot=20"]
COLUMNS = ["stations", "samples", "delivered", "p50, ms", "p99, ms", "late, p50, ms", "late, p99, ms", "CPU"]


class Peer:
    """ns-3 under way with a TAP in each host of a network without a bridge."""

    def __init__(self, program, network, seconds):
        spaces = ",".join(str(network.namespace(i)) for i in range(network.count))
        self.process = subprocess.Popen(
            network.outside(program, f"--namespaces={spaces}", f"--seconds={seconds}", *RADIO),
            stdout=subprocess.PIPE, text=True)
        if self.process.stdout.readline() != "ready\n":
            raise SystemExit(f"{program} does not begin")
        for i in range(network.count):
            network.set_up(i)

    def finish(self):
        """{key: number}."""
        text = self.process.communicate(timeout=600)[0]
        return {key: float(value) for key, value in (line.split(": ") for line in text.splitlines())}


def loads(network, folder, program, stations, options):
    """Started; {number: journal}."""
    common = ["--best-effort", "--publish", "t", "--subscribe", "t", "--size", options.size, "--rate", options.rate,
              "--count", max(1, round(options.seconds * options.rate)), "--until-matched", stations - 1, "--settle", 3,
              "--linger", 2, "--for", options.seconds + options.discovery]
    files = {i: folder / f"{i}.csv" for i in range(stations)}
    started = []
    for i, file in files.items():
        started.append(network.start(i, program, *common, "--writer", i, "--csv", file, stdout=subprocess.DEVNULL,
                                     env=dds_loads.environment(PROFILE)))
        time.sleep(STAGGER)
    return started, files


def measure(stations, options):
    """A row of the table, as a dictionary."""
    with tempfile.TemporaryDirectory(prefix="baraka-tap-") as name, PrivateNetwork(stations, bridge=False) as network:
        whole = options.seconds + options.discovery + 3
        peer = Peer(options.peer, network, whole)
        started, files = loads(network, pathlib.Path(name), options.build / "tests/cyclone_load", stations, options)
        statuses = [one.wait() for one in started]
        cost = peer.finish()
        found = journals.totals(files)
    blocks = list(found.latencies.values())
    row = {"stations": stations, "samples": found.received, "delivered": found.delivered, "alone": sum(map(bool, statuses)),
           "late_ms_median": cost["late_ms_median"], "late_ms_99": cost["late_ms_99"], "cpu": cost["cpu_s"] / whole}
    for share in (0.5, 0.99):
        if found.received:
            row[f"p{share}"] = [1e3 * figures.quantile(found.pooled(), share),
                                *(1e3 * end for end in figures.blocks_interval(
                                    blocks, lambda values, s=share: figures.quantile(values, s), resamples=200))]
    return row


def shown(row):
    def of(share):
        value = row.get(f"p{share}")
        return figures.with_interval(value[0], value[1:]) if value else "-"
    return [row["stations"], row["samples"], row["delivered"], of(0.5), of(0.99), row["late_ms_median"], row["late_ms_99"],
            row["cpu"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--peer", type=pathlib.Path, default=ROOT / "build/peers/tap")
    parser.add_argument("--stations", type=int, nargs="+", default=[2, 10, 20])
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--discovery", type=float, default=20, help="s that may pass until all know each other")
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--rate", type=float, default=10)
    options = parser.parse_args()
    options.build, options.peer = options.build.resolve(), options.peer.resolve()
    if not os.access(options.peer, os.X_OK):
        raise SystemExit(f"no {options.peer}: make -C tests/peer/ns3 (needs libns3-dev)")
    print(figures.table(COLUMNS, [shown(measure(count, options)) for count in options.stations]))


if __name__ == "__main__":
    main()
