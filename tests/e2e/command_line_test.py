#!/usr/bin/env python3
"""What `baraka` says to those who use it wrongly, and what it does with folders of results."""
import contextlib
import csv
import pathlib
import re
import shutil
import sqlite3
import subprocess
import tempfile
import unittest

from baraka import BIN, CASE_STUDY, ROOT, Case, Program

TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
IN_PROCESS = ["--controllers", "in-process"]


class CommandLine(Case):
    def test_no_command_or_an_unknown_option_is_a_usage_error(self):
        for arguments in ([], ["run"], ["run", TWO_MOTES, "--sed", "1"], ["fly"],
                          ["run", TWO_MOTES, "--max-speed", "0"], ["run", TWO_MOTES, "--until", "-1"]):
            with self.subTest(arguments=arguments):
                finished = Program("baraka", *arguments).finish()
                self.assertEqual(finished.status, 2, str(finished))
                self.assertTrue(finished.err)

    def test_help_is_no_error(self):
        finished = Program("baraka", "run", "--help").finish()
        self.assertEqual(finished.status, 0)
        self.assertIn("--max-speed", finished.out)

    def test_a_word_that_is_nearly_right_is_found(self):
        for arguments, what in ((["ruin"], "'ruin' is no command; did you mean 'run'?"),
                                (["topic", "ecko"], "'ecko' is no command; did you mean 'echo'?"),
                                (["run", TWO_MOTES, "--sed", "1"], "'--sed' is no option; did you mean '--seed'?"),
                                (["run", TWO_MOTES, "--controllers", "externl"],
                                 "'externl' is not one of spawn, external, in-process; did you mean 'external'?")):
            with self.subTest(arguments=arguments):
                finished = Program("baraka", *arguments).finish()
                self.assertEqual(finished.status, 2, str(finished))
                self.assertIn(what, finished.err)

    def test_every_program_tells_its_version(self):
        for program in ("baraka", "baraka-agentd", "help_mote"):
            finished = Program(program, "--version").finish()
            self.assertEqual(finished.status, 0, str(finished))
            self.assertRegex(finished.out, rf"^{program} \(BARAKA \d+\.\d+\.\d+\)\n$")

    def test_help_names_what_can_be_chosen(self):
        help_text = Program("baraka", "run", "--help").finish().out
        self.assertIn("spawn|external|in-process", help_text)
        self.assertNotIn("ENUM", help_text)

    def test_items_of_lists_can_be_set(self):
        pose = "agents.robots.poses.0.x"
        self.run_baraka(CASE_STUDY, *IN_PROCESS, "--until", "1", "--set", f"{pose}=3 m")
        self.assertEqual(self.query("SELECT x_m FROM agents WHERE name = 'r0'"), [(3,)])
        finished = Program("baraka", "check", CASE_STUDY, "--set", "agents.robots.poses.7.x=3 m").finish()
        self.assertEqual(finished.status, 2, str(finished))
        self.assertIn("--set agents.robots.poses.7.x: '7' is not an item: the list has 1, 0 to 0", finished.err)
        finished = Program("baraka", "check", CASE_STUDY, "--set", f"{pose}=far").finish()
        self.assertIn(f"--set {pose}: 'far' is not a number", finished.err)

    def test_what_cannot_be_printed_is_a_failure(self):
        self.run_baraka(TWO_MOTES, *IN_PROCESS)
        for program, *arguments in (["baraka", "--help"], ["baraka", "--version"],
                                    ["baraka", "check", TWO_MOTES], ["baraka", "report", self.out],
                                    ["baraka", "run", TWO_MOTES, *IN_PROCESS, "--out", self.folder / "full"],
                                    ["baraka", "new-controller", "x", "--to", self.folder],
                                    ["baraka-agentd", "--help"], ["help_mote", "--help"]):
            with self.subTest(program=program, arguments=arguments), open("/dev/full", "w") as full:
                finished = subprocess.run([BIN / program, *map(str, arguments)], stdout=full,
                                          stderr=subprocess.PIPE, text=True)
                self.assertEqual(finished.returncode, 1, finished.stderr)
                self.assertRegex(finished.stderr, "error: (standard output: |.*No space left on device)")

    def test_check_finds_every_mistake_and_places_it(self):
        self.assertEqual(Program("baraka", "check", CASE_STUDY).finish().status, 0)
        finished = Program("baraka", "check", CASE_STUDY,
                           "--set", "agents.robots.controller.parameters.speed=9 m/s",
                           "--set", "agents.motes.controller.parameters.repeat_aftr=1 s").finish()
        self.assertEqual(finished.status, 2, str(finished))
        self.assertRegex(finished.err, r"speed: 9 m/s is above the limit")
        self.assertRegex(finished.err, r"repeat_aftr: .*did you mean 'repeat_after'")

    def test_files_with_mistakes_that_only_the_controller_can_find(self):
        judged = 0
        for path in sorted((ROOT / "config/invalid").glob("*.yaml")):
            lines = [line.removeprefix("# expect-check: ")
                     for line in path.read_text().splitlines() if line.startswith("# expect-check: ")]
            if not lines:
                continue
            judged += 1
            finished = Program("baraka", "check", path).finish()
            self.assertEqual(finished.status, 2, str(finished))
            for line in lines:
                place = f"{path.parent / line}" if line.startswith("parts/") else f"{path}:{line}"
                self.assertIn(place, finished.err)
        self.assertGreaterEqual(judged, 2)

    def test_a_program_that_is_not_there_is_named_before_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario, out = pathlib.Path(folder, "late.yaml"), pathlib.Path(folder, "out")
            scenario.write_text("""version: 1
routing: none
radio: {profile: ieee80211g}
end: [{at: 10 s, result: done}]
agents:
  a:
    name: a
    station: {}
    poses: [{x: 0 m, y: 0 m}]
    network: {}
    programs:
      - {name: there, command: [sh, -c, "true"]}
      - {name: late, command: [ddspref, ping], start: 9 s}
      - {name: made, command: ["{results}/later"], start: 9 s}
""")
            line = f"{scenario}:13:9: command: no program 'ddspref' in PATH"
            checked = Program("baraka", "check", scenario).finish()
            self.assertEqual((checked.status, checked.out), (2, ""), str(checked))
            self.assertIn(line, checked.err)
            refused = Program("baraka", "run", scenario, "--out", out).finish()
            self.assertEqual((refused.status, refused.err), (2, checked.err), str(refused))
            self.assertFalse(out.exists())

    def test_an_unknown_controller_is_a_mistake_in_the_scenario(self):
        finished = Program("baraka", "check", TWO_MOTES, "--set",
                           "agents.motes.controller.program=helpmote").finish()
        self.assertEqual(finished.status, 2, str(finished))
        self.assertRegex(finished.err, r"program: 'helpmote' is not a known controller")

    def test_a_controller_on_the_wrong_kind_of_agent_is_a_mistake(self):
        finished = Program("baraka", "check", TWO_MOTES, "--set",
                           "agents.motes.controller.program=wanderer").finish()
        self.assertEqual(finished.status, 2, str(finished))
        self.assertRegex(finished.err, r"'wanderer' does not drive agents like m0")

    def test_a_file_of_another_kind_is_the_one_mistake_where_it_is_included(self):
        included = "agents.motes.mote.include"
        with tempfile.TemporaryDirectory() as folder:
            scenario = pathlib.Path(folder, "s.yaml")
            scenario.write_text(TWO_MOTES.read_text().replace("../robots/mote.yaml", "radios/disk.yaml"))
            line = rf"{scenario}:11:21: {included}: '\S+/radios/disk.yaml' is a radio file, not a mote; scenarios include it: " \
                   r"radio: \{include: FILE\}\n"
            for command in (["check"], ["run"], ["view"]):
                said = Program("baraka", *command, scenario).finish()
                self.assertEqual((said.status, said.out), (2, ""), str(said))
                self.assertRegex(said.err, f"^{line}$")
            said = Program("baraka", "check", scenario, "--set", f"{included}=robots/mote.yaml").finish()
            self.assertEqual(said.status, 0, str(said))
            said = Program("baraka", "check", scenario, "--set", f"{included}=robots/mote.yaml", "--set", "sed=1").finish()
            self.assertRegex(said.err, r"^--set sed: is not a known key; .*\n$")
        said = Program("baraka", "run", TWO_MOTES, "--set", f"{included}=robots/robertino.yaml").finish()
        self.assertRegex(said.err, rf"^--set {included}: '\S+/robertino.yaml' is a robot file, not a mote; .*\n$")

    def test_a_daemon_says_what_takes_a_file_that_is_not_for_it(self):
        said = Program("baraka-agentd", TWO_MOTES).finish()
        self.assertEqual((said.status, said.out, said.err),
                         (2, "", f"{TWO_MOTES}: is a scenario file, not a hardware file; `baraka run FILE` runs it\n"))

    def test_a_missing_file_is_named(self):
        finished = Program("baraka", "run", "nowhere.yaml").finish()
        self.assertEqual(finished.status, 2, str(finished))
        self.assertIn("nowhere.yaml", finished.err)


