#!/usr/bin/env python3
"""Coverage of a floor and a survey fitted to it: what is said before a run is what a run then shows."""
import csv
import math
import random
import re
import unittest

from baraka import BIN, ROOT, Case, Program
from browser import CHROMIUM, Browser

FLOOR = """version: 1
name: floor
seed: 3
controller_latency: 0 s
routing: none
record: {frames: all}
radio:
  profile: ieee80211g
  antenna_height: 1 m
  obstacles: false
  propagation: [{model: multi_wall}]
world:
  walls:
    - {size: [20 cm, 40 m, 3 m], position: [5 m, 0 m], material: brick}
    - {size: [20 cm, 40 m, 3 m], position: [9 m, 0 m], material: door}
    - {size: [20 cm, 4 m, 3 m], position: [2 m, 8 m], material: brick}
  materials: [{name: door, loss: 2 dB}]
agents:
  a: {name: a, station: {}, poses: [{x: 0 m, y: 0 m}],
      controller: {program: traffic_source, parameters: {topic: t, pattern: periodic, rate: 100 Hz, to: b, size: 200}}}
  b: {name: b, station: {}, poses: [{x: 12 m, y: 0 m}], controller: {program: traffic_sink, parameters: {topic: t}}}
end: [{at: 300 ms, result: done}]
"""
TRUTH = {"constant_loss": 3.0, "exponent": 2.4, "brick": 6.0, "door": 1.5}


def crossed(x, y):
    """Walls of brick and doors between a, at the origin, and a place."""
    brick = (x > 5) + (x > 2 and 6 < y / x * 2 < 10)
    return brick, int(x > 9)


