#!/usr/bin/env python3
"""What people do with the view's controls, with keys and a mouse: lanes, the panel, a live run, a robot driven by hand.

Needs the page (./setup pages) and Chromium; where one is missing it is skipped (status 77).
"""
import contextlib
import json
import pathlib
import re
import sqlite3
import sys
import unittest

from baraka import BIN, CASE_STUDY, Case, Program, send, wait_for
from browser import CHROMIUM, Browser

SKIPPED = 77
ROBOT = 26
SECOND = 1_000_000_000
TELEOP = pathlib.Path(__file__).parent / "teleop.yaml"


class Tab(Browser):
    """A tab, and what people do in it."""

    def key(self, key, up=True):
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=key if len(key) == 1 else "")
        if up:
            self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    def mouse(self, what, x, y):
        self.call("Input.dispatchMouseEvent", type=f"mouse{what}", x=x, y=y, button="left", clickCount=1)

    def state(self, name):
        return json.loads(self.run(f"JSON.stringify(baraka.store.state.{name} ?? null)"))

    def panel(self):
        return self.run("document.getElementById('inspector').innerText")

    def becomes(self, name, condition):
        """Its value once the condition holds of it."""
        return wait_for(lambda: [value for value in [self.state(name)] if condition(value)])[0]


class Controls(Case):
    @classmethod
    def setUpClass(cls):
        cls.tab = Tab(1280, 720)
        cls.addClassCleanup(cls.tab.close)

    def setUp(self):
        super().setUp()
        self.addCleanup(self.tab.forget)

    def tearDown(self):
        self.assertEqual(self.tab.said, [])

    def result(self):
        """The case study with all frames."""
        run = self.run_baraka(CASE_STUDY, "--controllers", "in-process", "--no-inspect", "--until", "60", "--set", "record.frames=all")
        self.assertEqual(run.status, 0, str(run))
        server = Program("baraka", "view", self.out, "--no-open")
        self.addCleanup(server.clean_up)
        return re.match(r"view: (\S+)", server.process.stdout.readline()).group(1)

    def record(self, sql, *values):
        with contextlib.closing(sqlite3.connect(self.out / "run.sqlite")) as database:
            return database.execute(sql, values).fetchall()

    def test_times_lanes_and_panels(self):
        address = self.result()
        tab = self.tab
        [(sender, identity, sent, delay)] = self.record(
            "SELECT m.sender, m.id, m.sent_ns, d.delay_ns FROM messages m JOIN deliveries d USING (sender, id) WHERE m.destination < 65534"
            " AND d.transmissions > 1 ORDER BY m.sent_ns LIMIT 1")
        tab.open(f"{address}#message={sender},{identity},{sent}")
        tab.go()
        # The hops' parts sum up to the delay.
        self.assertIn("its delay", tab.panel())
        units = {"s": SECOND, "ms": 1_000_000, "µs": 1000, "ns": 1}
        cells = tab.run("[...document.querySelectorAll('.hops tbody td')].map((cell) => cell.innerText)")
        lengths = [re.findall(r"([\d.]+) (s|ms|µs|ns)\b", cell) for cell in cells]
        self.assertEqual(sum(round(float(value) * units[unit]) for found in lengths for value, unit in found), delay)
        # A time that is written is gone to.
        tab.key("g")
        tab.call("Input.insertText", text="12.000000345")
        tab.key("Enter")
        self.assertEqual(tab.state("t"), 12_000_000_345)
        tab.key("g")
        tab.call("Input.insertText", text="+20 us")
        tab.key("Enter")
        self.assertEqual(tab.state("t"), 12_000_020_345)
        # A click on the axis sets the time; one on an agent's name chooses it.
        left, top, width = tab.run("(({left, top, width}) => [left, top, width])(document.querySelector('#lanes').getBoundingClientRect())")
        axis = 118, width - 8  # px: from there, to there
        x = left + (axis[0] + axis[1]) // 2
        tab.mouse("Pressed", x, top + 10)
        tab.mouse("Released", x, top + 10)
        self.assertAlmostEqual(tab.state("t"), 30 * SECOND, delta=0.1 * SECOND)  # 60 s on 834 px: 72 ms each
        tab.run("document.querySelector('#lanes input').focus()")
        tab.call("Input.insertText", text="r0")
        tab.key("Enter")
        tab.go()
        name = top + 22 + 30 + 44 + 18 + 7  # below the axis, frames, messages, events
        tab.mouse("Pressed", left + 20, name)
        tab.mouse("Released", left + 20, name)
        self.assertEqual(tab.state("chosen"), {"kind": "agent", "agent": ROBOT, "run": 0})
        self.assertEqual(tab.state("lanes"), "r0")
        wait_for(lambda: re.search(f"agent={ROBOT}.*lanes=r0", tab.run("location.hash")))
        # It is told of each message once.
        tab.go(t=40 * SECOND)
        rows = tab.run("[...document.querySelectorAll('#inspector .list tr')].map((row) => row.innerText).filter((row) => / help /.test(row.replace(/\\t/g, ' ')))")
        sends = [row for row in rows if row.endswith("delivered")]
        self.assertEqual(len(sends), len(set(sends)))
        self.assertGreater(len(sends), 1)

    def live(self, *arguments):
        if "--pace" not in arguments and "--max-speed" not in arguments:
            arguments = *arguments, "--max-speed", "1e9"
        run = self.start(*arguments, "--view", "--no-open")
        address = next(found.group(1) for line in run.process.stderr if (found := re.match(r"view: (\S+)", line)))
        self.tab.open(address)
        self.assertNotIn("token", self.tab.run("location.href"))
        return run

    def test_a_live_run_is_held_stepped_and_goes_on_as_if_nobody_had_looked(self):
        common = CASE_STUDY, "--controllers", "in-process", "--no-inspect", "--until", "60"
        alone = self.run_baraka(*common)["fingerprint"]
        run = self.live(*common, "--paused")
        tab = self.tab
        tab.becomes("live", lambda live: live["paused"])
        before = tab.state("t")
        tab.key("c")
        tab.becomes("t", lambda t: t > before)
        tab.run("""(() => {
          const form = document.querySelector('.breaks');
          const kind = form.querySelector('select');
          kind.value = 'time';
          kind.dispatchEvent(new Event('change'));
          form.querySelector('input').value = '12.5';
          form.requestSubmit();
        })()""")
        tab.becomes("live", lambda live: len(live["breaks"]) == 1)
        tab.key(" ")
        self.assertIn("12.5", tab.becomes("live", lambda live: live["paused"] and live["stoppedBy"])["stoppedBy"])
        self.assertEqual(tab.becomes("t", lambda t: t > 12 * SECOND), 12_500_000_000 - 1)
        # Who looks back plays the record; the run waits.
        tab.key("Home")
        tab.key(" ")
        tab.becomes("t", lambda t: 0 < t < 12 * SECOND)
        self.assertTrue(tab.state("live")["paused"])
        tab.key("End")
        tab.key(" ")
        wait_for(lambda: tab.state("live")["ended"], 60)
        tab.call("Page.navigate", url="about:blank")  # as long as its page is open it stays
        self.assertEqual(run.finish()["fingerprint"], alone)

    def test_a_robot_is_driven_by_the_pad_and_rests_when_it_is_let_go(self):
        run = self.live(TELEOP, "--pace", "realtime:0.5")  # a minute, of which it takes ten seconds
        tab = self.tab
        tab.run("baraka.store.set({chosen: {kind: 'agent', run: 0, agent: 1}})")
        pad = "(({left, top, width, height}) => [left + width / 2, top + height / 2])(document.querySelector('.pad').getBoundingClientRect())"
        wait_for(lambda: "true pose" in tab.panel() and tab.run(pad)[0] > 0)
        x, y = tab.run(pad)
        tab.mouse("Pressed", x, y - 55)
        wait_for(lambda: self.place()[0] > 0.3)
        # A message in the panel draws it anew, not the pad under the finger.
        tab.run("baraka.store.set({live: {...baraka.store.state.live, said: 'something'}})")
        moved = self.place()[0]
        wait_for(lambda: self.place()[0] > moved + 0.2)
        tab.mouse("Released", x, y - 55)
        self.rests()
        # The same by a key.
        tab.run("document.querySelector('.pad').focus()")
        tab.key("a", up=False)
        wait_for(lambda: self.place()[2] > 20)
        tab.call("Input.dispatchKeyEvent", type="keyUp", key="a")
        self.rests()
        # Nobody else may hold it: it follows the clock.
        tab.run("document.activeElement.blur()")
        tab.key(" ")
        wait_for(lambda: "keeps real time" in tab.panel())
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish().status, 130)

    def place(self):
        """What the panel says of the robot's true pose [m, m, degrees]."""
        found = re.search(r"true pose\s+x (\S+) m, y (\S+) m, (\S+)°", self.tab.panel())
        return tuple(float(value) for value in found.groups())

    def rests(self):
        """It is where it was half a second of the run before."""
        def same():
            before, at = self.place(), self.tab.state("t")
            self.tab.becomes("t", lambda t: t > at + SECOND // 2)
            return self.place() == before
        wait_for(same)


if __name__ == "__main__":
    if CHROMIUM is None or not (BIN / "view_page.html").exists():
        print("skipped: needs chromium and ./setup pages")
        sys.exit(SKIPPED)
    unittest.main()
