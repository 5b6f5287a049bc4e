#!/usr/bin/env python3
"""Campaigns: every run once, whatever ends them early; the same as single runs; mistakes where they stand."""
import contextlib
import csv
import io
import json
import os
import pathlib
import random
import shutil
import sqlite3
import subprocess
import time
import unittest

import private_network
from baraka import BIN, CASE_STUDY, ROOT, Case, Program, send, wait_for

KILLS = int(os.environ.get("BARAKA_KILLS", "4"))
FAULTY = ROOT / "tests/e2e/faulty.yaml"
SPEED = "agents.robots.controller.parameters.speed"
# Two runs at each of two points, of some tenths of a second.
SPEEDS = {"scenario": str(CASE_STUDY), "until": "5 s", "replications": 2,
          "vary": {SPEED: ["0.3 m/s", "0.9 m/s"]}}
ENDED = "SELECT point, replication, seed, state, result, fingerprint FROM runs ORDER BY run"


class Campaigns(Case):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def write(self, content, name="speeds.yaml"):
        """JSON is YAML. @return the file."""
        file = self.folder / name
        file.write_text(json.dumps({"version": 1, **content}))
        return file

    def begin(self, content, *options, out=None):
        program = Program("baraka", "campaign", self.write(content), "--out", out or self.out, *options)
        self.addCleanup(program.clean_up)
        return program

    def campaign(self, content, *options, out=None, status=0):
        finished = self.begin(content, *options, out=out).finish()
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def ask(self, sql, out=None):
        file = (out or self.out) / "campaign.sqlite"
        with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as database:
            return database.execute(sql).fetchall()

    def done(self):
        with contextlib.suppress(sqlite3.OperationalError):
            return self.ask("SELECT COUNT(*) FROM runs WHERE state = 'done'")[0][0]
        return 0


