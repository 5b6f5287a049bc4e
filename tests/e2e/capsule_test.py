#!/usr/bin/env python3
"""Studies as one file: `baraka capsule` packs a run or a campaign, and what was packed plays again to equal fingerprints."""
import hashlib
import json
import os
import subprocess
import unittest

from baraka import BIN, ROOT, Case, Program

MANY_ROBOTS = ROOT / "config/scenarios/many_robots.yaml"
CAMPAIGN = f"""version: 1
name: study
scenario: {MANY_ROBOTS}
replications: 2
until: 20 s
vary:
  control_phase: [aligned, uniform]
"""


class Capsule(Case):
    def command(self, *arguments, status=0, env=None):
        program = Program("baraka", *arguments, env=env)
        self.addCleanup(program.clean_up)
        done = program.finish()
        self.assertEqual(done.status, status, str(done))
        return done

    def unpacked(self, capsule):
        folder = self.folder / capsule.name.removesuffix(".tar.zst")
        folder.mkdir()
        subprocess.run(["tar", "-C", folder, "-xf", capsule], check=True)
        return folder

    def play(self, folder):
        """Where nothing but the capsule is known."""
        env = {name: value for name, value in os.environ.items() if not name.startswith("BARAKA_")}
        return subprocess.run([folder / "play.sh", BIN / "baraka"], env=env, cwd="/", capture_output=True, text=True, check=False)

    def test_a_run_plays_again_with_its_python_controller(self):
        if not (BIN / "libbaraka_python.so").exists():
            self.skipTest("needs a build with Python's headers and pybind11")
        env = {"BARAKA_CONTROLLER_PATH": str(ROOT / "tests/e2e/python")}
        run = self.run_baraka(MANY_ROBOTS, "--seed", 4, "--until", "30s", "--controllers", "in-process", "--set",
                              "agents.robots.controller.program=help_robot.py", env=env)
        capsule = self.folder / "run4.tar.zst"
        lost = self.command("capsule", self.out, "-o", capsule, status=2, env={"BARAKA_CONTROLLER_PATH": ""})
        self.assertIn("the controller help_robot.py belongs to the capsule, and is not in ", lost.err)
        self.assertFalse(capsule.exists())
        self.command("capsule", self.out, "-o", capsule, env=env)
        folder = self.unpacked(capsule)
        manifest = json.loads((folder / "capsule.json").read_text())
        for name in ("help_robot.py", "travel.py"):
            text = (folder / "controllers" / name).read_bytes()
            self.assertEqual(text, (ROOT / "tests/e2e/python" / name).read_bytes())
            (entry,) = (one for one in manifest["files"] if one["name"] == f"controllers/{name}")
            self.assertEqual((entry["sha256"], entry["is_here"]), (hashlib.sha256(text).hexdigest(), True))
        (plugin,) = (one for one in manifest["files"] if one["name"] == "controllers/help_mote.so")
        self.assertEqual((plugin["sha256"], plugin["is_here"]),
                         (hashlib.sha256((BIN / "help_mote.so").read_bytes()).hexdigest(), False))
        self.assertEqual(manifest["runs"][0]["fingerprint"], run["fingerprint"])
        played = self.play(folder)
        self.assertEqual((played.returncode, played.stdout), (0, f"equal: seed 4: {run['fingerprint']}\n"), played.stderr)
        # The program's place may be given as seen from where the caller is.
        beside = subprocess.run([folder / "play.sh", f"{BIN.name}/baraka"], cwd=BIN.parent, capture_output=True, text=True, check=False)
        self.assertEqual((beside.returncode, beside.stdout), (0, played.stdout), beside.stderr)
        # Another controller is another run.
        file = folder / "controllers/travel.py"
        file.write_text(file.read_text().replace("0.25, 0.25", "0.25, 0.2").replace("p[\"speed\"]", "0.5 * p[\"speed\"]"))
        played = self.play(folder)
        self.assertEqual(played.returncode, 1)
        self.assertIn("DIFFERS: seed 4: ", played.stdout)

    def test_a_campaign_plays_every_run_again(self):
        file = self.folder / "study.yaml"
        file.write_text(CAMPAIGN)
        self.command("campaign", file, "--out", self.folder / "study")
        capsule = self.folder / "capsule.tar.zst"
        self.command("capsule", self.folder / "study", "-o", capsule, "--add", ROOT / "LICENSE")
        folder = self.unpacked(capsule)
        self.assertEqual((folder / "campaign.yaml").read_text(), CAMPAIGN)
        self.assertTrue((folder / "added/LICENSE").exists())
        played = self.play(folder)
        self.assertEqual(played.returncode, 0, played.stdout + played.stderr)
        lines = played.stdout.splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({line.split()[-1] for line in lines}), 4)  # four runs, four fingerprints

    def test_the_database_keeps_what_is_small(self):
        self.run_baraka(MANY_ROBOTS, "--until", "20s", "--controllers", "in-process")
        capsule = self.folder / "small.tar.zst"
        self.command("capsule", self.out, "-o", capsule, "--most-rows", 100)
        folder = self.unpacked(capsule)
        left_out = json.loads((folder / "capsule.json").read_text())["tables_left_out"]
        tables = [row[0] for row in self.query("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite%'")]
        for table in tables:
            ours, = self.query(f'SELECT COUNT(*) FROM "{table}"')[0]
            theirs, = self.query(f'SELECT COUNT(*) FROM "{table}"', out=folder / "results")[0]
            self.assertEqual(theirs, 0 if ours > 100 else ours, table)
            self.assertEqual(left_out.get(table, 0), ours if ours > 100 else 0, table)
        self.assertIn("poses", left_out)
        self.command("report", folder / "results")

    def test_files_that_a_scenario_reads_come_along(self):
        building = self.folder / "building"
        building.mkdir()
        for name in ("office.yaml", "office.png"):
            (building / name).write_bytes((ROOT / "config/maps" / name).read_bytes())
        scenario = building / "own.yaml"
        scenario.write_text((ROOT / "config/scenarios/office_map.yaml").read_text().replace("../maps/office.yaml", "office.yaml")
                            .replace("../radios/", "radios/").replace("../robots/", "robots/"))
        run = self.run_baraka(scenario, "--until", "2s", "--controllers", "in-process")
        capsule = self.folder / "map.tar.zst"
        self.command("capsule", self.out, "-o", capsule)
        folder = self.unpacked(capsule)
        self.assertEqual(sorted(file.name for file in (folder / "inputs/0").iterdir()), ["office.png", "office.yaml"])
        for file in building.iterdir():
            file.unlink()
        played = self.play(folder)
        self.assertEqual(played.stdout.split()[-1], run["fingerprint"], played.stderr)

    def test_what_cannot_be_played_again_is_refused(self):
        self.run_baraka(ROOT / "config/scenarios/two_motes.yaml", "--pace", "realtime:20", "--until", "1s")
        for arguments, words in (((self.out, "-o", self.folder / "x.tar.zst"), "scenario and seed do not determine this run"),
                                 ((self.folder / "nowhere", "-o", self.folder / "x.tar.zst"), "there is no such folder"),
                                 ((self.out, "-o", "/nowhere/x.tar.zst"), "/nowhere/x.tar.zst: there is no such folder"),
                                 ((self.out, ), "-o is required")):
            program = Program("baraka", "capsule", *arguments)
            self.addCleanup(program.clean_up)
            done = program.finish()
            self.assertNotEqual(done.status, 0)
            self.assertIn(words, done.err)
        self.assertFalse(list(self.folder.glob("x.tar.zst*")))


if __name__ == "__main__":
    unittest.main()