class Results(Case):
    def test_the_resolved_scenario_repeats_the_run(self):
        first = self.run_baraka(CASE_STUDY, *IN_PROCESS, "--until", "20", "--seed", "5")
        resolved = self.out / "scenario.resolved.yaml"
        second = self.run_baraka(resolved, *IN_PROCESS, "--until", "20")
        self.assertEqual(first["fingerprint"], second["fingerprint"])

    def test_an_expectation_that_is_not_met_has_its_own_exit_status(self):
        finished = self.run_baraka(
            CASE_STUDY, *IN_PROCESS, "--set", "end=[{at: 5 s, result: gave up}]", status=3)
        self.assertEqual(finished["result"], "gave up")
        self.assertRegex(finished.err, r"not met: .*case_study.yaml:\d+:\d+: ")

    def test_until_before_the_end_is_no_failed_expectation(self):
        finished = self.run_baraka(CASE_STUDY, *IN_PROCESS, "--until", "3")
        self.assertEqual((finished["result"], finished["simulated_s"]), ("until", "3.000000000"))

    def test_a_sensor_more_needs_no_list_of_the_others(self):
        (self.folder / "mine.yaml").write_text(f"include: {ROOT}/config/robots/robertino.yaml\n"
                                               "sensors: {add: [{kind: pose}, {kind: bumper}]}\n")
        scenario = self.folder / "more.yaml"
        scenario.write_text(f"""version: 1
name: more
radio: {{profile: ideal}}
agents:
  robots:
    poses: [{{x: 0 m, y: 0 m}}]
    robot:
      include: mine.yaml
      sensors: {{add: [{{kind: pose, name: second}}], remove: [bumper]}}
    controller: {{program: wanderer}}
end: [{{at: 1 s, result: over}}]
""")
        checked = Program("baraka", "check", scenario).finish()
        self.assertEqual(checked.status, 0, str(checked))
        self.run_baraka(scenario, *IN_PROCESS)
        resolved = (self.out / "scenario.resolved.yaml").read_text()
        self.assertEqual(re.findall("kind: (pose|bumper)\n *name: (.+)", resolved),
                         [("pose", "pose"), ("pose", "second")])

    def test_every_command_says_the_same_of_what_is_no_result(self):
        (self.folder / "empty").mkdir()
        (self.folder / "file").write_text("x")
        for name, what, commands in (("empty", "holds no result", ["report", "export", "view", "diff"]),
                                     ("nowhere", "there is no such folder", ["report", "export", "diff"]),
                                     ("file", "is a file, and the folder of a result is wanted", ["report", "export", "diff"])):
            said = set()
            for command in commands:
                again = [self.folder / name] if command == "diff" else []
                finished = Program("baraka", command, self.folder / name, *again).finish()
                self.assertEqual(finished.status, 2, str(finished))
                said.add(finished.err)
            self.assertEqual(len(said), 1, said)
            self.assertIn(what, said.pop())

    def test_view_of_what_is_not_there_says_what_it_takes(self):
        takes = "; view takes folders of results, where a run wrote run.sqlite, or one scenario file"
        (self.folder / "results").mkdir()
        given = self.folder / "results"
        for name, similar in (("nowhere", ""), ("resutls", f"; did you mean '{given}'?")):
            said = Program("baraka", "view", self.folder / name).finish()
            self.assertEqual((said.status, said.err),
                             (2, f"error: {self.folder / name}: there is no such folder{similar}{takes}\n"))
        said = Program("baraka", "view", "tow_motes").finish()
        self.assertEqual((said.status, said.err),
                         (2, f"error: tow_motes: there is no such folder; did you mean 'two_motes.yaml'?{takes}\n"))
        said = Program("baraka", "view", "tow_motes.yaml").finish()
        self.assertEqual(said.status, 2)
        self.assertIn("tow_motes.yaml: there is no such file here", said.err)

    def test_a_report_without_the_page_says_what_is_missing(self):
        program = shutil.copy(BIN / "baraka", self.folder)  # where no page lies beside it
        finished = Program(program, "report", "-o", self.folder / "report.html", self.folder).finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertRegex(finished.err, "report_page.html is missing.*npm.*./setup report_page")
        self.assertFalse((self.folder / "report.html").exists())