class WhatIsRun(Campaigns):
    def test_each_run_is_the_single_run_of_its_values_and_seed(self):
        finished = self.campaign(SPEEDS)
        self.assertEqual([finished[key] for key in ("points", "runs", "finished", "failed", "kept")],
                         ["2", "4", "4", "0", "0"])
        self.assertIn("speed=0.3 m/s", finished.out)
        rows = self.ask("SELECT text, number, unit, seed, fingerprint FROM runs JOIN levels USING (point) JOIN "
                        "factors USING (factor) ORDER BY run")
        self.assertEqual([row[:4] for row in rows],
                         [("0.3 m/s", 0.3, "m/s", 1), ("0.3 m/s", 0.3, "m/s", 2),
                          ("0.9 m/s", 0.9, "m/s", 1), ("0.9 m/s", 0.9, "m/s", 2)])
        self.assertEqual(len({row[4] for row in rows}), 4)
        for text, _, _, seed, fingerprint in rows[1:3]:
            single = self.start(CASE_STUDY, "--controllers", "in-process", "--until", 5, "--seed", seed, "--set",
                                f"{SPEED}={text}", out=self.folder / "single").finish()
            self.assertEqual(single["fingerprint"], fingerprint)
        self.out = self.folder / "out"
        self.assertEqual(list((self.out / "runs").iterdir()), [], "nothing is kept")
        values = self.ask("SELECT run, COUNT(*) FROM measurements GROUP BY run")
        self.assertEqual(len(values), 4)
        self.assertGreater(values[0][1], 10)

    def test_runs_of_a_rebuilt_controller_are_not_mixed_with_those_before(self):
        own = self.folder / "own/mine.so"
        own.parent.mkdir()
        shutil.copy(pathlib.Path(os.environ["BARAKA_CONTROLLER_PATH"]) / "gossip.so", own)
        scenario = self.folder / "mine.yaml"
        mine = "{controller: {program: mine}}"
        scenario.write_text(f"version: 1\ninclude: {ROOT}/tests/e2e/gossip.yaml\nagents: {{motes: {mine}, robots: {mine}}}\n")
        file = self.write({"scenario": str(scenario), "replications": 1})

        def play(*command):
            return Program("baraka", *command, env={"BARAKA_CONTROLLER_PATH": str(own.parent)}).finish()
        campaign = ("campaign", file, "--out", self.out)
        replications = ("run", scenario, "--controllers", "in-process", "--out", self.folder / "more", "--replications")
        self.assertEqual(play(*campaign).status, 0)
        self.assertEqual(play(*replications, 1).status, 0)
        own.write_bytes(own.read_bytes() + b"rebuilt")
        for again in (campaign, (*replications, 2)):
            finished = play(*again)
            self.assertEqual(finished.status, 2, finished)
            self.assertRegex(finished.err, "played by other files: programs: there '(baraka [0-9a-f]{16}), mine ([0-9a-f]{16})', "
                                           "now '\\1, mine (?!\\2)[0-9a-f]{16}'; .*give another --out")

    def test_a_campaign_that_has_ended_is_told_again_and_more_replications_extend_it(self):
        self.campaign(SPEEDS)
        before = self.ask(ENDED)
        self.assertEqual(self.campaign(SPEEDS)["kept"], "4")
        self.assertEqual(self.ask(ENDED), before)
        more = self.campaign({**SPEEDS, "replications": 3, "vary": {SPEED: ["0.3 m/s", "0.6 m/s", "0.9 m/s"]}})
        self.assertIn("the campaign has 1 more point, 5 more runs", more.err)
        self.assertEqual((more["kept"], more["finished"]), ("4", "9"))
        self.assertEqual(self.ask(ENDED)[:4], before)
        self.assertEqual(self.ask("SELECT DISTINCT attempts FROM runs"), [(1,)])

    def test_another_campaign_in_the_folder_is_refused(self):
        self.campaign({**SPEEDS, "replications": 1})
        for change, words in (({"until": "4 s"}, "until: there '5 s', now '4 s'"),
                              ({"vary": {SPEED: ["0.3 m/s"]}}, "point 2 there, speed=0.9 m/s"),
                              ({"seed": 2}, "base_seed: there '1', now '2'"),
                              ({"vary": {"control_period": ["50 ms"]}}, "is varied, now control_period [s]")):
            with self.subTest(change=change):
                refused = self.campaign({**SPEEDS, "replications": 1, **change}, status=2)
                self.assertIn(words, refused.err)
        single = self.start(CASE_STUDY, "--until", 1, out=self.out).finish()
        self.assertEqual(single.status, 2)
        self.assertIn("campaign.sqlite", single.err)

    def test_a_campaign_and_replications_do_not_share_a_folder(self):
        self.campaign({**SPEEDS, "replications": 1})
        few = ["--replications", 1, "--until", 1, "--controllers", "in-process"]
        refused = self.start(CASE_STUDY, *few, out=self.out).finish()
        self.assertEqual(refused.status, 2)
        self.assertIn("holds a campaign", refused.err)
        self.assertFalse((self.out / "replications.yaml").exists())
        self.run_baraka(CASE_STUDY, *few)
        self.assertEqual(self.ask("SELECT state, folder FROM runs"), [("done", "replication-01")])
        refused = self.campaign({"scenario": str(CASE_STUDY), "until": "1 s"}, status=2)
        self.assertIn("holds replications", refused.err)

    def test_a_hypercube_has_its_points_from_the_seed(self):
        content = {**SPEEDS, "replications": 1, "until": "1 s", "vary": None,
                   "sample": {"latin_hypercube": 4, "ranges": {SPEED: {"from": "0.1 m/s", "to": "0.9 m/s"}}}}
        del content["vary"]
        self.campaign(content)
        speeds = sorted(row[0] for row in self.ask("SELECT number FROM levels"))
        for number, speed in enumerate(speeds):
            self.assertTrue(0.1 + 0.2 * number <= speed <= 0.3 + 0.2 * number, speeds)
        self.campaign(content, out=self.folder / "again")
        self.assertEqual(sorted(row[0] for row in self.ask("SELECT number FROM levels", self.folder / "again")), speeds)

    def test_a_point_shows_the_defaults_that_it_leaves(self):
        self.campaign({"scenario": str(CASE_STUDY), "until": "1 s", "replications": 1,
                       "points": [{"radio.tx_power": "1 mW"},
                                  {"agents.motes.controller.parameters.max_repeats": 7},
                                  {"radio.profile": "ideal"}]})
        levels = self.ask("SELECT point, key, text, number, is_default FROM levels JOIN factors USING (factor) "
                          "ORDER BY point, factor")
        repeats = "agents.motes.controller.parameters.max_repeats"
        self.assertEqual(levels, [
            (1, "radio.tx_power", "1 mW", 0.001, 0), (1, repeats, "3", 3, 1),
            (1, "radio.profile", "mobility_framework", None, 1),
            (2, "radio.tx_power", "2 mW", 0.002, 1), (2, repeats, "7", 7, 0),
            (2, "radio.profile", "mobility_framework", None, 1),
            (3, "radio.tx_power", "", None, 1), (3, repeats, "3", 3, 1), (3, "radio.profile", "ideal", None, 0)])
        report = Program("baraka", "report", self.out, "--figure", "frames.sent", "--as", "table").finish()
        for words in ("max_repeats 3, profile mobility_framework", "max_repeats 3, profile ideal", " 2 mW ", " - "):
            self.assertIn(words, report.out)

    def test_a_count_of_zero_is_in_the_mean(self):
        self.campaign({"scenario": str(CASE_STUDY), "until": "20 s", "replications": 4,
                       "vary": {"radio.loss.probability": [0.15]}})
        values = [value for value, in self.ask("SELECT value FROM measurements JOIN observables USING (observable) "
                                               "WHERE name = 'requests.retry_limit'")]
        self.assertEqual(len(values), 4)
        self.assertIn(0, values, "else this test shows nothing")
        self.assertGreater(sum(values), 0)
        report = Program("baraka", "report", self.out).finish()
        self.assertRegex(report.out, rf"requests\.retry_limit +4 +{sum(values) / 4:g} ")

    def test_what_it_measured_can_be_exported(self):
        self.campaign({**SPEEDS, "keep": "all", "replications": 1})
        exported = Program("baraka", "export", self.out, "runs").finish()
        rows = list(csv.DictReader(io.StringIO(exported.out)))
        self.assertEqual([row["folder"] for row in rows], ["runs/p001-r01", "runs/p002-r01"])
        for row in rows:
            self.assertTrue((self.out / row["folder"] / "run.sqlite").exists())
        listed = Program("baraka", "export", self.out).finish().out
        self.assertRegex(listed, r"(?m)^runs +2 ")
        described = Program("baraka", "export", self.out, "--describe").finish().out
        self.assertEqual(described, (ROOT / "docs/campaign_tables.md").read_text(),
                         "baraka export DIR --describe > docs/campaign_tables.md, if the change was meant")
        wrong = Program("baraka", "export", self.out, "frames").finish()
        self.assertEqual(wrong.status, 2)
        self.assertIn("not a table of a campaign", wrong.err)


