#!/usr/bin/env python3
"""Ten robots drive between walls and carry programs of all sorts, held in lock-step: equal runs have equal digests, alone and
on a busy machine, with controllers in process, over DDS and inside their agents, as root and as another user.

    lockstep_mix_test.py                      three runs of each way
    BARAKA_MIX_RUNS=20 lockstep_mix_test.py   twenty, of the twenty seconds of the page"""
import os
import shutil
import unittest

import wire
from baraka import BIN, ROOT, Case
from lockstep_inside_test import BusyLoops

REFUSED = wire.why_not()
LOAD = BIN.parent / "tests/fastdds_load"
PYTHON = "/usr/bin/python3"
RUNS = int(os.environ.get("BARAKA_MIX_RUNS", "1"))
END = "20 s" if RUNS > 1 else "6 s"

ECHO = """
import socket, sys, time
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
if len(sys.argv) == 1:
    s.bind(('', 5000))
    while True:
        data, peer = s.recvfrom(2000)
        s.sendto(data, peer)
s.settimeout(0.5)
for i in range(1000):
    begin = time.monotonic_ns()
    s.sendto(b'x' * (i % 1000), (sys.argv[1], 5000))
    try: s.recvfrom(2000); print(i, time.monotonic_ns() - begin, flush=True)
    except TimeoutError: print(i, 'lost', flush=True)
    time.sleep(0.05)
"""

WALLS = [("north", 14, 0.2, 0, 4), ("south", 14, 0.2, 0, -4), ("east", 0.2, 8, 7, 0), ("west", 0.2, 8, -7, 0),
         ("inner", 0.3, 4, 1.4, 0.5), ("screen", 3, 0.3, -3, -1.2)]


def programs():
    """Of each robot: [(name, [word, ...])]."""
    pong, find = ("pong", ["ddsperf", "-D", "60", "pong"]), ("read", [LOAD, "--subscribe", "t", "--for", "60"])
    own = [[("ping", ["ddsperf", "-D", "60", "ping", "10Hz", "size", "64"])], [pong], [pong],
           [("write", [LOAD, "--publish", "t", "--rate", "10", "--size", "200", "--reliable", "--for", "60"])], [find], [find],
           [("ping", ["ping", "-i", "0.1", "r7"])], [("ask", [PYTHON, "-c", ECHO, "10.77.0.9"])],
           [("echo", [PYTHON, "-c", ECHO])], [("shell", ["bash", "-c", "while sleep 0.3; do ping -c 1 -W 1 r0 | tail -1; done"])]]
    return [[*mine, ("babeld", ["babeld", "-I", "/run/babeld.pid", "-S", "/run/babel-state", "wlan0"])] for mine in own]


def controller(i, inside):
    """Two of those inside speak DDS themselves, in a domain of their own."""
    if inside and i in (2, 4):
        return "{program: ros_base, inside: true, parameters: {domain: 1}}"
    return f"{{program: wanderer, inside: {str(inside).lower()}, parameters: {{speed: 0.5 m/s}}}}"


def scenario(folder, seed, inside):
    lines = ["version: 1", "name: mix", f"seed: {seed}", "routing: none", "record: {frames: none}", "world:", "  walls:"]
    lines += [f"    - {{name: {name}, size: [{dx} m, {dy} m, 1 m], position: [{x} m, {y} m], radio_loss: {{per_crossing: 8 dB}}}}"
              for name, dx, dy, x, y in WALLS]
    lines += ["radio:", f"  include: {ROOT}/config/radios/ieee80211g.yaml", "  obstacles: true", "agents:"]
    for i, mine in enumerate(programs()):
        lines += [f"  r{i}:", f"    name: r{i}", f"    robot: {{include: {ROOT}/config/robots/robertino.yaml}}",
                  f"    poses: [{{x: {-6 + 3 * (i % 5)} m, y: {-3 + 6 * (i // 5)} m, yaw: {37 * i} deg}}]",
                  f"    controller: {controller(i, inside)}", f"    network: {{address: 10.77.0.{i + 1}/16}}",
                  "    programs:"]
        for name, words in mine:
            quoted = ", ".join('"' + str(word).replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"' for word in words)
            lines.append(f"      - {{name: {name}, command: [{quoted}]}}")
    lines += [f"end: [{{at: {END}, result: done}}]"]
    file = folder / f"mix{seed}.yaml"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def missing():
    return [program for program in ("ddsperf", "babeld", "ping", "bash") if shutil.which(program, path=wire.PATH) is None]


@unittest.skipIf(REFUSED, REFUSED)
@unittest.skipIf(missing(), "not all programs are there")
class Mix(Case):
    def mix(self, *arguments, seed=1, inside=False):
        finished = self.run_baraka(scenario(self.folder, seed, inside), "--no-inspect", *arguments, timeout=600)
        # ddsperf writes how much memory it has.
        logs = {log.name: [line for line in log.read_text(encoding="utf-8").splitlines() if " rss:" not in line]
                for log in self.out.glob("r?.*.log")}
        return finished["fingerprint"], finished["frames_digest"], logs

    def check_programs(self, logs):
        """Each of them has got somewhere, else equal runs would say nothing."""
        self.assertRegex("\n".join(logs["r0.ping.log"]), r"mean \d+")
        self.assertIn("bytes from", "".join(logs["r6.ping.log"]))
        self.assertGreater(len(logs["r7.ask.log"]), 20)

    def test_equal_runs_are_equal_however_they_are_made(self):
        first = self.mix("--controllers", "in-process")
        self.check_programs(first[2])
        self.assertNotEqual(self.mix("--controllers", "in-process", seed=2)[1], first[1], "another seed")
        for _ in range(RUNS - 1):
            self.assertEqual(self.mix(), first, "controllers over DDS")
        with BusyLoops():
            for _ in range(RUNS):
                self.assertEqual(self.mix(), first, "controllers over DDS, beside four busy loops")

    def test_so_they_are_with_controllers_inside(self):
        first = self.mix(inside=True)
        self.check_programs(first[2])
        self.assertEqual(self.query("SELECT DISTINCT program FROM agents ORDER BY 1"), [("ros_base",), ("wanderer",)])
        for _ in range(RUNS - 1):
            self.assertEqual(self.mix(inside=True), first)
        with BusyLoops():
            for _ in range(RUNS):
                self.assertEqual(self.mix(inside=True), first, "beside four busy loops")


if __name__ == "__main__":
    unittest.main()
