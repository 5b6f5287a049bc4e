#!/usr/bin/env python3
"""What happens to folders of results: no run touches what no run wrote, and whatever ends a run, the
earlier result is still there, whole."""
import csv
import os
import pathlib
import shutil
import sqlite3
import subprocess
import unittest
import xml.etree.ElementTree

from baraka import BIN, CASE_STUDY, ROOT, Case, Program, send, some_domain, wait_for

TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
IN_PROCESS = ["--controllers", "in-process"]
NOBODY = 65534
STEP = int(os.environ.get("BARAKA_STEP", "16"))  # changes from one kill to the next, after the first 24


def content(folder):
    """Every file in a folder, byte by byte."""
    return {path.relative_to(folder): path.read_bytes()
            for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}


class Folders(Case):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def beside(self, suffix):
        return self.out.with_name("out" + suffix)

    def run_to(self, *arguments, status=0, scenario=TWO_MOTES, out=None, env=None):
        finished = self.start(scenario, *IN_PROCESS, *arguments, out=out or self.out, env=env).finish()
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def run_value(self, key, out=None):
        rows = self.query(f"SELECT value FROM run WHERE key = '{key}'", out)
        return rows[0][0] if rows else None

    def has_poses(self):
        try:
            return self.query("SELECT COUNT(*) FROM poses")[0][0] > 0
        except sqlite3.OperationalError:
            return False  # not even the tables are there

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())


class Replacing(Folders):
    def test_the_run_says_where_its_results_are(self):
        self.assertEqual(self.run_to()["results"], str(self.out))
        self.assertEqual(self.run_value("result"), "done")

    def test_earlier_ones_are_kept_in_the_order_of_their_age(self):
        for seed in (1, 2, 3):
            finished = self.run_to("--seed", seed)
        self.assertIn(f"the earlier result is kept: {self.out}.2", finished.err)
        self.assertEqual(self.names(), ["out", "out.1", "out.2"])
        self.assertEqual([self.run_value("seed", self.beside(s)) for s in (".1", ".2", "")], [1, 2, 3])
        shutil.rmtree(self.beside(".1"))
        self.run_to("--seed", "4")
        self.assertEqual(self.names(), ["out", "out.2", "out.3"])

    def test_overwrite_keeps_none(self):
        self.run_to()
        self.run_to("--seed", "2", "--overwrite")
        self.assertEqual(self.names(), ["out"])
        self.assertEqual(self.run_value("seed"), 2)

    def test_files_that_no_run_wrote_are_never_touched(self):
        self.out.mkdir()
        for name in ("notebook.log", "run.sqlite.backup", "run.sqlite", "scenario.resolved.yaml"):
            with self.subTest(name=name):
                (self.out / name).write_text("precious")
                before = content(self.out)
                for arguments in ([], ["--overwrite"], ["--replications", "2"]):
                    refused = self.run_to(*arguments, status=2)
                    self.assertIn(name, refused.err)
                    self.assertIn(str(self.out), refused.err)
                    self.assertEqual(content(self.out), before)
                (self.out / name).unlink()
        self.assertEqual(self.names(), ["out"])

    def test_a_result_with_something_else_in_it_is_refused(self):
        self.run_to()
        for name in ("thesis.tex", "run.log"):
            precious = self.out / name
            precious.unlink(missing_ok=True)
            precious.mkdir()  # a folder is nothing that a run wrote, however it is called
            self.assertIn(name, self.run_to(status=2).err)
            self.assertIn(name, self.run_to("--overwrite", status=2).err)
            precious.rmdir()
        self.run_to()

    def test_a_marker_cannot_name_what_is_elsewhere(self):
        precious = self.folder / "precious"
        precious.write_text("thesis")
        self.out.mkdir()
        (self.out / ".baraka-result").write_text(
            f"run: 0\nfiles:\n- ../precious\n- {precious}\n- link\n- ..\n")
        (self.out / "link").symlink_to(precious)
        self.run_to("--overwrite")
        self.assertEqual(precious.read_text(), "thesis")
        self.assertEqual(self.names(), ["out", "precious"])

    def test_replications_keep_an_earlier_single_run(self):
        self.run_to("--seed", "9")
        finished = self.run_to("--replications", "2")
        self.assertEqual(finished["results"], str(self.out))
        self.assertEqual(self.run_value("seed", self.beside(".1")), 9)
        self.assertEqual([self.run_value("seed", self.out / f"replication-0{k}") for k in (1, 2)],
                         [1, 2])
        self.assertIn("replications.yaml", self.run_to(status=2).err)

    def test_a_repeated_run_is_not_replaced_by_its_repetition(self):
        self.run_to("--pace", "realtime:100")
        self.assertIn("--repeat", self.run_to("--repeat", self.out, status=2).err)