class Shipped(Campaigns):
    def test_those_that_come_with_it_run(self):
        files = sorted((ROOT / "config/campaigns").glob("*.yaml"))
        self.assertIn("sensitivity.yaml", [file.name for file in files])
        for file in files:
            with self.subTest(campaign=file.name):
                out = self.folder / file.stem
                self.assertEqual(Program("baraka", "check", file).finish().status, 0)
                finished = Program("baraka", "campaign", file, "--out", out, "--set", "replications=1", "--set",
                                   "until=1500 ms").finish()
                self.assertEqual((finished.status, finished["failed"]), (0, "0"), str(finished))
                rows = self.ask("SELECT label, fingerprint, result FROM runs JOIN points USING (point) ORDER BY point", out)
                self.assertGreater(len(rows), 1)
                self.assertEqual({result for _, _, result in rows}, {"until"})

    def test_the_first_point_of_the_sensitivities_is_the_case_study_as_it_is_shipped(self):
        file = ROOT / "config/campaigns/sensitivity.yaml"
        first = next(line for line in file.read_text().splitlines() if line.startswith("  - "))
        key, value = first.split("{")[1].split("}")[0].split(": ")
        single = self.start(CASE_STUDY, "--controllers", "in-process", "--until", 20).finish()
        varied = self.start(CASE_STUDY, "--controllers", "in-process", "--until", 20, "--set", f"{key}={value}",
                            out=self.folder / "varied").finish()
        self.assertEqual(varied["fingerprint"], single["fingerprint"])