class Coverage(Case):
    def setUp(self):
        super().setUp()
        self.floor = self.folder / "floor.yaml"
        self.floor.write_text(FLOOR)

    def baraka(self, *arguments):
        finished = Program("baraka", *arguments).finish()
        self.assertEqual(finished.status, 0, finished)
        return finished

    def at_b(self, *options):
        """dBm of a at b, by `coverage`."""
        table = self.folder / "map.csv"
        self.baraka("coverage", self.floor, "--of", "a", "--area", "11.5,-0.5,12.5,0.5", "--step", "1 m", "-o", table, *options)
        (row,) = csv.DictReader(table.read_text().splitlines())
        self.assertEqual((float(row["x_m"]), float(row["y_m"]), row["best"]), (12, 0, "a"))
        return float(row["rssi_dbm"])

    def in_a_run(self, *options):
        self.run_baraka(self.floor, "--controllers", "in-process", *options)
        return self.query("SELECT rssi_dbm FROM frame_ends JOIN agents USING (agent) WHERE name = 'b'", self.out)[0][0]

    def test_a_run_shows_the_power_that_the_map_says(self):
        said = self.at_b()
        self.assertAlmostEqual(self.in_a_run(), said, delta=0.01)
        opened = self.at_b("--set", "world.walls=[]")
        self.assertAlmostEqual(opened - said, 3.5 + 2, delta=0.011)

    def test_a_survey_becomes_a_radio_that_a_run_accepts(self):
        survey, radio = self.folder / "survey.csv", self.folder / "fitted.yaml"
        draw = random.Random(1)
        sent = self.at_b("--set", "world.walls=[]") + 20 * math.log10(12)  # dBm at 1 m
        rows = ["x,y,access_point,dbm"]
        for _ in range(300):
            x, y = draw.uniform(0.5, 14), draw.uniform(-6, 6)
            if abs(x - 2) < 0.2 or abs(x - 5) < 0.2 or abs(x - 9) < 0.2:
                continue
            brick, door = crossed(x, y)
            law = TRUTH["constant_loss"] + 10 * TRUTH["exponent"] * math.log10(math.hypot(x, y))
            rows.append(f"{x},{y},a,{sent - law - 6 * brick - 1.5 * door + draw.gauss(0, 0.5)}")
        survey.write_text("\n".join(rows) + "\n")
        said = self.baraka("survey", survey, self.floor, "-o", radio).out
        for name in TRUTH:
            low, high = map(float, re.search(rf"^{name} .* ([-\d.]+) to ([-\d.]+)", said, re.M).groups())
            self.assertTrue(low - 0.5 < TRUTH[name] < high + 0.5, said)
        self.assertRegex(said, r"held out\n$")
        self.baraka("check", radio)
        fitted = ("--set", f"radio={{include: {radio}}}")
        self.assertAlmostEqual(self.in_a_run(*fitted), self.at_b(*fitted), delta=0.01)
        self.assertNotAlmostEqual(self.at_b(*fitted), self.at_b(), delta=1)

    def test_it_is_drawn(self):
        page, drawing = self.folder / "map.html", self.folder / "map.svg"
        self.baraka("coverage", self.floor, "--of", "*", "-o", page)
        self.assertEqual(page.read_text().count("<figure"), 4)
        self.baraka("coverage", self.floor, "--of", "*", "--layer", "rate", "-o", drawing)
        self.assertIn("expected rate, 1500 bytes, 1 m above the ground", drawing.read_text())
        self.assertRegex(self.baraka("coverage", self.floor, "--of", "a").out, r"54 Mb/s +\d+\.\d %")

    @unittest.skipIf(CHROMIUM is None or not (BIN / "view_page.html").exists(), "needs chromium and ./setup pages")
    def test_the_view_has_it_as_a_layer(self):
        page = self.folder / "view.html"
        (self.folder / "floor.yaml").write_text(FLOOR.replace("  obstacles: false\n", "  bss: {access_point: a}\n"))
        self.baraka("view", self.floor, "--export", page)
        browser = Browser(1000, 700)
        self.addCleanup(browser.close)
        colours = "new Set([...document.querySelectorAll('.coverage i')].map((one) => one.style.background)).size"
        browser.open(f"file://{page}#2d=1")
        self.assertTrue(browser.run("document.querySelector('.coverage').hidden"))
        browser.run("[...document.querySelectorAll('.switches button')].find((one) => one.textContent === 'coverage').click()")
        browser.wait(f"{colours} > 2")
        self.assertRegex(browser.run("document.querySelector('.coverage').innerText"), r"-\d+ to -\d+ dBm")
        choose = "const s = document.querySelector('.coverage select'); s.value = 'best'; s.dispatchEvent(new Event('change'));"
        browser.run(f"(() => {{ {choose} }})()")
        browser.wait(f"{colours} === 1")
        self.assertRegex(browser.run("document.querySelector('.coverage').innerText"), r"\na$")
        self.assertEqual(browser.said, [])

    def test_mistakes_have_a_place(self):
        survey = self.folder / "survey.csv"
        survey.write_text("x,y,access_point,dbm\n1,2,a,-40\n1,2,c,-40\n")
        for arguments, said in ((("coverage", self.floor), "there is no access point"),
                                (("coverage", self.floor, "--of", "z"), "--of: 'z' matches no agent"),
                                (("coverage", self.floor, "-o", "map.png"), "must end in .html, .svg or .csv"),
                                (("coverage", self.floor, "--step", "0"), "--step: '0' is not a length"),
                                (("coverage", self.floor, "--area", "1,2,3"), "--area takes two opposite corners"),
                                (("survey", survey, self.floor), f"{survey}:3:5: access_point: the scenario has no agent 'c'"),
                                (("survey", self.folder / "none.csv", self.floor), "none.csv: cannot be read")):
            finished = Program("baraka", *arguments).finish()
            self.assertNotEqual(finished.status, 0, arguments)
            self.assertIn(said, finished.err)

    def test_the_page_of_the_docs_works_as_written(self):
        text = (ROOT / "docs/coverage.md").read_text()
        self.floor.write_text(re.search(r"```yaml\n(.*?)```", text, re.S)[1])
        said = self.baraka("coverage", self.floor).out
        self.assertRegex(said, r"ap0 +\d+\.\d %")
        for line in re.findall(r"^baraka (coverage .*?) *(?:#.*)?$", text, re.M):
            if "fitted" in line:
                continue
            words = line.replace("office.yaml", str(self.floor)).split()
            words = [str(self.folder / word) if word.startswith("coverage.") else word for word in words]
            self.baraka(*words)


if __name__ == "__main__":
    unittest.main()