class Export(Case):
    def export(self, *arguments, status=0):
        finished = Program("baraka", "export", *arguments).finish()
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def test_a_table_that_is_nearly_right_is_found(self):
        (self.folder / "r").mkdir()
        self.assertIn("export: 'framez' is not a table of a result; did you mean 'frames'?; there are: run, ",
                      self.export(self.folder / "r", "framez", status=2).err)
        self.assertIn("export: 'colour' is not a table of a result; there are: run, ",
                      self.export(self.folder / "r", "colour", status=2).err)

    def test_every_table_comes_as_csv_with_its_units(self):
        self.run_baraka(CASE_STUDY, *IN_PROCESS, "--until", "20")
        rows = {}
        for line in self.export(self.out).out.splitlines()[1:]:
            name, count, _ = line.split(None, 2)
            rows[name] = int(count)
        self.assertGreater(rows["poses"], 20)
        for name, count in rows.items():
            table = self.folder / f"{name}.csv"
            self.export(self.out, name, "-o", table)
            with open(table, newline="") as file:
                head, *body = csv.reader(file)
            self.assertEqual(len(body), count, name)
            columns = [c for c, in self.query(f"SELECT name FROM pragma_table_info('{name}')")]
            self.assertEqual(head, columns)
        with open(self.folder / "poses.csv", newline="") as file:
            head, *body = csv.reader(file)
        self.assertEqual(head, ["agent", "at_ns", "x_m", "y_m", "theta_rad"])
        self.assertEqual([tuple(map(float, row)) for row in body], self.query("SELECT * FROM poses"))
        self.assertEqual(self.export(self.out, "poses").out,
                         (self.folder / "poses.csv").read_text())

    def test_the_page_of_the_results_is_what_the_program_says(self):
        self.assertEqual(self.export("--describe").out, (ROOT / "docs/results.md").read_text())

    def test_what_is_wrong_is_named_and_no_file_is_replaced(self):
        self.run_baraka(TWO_MOTES, *IN_PROCESS)
        kept = self.folder / "kept.csv"
        kept.write_text("mine")
        self.assertIn("'pose' is not a table of a result; did you mean 'poses'?; there are: run, settings, ",
                      self.export(self.out, "pose", "-o", kept, status=2).err)
        self.assertIn("nowhere", self.export(self.folder / "nowhere", "poses", "-o", kept, status=2).err)
        self.export(status=2)
        with contextlib.closing(sqlite3.connect(self.out / "run.sqlite")) as database:
            database.execute("PRAGMA user_version = 3")
        for command in (["export", self.out, "poses", "-o", kept], ["report", self.out]):
            finished = Program("baraka", *command).finish()
            self.assertEqual(finished.status, 1, str(finished))
            self.assertRegex(finished.err, r"run1: run.sqlite has tables of version 3, and this "
                                           r"baraka reads version \d+ only")
        self.assertEqual(kept.read_text(), "mine")


