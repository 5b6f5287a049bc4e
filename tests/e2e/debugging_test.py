#!/usr/bin/env python3
"""What helps those who debug a controller: who is waited for and for how long, what is logged, and the end of
controllers that hang, call exit() or say what would confuse a terminal."""
import re
import time
import unittest

from baraka import BIN, CASE_STUDY, ROOT, Case, Program, children, send, some_domain, wait_for

FAULTY = ROOT / "tests/e2e/faulty.yaml"
TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
IN_PROCESS = ["--controllers", "in-process"]
NEVER = ["--set", "reply_timeout=none"]


def at(fault, when="2 s"):
    return ["--set", f"agents.robots.controller.parameters.{fault}={when}"]


class Exits(Case):
    def test_a_controller_that_calls_exit_fails_the_run_and_is_named(self):
        for mode in (IN_PROCESS, []):
            for fault, what in (("exit_at", r"called exit\(0\) in step\(\)"),
                                ("leave_at", r"called _exit\(0\) in step\(\)"),
                                ("quick_exit_at", r"called quick_exit\(0\) in step\(\)")):
                with self.subTest(mode=mode, fault=fault):
                    begin = time.monotonic()
                    finished = self.run_baraka(FAULTY, *mode, *at(fault), *NEVER, status=1)
                    self.assertLess(time.monotonic() - begin, 60, "nobody waits for an answer")
                    self.assertRegex(finished.err, rf"error: .*controller of r0.*{what}")
                    self.assertRegex(finished.err, r"at 2\.000000000 s")
                    self.assertEqual(finished["result"], "failed")
                    self.assertEqual(self.query("SELECT value FROM run WHERE key = 'result'"), [("failed",)])
                    self.assertGreater(self.query("SELECT count(*) FROM poses")[0][0], 0, "results are kept")

    def test_exit_on_a_thread_of_a_controller_is_no_good_end_either(self):
        finished = self.run_baraka(FAULTY, *IN_PROCESS, *at("thread_exit_at"), status=1)
        self.assertRegex(finished.err, r"error: .*controller.*called exit\(0\)")
        self.assertEqual(finished["result"], "failed")
        finished = self.run_baraka(FAULTY, *at("thread_exit_at"), *NEVER, status=1)
        self.assertRegex(finished.err, r"error: .*r0.*at 2\.000000000 s")


class Faults(Case):
    """A controller that a signal ends: a null pointer, an exception that nobody catches."""

    FAULTS = (("null_at", 11, r"controller of r0: SIGSEGV \(Segmentation fault\) at address 0x0 in step\(\)"),
              ("overflow_at", 11, r"controller of r0: SIGSEGV \(Segmentation fault\) at address 0x[0-9a-f]+ in step\(\)"),
              ("abort_at", 6, r"controller of r0: SIGABRT \(Aborted\) in step\(\)"),
              ("raise_at", 10, r"controller of r0: SIGUSR1 \(User defined signal 1\) in step\(\)"),
              ("thread_throw_at", 6, r"uncaught exception std::runtime_error: \\x1b\[2Jthe antenna has come off "
                                     r"on another thread during step\(\) of controller of r0"),
              ("thread_null_at", 11, r"SIGSEGV .* on another thread during step\(\) of controller of r0"))

    def assert_failed(self, finished):
        self.assertEqual(finished["result"], "failed")
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'result'"), [("failed",)])
        self.assertGreater(self.query("SELECT count(*) FROM poses")[0][0], 0, "results are kept")

    def test_in_process_it_is_named_with_its_call_and_results_are_kept(self):
        for fault, signal, what in self.FAULTS:
            with self.subTest(fault=fault):
                finished = self.run_baraka(FAULTY, *IN_PROCESS, *at(fault), status=-signal)
                self.assertRegex(finished.err, rf"error: {what} at 2\.000000000 s\n")
                self.assert_failed(finished)

    def test_a_process_says_so_in_its_log_and_the_run_repeats_it(self):
        for fault, signal, what in self.FAULTS:
            with self.subTest(fault=fault):
                finished = self.run_baraka(FAULTY, *at(fault), *NEVER, status=1)
                self.assertRegex(finished.err, rf"error: process 'robots' .*killed by signal {signal} \(agents r0\)")
                self.assertRegex(finished.err, rf"warning: faulty .*: robots: {what} at 2\.0+ s; see .*robots\.log")
                self.assert_failed(finished)


