#!/usr/bin/env python3
"""What the view costs and how quick it is, on this machine's software renderer at 1280 x 720.

    BARAKA_BIN=build/release/bin BARAKA_CONTROLLER_PATH=build/release/bin tests/bench/view.py [live] [thousand] [hour]

live: user time and speed of a run in process without the view, with it, and with a page that looks on.
thousand: 1000 stations that move for 60 s and broadcast, frames sampled: until the page is drawn, pictures per second.
hour: 25 motes and 12 robots, every frame recorded: until the page is drawn, seeks to random times, memory of the page.
"""
import pathlib
import random
import re
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "e2e"))
from baraka import BIN, ROOT, Program  # noqa: E402
from browser import Browser  # noqa: E402

MANY = ROOT / "config/scenarios/many_robots.yaml"
COMMON = "--controllers", "in-process", "--no-inspect", "--overwrite"
THOUSAND = """version: 1
name: thousand
radio: {{include: {radio}}}
routing: none
record: {{frames: sample, pose_period: 100 ms}}
end: [{{at: 60 s, result: done}}]
agents:
  all:
    name: s{{}}
    station: {{path: {{random_waypoint: {{from: [0 m, 0 m], to: [2000 m, 2000 m], speed: [1 m/s, 5 m/s], pause: 0 s}}}}}}
    uniform: {{count: 1000, from: [0 m, 0 m], to: [2000 m, 2000 m]}}
    controller: {{program: traffic_source, parameters: {{pattern: poisson, rate: 0.2 Hz, topic: t, size: 64, to: everyone}}}}
"""


def said(process, stream):
    for line in getattr(process, stream):
        found = re.match(r"view: (\S+)", line)
        if found:
            return found.group(1)
    raise AssertionError("no address")


def live(folder):
    def run(shown, looked):
        extra = ("--view", "--no-open", "--max-speed", "1e9") if shown else ()
        program = Program("baraka", "run", MANY, "--until", "1800", *COMMON, "--out", folder / "live", *extra)
        if shown:
            address = said(program.process, "stderr")
        if looked:
            browser.open(address)
        done = program.finish(300)
        assert done.status == 0, done
        return float(done["simulated_s"]) / float(done["wall_s"]), done["fingerprint"]

    browser = Browser(1280, 720)
    speeds = {case: [] for case in ((False, False), (True, False), (True, True))}
    fingerprints = set()
    for _ in range(3):
        for case in speeds:
            speed, fingerprint = run(*case)
            speeds[case].append(speed)
            fingerprints.add(fingerprint)
            if case[1]:
                browser.call("Page.navigate", url="about:blank")
    browser.close()
    alone = statistics.median(speeds[False, False])
    for (shown, looked), values in speeds.items():
        words = "alone" if not shown else "page open" if looked else "with --view"
        print(f"live, {words}: {statistics.median(values):.0f} x real time, {statistics.median(values) / alone:.0%} of alone")
    print(f"fingerprints: {len(fingerprints)}")


class Shown:
    def __init__(self, folder, result):
        self.server = Program("baraka", "view", result, "--no-open")
        self.address = said(self.server.process, "stdout")
        self.browser = Browser(1280, 720)

    def opened(self, bookmark=""):
        begin = time.monotonic()
        self.browser.open(f"{self.address}#{bookmark}")
        self.browser.go()
        return time.monotonic() - begin

    def close(self):
        self.browser.close()
        self.server.clean_up()


def record(folder, scenario, *arguments):
    done = Program("baraka", "run", scenario, *COMMON, "--out", folder / "result", *arguments).finish(600)
    assert done.status == 0, done
    print(f"recorded: {done['wall_s']} s of wall, {(folder / 'result/run.sqlite').stat().st_size / 1e6:.0f} MB")
    return folder / "result"


def thousand(folder):
    scenario = folder / "thousand.yaml"
    scenario.write_text(THOUSAND.format(radio=ROOT / "config/radios/ieee80211b.yaml"))
    shown = Shown(folder, record(folder, scenario))
    print(f"thousand: drawn after {shown.opened('t=20.0'):.2f} s")
    for name, layers in (("as it opens", {}), ("without names", {"labels": False}), ("bodies only", {
            "labels": False, "links": False, "frames": False, "trails": False, "queues": False, "beams": False})):
        shown.browser.run(f"baraka.store.set({{layers: {{...baraka.store.state.layers, ...{layers_text(layers)}}}, t: 20e9, playing: true}})")
        time.sleep(8)
        print(f"thousand, {name}: {shown.browser.run('baraka.fps()'):.1f} pictures/s")
    shown.close()


def layers_text(layers):
    return "{" + ", ".join(f"{name}: {str(on).lower()}" for name, on in layers.items()) + "}"


def hour(folder):
    shown = Shown(folder, record(folder, MANY, "--set", "record.frames=all"))
    print(f"hour: drawn after {shown.opened():.2f} s")
    draw = random.Random(1)
    seeks = []
    for _ in range(60):
        begin = time.monotonic()
        shown.browser.go(t=draw.randrange(3_600_000_000_000))
        seeks.append(time.monotonic() - begin)
    print(f"hour: seeks of 60: median {statistics.median(seeks) * 1e3:.0f} ms, greatest {max(seeks) * 1e3:.0f} ms")
    closer = []
    for _ in range(30):
        t = draw.randrange(3_600_000_000_000)
        begin = time.monotonic()
        shown.browser.go(t=t, view=[t - 5e6, t + 5e6])
        closer.append(time.monotonic() - begin)
    print(f"hour: seeks to 10 ms of 30: median {statistics.median(closer) * 1e3:.0f} ms, greatest {max(closer) * 1e3:.0f} ms")
    print(f"hour: {shown.browser.heap() / 1e6:.0f} MB of objects, {shown.browser.run('baraka.source.bytes') / 1e6:.0f} MB of answers kept")
    resident = subprocess.run(["ps", "--ppid", str(shown.browser.process.pid), "-o", "rss=,args="], capture_output=True, text=True).stdout
    print("hour: resident MB:", [round(int(line.split()[0]) / 1e3) for line in resident.splitlines() if "renderer" in line or "zygote" in line])
    shown.close()


if __name__ == "__main__":
    for name in sys.argv[1:] or ("live", "thousand", "hour"):
        with tempfile.TemporaryDirectory(prefix="baraka-view-bench-", ignore_cleanup_errors=True) as path:
            {"live": live, "thousand": thousand, "hour": hour}[name](pathlib.Path(path))