class Mistakes(Campaigns):
    def check(self, text):
        file = self.folder / "c.yaml"
        file.write_text(f"version: 1\nscenario: {CASE_STUDY}\n" + text)
        checked = Program("baraka", "check", file).finish()
        started = Program("baraka", "campaign", file, "--out", self.out).finish()
        self.assertEqual((checked.status, started.status), (2, 2), str(checked))
        self.assertFalse(self.out.exists(), "judged before anything is written")
        self.assertEqual(checked.err, started.err)
        return checked.err.replace(str(file), "c.yaml")

    def test_a_wrong_value_is_named_with_its_point_and_where_it_stands(self):
        said = self.check(f"vary:\n  control_period: [50 ms, 100 ms]\n  {SPEED}: [0.3 m/s, 7]\n")
        self.assertRegex(said, r"^c.yaml:5:56: .*speed.*'7' must be written in m/s.*"
                               r"\(point 2: control_period=50 ms, speed=7\)\n$")

    def test_an_unknown_key_is_told_once_at_each_value(self):
        said = self.check("vary:\n  radio.tx_pover: [1 mW, 2 mW]\n")
        self.assertIn("c.yaml:4:20: radio.tx_pover: is not a known key; did you mean", said)
        self.assertEqual(len(said.splitlines()), 2, said)

    def test_a_mistake_that_values_make_elsewhere_names_the_point(self):
        said = self.check("vary: {command_timeout: [50 ms, 500 ms]}\n")
        self.assertRegex(said, r"^c.yaml:3:26: .*\(point 1: command_timeout=50 ms\)\n$")

    def test_a_scenario_that_is_wrong_by_itself_is_told_once(self):
        wrong = self.folder / "wrong.yaml"
        wrong.write_text(CASE_STUDY.read_text().replace("control_period: 100 ms", "control_period: 100 m")
                         .replace("../", str(ROOT / "config") + "/"))
        file = self.write({**SPEEDS, "scenario": "wrong.yaml"})
        said = Program("baraka", "check", file).finish()
        self.assertEqual(len(said.err.splitlines()), 1, str(said))
        self.assertIn("wrong.yaml:10:17: control_period", said.err)

    def test_a_program_that_is_not_there_is_told_once_before_anything_starts(self):
        file = self.write({**SPEEDS, "scenario": str(ROOT / "config/invalid/program_that_is_not_there.yaml"),
                           "vary": {"radio.tx_power": ["1 mW", "2 mW"]}})
        for command in (["check"], ["campaign", "--out", self.out]):
            said = Program("baraka", *command, file).finish()
            self.assertEqual(said.status, 2, str(said))
            self.assertRegex(said.err, r"^\S+there.yaml:12:9: command: no program 'no_such_program_anywhere' in PATH \(.*\)\n$")
        self.assertFalse(self.out.exists())

    def test_a_scenario_that_is_not_there(self):
        said = Program("baraka", "check", self.write({**SPEEDS, "scenario": "nowhere.yaml"})).finish()
        self.assertEqual(said.status, 2)
        self.assertRegex(said.err, r"speeds.yaml:1:\d+: scenario: .*nowhere.yaml")


