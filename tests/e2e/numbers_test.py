#!/usr/bin/env python3
"""Numbers on command lines: finite, in range, or refused with a message and status 2."""
import contextlib
import shutil
import sqlite3
import unittest

from baraka import CASE_STUDY, ROOT, Case, Program

FAULTY = ROOT / "tests/e2e/faulty.yaml"
NONSENSE = ["nan", "inf", "-inf", "-1", "1e300", "-1e300", "", " ", "1e999", "0x", "1,5", "١", "3 apples",
            "99999999999999999999999"]
MANY = ["--replications", "2"]
# Program, arguments before the option, option, what else it must not take.
OPTIONS = [
    ("baraka", ["run", FAULTY], "--until", ["1e10", "5 kg"]),
    ("baraka", ["run", FAULTY], "--seed", ["1.5", "9223372036854775808"]),
    ("baraka", ["run", FAULTY], "--max-speed", ["0"]),
    ("baraka", ["run", FAULTY], "--domain", ["233", "1.5", "5-", "-5", "7-5", "1-233"]),
    ("baraka", ["run", FAULTY], "--inspect-domain", ["233", "1.5"]),
    ("baraka", ["run", FAULTY], "--replications", ["0", "1.5", "1000001"]),
    ("baraka", ["run", FAULTY, *MANY], "--jobs", ["0", "1.5", "1001"]),
    ("baraka", ["topic", "echo", "clock"], "--timeout", ["0", "1e10"]),
    ("baraka", ["topic", "hz", "clock"], "--count", ["0", "1.5"]),
    ("baraka", ["topic", "list"], "--domain", ["233"]),
    ("baraka-agentd", ["nowhere.yaml"], "--domain", ["233"]),
    ("baraka-agentd", ["nowhere.yaml"], "--inspect-domain", ["233"]),
    ("help_mote", ["--agents", "m0"], "--domain", ["233", "1.5"]),
    ("help_mote", ["--agents", "m0"], "--wait", ["1e10", "5 kg"]),
]


class Numbers(Case):
    def refuses(self, program, arguments, message):
        finished = Program(program, *arguments).finish(timeout=30)
        self.assertEqual(finished.status, 2, str(finished))
        self.assertIn(message, finished.err)
        self.assertNotIn("\n\n", finished.err, "one message, no help text")

    def test_nonsense_is_refused_by_every_option_that_takes_a_number(self):
        for program, before, option, others in OPTIONS:
            for value in NONSENSE + others:
                with self.subTest(program=program, option=option, value=value):
                    self.refuses(program, [*before, f"{option}={value}"] if value.startswith("-")
                                 else [*before, option, value], option)

    def test_no_factor_of_real_time_is_nonsense(self):
        for value in [*NONSENSE, "0", "1e6"]:
            with self.subTest(value=value):
                self.refuses("baraka", ["run", FAULTY, "--pace", f"realtime:{value}"], "--pace")

    def test_times_take_a_unit_and_are_in_seconds_without(self):
        for until in ("2", "2 s", "2000 ms", "2e9 ns"):
            finished = self.run_baraka(FAULTY, "--controllers", "in-process", "--until", until)
            self.assertEqual(finished["simulated_s"], "2.000000000", until)

    def test_a_run_until_its_start_takes_no_time(self):
        finished = self.run_baraka(FAULTY, "--controllers", "in-process", "--until", "0")
        self.assertLess(float(finished["wall_s"]), 60, "counted from the run's start")

    def test_an_option_that_is_given_nothing_is_a_mistake(self):
        for program, arguments, option in (
                ("baraka", ["run", FAULTY, "--repeat", ""], "--repeat"),
                ("baraka", ["run", FAULTY, "--out", ""], "--out"),
                ("baraka", ["run", FAULTY, "--seed", ""], "--seed"),
                ("baraka", ["run", FAULTY, "--pace", ""], "--pace"),
                ("baraka", ["run", FAULTY, "--set", ""], "--set"),
                ("baraka", ["run", ""], "SCENARIO"),
                ("baraka", ["report", "-o", "", self.folder], "-o"),
                ("baraka", ["report", ""], "DIR"),
                ("baraka", ["new-controller", "x", "--to", ""], "--to"),
                ("baraka-agentd", ["nowhere.yaml", "--name", ""], "--name"),
                ("baraka-agentd", ["nowhere.yaml", "--inspect-address", ""], "--inspect-address"),
                ("help_mote", ["--agents", ""], "--agents"),
                ("help_mote", ["--agents", "m0", "--name", ""], "--name")):
            with self.subTest(program=program, option=option):
                self.refuses(program, arguments, option)

    def test_a_bad_domain_in_the_environment_is_a_mistake_of_the_command_line(self):
        for value in ("x", "-1", "233", "1.5", "\033[2J"):
            for program, arguments in (("baraka", ["topic", "list"]),
                                       ("baraka", ["run", CASE_STUDY, "--controllers", "external", "--out",
                                                   self.folder / "out"]),
                                       ("help_mote", ["--agents", "m0"])):
                with self.subTest(program=program, value=value):
                    finished = Program(program, *arguments, env={"BARAKA_DOMAIN": value}).finish()
                    self.assertEqual(finished.status, 2, str(finished))
                    self.assertIn("BARAKA_DOMAIN", finished.err)
                    self.assertNotIn("\033", finished.err)


class ForgedRecord(Case):
    """The turns of a run in real time, changed by somebody."""

    def test_times_that_no_run_can_have_are_refused(self):
        self.run_baraka(CASE_STUDY, "--pace", "realtime:20", "--until", "4")
        record = self.out
        for sql, what in (("UPDATE turns SET at_ns = -5 WHERE rowid = 3", "table turns, row 3: at_ns is -5, not a whole number from 0 to"),
                          ("UPDATE turns SET at_ns = 9223372036854775807 WHERE rowid = 4",
                           "table turns, row 4: at_ns is 9223372036854775807, not a whole number from 0 to"),
                          ("UPDATE turns SET at_ns = 0 WHERE rowid = 5", "table turns, row 5: at_ns is 0, before "),
                          ("UPDATE run SET value = '-1' WHERE key = 'ended_ns'", "table run, row ended_ns: value is '-1', not a number"),
                          ("UPDATE run SET value = 'soon' WHERE key = 'ended_ns'", "table run, row ended_ns: value is 'soon', not a number")):
            with self.subTest(sql=sql):
                forged = shutil.copytree(record, self.folder / "forged", dirs_exist_ok=True)
                with contextlib.closing(sqlite3.connect(forged / "run.sqlite")) as database, database:
                    self.assertEqual(database.execute(sql).rowcount, 1)
                refused = self.run_baraka(CASE_STUDY, "--repeat", forged, "--controllers", "in-process",
                                          status=1)
                self.assertIn(what, refused.err)


if __name__ == "__main__":
    unittest.main()
