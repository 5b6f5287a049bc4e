#!/usr/bin/env python3
"""The view as a browser shows it, beside what the record says.

Needs the page (./setup pages) and Chromium; where one is missing it is skipped (status 77).
BARAKA_SCREENSHOTS=DIR keeps the pictures it takes.
"""
import contextlib
import math
import os
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile
import unittest

from baraka import BIN, CASE_STUDY, Case, Program, wait_for
from browser import CHROMIUM, Browser

PAGE = BIN / "view_page.html"
SKIPPED = 77
ROBOT = 26
ROBOT_COLOUR = 0x00, 0x72, 0xb2  # --robot-0 of the light theme
SECOND = 1_000_000_000


class Shown:
    """The case study's result, a server of it and a browser, for all tests."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="baraka-view-")
        root = pathlib.Path(self.folder.name)
        self.result = root / "case_study"
        done = Program("baraka", "run", CASE_STUDY, "--controllers", "in-process", "--no-inspect", "--out", self.result).finish()
        assert done.status == 0, str(done)
        self.server = Program("baraka", "view", self.result, "--no-open")
        self.address = re.match(r"view: (\S+)", self.server.process.stdout.readline()).group(1)
        self.browser = Browser(1280, 720)

    def close(self):
        self.browser.close()
        self.server.clean_up()
        self.folder.cleanup()


class View(Case):
    @classmethod
    def setUpClass(cls):
        cls.shown = Shown()
        cls.browser = cls.shown.browser

    @classmethod
    def tearDownClass(cls):
        cls.shown.close()

    def tearDown(self):
        self.assertEqual(self.browser.said, [])

    def record(self, sql, *values):
        with contextlib.closing(sqlite3.connect(self.shown.result / "run.sqlite")) as database:
            return database.execute(sql, values).fetchall()

    def opens(self, bookmark):
        self.browser.open(f"{self.shown.address}#theme=light&{bookmark}")
        self.browser.go()

    def keep(self, name):
        folder = os.environ.get("BARAKA_SCREENSHOTS")
        return self.browser.screenshot(pathlib.Path(folder) / f"view_{name}.png" if folder else None)

    def test_the_robot_is_where_the_record_says(self):
        [(x, y)] = self.record("SELECT x_m, y_m FROM poses WHERE agent = ? AND at_ns = ?", ROBOT, 100 * SECOND)
        middle, span = (x + 1.5, y - 0.75), 20  # m
        self.opens(f"t=100.0&map={middle[0]},{middle[1]},{span}"
                   "&layers=-labels,-links,-frames,-beams,-trails,-ranges,-queues")
        pane = self.browser.run("(({left, top, width, height}) => [left, top, width, height])"
                                "(document.querySelector('.pane').getBoundingClientRect())")
        left, top, width, height = pane
        scale = width / span  # px/m: the map is as wide as the pane, north up, its middle in the middle
        wanted = left + width / 2 + (x - middle[0]) * scale, top + height / 2 - (y - middle[1]) * scale
        found = self.keep("robot").places(ROBOT_COLOUR, (int(left), int(top) + 30, int(left + width), int(top + height)))
        self.assertGreater(len(found), 30, "no marker")
        for axis in (0, 1):
            edges = min(p[axis] for p in found), max(p[axis] for p in found) + 1
            self.assertLess(abs(sum(edges) / 2 - wanted[axis]), 1, (edges, wanted))

    def test_arrows_are_as_wide_as_equation_one_says(self):
        # The replica's messages choose by hops: r = 1 / hops, H where the next hop is the end, P = r^beta / sum.
        settings = dict(self.record("SELECT key, value FROM settings WHERE key LIKE 'routing.%'"))
        tables, most, (at, agent, topic, destination), table = {}, 1, (None,) * 4, {}
        for agent_, at_, topic_, destination_, hop, *path in self.record(
                "SELECT agent, at_ns, topic, destination, next_hop, hops, delay_ns, min_snr_db, energy_j FROM routes ORDER BY rowid"):
            ways = tables.setdefault((agent_, topic_, destination_), {})
            ways.pop(hop, None)
            if path[0] is not None:
                ways[hop] = path
            if len(ways) > most and destination_ not in ways:  # H would leave nothing to the others
                most, (at, agent, topic, destination), table = len(ways), (at_, agent_, topic_, destination_), dict(ways)
        self.assertGreater(most, 1, "no choice")
        beta, weights = float(settings["routing.beta"]), metric(settings)
        values = {hop: (weights["direct"] if hop == destination else value(weights, *row)) ** beta for hop, row in table.items()}
        shares = {hop: one / sum(values.values()) for hop, one in values.items()}
        self.opens(f"t={at / 1e9:.9f}&agent={agent}&route={destination},{topic}")
        arrows = self.browser.run("baraka.arrows()")
        self.keep("route")
        of_agent = {one["to"]: one for one in arrows if one["from"] == agent}
        self.assertEqual(set(of_agent), set(shares))
        widest = max(of_agent.values(), key=lambda one: one["probability"])
        for hop, share in shares.items():
            self.assertAlmostEqual(of_agent[hop]["probability"], share, delta=1e-9)
            self.assertAlmostEqual(of_agent[hop]["width"] / widest["width"], share / max(shares.values()), delta=0.02)

    def test_the_first_message_for_help_is_followed_over_its_hops(self):
        sender, identity, sent, delay, hops = self.record(
            "SELECT m.sender, m.id, m.sent_ns, d.delay_ns, d.transmissions FROM messages m JOIN deliveries d USING (sender, id)"
            " WHERE m.destination < 65534 AND m.topic = 'help' ORDER BY m.sent_ns, m.sender, m.id LIMIT 1")[0]
        self.opens(f"t={sent / 1e9:.9f}&message={sender},{identity},{sent}&followed={sender},{identity},{sent}")
        shown = self.browser.run("baraka.hops()")
        self.keep("message")
        came = [hop for hop in shown if hop["first"]]
        self.assertEqual(len(came), hops)
        self.assertEqual(came[-1]["delivered"], delay)
        at = sent
        for hop in came:
            [(began, ended)] = self.record(
                "SELECT f.at_ns, e.at_ns FROM frames f JOIN frame_ends e USING (frame) WHERE f.sender = ? AND f.message = ? AND"
                " f.transmitter = ? AND e.agent = ? AND e.verdict = 'delivered' ORDER BY f.at_ns LIMIT 1",
                sender, identity, hop["from"], hop["to"])
            self.assertEqual((hop["began"], hop["ended"]), (began, ended))
            tries = [one for one in shown if one["from"] == hop["from"] and one["to"] == hop["to"]]
            self.assertEqual(min(one["waited"] for one in tries), min(one["began"] for one in tries) - at)
            at = ended
        self.assertEqual(at - sent, delay)

    def test_a_lost_frame_tells_its_verdict(self):
        frame, transmitter, at, verdict, loser = self.record(
            "SELECT f.frame, f.transmitter, f.at_ns, e.verdict, a.name FROM frames f JOIN frame_ends e USING (frame)"
            " JOIN agents a ON a.agent = e.agent WHERE f.receiver = e.agent AND e.verdict <> 'delivered' ORDER BY f.at_ns LIMIT 1")[0]
        self.opens(f"t={at / 1e9:.9f}&view={at / 1e9 - 0.002:.9f},{at / 1e9 + 0.004:.9f}"
                   f"&frame={transmitter},{frame & (1 << 48) - 1},{at}")
        rows = self.browser.run("[...document.querySelectorAll('#inspector .list tr')].map((row) => [...row.cells].map((c) => c.innerText))")
        self.keep("lost_frame")
        self.assertIn([loser, verdict], [row[:2] for row in rows])

    def test_a_link_reproduces_the_view(self):
        self.opens("t=300.0&view=290,310&agent=26&speed=0.01&follow=26&layers=-links")
        self.browser.run("baraka.store.set({t: 301.5e9, mode2d: false}); new Promise((done) => setTimeout(done, 900))")
        address = self.browser.run("location.href")
        state = self.browser.run("baraka.store.state")
        self.keep("bookmark")
        self.browser.open(address)
        again = self.browser.run("baraka.store.state")
        for key in ("t", "view", "chosen", "speed", "follow", "layers", "mode2d", "theme"):
            self.assertEqual(again[key], state[key], key)

    def test_scrubbing_leaks_nothing(self):
        self.opens("t=0.0")
        end = self.browser.run("baraka.source.end")

        def scrub():
            for quarter in range(5):
                self.browser.go(t=round(end * quarter / 4))
        for _ in range(3):
            scrub()
        before = self.browser.heap()
        for _ in range(10):
            scrub()
        after = self.browser.heap()
        # One more copy of the record's answers (some 2 MB) would show.
        self.assertLess(after - before, 1.5e6, (before, after))

    def test_an_exported_page_needs_no_server(self):
        page = self.folder / "page.html"
        done = Program("baraka", "view", self.shown.result, "--export", page).finish()
        self.assertEqual(done.status, 0, str(done))
        [(sender, identity, sent)] = self.record(
            "SELECT sender, id, sent_ns FROM messages WHERE destination < 65534 AND verdict = 'delivered' ORDER BY sent_ns, sender LIMIT 1")
        bookmark = f"t={sent / 1e9:.9f}&message={sender},{identity},{sent}&followed={sender},{identity},{sent}"
        self.opens(bookmark)
        served = self.browser.run("baraka.hops()")
        self.browser.open(f"{page.as_uri()}#theme=light&{bookmark}")
        self.browser.go()
        self.assertTrue(self.browser.run("baraka.source.exported"))
        self.assertEqual(self.browser.run("baraka.hops()"), served)
        self.assertGreater(len(served), 0)
        self.assertEqual(self.browser.run("performance.getEntriesByType('resource').filter((one) => !one.name.startsWith('data:')).length"), 0)

    def test_a_scenario_is_shown_as_it_will_start(self):
        server = Program("baraka", "view", CASE_STUDY, "--no-open")
        self.addCleanup(server.clean_up)
        address = re.match(r"view: (\S+)", server.process.stdout.readline()).group(1)
        self.browser.open(f"{address}#theme=light&agent={ROBOT}")
        self.browser.go()
        self.assertIn("help_robot", self.browser.run("document.getElementById('inspector').innerText"))
        self.assertTrue(self.browser.run("document.getElementById('notice').hidden"))
        self.assertEqual(self.browser.run("baraka.source.runs[0].world.agents.length"), 26)

    def test_the_keys_work(self):
        self.opens("t=100.0&agent=26")

        def press(key):
            self.browser.run(f"dispatchEvent(new KeyboardEvent('keydown', {{key: {key!r}}})); baraka.idle()")
            return self.browser.run("baraka.idle().then(() => baraka.store.state)")
        self.assertEqual(press("c")["t"], 100_100_000_000)
        self.assertEqual(press("C")["t"], 100_000_000_000)
        [(following,)] = self.record("SELECT MIN(at_ns) FROM frames WHERE at_ns > ?", 100 * SECOND)
        press("f")  # asks for frames, and goes there when they have come
        self.assertEqual(wait_for(lambda: (t := self.browser.run("baraka.store.state.t")) != 100 * SECOND and t), following)
        self.assertTrue(press("?")["help"])
        self.assertIn("next, previous control cycle", self.browser.run("document.getElementById('keys').innerText"))
        self.assertFalse(press("Escape")["help"])
        self.assertEqual(press("End")["t"], self.browser.run("baraka.source.end"))


def metric(settings):
    names = "hops", "delay", "min_snr", "energy"
    given = settings.get("routing.metric", "hops")
    weights = {name: float(settings.get(f"routing.metric.{name}", given == name)) for name in names}
    return {**weights, "direct": float(settings.get("routing.direct_weight", settings.get("routing.metric.direct_weight", 1e6)))}


def value(weights, hops, delay_ns, min_snr_db, energy):
    rate = math.log2(1 + 10 ** (min_snr_db / 10))
    return (hops ** -weights["hops"] * (delay_ns * 1e-9) ** -weights["delay"] * rate ** weights["min_snr"] * energy ** -weights["energy"])


if __name__ == "__main__":
    if CHROMIUM is None or not PAGE.exists():
        print("skipped: needs chromium and ./setup pages")
        sys.exit(SKIPPED)
    unittest.main()
