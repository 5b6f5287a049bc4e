#!/usr/bin/env python3
"""Results in Python: the frames hold what the files hold, and the figures what `baraka report` says."""
import importlib.util
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import page_commands
from baraka import BIN, ROOT, Case, Program, some_domain

os.environ["MPLBACKEND"] = "agg"
MISSING = [name for name in ("pandas", "matplotlib", "numpy") if importlib.util.find_spec(name) is None]
if not (BIN / "python/baraka/copied.stamp").exists():
    MISSING.append("a build with Python's headers and pybind11")
CAMPAIGN = f"""version: 1
name: study
scenario: {ROOT}/config/scenarios/many_robots.yaml
replications: 6
until: 60 s
vary:
  control_phase: [aligned, uniform]
"""
QUANTITY = "messages.delay.p95"


def package():
    """The package baraka, whose name is that of a file beside this one."""
    ours = sys.modules.pop("baraka")
    sys.path.insert(0, str(BIN / "python"))
    try:
        return importlib.import_module("baraka")
    finally:
        sys.path.pop(0)
        sys.modules["baraka"] = ours


class Results(Case):
    @classmethod
    def setUpClass(cls):
        cls.baraka = package()
        folder = tempfile.TemporaryDirectory(prefix="baraka-e2e-")
        cls.addClassCleanup(folder.cleanup)
        file = pathlib.Path(folder.name) / "study.yaml"
        file.write_text(CAMPAIGN)
        cls.studied = file.with_suffix("")
        done = Program("baraka", "campaign", file, "--out", cls.studied).finish()
        assert done.status == 0, str(done)

    def setUp(self):
        super().setUp()
        self.study = self.baraka.campaign(self.studied)

    def succeed(self, *arguments):
        program = Program("baraka", *arguments)
        self.addCleanup(program.clean_up)
        done = program.finish()
        self.assertEqual(done.status, 0, str(done))
        return done.out

    def test_a_campaigns_figure_is_that_of_the_report(self):
        figure = self.study.figure(QUANTITY, versus="control_phase")
        values = self.study.values(QUANTITY)
        by_label = {label: list(group["value"]) for label, group in values.groupby("label")}
        self.assertEqual([len(one) for one in by_label.values()], [6, 6])
        said = self.succeed("report", self.studied, "--figure", QUANTITY, "--versus", "control_phase")
        for (_, row), (label, seen) in zip(figure.frame.iterrows(), sorted(by_label.items())):
            self.assertIn(row["setting"], label)
            mean = sum(seen) / 6
            self.assertAlmostEqual(row["mean"], mean, places=12)
            self.assertAlmostEqual(row["sd"], math.sqrt(sum((x - mean)**2 for x in seen) / 5), places=12)
            self.assertEqual(row["runs"], 6)
            cells = next(line.split() for line in said.splitlines() if line.startswith(row["setting"] + " "))
            self.assertEqual(cells[2:6], [f"{row[name]:.6g}" for name in ("mean", "low", "high", "sd")])
            self.assertLess(row["low"], row["mean"])
            self.assertLess(row["mean"], row["high"])
        self.assertEqual(figure.frame.attrs["y"], QUANTITY + " / s")
        self.assertEqual(figure.frame.attrs["level"], 0.95)

    def test_paired_differences_are_students_over_equal_seeds(self):
        differences = self.study.figure(QUANTITY).differences
        values = self.study.values(QUANTITY).pivot(index="seed", columns="label", values="value")
        each = list(values["control_phase=uniform"] - values["control_phase=aligned"])
        mean = sum(each) / 6
        sd = math.sqrt(sum((x - mean)**2 for x in each) / 5)
        (row,) = differences.to_dict("records")
        self.assertEqual(row["pairs"], 6)
        self.assertAlmostEqual(row["difference"], mean, places=12)
        self.assertAlmostEqual(row["high"] - mean, 2.570581835636 * sd / math.sqrt(6), places=9)  # t(0.975, 5)
        self.assertAlmostEqual(mean - row["low"], row["high"] - mean, places=12)

    def test_tables_have_the_files_numbers_and_units(self):
        scenario = ROOT / "config/scenarios/two_motes.yaml"
        self.run_baraka(scenario, "--controllers", "in-process")
        run = self.baraka.results(self.out)
        for table in ("messages", "agents", "run"):
            self.assertEqual(len(run.table(table)), self.query(f"SELECT COUNT(*) FROM {table}")[0][0], table)
        messages = run.table("messages")
        self.assertEqual(list(messages["sent_ns"]), [row[0] for row in self.query("SELECT sent_ns FROM messages")])
        self.assertEqual(messages.attrs["units"]["sent_ns"], "ns")
        self.assertEqual(run.values()["fingerprint"], self.query("SELECT value FROM run WHERE key = 'fingerprint'")[0][0])
        self.assertEqual(self.study.table("runs").attrs["units"]["wall_s"], "s")
        self.assertEqual(set(self.study.runs()["state"]), {"done"})

    def test_figures_of_every_kind_are_drawn(self):
        for kind, parts in (("points", "lines"), ("histogram", "patches")):
            axes = self.study.figure(QUANTITY, kind=kind).plot()
            self.assertTrue(getattr(axes, parts), kind)
            file = self.folder / f"{kind}.png"
            axes.figure.savefig(file)
            self.assertTrue(re.match(rb"\x89PNG", file.read_bytes()))
        histogram = self.study.figure(QUANTITY, kind="histogram").frame
        self.assertEqual(histogram["count"].sum(), 12)
        self.assertEqual([text.get_text() for text in self.study.figure(QUANTITY).plot().get_xticklabels()],
                         ["aligned", "uniform"])

    def test_the_page_leads_from_a_controller_to_a_figure(self):
        script = page_commands.script(ROOT / "docs/python.md", "From the package to a figure", "said.txt")
        env = {"PATH": f"{BIN}:/usr/bin:/bin", "PYTHONPATH": str(BIN / "python"), "HOME": str(self.folder), "LC_ALL": "C.UTF-8",
               "BARAKA_DOMAIN": str(some_domain(self))}
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=env, capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / "my_robot/arrival.pdf").read_bytes().startswith(b"%PDF"))
        study = self.baraka.campaign(self.folder / "my_robot/results/speeds")
        first, *_, last = study.figure("states.ARRIVED.first").frame["mean"]
        self.assertGreater(first, last)  # the fastest is there first
        # What is kept over time has no value for each setting.
        with self.assertRaises(self.baraka.AnalysisError) as raised:
            study.figure("controllers.nearest", versus="speed")
        self.assertIn("controllers.nearest.mean", str(raised.exception))

    def test_mistakes_are_said_as_the_command_says_them(self):
        for call, words in ((lambda: self.baraka.campaign("/nowhere"), "/nowhere: has no campaign.sqlite"),
                            (lambda: self.baraka.results(self.studied), "has no run.sqlite"),
                            (lambda: self.study.table("rnus"), "has no table 'rnus'; it has campaign, points"),
                            (lambda: self.study.figure("nothing"), "none of these runs has such a quantity"),
                            (lambda: self.study.figure(QUANTITY, versus="speed"), "speed"),
                            (lambda: self.study.figure(QUANTITY, kind="pie"), "pie"),
                            (lambda: self.study.values("nothing"), "no run has the quantity 'nothing'"),
                            (lambda: self.study.sql("DROP TABLE runs"), "readonly database")):
            with self.assertRaises(self.baraka.AnalysisError) as raised:
                call()
            self.assertIn(words, str(raised.exception))


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: needs {', '.join(MISSING)}")
        sys.exit(77)
    unittest.main()