class NotStarted(Folders):
    def attempt(self):
        return self.beside(".not-started")

    def assert_not_started(self, finished, error):
        self.assertEqual(self.run_value("result", self.attempt()), "not started")
        self.assertRegex(self.run_value("error", self.attempt()), error)
        self.assertIn(str(self.attempt()), finished.err)
        self.assertFalse((self.attempt() / ".reserve").exists())

    def test_a_busy_domain_leaves_the_earlier_result(self):
        self.run_to("--seed", "5")
        before = content(self.out)
        domain = some_domain(self)
        holder = self.start(TWO_MOTES, "--controllers", "external", "--domain", domain,
                            out=self.folder / "holder")
        self.addCleanup(holder.clean_up)
        wait_for(lambda: f"@baraka-domain-{domain}-7" in pathlib.Path("/proc/net/unix").read_text())
        for arguments in ([], ["--overwrite"]):
            finished = self.start(TWO_MOTES, "--domain", domain, *arguments,
                                  out=self.folder / "out").finish()
            self.assertEqual(finished.status, 1, str(finished))
            self.assert_not_started(finished, f"DDS domain {domain} is busy: pid \\d+ ")
            self.assertEqual(content(self.out), before)
        self.assertNotIn("results:", finished.out)
        self.run_to("--seed", "6")  # takes the place of the attempt, too
        self.assertEqual([n for n in self.names() if n.startswith("out")], ["out", "out.1"])
        self.assertEqual(content(self.beside(".1")), before)

    def test_missing_controllers_leave_the_earlier_result(self):
        self.run_to()
        before = content(self.out)
        finished = self.start(TWO_MOTES, "--controllers", "external", "--domain", some_domain(self),
                              "--set", "wait=100 ms", out=self.out).finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assert_not_started(finished, "m0")
        self.assertEqual(content(self.out), before)

    def test_what_a_controller_said_that_did_not_start_is_kept(self):
        finished = self.start(TWO_MOTES, "--set", "agents.motes.controller.processes=2",
                              env={"LD_PRELOAD": "/no/such/library"}, out=self.out).finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertIn("/no/such/library", (self.out / "motes-1.log").read_text())
        self.assertEqual(sorted(p.name for p in self.out.iterdir()),
                         [".baraka-result", "motes-1.log", "motes-2.log", "run.log", "run.sqlite",
                          "scenario.resolved.yaml"])

    def test_the_report_of_an_attempt_says_that_it_did_not_start(self):
        finished = self.start(TWO_MOTES, "--controllers", "external", "--domain", some_domain(self),
                              "--set", "wait=100 ms", out=self.out).finish()
        self.assert_not_started(finished, "m0")
        report = Program("baraka", "report", self.attempt()).finish()
        self.assertEqual(report.status, 0, str(report))
        self.assertIn("not started", report.out)


