"""What `baraka describe` says, that docs/keys.md says the same, and that what it shows runs."""
import pathlib
import re
import tempfile
import unittest

from baraka import ROOT, Program, some_domain

PAGE = ROOT / "docs/keys.md"
# Where the words of this page come from, for whom it differs.
REGENERATE = ("docs/keys.md is not what the program says; if the change was meant:\n"
              "  build/release/bin/baraka describe --markdown > docs/keys.md")


def describe(*what):
    return Program("baraka", "describe", *what).finish()


class Describe(unittest.TestCase):
    def test_the_page_of_observables_is_what_the_program_writes(self):
        finished = describe("observables", "--markdown")
        self.assertEqual(finished.status, 0, finished)
        self.assertEqual(finished.out, (ROOT / "docs/observables.md").read_text(),
                         REGENERATE.replace("--markdown", "observables --markdown").replace("keys", "observables"))
        self.assertEqual(describe("radio", "--markdown").status, 2)

    def test_observables_are_listed_with_their_units(self):
        text = describe("observables").out
        self.assertRegex(text, r"(?m)^  agents.AGENT.speed +m/s +true horizontal speed")
        self.assertRegex(text, r"(?m)^  messages.delay.p95 +s +95th percentile")
        self.assertIn("record.observables (scenario file)", text)
        self.assertRegex(describe("traffic_sink").out, r"(?m)^controllers.AGENT.goodput\n.*\n +unit: +bit/s$")

    def test_the_page_of_the_tree_is_what_the_program_writes(self):
        finished = describe("--markdown")
        self.assertEqual(finished.status, 0, finished)
        self.assertEqual(finished.out, PAGE.read_text(), REGENERATE)

    def test_alone_it_lists_the_kinds(self):
        finished = describe()
        self.assertEqual(finished.status, 0)
        for kind in ("scenario", "hardware", "robot", "mote", "radio"):
            self.assertRegex(finished.out, rf"(?m)^  {kind} ")

    def test_a_kind_shows_its_keys(self):
        self.assertRegex(describe("radio").out, r"(?m)^tx_power\n.*\n.*\(mW\), 1e-06 mW .. 100000 mW$")

    def test_a_key_is_found_by_its_path_its_end_and_its_name(self):
        for what in ("agents.robots.grid.columns", "grid.columns", "columns"):
            finished = describe(what)
            self.assertEqual(finished.status, 0, finished)
            self.assertIn("agents.NAME.grid.columns (scenario file)", finished.out)
            self.assertIn("1 .. 65533", finished.out)
        several = describe("stale_after").out
        self.assertIn("localisation.stale_after (hardware file)", several)
        self.assertIn("wheels.stale_after (hardware file)", several)
        self.assertIn("only with `driver: pose_topic`", several)

    def test_a_key_shows_the_defaults_of_each_profile(self):
        self.assertIn("7 (mobility_framework), 31 (ieee80211b)", describe("radio.cw_min").out)

    def test_a_list_shows_the_keys_of_its_items(self):
        self.assertRegex(describe("sensors").out, r"(?m)^    keys:    kind, name, .*half_angle")
        self.assertRegex(describe("grid").out, r"(?m)^    keys:    columns, rows, spacing, origin, yaw$")

    def test_a_value_shows_the_keys_that_it_brings(self):
        finished = describe("sonar")
        self.assertEqual(finished.status, 0, finished)
        self.assertIn("sensors[].kind: sonar (robot file)", finished.out)
        self.assertIn("sensors[].kind: sonar (mote file)", finished.out)
        self.assertRegex(finished.out, r"(?m)^half_angle\n.*\n.*\(rad\), 0.001 rad .. 1.5 rad$")
        self.assertNotRegex(finished.out, r"(?m)^gyro_sigma$")
        self.assertIn("wheels.driver: tmc200 (hardware file)", describe("tmc200").out)

    def test_a_file_is_none_of_these(self):
        finished = describe("rover.yaml")
        self.assertEqual(finished.status, 2)
        self.assertIn("`baraka check` judges a file", finished.err)

    def test_a_controller_shows_its_parameters(self):
        finished = describe("help_mote")
        self.assertEqual(finished.status, 0, finished)
        self.assertRegex(finished.out, r"(?m)^help_at$")

    def test_what_nothing_is_called_is_refused_with_the_nearest(self):
        finished = describe("tx_powr")
        self.assertEqual(finished.status, 2)
        self.assertIn("did you mean 'tx_power'?", finished.err)

    def test_every_kind_s_example_passes_check_by_itself(self):
        examples = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(), re.S)
        self.assertEqual(len(examples), 7)
        with tempfile.TemporaryDirectory() as folder:
            for number, example in enumerate(examples):
                path = pathlib.Path(folder, f"own{number}.yaml")
                path.write_text(example)
                finished = Program("baraka", "check", path).finish()
                self.assertEqual(finished.status, 0, f"{example}\n{finished}")

    def test_the_scenario_of_the_page_runs(self):
        example = re.search(r"```yaml\n(.*?)```", PAGE.read_text(), re.S)[1]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "own.yaml")
            path.write_text(example)
            finished = Program("baraka", "run", path, "--controllers", "in-process", "--out",
                               pathlib.Path(folder, "out"), "--domain",
                               some_domain(self)).finish(300)
            self.assertEqual(finished.status, 0, finished)
            self.assertEqual(finished["result"], "arrived")


class Check(unittest.TestCase):
    def test_files_of_every_kind_are_recognised_and_checked(self):
        files = [path for folder in ("hardware", "robots", "radios", "scenarios")
                 for path in sorted((ROOT / "config" / folder).glob("*.yaml"))]
        self.assertGreaterEqual(len(files), 12)
        finished = Program("baraka", "check", *files).finish()
        self.assertEqual((finished.status, finished.err), (0, ""), finished)
        self.assertEqual(finished.out.splitlines(), [f"{path}: ok" for path in files])

    def test_mistakes_of_every_kind_are_placed(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text, expected in (
                    ("robot", "version: 1\nmodel: x\nlink: {}\nwheels: {}\n",
                     r":3:7: link.collision: must have at least one shape"),
                    ("mote", "version: 1\nmodel: x\nsize: [1 m]\nmass: 1 g\n",
                     r":3:7: size: must be a list of 3 values"),
                    ("radio", "profile: disk\nrange: 3\n", r":2:8: range: '3' must be written in m"),
                    ("hardware", "version: 1\nagent: {name: a}\n",
                     r":2:8: agent.address: is missing: a whole number, 1 .. 65533")):
                path = pathlib.Path(folder, name + ".yaml")
                path.write_text(text)
                finished = Program("baraka", "check", path).finish()
                self.assertEqual(finished.status, 2, finished)
                self.assertRegex(finished.err, expected)

    def test_a_file_of_no_kind_is_refused_unless_one_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "what.yaml")
            path.write_text("colour: red\n")
            finished = Program("baraka", "check", path).finish()
            self.assertEqual(finished.status, 2)
            self.assertIn("--kind", finished.err)
            finished = Program("baraka", "check", path, "--kind", "mote").finish()
            self.assertIn("colour: is not a known key; known here: version, model", finished.err)


if __name__ == "__main__":
    unittest.main()