class Stuck(Case):
    """A controller that does not return."""

    def interrupted(self, signal, *arguments):
        program = self.start(FAULTY, *arguments, *at("hang_at"), *NEVER)
        wait_for(lambda: (self.out / "run.log").exists())
        time.sleep(1)  # until it hangs
        send(program.process.pid, signal)
        finished = program.finish(timeout=60)
        self.assertEqual(finished.status, 130, str(finished))
        self.assertEqual(finished["result"], "interrupted")
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'result'"), [("interrupted",)])
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'fingerprint'"),
                         [(finished["fingerprint"],)])
        return finished

    def test_one_signal_ends_a_run_whose_callback_does_not_return(self):
        for signal in ("SIGTERM", "SIGINT", "SIGHUP"):
            with self.subTest(signal=signal):
                finished = self.interrupted(signal, *IN_PROCESS)
                self.assertRegex(finished.err, r"step\(\) of controller of r0, called at 2\.000000000 s")

    def test_one_signal_ends_a_run_that_waits_for_ever_for_a_process(self):
        finished = self.interrupted("SIGTERM")
        self.assertRegex(finished.err, r"the answer of process 'robots'")

    def test_no_answer_within_the_reply_timeout_names_the_key_to_change(self):
        finished = self.run_baraka(FAULTY, *at("hang_at"), "--set", "reply_timeout=500 ms", status=1)
        self.assertRegex(finished.err, r"did not answer within 0.5 s: .*reply_timeout=none")


class External(Case):
    def served(self, *arguments):
        program = self.start(CASE_STUDY, "--controllers", "external", "--until", "3", "--domain",
                             some_domain(self), *arguments)
        self.lines = []
        return program

    def read_until(self, program, pattern):
        """The next line of standard error that fits; those before are in self.lines."""
        for line in program.process.stderr:
            self.lines.append(line.rstrip())
            if re.search(pattern, line):
                return line.rstrip()
        raise AssertionError(f"no {pattern} in {self.lines}")

    def test_it_says_at_once_and_again_what_to_type_and_that_works(self):
        program = self.served()
        self.read_until(program, "^waiting for controllers of 26 agents")
        motes, robot = (self.read_until(program, name).split() for name in ("help_mote", "help_robot"))
        self.assertEqual(motes[-2:], ["--agents", "'m*'"])
        motes[-1] = "m*"

        typed = Program(BIN / motes[0], *motes[1:])
        self.addCleanup(typed.clean_up)
        self.read_until(program, "still waiting for controllers of 1 agent,")
        self.assertEqual(self.read_until(program, "help_").split(), robot, "the motes are there")
        typed = Program(BIN / robot[0], *robot[1:])
        self.addCleanup(typed.clean_up)
        finished = program.finish()
        self.assertEqual(finished.status, 0, str(finished))

    def test_ctrl_c_while_it_waits_is_an_interruption(self):
        for signal in ("SIGINT", "SIGTERM", "SIGHUP"):
            program = self.served()
            self.read_until(program, "waiting for controllers")
            send(program.process.pid, signal)
            finished = program.finish()
            self.assertEqual(finished.status, 130, str(finished))

    def test_a_refusal_is_said_once(self):
        program = self.served("--set", "wait=5 s")
        self.read_until(program, "help_robot")
        refused = Program(*re.sub("'", "", self.lines[-2]).split(), "--agents", "x7", "--name", "stranger").finish()
        self.assertEqual(refused.status, 2, str(refused))
        self.assertEqual(refused.err.count("unknown agent 'x7'"), 1, refused.err)
        finished = program.finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertEqual(finished.err.count("unknown agent 'x7'"), 1, str(finished))


