#!/usr/bin/env python3
"""What somebody sees who opens the view of a few robots with sensors in a room, and keeps its page open.

Needs the page (./setup pages) and Chromium; where one is missing it is skipped (status 77).
BARAKA_SCREENSHOTS=DIR keeps the pictures it takes.
"""
import contextlib
import json
import math
import os
import pathlib
import re
import sqlite3
import sys
import time
import unittest

from baraka import BIN, CASE_STUDY, Case, Program, send, wait_for
from browser import CHROMIUM, Browser

SKIPPED = 77
ROOM = pathlib.Path(__file__).parent / "room_with_scanners.yaml"
SECOND = 1_000_000_000
INSIDE = 1.95  # m from the middle of the room to its walls


class Tab(Browser):
    def key(self, key):
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=key if len(key) == 1 else "")
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def click(self, x, y):
        for what in ("Pressed", "Released"):
            self.call("Input.dispatchMouseEvent", type=f"mouse{what}", x=x, y=y, button="left", clickCount=1)

    def state(self, name):
        return json.loads(self.run(f"JSON.stringify(baraka.store.state.{name} ?? null)"))

    def panel(self):
        return self.run("document.getElementById('inspector').innerText")

    def box(self, selector):
        return self.run(f"(({{left, top, width, height}}) => [left, top, width, height])(document.querySelector('{selector}').getBoundingClientRect())")