class Several(Folders):
    def test_two_at_once_do_not_meet(self):
        self.run_to("--seed", "7")
        first = self.start(CASE_STUDY, *IN_PROCESS, "--until", "2", "--max-speed", "1", out=self.out)
        wait_for(self.beside(".1").exists)
        refused = self.run_to(status=1)
        self.assertIn(f"another run is writing there (pid {first.process.pid})", refused.err)
        finished = first.finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertEqual((self.run_value("result"), self.run_value("seed", self.beside(".1"))),
                         ("until", 7))

    def test_of_many_at_once_none_harms_another(self):
        programs = [self.start(TWO_MOTES, *IN_PROCESS, "--seed", seed, out=self.out)
                    for seed in range(1, 9)]
        finished = [program.finish() for program in programs]
        ended = {seed for seed, one in enumerate(finished, 1) if one.status == 0}
        self.assertGreaterEqual(len(ended), 1)
        for one in finished:
            self.assertIn(one.status, (0, 1), str(one))
        folders = [self.folder / name for name in self.names() if not name.startswith(".")]
        self.assertEqual({self.run_value("seed", folder) for folder in folders}, ended)
        self.assertEqual({self.run_value("result", folder) for folder in folders}, {"done"})


class Killed(Folders):
    def setUp(self):
        super().setUp()
        if shutil.which("cc") is None:
            self.skipTest("no C compiler")
        self.library = self.folder / "kill_at.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-o", self.library,
                        ROOT / "tests/e2e/kill_at/kill_at.c", "-ldl"], check=True)

    def results(self):
        """Seeds of whole results there are, by folder."""
        seeds = {}
        for folder in self.folder.glob("out*"):
            try:
                if self.run_value("result", folder) == "done":
                    seeds[folder.name] = self.run_value("seed", folder)
            except sqlite3.OperationalError:
                continue
        return seeds

    def kill_everywhere(self, *arguments):
        """Kills runs of seed 2 before each change that they make, until one comes to its end. There is a result of seed 1."""
        out, earlier = self.out, self.folder / "earlier"
        self.run_to("--seed", "1", out=earlier)
        self.out = out
        for number in [*range(1, 25), *range(25, 400, STEP)]:
            for path in self.folder.glob("out*"):
                shutil.rmtree(path)
            shutil.copytree(earlier, self.out)
            killed = self.start(TWO_MOTES, *IN_PROCESS, "--seed", "2", *arguments, out=self.out, env={
                "LD_PRELOAD": str(self.library), "KILL_AT": str(number)}).finish()
            yield number, killed.status == -9
            if killed.status == 0:
                return
        raise AssertionError("no end")

    def test_at_every_stage_the_earlier_result_stays_whole(self):
        stages = 0
        for number, was_killed in self.kill_everywhere():
            with self.subTest(number=number):
                self.assertIn(1, self.results().values())
                self.run_to("--seed", "3")
                after = self.results()
                self.assertEqual(after["out"], 3)
                self.assertIn(1, after.values())
                stages += was_killed
        self.assertGreater(stages, 20)

    def test_overwriting_loses_the_earlier_one_only_when_the_new_one_has_begun(self):
        for number, _ in self.kill_everywhere("--overwrite"):
            with self.subTest(number=number):
                begun = (self.out / "run.sqlite").exists() and 1 not in self.results().values()
                if begun:  # the new one is in its place, ended or not
                    self.assertIn("run: ", (self.out / ".baraka-result").read_text())
                    self.assertFalse(self.beside(".not-started").exists())
                self.run_to("--seed", "3", "--overwrite")
                self.assertEqual([n for n in self.names() if n.startswith("out")], ["out"])
                self.assertEqual(self.results(), {"out": 3})

    def test_one_that_was_killed_is_called_unfinished(self):
        program = self.start(CASE_STUDY, *IN_PROCESS, "--max-speed", "2", out=self.out)
        wait_for(self.has_poses)
        send(program.process.pid, "SIGKILL")
        program.finish()
        self.assertEqual(self.run_value("result"), "running")
        report = Program("baraka", "report", self.out).finish()
        self.assertIn("unfinished", report.out)
        export = Program("baraka", "export", self.out, "poses").finish()
        self.assertEqual(export.status, 0, str(export))
        self.assertIn("unfinished", export.err)
        self.assertIn("agent,at_ns,x_m", export.out)


