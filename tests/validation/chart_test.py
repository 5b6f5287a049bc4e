#!/usr/bin/env python3
"""Charts are drawn as they were declared: chart_test.py BUILD [unittest's arguments]"""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from chart import GREY, Chart, Panel, around, axis, series
from runs import Runs

BUILD = pathlib.Path(sys.argv.pop(1))
SVG = "{http://www.w3.org/2000/svg}"


def drawn(*panels, **chart):
    """The root of the drawing."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "figures/one.svg"
        Runs(BUILD).draw(Chart(*panels, **chart), path)
        return xml.etree.ElementTree.fromstring(path.read_text(encoding="utf-8"))


def of_class(root, name):
    return [one for one in root.iter() if name in one.get("class", "").split()]


def texts(root, name=None):
    return [one.text for one in (root.iter(f"{SVG}text") if name is None else of_class(root, name))]


def answer(text):
    """Exit status and message of draw_chart."""
    done = subprocess.run([BUILD / "tests/draw_chart"], input=text, capture_output=True, text=True)
    return done.returncode, done.stderr


class ChartTest(unittest.TestCase):
    def test_each_kind_of_layer_is_drawn_with_its_curve(self):
        panel = Panel("a title", axis("time, s"), axis("delay, ms"))
        panel.line([0, 1, 2], [1, 2, 3], curve=0, label="ours", dash="dashed")
        panel.line([0, 1, 2], [3, 2, 1], stepped=True, curve=1, stroke=0.5)
        panel.marks([0, 1], [1, 2], "cross", around([1, 2], [0.5, 0.25]), curve=2, label="theirs")
        panel.bars([0, 1, 2], series("near", [1, 2, 3], 3), series("far", [3, 2, 1], 4, texts=["x", "y", "z"]))
        panel.vertical(0.5)
        panel.horizontal(2, curve=5, label="limit")
        panel.span(1, 1.5, label="pause")
        panel.text(1, 2, "here")
        root = drawn(panel, title="Of all")
        self.assertEqual(root.find(f"{SVG}title").text, "Of all")
        counts = {name: len(of_class(root, name)) for name in ("line", "point", "interval", "bin", "band", "remark")}
        self.assertEqual(counts, {"line": 4, "point": 2, "interval": 2, "bin": 6, "band": 1, "remark": 1})
        self.assertEqual([one.get("class") for one in of_class(root, "curve")],
                         [f"curve {one}" for one in ("curve-0", "curve-1", "curve-2", "curve-3", "curve-4", "neutral",
                                                     "curve-5", "neutral", "neutral")])
        self.assertEqual(texts(root, "title"), ["a title"])
        self.assertEqual(texts(root, "label"), ["time, s", "delay, ms"])
        self.assertEqual(texts(root, "value"), ["x", "y", "z"])
        for label in ("ours", "theirs", "near", "far", "limit", "pause", "here"):
            self.assertEqual(texts(root).count(label), 1, label)
        self.assertEqual(texts(root, "note"), [])

    def test_axes_have_the_limits_ticks_and_names_that_were_given(self):
        panel = Panel(x=axis(names=["b11", "g54"]), y=axis(log=True, limits=(1, 100), ticks=(1, 3, 100)))
        panel.marks([0, 1], [1, 100])
        root = drawn(panel)
        self.assertEqual(sorted(texts(root, "tick")), ["1", "100", "3", "b11", "g54"])
        heights = [float(re.search(r",([\d.]+)\)", one.get("transform"))[1]) for one in of_class(root, "point")]
        frame = of_class(root, "axis")[-1].find(f"{SVG}path").get("d")
        top, bottom = (float(one) for one in re.search(r",([\d.]+)V([\d.]+)H", frame).groups())
        self.assertEqual(heights, [bottom, top])

    def test_a_value_that_is_not_finite_is_said(self):
        panel = Panel()
        panel.line([0, 1, 2, 3], [1, math.nan, 2, 3])
        panel.marks([0, 1], [math.inf, 2])
        self.assertEqual(texts(drawn(panel), "note"), ["not shown: 2 without a position"])

    def test_labels_without_data_are_in_the_legend(self):
        panel = Panel()
        panel.marks([], [], "cross", curve=GREY, label="ns-3")
        self.assertIn("ns-3", texts(drawn(panel)))

    def test_panels_can_share_limits(self):
        low, high = Panel(), Panel()
        low.line([0, 1], [0, 1])
        high.line([0, 1], [0, 100])
        ticks = [texts(drawn(low, high, columns=2, shares=shares), "tick").count("100") for shares in ("", "y")]
        self.assertEqual(ticks, [1, 2])

    def test_what_is_wrong_is_said_with_its_place(self):
        for text, message in (
                ("{", "parse error"), ("[]", "chart: is no object"), ('{"panels": [1]}', "panels[0]: is no object"), ("{}", "there is no panel"),
                ('{"panels": 1}', "panels: is no list"),
                ('{"panels": [{"tilte": "a"}]}', "panels[0].tilte: is no key here"),
                ('{"panels": [{"layers": [{}]}]}', "panels[0].layers[0].kind: is missing"),
                ('{"panels": [{"layers": [{"kind": "pie"}]}]}', "'pie' is none of line, marks, bars"),
                ('{"panels": [{"layers": [{"kind": "line", "x": ["1"]}]}]}', 'layers[0].x: "1" is of the wrong type'),
                ('{"panels": [{"layers": [{"kind": "line", "x": [1], "y": []}]}]}', "y of a line: 0 values, not 1"),
                ('{"panels": [{"y": {"low": 2, "high": 1}}]}', "2 .. 1 are no limits")):
            status, said = answer(text)
            self.assertEqual(status, 1, text)
            self.assertIn(message, said)


if __name__ == "__main__":
    unittest.main()