class Room(Case):
    @classmethod
    def setUpClass(cls):
        cls.tab = Tab(1280, 720)
        cls.addClassCleanup(cls.tab.close)

    def setUp(self):
        super().setUp()
        self.addCleanup(self.tab.resize, 1280, 720)
        self.addCleanup(self.tab.forget)

    def keep(self, tab, name):
        if folder := os.environ.get("BARAKA_SCREENSHOTS"):
            tab.screenshot(pathlib.Path(folder) / f"view_{name}.png")

    def serve(self, what):
        server = Program("baraka", "view", what, "--no-open")
        self.addCleanup(server.clean_up)
        return re.match(r"view: (\S+)", server.process.stdout.readline()).group(1)

    def result(self, *arguments):
        self.run_baraka(ROOM, "--controllers", "in-process", "--no-inspect", *arguments)
        return self.serve(self.out)

    def live(self, scenario, *arguments):
        run = self.start(scenario, "--controllers", "in-process", "--no-inspect", "--view", "--no-open", *arguments)
        address = next(found.group(1) for line in run.process.stderr if (found := re.match(r"view: (\S+)", line)))
        self.tab.open(address)
        return run

    def record(self, sql, *values):
        with contextlib.closing(sqlite3.connect(self.out / "run.sqlite")) as database:
            return database.execute(sql, values).fetchall()

    def test_the_room_fills_the_pane(self):
        address, tab = self.result("--until", "2"), self.tab
        for width, height in ((1280, 720), (390, 844)):
            tab.resize(width, height)
            tab.open(f"{address}#theme=light&t=1.0")
            tab.go()
            self.assertFalse(tab.state("mode2d"))  # two bodies: in 3-D
            self.keep(tab, f"room_{width}")
            self.assertFalse(self.overlap(tab.box(".pane h2"), tab.box(".pane .switches")), width)
            for free in (True, False):
                tab.go(mode2d=not free)
                left, top, wide, high = tab.box(".pane")
                corners = [tab.run(f"baraka.project({x}, {y})") for x in (-2.05, 2.05) for y in (-2.05, 2.05)]
                across, down = ([corner[axis] for corner in corners] for axis in (0, 1))
                self.assertTrue(left <= min(across) and max(across) <= left + wide, corners)
                self.assertTrue(top <= min(down) and max(down) <= top + high, corners)
                share = max((max(across) - min(across)) / wide, (max(down) - min(down)) / high)
                self.assertGreater(share, 0.6, (width, free))

    @staticmethod
    def overlap(one, other):
        """@param one, other  boxes: left, top, width, height"""
        return all(one[axis] < other[axis] + other[axis + 2] and other[axis] < one[axis] + one[axis + 2] for axis in (0, 1))

    def test_the_panel_says_that_an_agent_is_not_in_the_run(self):
        self.tab.open(f"{self.result('--until', '1')}#agent=77")
        self.tab.go()
        self.assertIn("No agent of this run has address 77.", self.tab.panel())

    def test_the_free_view_is_left_out_for_many_and_where_the_address_says_so(self):
        address = self.result("--until", "1")
        self.tab.open(f"{address}#2d=1")
        self.assertTrue(self.tab.state("mode2d"))
        self.tab.open(self.tab.run("location.href"))
        self.assertTrue(self.tab.state("mode2d"))
        many = self.serve(CASE_STUDY)  # 26 agents
        self.tab.open(many)
        self.assertTrue(self.tab.state("mode2d"))

    def test_a_scan_is_drawn_where_the_walls_are(self):
        address = self.result("--until", "3")
        self.tab.open(f"{address}#theme=light&t=2.5&agent=1&2d=1")
        self.tab.go()
        self.keep(self.tab, "scan")
        hits = [one for one in self.tab.run("baraka.seen()") if one["channel"] == "lidar"]
        self.assertEqual({one["agent"] for one in hits}, {1, 2})
        self.assertGreater(len(hits), 400)
        bodies = dict((agent, (x, y)) for agent, x, y in self.record("SELECT agent, x_m, y_m FROM poses WHERE at_ns = ?", 2_500_000_000))
        self.assertEqual(set(bodies), {1, 2})
        for hit in hits:
            at_wall = abs(max(abs(hit["x"]), abs(hit["y"])) - INSIDE) < 0.02
            at_body = any(math.dist((hit["x"], hit["y"]), bodies[other]) < 0.25 for other in bodies if other != hit["agent"])
            self.assertTrue(at_wall or at_body, hit)
        # The panel has it as a plot, and in words.
        self.assertTrue(self.tab.run("document.querySelector('#inspector canvas.polar').width") > 0)
        panel = self.tab.panel()
        [(reading,)] = self.record("SELECT reading FROM readings WHERE agent = 1 AND channel = 'lidar' AND at_ns <= ? ORDER BY at_ns DESC LIMIT 1",
                                   2_500_000_000)
        nearest = min(float(value) for value in reading.split() if value != "-")
        self.assertRegex(panel, rf"nearest\s+{nearest:.3g} m, ")
        self.assertRegex(panel, r"rays\s+241, of which (\d+|all) hit something")

    def test_readings_have_names_and_units(self):
        address = self.result("--until", "3")
        self.tab.open(f"{address}#t=2.5&agent=1")
        self.tab.go()
        panel = self.tab.panel()
        self.assertRegex(panel, r"pose\nx\s+-?[\d.]+ m\ny\s+-?[\d.]+ m\nyaw\s+-?[\d.]+°")
        self.assertRegex(panel, r"localisation\nr1\s+[\d.]+ m, \d+° (left|right) \(x -?[\d.]+ m, y -?[\d.]+ m\)")
        # Odometry in the frame of the true pose, and as it was read.
        place = r"x (\S+) m, y (\S+) m, (\S+)°"
        true, believed, read = (tuple(map(float, re.search(rf"{name}\s+{place}", panel).groups())) for name in ("true pose", "by odometry", "from its start"))
        off = float(re.search(r"off by\s+(\S+) m", panel).group(1))
        self.assertAlmostEqual(math.dist(true[:2], believed[:2]), off, delta=0.002)
        self.assertLess(off, 0.05)
        turn = math.radians(20)  # how it starts
        self.assertAlmostEqual(believed[0], -1 + read[0] * math.cos(turn) - read[1] * math.sin(turn), delta=0.002)
        self.assertAlmostEqual(believed[1], -0.5 + read[0] * math.sin(turn) + read[1] * math.cos(turn), delta=0.002)
        self.assertAlmostEqual(believed[2], read[2] + 20, delta=0.02)

    def test_a_scan_that_is_not_recorded_says_which_line_records_it(self):
        address = self.result("--until", "1", "--set", "record.readings=ranges")
        self.tab.open(f"{address}#t=0.5&agent=1")
        self.tab.go()
        self.assertRegex(self.tab.panel(), r"lidar, pose\nnot recorded; record: \{readings: all\} records")

    def test_space_after_a_click_in_the_lanes_plays_on_into_the_run(self):
        """A paused run: from where the click looks back to, through the record, and on with the run."""
        run = self.live(ROOM, "--paused", "--max-speed", "1")
        tab = self.tab
        tab.run("baraka.store.set({speed: 1})")
        for _ in range(3):
            tab.key("c")
        before = wait_for(lambda: (live := tab.state("live"))["paused"] and live["now"] > 0 and live["now"])
        left, top, wide, _ = tab.box("#lanes")
        tab.click(left + 118 + (wide - 126) / 2, top + 40)
        looked = tab.state("t")
        self.assertLess(looked, before)
        tab.key(" ")
        wait_for(lambda: tab.state("live")["now"] > before + SECOND // 2)
        self.assertFalse(tab.state("live")["paused"])
        wait_for(lambda: tab.state("t") > before)
        tab.key(" ")
        wait_for(lambda: tab.state("live")["paused"])
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish().status, 130)

    def test_the_server_stays_as_long_as_the_page_is_open_and_the_page_knows_when_it_has_ended(self):
        run = self.live(ROOM, "--until", "5")
        tab = self.tab
        wait_for(lambda: tab.state("live")["ended"])
        time.sleep(7)  # it left after 3 s
        self.assertIsNone(run.process.poll())
        tab.run("baraka.store.set({chosen: {kind: 'agent', run: 0, agent: 2}})")
        wait_for(lambda: "from its start" in tab.panel() and "none now" in tab.panel())
        self.assertNotIn("server has ended", tab.panel())
        self.assertRegex(tab.run("document.querySelector('.pane h2').innerText"), "room_with_scanners · ieee80211b · until")
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish().status, 0)
        wait_for(lambda: "Its server has ended" in tab.panel())
        self.assertIn("the run has ended", tab.panel())
        # What was not asked for before does not come any more.
        tab.run("baraka.store.set({chosen: {kind: 'agent', run: 0, agent: 1}})")
        wait_for(lambda: "not asked for before the server ended" in tab.panel())

    def test_it_goes_when_its_page_is_closed(self):
        run = self.live(ROOM, "--until", "5")
        wait_for(lambda: self.tab.state("live")["ended"])
        time.sleep(4)
        self.assertIsNone(run.process.poll())
        self.tab.call("Page.navigate", url="about:blank")
        self.assertEqual(run.finish(30).status, 0)

    def test_a_run_that_is_killed_is_not_said_to_go_on(self):
        run = self.live(ROOM, "--paused")
        wait_for(lambda: "the run waits" in self.tab.panel())
        run.process.kill()
        wait_for(lambda: "the run does not answer any more" in self.tab.panel())
        self.assertNotIn("running", self.tab.panel())
        wait_for(lambda: "does not answer" in self.tab.run("document.querySelector('.pane h2').innerText"))

    def test_states_keep_their_colours(self):
        run = self.live(CASE_STUDY, "--paused", "--until", "20", "--max-speed", "1e9")
        tab = self.tab
        states = "baraka.source.runs[0].world.states"
        tab.run("fetch('/api/control', {method: 'POST', headers: {'Content-Type': 'application/json',"
                " 'X-Baraka-Token': sessionStorage.getItem('baraka-token')}, body: JSON.stringify({command: 'break', on: 'time', at: 5e8})})")
        wait_for(lambda: tab.state("live")["paused"])  # before the page knows, Space plays the record
        tab.key(" ")
        early = wait_for(lambda: tab.state("live")["paused"] and tab.state("live")["now"] > 0.4 * SECOND and tab.run(states))
        tab.key(" ")
        wait_for(lambda: tab.state("live")["ended"])
        late = wait_for(lambda: len(now := tab.run(states)) > len(early) and now)
        self.assertEqual(late[:len(early)], early)
        self.assertLess(min(late[len(early):]), early[0])  # in the order of their names they would not have stayed
        send(run.process.pid, "SIGINT")
        run.finish()


if __name__ == "__main__":
    if CHROMIUM is None or not (BIN / "view_page.html").exists():
        print("skipped: needs chromium and ./setup pages")
        sys.exit(SKIPPED)
    unittest.main()