class Places(Folders):
    def test_a_link_to_a_folder_is_followed_and_stays(self):
        real = self.folder / "disk" / "real"
        real.mkdir(parents=True)
        self.out.symlink_to(real)
        self.run_to("--seed", "1")
        self.run_to("--seed", "2")
        self.assertTrue(self.out.is_symlink())
        self.assertEqual((self.run_value("seed"), self.run_value("seed", real.with_name("real.1"))),
                         (2, 1))

    def test_however_the_folder_is_written_it_is_the_same(self):
        self.run_to("--seed", "1", out=f"{self.folder}/./x/../out/")
        self.run_to("--seed", "2", out=f"{self.folder}//out")
        self.out = self.folder / "out"
        self.assertEqual(self.names(), ["out", "out.1"])
        done = subprocess.run([BIN / "baraka", "run", TWO_MOTES, *IN_PROCESS, "--seed", "3", "--out", "."],
                              cwd=self.out, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"results: {self.out}\n", done.stdout)
        self.assertEqual([self.run_value("seed", self.beside(s)) for s in (".1", ".2", "")], [1, 2, 3])

    def test_what_is_no_folder_is_refused(self):
        self.out.write_text("precious")
        self.assertIn("no folder", self.run_to(status=2).err)
        self.assertEqual(self.out.read_text(), "precious")
        self.out.unlink()
        self.out.symlink_to(self.folder / "nowhere")
        self.assertIn("no folder", self.run_to(status=2).err)

    def test_a_lock_is_not_opened_through_a_link_nor_truncated(self):
        precious = self.folder / "precious"
        precious.write_text("thesis")
        (self.folder / ".out.lock").symlink_to(precious)
        self.assertIn(".out.lock", self.run_to(status=1).err)
        (self.folder / ".out.lock").unlink()
        os.link(precious, self.folder / ".out.lock")
        self.assertIn(".out.lock", self.run_to(status=1).err)
        self.assertEqual(precious.read_text(), "thesis")

    def test_a_folder_that_cannot_be_written_is_named_and_stays(self):
        self.run_to()
        before = content(self.folder)
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        command = [BIN / "baraka", "run", TWO_MOTES, *IN_PROCESS, "--out", self.out]
        if os.geteuid() == 0:
            command = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", *command]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(str(self.folder), done.stderr)
        self.assertIn("Permission denied", done.stderr)
        self.assertEqual(content(self.folder), before)

    def test_its_rights_are_those_of_the_folder_that_was_there(self):
        self.out.mkdir(mode=0o700)
        self.run_to()
        self.assertEqual(self.out.stat().st_mode & 0o777, 0o700)
        self.run_to()
        self.assertEqual(self.out.stat().st_mode & 0o777, 0o700)