class Help(unittest.TestCase):
    def test_of_every_command_shows_words_for_people(self):
        """CLI11 would show what a flag or a word means inside: '--no-inspect{false}', 'ENUM:value in {time->2}'."""
        commands = re.findall(r"^  ([a-z-]+) ", Program("baraka", "--help").finish().out.partition("Subcommands:")[2], re.M)
        self.assertGreaterEqual(len(commands), 10)
        for words in [[]] + [[command] for command in commands] + [["topic", "list"], ["topic", "echo"]]:
            self.assertNotRegex(Program("baraka", *words, "--help").finish().out, r"[{}]|->|ENUM")
        self.assertNotRegex(Program("baraka-agentd", "--help").finish().out, r"[{}]|->|ENUM")

    def test_list_names_everything_that_is_shipped_with_a_sentence(self):
        said = Program("baraka", "list").finish()
        self.assertEqual((said.status, said.err), (0, ""))
        for folder in "scenarios", "campaigns", "robots", "radios", "hardware":
            of_kind = Program("baraka", "list", folder).finish().out
            self.assertIn(of_kind, said.out)
            listed = set(re.findall(r"^  (\S+)  +\S", of_kind, re.M))
            self.assertEqual(listed, {path.stem for path in (ROOT / "config" / folder).glob("*.yaml")})
        self.assertRegex(Program("baraka", "list", "controllers").finish().out, r"  wanderer +for robots; parameters: speed\n")

    def test_list_goes_on_behind_a_plugin_that_is_broken(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "broken.so").write_bytes(b"no ELF")
            said = Program("baraka", "list", "controllers", env={"BARAKA_CONTROLLER_PATH": folder}).finish()
            self.assertEqual(said.status, 0)
            self.assertRegex(said.out, r"  broken +\S+broken.so cannot be loaded: ")
            self.assertRegex(said.out, r"  wanderer +for robots")

    def test_list_tells_of_links_and_folders_that_lead_nowhere(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "vanished.so").symlink_to("/nowhere/vanished.so")
            environment = {"BARAKA_CONTROLLER_PATH": f"/nowhere:{folder}:/nowhere"}
            said = Program("baraka", "list", "controllers", env=environment).finish()
            self.assertEqual((said.status, said.err),
                             (0, "warning: BARAKA_CONTROLLER_PATH: there is no folder /nowhere\n"))
            self.assertRegex(said.out, r"  vanished +a link to /nowhere/vanished.so, which is not there\n")
            self.assertRegex(said.out, r"  wanderer +for robots")
            said = Program("baraka", "check", CASE_STUDY, "--set", "agents.motes.controller.program=vanished",
                           "--set", "agents.robots.controller.program=wandrer", env=environment).finish()
            self.assertEqual(said.status, 2, str(said))
            self.assertEqual(said.err.count("warning: BARAKA_CONTROLLER_PATH: there is no folder /nowhere\n"), 1, said.err)
            first, second = said.err.splitlines()[1:]
            self.assertRegex(first, r"program: 'vanished' is not a known controller: looked for vanished.so in .*"
                                    r"vanished.so is a link to a file that is not there$")
            self.assertRegex(second, r"program: 'wandrer' is not a known controller: looked .*; did you mean 'wanderer'\?$")
            self.assertNotIn("no controller '", said.err)

    def test_list_names_what_is_no_controller_only_where_the_user_put_it(self):
        """The folder of the program may be /usr/bin, which has an ld.so."""
        with tempfile.TemporaryDirectory() as folder:
            own, given = pathlib.Path(folder) / "own", pathlib.Path(folder) / "given"
            for place in own, given:
                place.mkdir()
                shutil.copy(BIN / "../tests/mute.so", place)
            shutil.copy(BIN / "wanderer.so", own)
            (own / "gone.so").symlink_to("/nowhere/gone.so")
            program = shutil.copy(BIN / "baraka", own)
            alone = Program(program, "list", "controllers", env={"BARAKA_CONTROLLER_PATH": ""}).finish()
            self.assertEqual((alone.status, alone.err), (0, ""))
            self.assertRegex(alone.out, rf"^controllers, in {own}:\n  wanderer .*\n$")
            both = Program(program, "list", "controllers", env={"BARAKA_CONTROLLER_PATH": given}).finish()
            self.assertRegex(both.out, rf"^controllers, in {given}:\n  mute +\S+/given/mute.so is no controller: .*\n"
                                       rf"controllers, in {own}:\n  wanderer .*\n$")

    def test_a_folder_that_is_not_there_is_not_made_for_a_project(self):
        with tempfile.TemporaryDirectory() as folder:
            finished = Program("baraka", "new-controller", "x", "--to", pathlib.Path(folder) / "a/b").finish()
            self.assertEqual(finished.status, 2)
            self.assertIn("a/b: there is no such folder; make it first", finished.err)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])

    def test_results_that_cannot_be_written_name_their_folder(self):
        finished = Program("baraka", "run", TWO_MOTES, *IN_PROCESS, "--out", "/proc/foo").finish()
        self.assertEqual(finished.status, 1)
        self.assertIn("error: /proc/foo: no results can be written in /proc: ", finished.err)


class Wanderer(Case):
    def test_the_controller_of_the_book_stays_off_the_walls(self):
        self.run_baraka(ROOT / "config/scenarios/wanderer.yaml")
        (path, contacts), = self.query("SELECT path_m, wall_steps FROM bodies")
        self.assertGreater(path, 5)
        self.assertEqual(contacts, 0)

    def test_the_book_shows_it_as_it_is(self):
        source = (ROOT / "controllers/wanderer/wanderer.cpp").read_text()
        self.assertIn(source.strip(), (ROOT / "docs/controllers.md").read_text())


if __name__ == "__main__":
    unittest.main()
