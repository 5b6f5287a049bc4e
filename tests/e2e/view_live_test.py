#!/usr/bin/env python3
"""A run that is shown in a browser while it goes on: equal to one that nobody looks at, whatever the page asks for."""
import contextlib
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import threading
import time
import unittest
import urllib.error
import urllib.request

from baraka import BIN, CASE_STUDY, Case, send

UNTIL = 130  # s
FULL = "1e9"  # simulated s per s: as fast as it can


class Page:
    """What a page knows: the address with the token that the run printed."""

    def __init__(self, address):
        self.address, _, self.token = address.partition("#token=")
        self.address = self.address.rstrip("/")

    def get(self, path, headers=None):
        headers = {"X-Baraka-Token": self.token} if headers is None else headers
        request = urllib.request.Request(self.address + path, headers=headers)
        with urllib.request.urlopen(request, timeout=10) as answer:
            return answer.read().decode()

    def now(self):
        return json.loads(self.get("/api/clock"))

    def post(self, command, headers=None, **what):
        headers = {"X-Baraka-Token": self.token, "Content-Type": "application/json"} if headers is None else headers
        request = urllib.request.Request(self.address + "/api/control", method="POST", headers=headers,
                                         data=json.dumps({"command": command, **what}).encode())
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.loads(answer.read() or b"{}")

    def rows(self, kind, level=13, index=0):
        return json.loads(self.get(f"/api/runs/0/{kind}/{level}/{index}"))["columns"]

    def until(self, condition, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            now = self.now()
            if condition(now):
                return now
            time.sleep(0.02)
        raise AssertionError(f"still {now}")


TELEOP = pathlib.Path(__file__).parent / "teleop.yaml"
ALONE = []  # the fingerprint of a run that is not shown


class LiveView(Case):
    COMMON = "--controllers", "in-process", "--until", UNTIL, "--no-inspect"

    def shown(self, *arguments):
        return self.viewed(CASE_STUDY, *self.COMMON, *arguments)

    def viewed(self, *arguments):
        if "--pace" not in arguments and "--max-speed" not in arguments:
            arguments = *arguments, "--max-speed", FULL
        run = self.start(*arguments, "--view", "--no-open")
        for line in run.process.stderr:
            found = re.match(r"view: (\S+)", line)
            if found:
                return run, Page(found.group(1))
        raise AssertionError("no address")

    def ends_as_alone(self, run):
        if not ALONE:
            ALONE.append(self.run_baraka(CASE_STUDY, *self.COMMON)["fingerprint"])
        done = run.finish()
        self.assertEqual(done.status, 0, str(done))
        self.assertEqual(done["fingerprint"], ALONE[0])

    def test_nobody_looks(self):
        run, _ = self.shown()
        self.ends_as_alone(run)

    def test_steps_breaks_and_a_pause_change_nothing(self):
        run, page = self.shown("--paused")
        self.assertTrue(page.now()["paused"])
        self.assertTrue(json.loads(page.get("/api/view"))["can_command"])
        page.post("break", on="time", at=100_000_000_000)
        page.post("resume")
        now = page.until(lambda now: now["paused"])
        self.assertRegex(now["stopped_by"], r"^time 100\.0+ s$")
        self.assertEqual(now["now"], 100_000_000_000 - 1)
        # Ten cycles of all agents, which the case study has aligned: ten control periods.
        period = 100_000_000
        page.post("step", count=10, of="cycle")
        now = page.until(lambda now: now["paused"] and now["now"] > 100_000_000_000)
        self.assertGreaterEqual(now["now"], 100_000_000_000 + 9 * period)
        self.assertLess(now["now"], 100_000_000_000 + 10 * period)
        time.sleep(self.PAUSE)
        self.assertEqual(page.now()["now"], now["now"])
        # What has happened can be read, to the last instant.
        poses = page.rows("poses", 11, 100_900_000_000 // 8 ** 11)
        self.assertEqual(max(poses["at"]), 100_900_000_000)
        page.post("break", on="message", topic="help")
        page.post("resume")
        now = page.until(lambda now: now["paused"] or now["ended"])
        self.assertRegex(now["stopped_by"], r"sent message \d+ of help")
        page.post("clear", id=2)
        page.post("resume")
        self.ends_as_alone(run)

    PAUSE = float(os.environ.get("BARAKA_PAUSE", "2"))  # s

    def test_a_state_stops_it_and_speed_slows_it(self):
        run, page = self.shown("--paused")
        identity = page.post("break", on="state", agent=26)["id"]
        page.post("resume")
        now = page.until(lambda now: now["paused"])
        self.assertRegex(now["stopped_by"], r"^r0 entered \w+$")
        page.post("clear", id=identity)
        page.post("speed", factor=5)
        page.post("resume")
        began, first = time.monotonic(), now["now"]
        time.sleep(1)
        simulated = 1e-9 * (page.now()["now"] - first)
        self.assertLess(simulated, 5 * (time.monotonic() - began) + 0.5)
        self.assertGreater(simulated, 1)
        page.post("speed", factor=0)
        self.ends_as_alone(run)

    def test_who_may_not_command(self):
        run, page = self.shown("--paused")
        host = page.address.removeprefix("http://")
        token = {"X-Baraka-Token": page.token}
        for headers in ({}, {"X-Baraka-Token": "0" * len(page.token)}, {**token, "Host": "evil.example"},
                        {**token, "Origin": "http://evil.example"}, {**token, "Origin": "null"}):
            with self.assertRaises(urllib.error.HTTPError, msg=headers) as refused:
                page.post("resume", headers=headers)
            self.assertIn(refused.exception.code, (400, 401, 403, 421), headers)
            self.assertTrue(page.now()["paused"])
        page.post("resume", headers={**token, "Origin": f"http://{host}"})
        run.finish()

    def test_nobody_reads_it_without_the_token(self):
        run, page = self.shown("--paused")
        for path in ("/api/view", "/api/clock", "/api/runs/0/world"):
            with self.assertRaises(urllib.error.HTTPError, msg=path) as refused:
                page.get(path, headers={})
            self.assertEqual(refused.exception.code, 403, path)
        if (BIN / "view_page.html").exists():
            self.assertIn("<html", page.get("/", headers={}))
        else:
            with self.assertRaises(urllib.error.HTTPError) as missing:
                page.get("/", headers={})
            self.assertIn("./setup pages", missing.exception.read().decode())
        page.post("resume")
        run.finish()

    def test_a_client_that_never_ends_its_request_keeps_nothing_from_ending(self):
        run, page = self.shown()
        host, _, port = page.address.removeprefix("http://").partition(":")
        slow = [socket.create_connection((host, int(port))) for _ in range(20)]
        over = threading.Event()

        def trickle():
            for one in slow:
                one.sendall(b"GET /api/view HTTP/1.1\r\nX-Slow: ")
            while not over.wait(0.1):
                for one in slow:
                    with contextlib.suppress(OSError):
                        one.send(b"a")

        thread = threading.Thread(target=trickle)
        thread.start()
        try:
            self.ends_as_alone(run)
        finally:
            over.set()
            thread.join()
            for one in slow:
                one.close()

    def test_the_token_is_in_no_ones_arguments(self):
        """A desktop: `xdg-open` gets a file that only this user may read, and that leads to the address."""
        bin_ = self.folder / "bin"
        bin_.mkdir()
        opened = self.folder / "opened"
        (bin_ / "xdg-open").write_text(f'#!/bin/sh\n{{ stat -c %a "$1"; echo "$1"; cat "$1"; }} >{opened}.new\nmv {opened}.new {opened}\n')
        (bin_ / "xdg-open").chmod(0o755)
        main, side = os.openpty()
        environment = {**os.environ, "DISPLAY": ":77", "PATH": f"{bin_}:{os.environ['PATH']}"}
        run = subprocess.Popen([BIN / "baraka", "run", CASE_STUDY, *map(str, self.COMMON), "--view", "--paused", "--out", self.folder / "run"],
                               stdin=subprocess.DEVNULL, stdout=side, stderr=subprocess.PIPE, text=True, env=environment)
        os.close(side)
        try:
            address = next(found for line in run.stderr if (found := re.match(r"view: (\S+)", line))).group(1)
            for _ in range(200):
                if opened.exists():
                    break
                time.sleep(0.05)
            mode, name, page = opened.read_text().split("\n", 2)
            self.assertEqual(mode, "600")
            self.assertIn(f"url={address}", page)
            self.assertNotIn(address.partition("#token=")[2], name)
        finally:
            run.send_signal(signal.SIGINT)
            run.stderr.read()
            run.wait()
            run.stderr.close()
            os.close(main)
        self.assertFalse(pathlib.Path(name).exists(), name)

    def test_mistakes_are_named(self):
        run, page = self.shown("--paused")
        for command, what, words in (("step", {"count": 0, "of": "cycle"}, "count"), ("break", {"on": "full moon"}, "one of state"),
                                     ("dance", {}, "one of pause"), ("speed", {"factor": -1}, "factor|speed"),
                                     ("clear", {"id": 7}, "7"), ("drive", {"agent": 1, "vx": 1, "vy": 0, "omega": 0},
                                                                 "driven by hand")):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                page.post(command, **what)
            self.assertRegex(json.loads(refused.exception.read())["error"], words)
        page.post("resume")
        run.finish()

    def test_it_begins_at_real_time(self):
        run = self.start(CASE_STUDY, "--controllers", "in-process", "--until", "600", "--no-inspect", "--view", "--no-open")
        address, told = None, ""
        for line in run.process.stderr:
            told += line
            if (found := re.match(r"view: (http\S+)", line)):
                address = found.group(1)
            elif "--max-speed" in line:
                break
        self.assertIn("plays at real time", told)
        page = Page(address)
        now = page.until(lambda now: now["now"] > 0)
        self.assertEqual(now["speed"], 1)
        began, first = time.monotonic(), now["now"]
        time.sleep(2)
        simulated = 1e-9 * (page.now()["now"] - first)
        self.assertLess(simulated, time.monotonic() - began + 0.5)
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish().status, 130)

    def test_another_speed_to_begin_with(self):
        run, page = self.shown("--paused", "--max-speed", "7.5")
        self.assertEqual(page.now()["speed"], 7.5)
        page.post("speed", factor=0)
        page.post("resume")
        self.ends_as_alone(run)

    def test_it_stays_as_long_as_a_page_is_open(self):
        """A page that nobody sees says that it is open, and asks for nothing else."""
        run, page = self.shown()
        page.until(lambda now: now["ended"])
        for _ in range(7):
            page.get("/api/open")
            time.sleep(1)
        self.assertIsNone(run.process.poll())
        self.assertTrue(page.now()["ended"])
        self.ends_as_alone(run)

    def test_interrupted_while_it_is_paused(self):
        run, page = self.shown("--paused")
        page.now()
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish().status, 130)

    def test_a_robot_is_driven_from_the_page(self):
        """10 s, of which it drives ahead for 2 or more; what came in is recorded, so that the run can be repeated."""
        run, page = self.viewed(TELEOP, "--until", "10", "--pace", "realtime")
        began = time.monotonic()
        for _ in range(20):
            page.post("drive", agent=1, vx=0.2, vy=0, omega=0)
            time.sleep(0.1)
        page.post("drive", agent=1, vx=0, vy=0, omega=0)
        seconds = time.monotonic() - began
        done = run.finish()
        self.assertEqual(done.status, 0, str(done))
        [(x, y)] = self.query("SELECT x_m, y_m FROM bodies")
        self.assertAlmostEqual(x, 0.2 * seconds, delta=0.15)  # 0.2 m/s, give or take what a busy machine does
        self.assertAlmostEqual(y, 0, delta=0.05)
        record = self.out
        repeated = self.run_baraka(TELEOP, "--repeat", record)
        self.assertEqual(repeated["fingerprint"], done["fingerprint"])

    def test_follows_the_clock_and_is_only_watched(self):
        run, page = self.shown("--pace", "realtime:100")
        self.assertFalse(page.now()["can_hold"])
        with self.assertRaises(urllib.error.HTTPError) as refused:
            page.post("pause")
        self.assertIn("keeps real time", json.loads(refused.exception.read())["error"])
        run.finish()


if __name__ == "__main__":
    unittest.main()