class FullDisk(Folders):
    """On a disk of a few megabytes, in a mount namespace of its own."""

    def setUp(self):
        super().setUp()
        if subprocess.run(["unshare", "--map-root-user", "--mount", "mount", "-t", "tmpfs", "none",
                           self.folder], capture_output=True).returncode != 0:
            self.skipTest("no right to mount")

    def on_disk(self, size, script):
        """Runs a script on a disk of its own; what is in `out` there stays in self.out."""
        self.disks = getattr(self, "disks", 0) + 1
        disk, kept = self.folder / f"disk{self.disks}", self.folder / f"kept{self.disks}"
        disk.mkdir()
        kept.mkdir()
        done = subprocess.run(
            ["unshare", "--map-root-user", "--mount", "sh", "-c",
             f"mount -t tmpfs -o size={size} none {disk} || exit 99; cd {disk}; {script}\n"
             f"status=$?; cp -a {disk}/. {kept}; exit $status"],
            capture_output=True, text=True, timeout=120)
        self.assertNotEqual(done.returncode, 99, done.stderr)
        self.out = kept / "out"
        return done

    def baraka(self, *arguments):
        return " ".join(map(str, [BIN / "baraka", "run", *arguments, "--out", "out"]))

    def test_one_that_fills_up_ends_the_run_and_the_result_says_so(self):
        for controllers in ("in-process", "spawn"):
            with self.subTest(controllers=controllers):
                done = self.on_disk("2m", self.baraka(CASE_STUDY, "--controllers", controllers, "--set",
                                                      "'record.frames=all'"))
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("result: failed", done.stdout)
                self.assertRegex(done.stderr, "error: .*run.sqlite: .*full")
                self.assertNotIn("   0.000000000]", done.stderr)
                self.assertEqual(self.run_value("result"), "failed")
                self.assertIn("full", self.run_value("error"))
                self.assertEqual(self.run_value("exit_status"), 1)
                self.assertGreater(self.run_value("simulated_s"), 1)
                self.assertGreater(self.query("SELECT COUNT(*) FROM frames")[0][0], 300)
                self.assertFalse((self.out / ".reserve").exists())

    def test_one_that_is_full_already_costs_nothing(self):
        done = self.on_disk("3m", f"{self.baraka(TWO_MOTES, *IN_PROCESS)} || exit 98;"
                                  "sha256sum out/* > before; dd if=/dev/zero of=rest bs=4k 2>/dev/null;"
                                  f"{self.baraka(TWO_MOTES, *IN_PROCESS)}; status=$?;"
                                  "sha256sum --quiet -c before || exit 97; (exit $status)")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("No space left on device", done.stderr)
        self.assertEqual(self.run_value("result"), "done")


# What has no place in a report about a scenario that compares itself with nothing.
PAPERS_WORDS = r"(?i)paper|replica score|case study|labella|fig\. ?\d|calibrated|inferred"


class Reports(Folders):
    """Of real runs, side by side."""

    def report(self, *folders):
        finished = Program("baraka", "report", *folders).finish()
        self.assertEqual(finished.status, 0, str(finished))
        return finished.out

    def head(self, report):
        line, = [line for line in report.splitlines() if line.startswith("figure ")]
        return [cell.strip() for cell in line.split("  ") if cell.strip()]

    def test_two_speeds_are_never_in_one_column(self):
        speeds = {"0.5 m/s": self.folder / "slow", "0.94 m/s": self.folder / "fast"}
        for speed, out in speeds.items():
            self.run_to("--until", "2", "--set", f"agents.robots.controller.parameters.speed={speed}",
                        scenario=CASE_STUDY, out=out)
        again = self.folder / "again"
        self.run_to("--until", "2", "--seed", "2", scenario=CASE_STUDY, out=again)
        report = self.report(*speeds.values(), again)
        self.assertEqual(self.head(report), ["figure", "paper", "basis", "mobility_framework, speed 0.5 m/s",
                                             "mobility_framework, speed 0.94 m/s"])
        self.assertRegex(report, r"\nruns +10 +stated +1 +2\n")
        self.assertRegex(report, r"speed 0.5 m/s: not the paper's case study: agents\.robots\.\S*speed "
                                 r"is 0\.5 m/s, not 0\.94 m/s\n")
        self.assertRegex(report, r"Settings in which these differ\n.*\nagents\.robots\.\S*speed +"
                                 r"0\.5 m/s +0\.94 m/s\n")

    def test_the_papers_column_stands_beside_its_case_study_only(self):
        self.run_to("--until", "2", "--set", "radio.profile=ideal", scenario=CASE_STUDY)
        self.assertEqual(self.head(self.report(self.out)), ["figure", "paper", "basis", "ideal"])
        self.run_to(out=self.folder / "other")
        report = self.report(self.folder / "other")
        self.assertEqual(self.head(report), ["figure", "two_motes"])
        self.assertNotRegex(report, PAPERS_WORDS)