class Logs(Case):
    def log(self):
        return (self.out / "run.log").read_text()

    def test_the_level_decides_what_is_logged(self):
        arguments = [CASE_STUDY, "--until", "15"]
        usual = self.run_baraka(*arguments)
        self.assertNotIn(" debug ", self.log())
        detailed = self.run_baraka(*arguments, "--log", "debug")
        for pattern in (r"debug gateway: session: process 'motes' \(pid \d+ on .*, program help_mote\) drives m0, m1",
                        r"debug exchange: Step 1 to robots: 2 events until 0\.000000000 s, answered with \d+ actions",
                        r"debug \w+: discovery of \d+ for 'help': found after \d\.\d+ s",
                        r"debug r0: state \w+"):
            self.assertRegex(self.log(), pattern)
        self.assertEqual(detailed["fingerprint"], usual["fingerprint"])
        self.run_baraka(FAULTY, *IN_PROCESS, *at("nan_at"), "--log", "error")
        self.assertEqual(self.log(), "")

    def test_a_controller_process_tells_of_its_session_and_its_steps(self):
        domain = some_domain(self)
        program = self.start(TWO_MOTES, "--controllers", "external", "--domain", domain, "--until", "1")
        motes = Program("help_mote", "--domain", domain, "--agents", "m*", "--log", "debug").finish()
        self.assertEqual(program.finish().status, 0)
        self.assertRegex(motes.err, r"session with server '.*', run 1: m0, m1")
        self.assertRegex(motes.err, r"Step 1: \d+ events until \d\.\d+ s, \d+ actions")

    def test_a_mistake_in_every_cycle_is_told_once_and_counted(self):
        for mode in (IN_PROCESS, []):
            with self.subTest(mode=mode):
                finished = self.run_baraka(FAULTY, *mode, *at("nan_from", "1 s"))
                lines = [line for line in self.log().splitlines() if "omega is nan" in line]
                # 90 cycles: the first, the tenth, and how many there were.
                self.assertEqual(len(lines), 3, lines)
                self.assertNotIn("times", lines[0])
                self.assertRegex(lines[1], r"\(10 times by now\)$")
                self.assertRegex(lines[2], r": 90 times in all$")
                self.assertEqual(finished.err.count("omega is nan"), 3, finished.err)

    def test_escape_sequences_of_controllers_reach_neither_terminal_nor_log(self):
        for mode in (IN_PROCESS, []):
            with self.subTest(mode=mode):
                shouted = self.run_baraka(FAULTY, *mode, *at("shout_at"), "--log", "debug")
                self.assertIn("\\x1b[2Jshouted\\n[   0.000000000] error r1: forged", shouted.err)
                self.assertIn("state \\x1b]0;LOUD\\x07", self.log())
                thrown = self.run_baraka(FAULTY, *mode, *at("throw_loudly_at"), status=1)
                self.assertIn("\\x1b[2Jthe wheels are green", thrown.err)
                for text in (shouted.err, shouted.out, thrown.err, thrown.out, self.log()):
                    self.assertNotIn("\033", text)
                    self.assertNotIn("\nerror r1", text)

    def test_nor_do_names_of_processes(self):
        domain = some_domain(self)
        program = self.start(TWO_MOTES, "--controllers", "external", "--domain", domain, "--set", "wait=4 s")
        name = "evil\033[2J"
        refused = Program("help_mote", "--domain", domain, "--agents", "x9", "--name", name).finish()
        finished = program.finish()
        self.assertEqual((refused.status, finished.status), (2, 1), f"{refused}\n{finished}")
        self.assertIn("evil\\x1b[2J", finished.err)
        self.assertIn("evil\\x1b[2J", refused.err)
        self.assertNotIn("\033", finished.err + refused.err)


class Domains(Case):
    def test_runs_side_by_side_have_domains_of_a_range_or_from_one_upwards(self):
        many = ["--replications", "4", "--jobs", "2", "--until", "1"]
        for domains in ("31", "31-33"):
            self.run_baraka(TWO_MOTES, *many, "--domain", domains)
            used = {re.search(r"^domain: (\d+)$", log.read_text(), re.M).group(1)
                    for log in self.out.glob("replication-*.log")}
            self.assertLessEqual(used, {"31", "32", "33"})
            self.assertEqual(len(used), 2, "two at a time")

    def test_too_few_of_them_are_a_mistake(self):
        for arguments, what in ((["--jobs", "3", "--domain", "31-32"], "31-32 has 2 domains, --jobs 3 needs one each"),
                                (["--jobs", "3", "--domain", "231"], "--jobs 3 needs the domains 231 to 233")):
            finished = self.run_baraka(TWO_MOTES, "--replications", "3", *arguments, status=2)
            self.assertIn(what, finished.err)
        self.assertIn("a range is for", self.run_baraka(TWO_MOTES, "--domain", "31-32", status=2).err)


if __name__ == "__main__":
    unittest.main()
