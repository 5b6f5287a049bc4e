#!/usr/bin/env python3
"""`baraka view` as a page sees it: what it answers is what the record says, and nobody else gets anything."""
import contextlib
import json
import os
import pathlib
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest
import urllib.error
import urllib.request

from baraka import BIN, CASE_STUDY, ROOT

UNTIL = 130_000_000_000  # ns


class View:
    """`baraka view` under way."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([BIN / "baraka", "view", *map(str, arguments), "--no-open"],
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        self.address = line.removeprefix("view: ").strip().rstrip("/")

    def get(self, path, **headers):
        request = urllib.request.Request(self.address + path, headers=headers)
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.load(answer)

    def status(self, path, method="GET", **headers):
        request = urllib.request.Request(self.address + path, headers=headers, method=method)
        try:
            with urllib.request.urlopen(request, timeout=10) as answer:
                return answer.status
        except urllib.error.HTTPError as error:
            error.close()
            return error.code

    def end(self):
        self.process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.communicate(timeout=10)
        self.process.kill()
        return self.process.returncode


class OfACaseStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name) / "case_study"
        subprocess.run([BIN / "baraka", "run", CASE_STUDY, "--controllers", "in-process", "--until", "130",
                        "--set", "record.frames=all", "--out", cls.folder], check=True, capture_output=True,
                       env={**os.environ, "BARAKA_CONTROLLER_PATH": str(BIN)}, timeout=120)
        cls.database = sqlite3.connect(cls.folder / "run.sqlite")
        cls.addClassCleanup(cls.database.close)
        cls.view = View(cls.folder)
        cls.addClassCleanup(cls.view.end)

    def rows(self, sql):
        return self.database.execute(sql).fetchall()

    def columns(self, path):
        tile = self.view.get("/api/runs/0/" + path)
        self.assertTrue(tile["complete"])
        return tile["columns"]

    def test_the_world_is_the_scenarios(self):
        world = self.view.get("/api/runs/0/world")
        self.assertEqual([(a["agent"], a["name"], a["kind"], a["x"], a["y"]) for a in world["agents"]],
                         self.rows("SELECT agent, name, kind, x_m, y_m FROM agents ORDER BY agent"))
        self.assertEqual([tuple(link) for link in world["links"]], self.rows("SELECT a, b FROM links ORDER BY a, b"))
        robot = world["agents"][25]
        shape = world["shapes"][robot["shape"]]
        self.assertEqual(len([w for w in shape["wheels"] if w["kind"] == "omni"]), 3)
        self.assertEqual(len(robot["infrared"]), 6)
        self.assertAlmostEqual(robot["range_m"], 250.158, places=3)
        self.assertEqual(world["recorded"]["frames"], "all")
        self.assertEqual(world["until"], UNTIL)

    def test_each_frame_is_there_with_all_its_ends(self):
        frames = self.columns("frames/13/0")
        self.assertEqual(list(zip(frames["at"], frames["transmitter"], frames["receiver"], frames["airtime"])),
                         self.rows("SELECT at_ns, transmitter, receiver, airtime_ns FROM frames "
                                   "ORDER BY at_ns, transmitter, rowid"))
        self.assertEqual(sum(map(len, frames["ends"])), self.rows("SELECT COUNT(*) FROM frame_ends")[0][0])
        # The same, tile by tile of a second.
        count = sum(len(self.columns(f"frames/10/{i}")["at"]) for i in range(0, 122))
        self.assertEqual(count, len(frames["at"]))

    def test_poses_messages_states_and_routes_are_the_records(self):
        poses = self.columns("poses/13/0")
        recorded = set(self.rows("SELECT agent, at_ns, x_m, y_m, theta_rad FROM poses"))
        self.assertLessEqual(recorded, set(zip(*poses.values())))
        messages = self.columns("messages/13/0")
        delivered = [(sender, number, *delivery) for sender, number, deliveries in
                     zip(messages["sender"], messages["id"], messages["deliveries"]) for delivery in deliveries]
        self.assertEqual(sorted(delivered), self.rows(
            "SELECT sender, id, receiver, at_ns, delay_ns, transmissions FROM deliveries ORDER BY 1, 2, 3"))
        states = self.columns("states/13/0")
        self.assertEqual(sorted(zip(states["agent"], states["at"], states["state"])),
                         sorted(self.rows("SELECT agent, at_ns, state FROM states")))
        for agent, changes in self.rows("SELECT agent, COUNT(*) FROM routes GROUP BY agent"):
            self.assertGreaterEqual(len(self.view.get(f"/api/runs/0/routes/{agent}")["columns"]["at"]), changes)

    def test_a_tile_takes_less_than_a_tenth_of_a_second(self):
        self.view.get("/api/runs/0/frames/13/0")
        begin = time.monotonic()
        for kind in ("poses", "frames", "messages", "states", "events", "readings", "queues", "log"):
            self.view.get(f"/api/runs/0/{kind}/12/1")
        self.assertLess((time.monotonic() - begin) / 8, 0.1)

    def test_others_get_nothing(self):
        self.assertEqual(self.view.status("/api/view"), 200)
        self.assertEqual(self.view.status("/api/view", Host="evil.example"), 421)
        self.assertEqual(self.view.status("/api/view", Origin="http://evil.example"), 403)
        self.assertEqual(self.view.status("/api/control", method="POST"), 403)
        self.assertEqual(self.view.status("/api/view", method="PUT"), 405)
        for path in ("/run.sqlite", "/../run.sqlite", "/api/runs/0/run.log", "/api/runs/0/%2e%2e/run.sqlite"):
            self.assertEqual(self.view.status(path), 404, path)

    def test_several_results_stand_side_by_side(self):
        view = View(self.folder, self.folder.parent)  # the same one twice is shown once
        self.addCleanup(view.end)
        self.assertEqual([run["name"] for run in view.get("/api/view")["runs"]], ["case_study"])

    def test_it_ends_when_interrupted(self):
        view = View(self.folder)
        self.assertEqual(view.end(), 0)

    def test_a_taken_port_is_named(self):
        port = self.view.address.rsplit(":", 1)[1]
        second = subprocess.run([BIN / "baraka", "view", self.folder, "--no-open", "--port", port],
                                capture_output=True, text=True, timeout=20, check=False)
        self.assertEqual(second.returncode, 2)
        self.assertIn(f"port {port} of 127.0.0.1 is taken", second.stderr)


class OfAScenario(unittest.TestCase):
    def test_it_is_shown_as_it_will_start(self):
        view = View(CASE_STUDY)
        self.addCleanup(view.end)
        self.assertEqual(view.get("/api/view")["mode"], "scenario")
        world = view.get("/api/runs/0/world")
        self.assertEqual(len(world["agents"]), 26)
        self.assertIn([1, 2], world["links"])
        self.assertEqual(world["until"], 0)

    def test_mistakes_are_those_of_check(self):
        with tempfile.TemporaryDirectory() as folder:
            wrong = pathlib.Path(folder) / "wrong.yaml"
            wrong.write_text("version: 1\nname: wrong\nradioo: {}\n")
            for scenario, words in ((wrong, "radioo"),
                                    (ROOT / "config/invalid/program_that_is_not_there.yaml",
                                     "12:9: command: no program 'no_such_program_anywhere' in PATH")):
                view, check = (subprocess.run([BIN / "baraka", *command, scenario], capture_output=True, text=True,
                                              timeout=20, check=False)
                               for command in (["view", "--no-open"], ["check", "--kind", "scenario"]))
                self.assertEqual(view.returncode, 2)
                self.assertIn(words, view.stderr)
                self.assertEqual(view.stderr, check.stderr)


if __name__ == "__main__":
    unittest.main()