class Experiments(Folders):
    """Two periods of hellos between two motes, three seeds each, as one experiment."""

    def run_all(self):
        self.outs = []
        for phase in "aligned", "uniform":
            for seed in 1, 2, 3:
                self.outs.append(self.folder / f"{phase}_{seed}")
                self.run_to("--until", "2", "--seed", seed, "--set", f"control_phase={phase}", "--set",
                            "report=[{plot: frames.sent, versus: control_phase}]", out=self.outs[-1])

    def test_a_figure_for_a_paper_and_its_numbers(self):
        self.run_all()
        text = Program("baraka", "report", *self.outs).finish()
        self.assertEqual(text.status, 0, str(text))
        self.assertIn("Experiment: 2 settings, 6 complete runs", text.out)
        self.assertIn("note: only 3 runs of a setting", text.out)
        self.assertNotRegex(text.out, PAPERS_WORDS)
        svg, table = self.folder / "sent.svg", self.folder / "sent.csv"
        for file in svg, table:
            self.assertEqual(Program("baraka", "report", *self.outs, "-o", file).finish()["figure"], str(file))
        drawing = xml.etree.ElementTree.parse(svg).getroot()
        points = [one for one in drawing.iter() if one.get("class") == "point"]
        self.assertEqual([(point.get("data-runs"), float(point.get("data-y"))) for point in points],
                         [("3", sum(self.query("SELECT sum(count) FROM frames_sent", out)[0][0] for out in outs) / 3)
                          for outs in (self.outs[:3], self.outs[3:])])
        head, *rows = csv.reader(table.read_text().splitlines())
        self.assertEqual(head, ["control_phase", "runs", "mean", "95 % low", "high", "sd"])
        self.assertEqual([row[:2] for row in rows], [["aligned", "3"], ["uniform", "3"]])
        scenario = self.folder / "scenario.yaml"
        scenario.write_text("report: [{plot: run.events, as: table}]\n")
        later = Program("baraka", "report", *self.outs, "--scenario", scenario).finish()
        self.assertIn("\nrun.events: run.events, mean over runs", later.out)
        scenario.write_text("report: [{plot: run.events, as: tabel}]\n")
        wrong = Program("baraka", "report", *self.outs, "--scenario", scenario).finish()
        self.assertIn(f"{scenario}:1:33: report.as: 'tabel' is not one of", wrong.err)
        resamples = self.folder / "resamples.csv"
        done = Program("baraka", "report", *self.outs, "--interval", "bootstrap", "--figure", "frames.sent",
                       "--resamples", resamples).finish()
        self.assertIn("BCa", done.out)
        lines = resamples.read_text().splitlines()
        self.assertEqual({len(line.split(",")) for line in lines}, {3})
        self.assertEqual(len(lines), 2000)
        for arguments, message in ((["--figure", "frames.snet"], "did you mean 'frames.sent'?"),
                                   (["--figure", "frames.sent", "--versus", "speed"], "they differ in\n  control_phase"),
                                   (["--figure", "frames.sent", "--as", "time"], "was not recorded over time")):
            wrong = Program("baraka", "report", *self.outs, *arguments).finish()
            self.assertEqual(wrong.status, 1, str(wrong))
            self.assertIn(message, wrong.err)


class TellingApart(Folders):
    def test_two_runs_differ_first_where_something_else_happened(self):
        first, other = self.folder / "first", self.folder / "other"
        self.run_to("--until", "60", scenario=CASE_STUDY, out=first)
        self.run_to("--until", "60", "--set", "end=[{at: 42500 ms, result: cut}]", "--set", "expect=[]",
                    scenario=CASE_STUDY, out=other)
        rows = {name: set(self.query("SELECT second, part, agent, hash FROM fingerprints", name))
                for name in (first, other)}
        second, part, _, _ = min(rows[first] ^ rows[other], key=lambda row: row[:3])
        self.assertEqual((second, part), (42, "bodies"))

    def test_a_second_like_the_one_before_needs_no_row(self):
        self.run_to("--until", "60", scenario=CASE_STUDY)
        still = self.query("SELECT COUNT(*) FROM fingerprints JOIN agents USING (agent)"
                           " WHERE kind = 'mote' AND part = 'bodies'")[0][0]
        self.assertLessEqual(still, 3 * 25)  # they never move: the first second, the others, the last
        moving = self.query("SELECT COUNT(*) FROM fingerprints JOIN agents USING (agent)"
                            " WHERE kind = 'robot' AND part = 'bodies'")[0][0]
        self.assertGreater(moving, 50)