class EndedEarly(Campaigns):
    content = {**SPEEDS, "replications": 4}

    def test_kills_at_random_instants_lose_and_repeat_nothing(self):
        content = {**self.content, "replications": max(4, KILLS)}
        self.campaign(content, out=self.folder / "undisturbed")
        expected = self.ask(ENDED, self.folder / "undisturbed")
        random.seed(int(os.environ.get("BARAKA_SEED", "12")))
        before = {}  # what was done before a kill is not touched after it
        for _ in range(KILLS):
            # While it plans, and while it runs.
            program = self.begin(content)
            time.sleep(random.uniform(0, 0.8))
            send(program.process.pid, "SIGKILL")
            program.finish()
            if self.done():
                before.update(self.ask("SELECT run, ended || attempts FROM runs WHERE state = 'done'"))
        finished = self.campaign(content)
        self.assertGreaterEqual(int(finished["kept"]), len(before))
        self.assertEqual(self.ask(ENDED), expected)
        after = dict(self.ask("SELECT run, ended || attempts FROM runs"))
        self.assertEqual({run: after[run] for run in before}, before, "done again")
        self.assertEqual(self.ask("PRAGMA integrity_check"), [("ok",)])
        measured = ("SELECT run, name, agent, value FROM measurements JOIN observables USING (observable) "
                    "ORDER BY 1, 2, 3")
        self.assertEqual(self.ask(measured), self.ask(measured, self.folder / "undisturbed"))
        self.assertEqual(list((self.out / "runs").iterdir()), [])

    def test_ctrl_c_ends_it_and_the_same_command_goes_on(self):
        program = self.begin(self.content, "--jobs", 1)
        wait_for(lambda: self.done() >= 2)
        second = self.campaign(self.content, status=1)
        self.assertIn("another run is writing there", second.err)
        status = self.campaign(self.content, "--status")
        self.assertEqual((status["under_way"], status["runs"]), ("yes", "8"))
        self.assertIn("about", status["estimate"])
        send(program.process.pid, "SIGINT")
        finished = program.finish()
        self.assertEqual(finished.status, 130, str(finished))
        self.assertIn("repeat the command to continue", finished.err)
        self.assertEqual(int(finished["finished"]), self.done())
        self.assertEqual(self.campaign(self.content, "--status")["under_way"], "no")
        self.assertEqual(self.campaign(self.content)["finished"], "8")

    def test_failed_runs_are_listed_and_only_they_are_done_again(self):
        content = {"scenario": str(FAULTY), "until": "3 s", "replications": 2, "keep": "failed",
                   "vary": {"agents.robots.controller.parameters.throw_at": ["2 s", "100 s"]}}
        for attempts, options in ((1, []), (1, []), (2, ["--retry-failed"])):
            finished = self.campaign(content, *options, status=1)
            self.assertEqual((finished["finished"], finished["failed"]), ("2", "2"))
            self.assertRegex(finished.err, r"failed: p001-r02 \(seed \d+\): .*the wheels have come off")
            self.assertEqual(self.ask("SELECT state, attempts FROM runs ORDER BY run"),
                             [("failed", attempts)] * 2 + [("done", 1)] * 2)
        self.assertIn("the wheels have come off", self.ask("SELECT error FROM runs")[0][0])
        self.assertEqual(self.ask("SELECT folder FROM runs ORDER BY run"),
                         [("runs/p001-r01",), ("runs/p001-r02",), (None,), (None,)])

    def test_the_log_of_a_failed_run_stays_when_no_folder_does(self):
        content = {"scenario": str(FAULTY), "until": "3 s", "replications": 1, "keep": "none",
                   "vary": {"agents.robots.controller.parameters.throw_at": ["2 s", "100 s"]}}
        for _ in range(2):  # also when the same command finds nothing to do
            self.campaign(content, status=1)
            left = sorted(file.name for file in (self.out / "runs").iterdir())
            self.assertEqual(left, ["p001-r01.log"])
            self.assertIn("the wheels have come off", (self.out / "runs" / left[0]).read_text())

    @unittest.skipUnless(private_network.is_possible(), "this user may make no namespaces")
    def test_a_full_disk_loses_nothing(self):
        self.campaign(self.content, out=self.folder / "undisturbed")
        file = self.write({**self.content, "keep": "all"})  # some hundred kilobytes each
        disk, kept = self.folder / "disk", self.folder / "kept"
        disk.mkdir()
        command = f"{BIN}/baraka campaign {file} --out {disk}/out --jobs 1"
        script = (f"set -e; mount -t tmpfs -o size=2500k none {disk}\n"
                  f"{command} > {self.folder}/first.log 2>&1 && echo 'not full'; echo status $?\n"
                  f"mount -o remount,size=100m {disk}\n"
                  f"{command}\n"
                  f"cp -r {disk}/out {kept}")
        done = subprocess.run(["unshare", "-Urm", "sh", "-c", script], capture_output=True, text=True, check=False)
        first = (self.folder / "first.log").read_text()
        self.assertEqual(done.returncode, 0, done.stderr + first)
        self.assertIn("status 1", done.stdout, first)
        self.assertIn("the disk is full", first)
        self.assertIn("repeat the command to continue", first)
        self.assertRegex(done.stdout, r"(?m)^kept: [1-7]$")
        self.assertEqual(self.ask(ENDED, kept), self.ask(ENDED, self.folder / "undisturbed"))


if __name__ == "__main__":
    unittest.main()