class Once(Folders):
    """What runs of a cluster do that start again: --once."""
    slow = ["--until", "2", "--max-speed", "2"]

    def run_id(self):
        return self.run_value("run_id")

    def test_a_finished_result_stays_and_is_told_again(self):
        first = self.run_to("--seed", "3")
        before = content(self.out)
        again = self.run_to("--seed", "3", "--once", "--overwrite")
        self.assertIn("the result is there already", again.err)
        self.assertEqual([again[key] for key in ("result", "fingerprint")],
                         [first[key] for key in ("result", "fingerprint")])
        self.assertEqual(content(self.out), before)
        unmet = ["--set", "end=[{at: 1 s, result: gave up}]", "--set", "expect=[{result: other}]"]
        for _ in range(2):
            self.run_to(*unmet, "--once", "--overwrite", "--seed", "4", status=3)

    def test_another_seed_or_a_failed_run_is_no_such_result(self):
        self.run_to("--seed", "3")
        self.run_to("--seed", "4", "--once", "--overwrite")
        self.assertEqual(self.run_value("seed"), 4)
        fault = ["--set", "agents.robots.controller.parameters.throw_at=1 s", "--once", "--overwrite"]
        failed = []
        for _ in range(2):
            self.run_to(*fault, status=1, scenario=ROOT / "tests/e2e/faulty.yaml")
            failed.append(self.run_id())
        self.assertNotEqual(*failed)

    def test_one_waits_for_another_that_is_writing_there(self):
        first = self.start(CASE_STUDY, *IN_PROCESS, *self.slow, "--once", out=self.out)
        wait_for(self.has_begun)
        mine = self.run_id()
        second = self.start(CASE_STUDY, *IN_PROCESS, *self.slow, "--once", "--overwrite", out=self.out)
        ended = second.finish()
        self.assertEqual((ended.status, first.finish().status), (0, 0), str(ended))
        self.assertIn(f"waiting: {self.out}: another run is writing there (pid {first.process.pid})", ended.err)
        self.assertIn("the result is there already", ended.err)
        self.assertEqual(self.run_id(), mine)

    def test_one_takes_the_place_of_another_that_was_killed(self):
        first = self.start(CASE_STUDY, *IN_PROCESS, *self.slow, "--once", out=self.out)
        wait_for(self.has_begun)
        second = self.start(CASE_STUDY, *IN_PROCESS, "--until", "2", "--once", "--overwrite", out=self.out)
        send(first.process.pid, "SIGKILL")
        ended = second.finish()
        self.assertEqual(ended.status, 0, str(ended))
        self.assertEqual(self.run_value("exit_status"), 0)
        self.assertNotIn("already", ended.err)

    def test_one_that_waits_can_be_interrupted(self):
        first = self.start(CASE_STUDY, *IN_PROCESS, "--max-speed", "1", out=self.out)
        wait_for(self.has_begun)
        second = self.start(CASE_STUDY, *IN_PROCESS, "--once", out=self.out)
        self.assertIn("waiting", second.process.stderr.readline())
        send(second.process.pid, "SIGTERM")
        self.assertEqual(second.finish().status, 130)
        send(first.process.pid, "SIGINT")
        self.assertEqual(first.finish().status, 130)

    def has_begun(self):
        try:
            return self.out.exists() and self.run_id()
        except sqlite3.OperationalError:
            return None


if __name__ == "__main__":
    unittest.main()
