#!/usr/bin/env python3
"""Controllers inside their agents' networks in lock-step: equal in equal runs, with their own traffic on the air; what they wait
for takes simulated time; they die, hang and end as elsewhere."""
import re
import subprocess
import sys
import time
import unittest

import wire
from baraka import ROOT, Case, send, wait_for
from remains import Mark

REFUSED = wire.why_not()
TELEOP = ROOT / "config/scenarios/teleop_behind_a_wall.yaml"
FAULTY = ROOT / "tests/e2e/faulty.yaml"
INSIDE = ["--no-inspect", "--set", "agents.robots.network={}", "--set", "agents.robots.controller.inside=true"]
ROBOT = "agents.robots.controller"
GONE_WITHIN = 20  # s after the end of a run

SOURCE_AND_SINK = """version: 1
name: inside
seed: 1
routing: none
radio: {{include: {root}/config/radios/ieee80211g.yaml}}
agents:
  sources:
    name: s{{}}
    station: {{}}
    line: {{count: 3, spacing: 5 m}}
    network: {{}}
    controller: {{program: traffic_source, inside: {inside}, parameters: {{topic: t, to: sink, rate: 40 Hz}}}}
  sink:
    name: sink
    station: {{}}
    poses: [{{x: 5 m, y: 5 m}}]
    network: {{}}
    controller: {{program: traffic_sink, inside: {inside}, parameters: {{topic: t}}}}
end: [{{at: 5 s, result: done}}]
"""


def digests(finished):
    return finished["fingerprint"], finished["frames_digest"]


class BusyLoops:
    def __enter__(self):
        self.loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(4)]

    def __exit__(self, *_):
        for loop in self.loops:
            loop.kill()
            loop.wait()


@unittest.skipIf(REFUSED, REFUSED)
class OwnTraffic(Case):
    """ros_operator drives ros_base: both speak ROS 2 by Fast DDS over the air."""

    def drive(self, *arguments):
        return self.run_baraka(TELEOP, "--no-inspect", "--set", "world.walls=[]", "--set", "end.0.at=4 s", *arguments, timeout=600)

    def test_equal_runs_are_equal_also_on_a_busy_machine_and_when_repeated(self):
        first = self.drive()
        states = [state for (state,) in self.query("SELECT state FROM states JOIN agents USING (agent) WHERE name = 'robot'")]
        self.assertEqual(states, ["waiting", "driving"])
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'pace'"), [("lockstep",)])
        self.assertEqual(first["program_unknown_waits"], "0")
        record = self.out
        with BusyLoops():
            self.assertEqual(digests(self.drive()), digests(first))
        self.assertEqual(digests(self.drive("--repeat", record)), digests(first))
        self.assertNotEqual(self.drive("--seed", 2)["frames_digest"], first["frames_digest"])

    def test_packets_leave_at_the_time_of_the_event_that_is_handled(self):
        self.drive()
        ((phase,),) = self.query("SELECT MIN(at_ns) FROM arrivals WHERE door = 'controller of robot'")
        answers = [at for (at,) in self.query("SELECT at_ns FROM arrivals WHERE door = 'controller of robot' ORDER BY at_ns")]
        cycles = answers[:-1]  # the last is at the end of the run
        self.assertEqual({(at - phase) % 100_000_000 for at in cycles}, {0}, "its control cycles")
        sent = {at for (at,) in self.query("SELECT at_ns FROM arrivals WHERE door = 'air of robot'")}
        self.assertGreater(len(sent & set(cycles)), 0.8 * len(set(cycles)), "odometry and transforms")

    def test_they_answer_where_turns_cost_time_too(self):
        """Before the run and at its end no time passes."""
        costly = ["--set", "agents.robot.network.cpu={per_wake: 20 us}"]
        first = self.drive(*costly)
        states = [state for (state,) in self.query("SELECT state FROM states JOIN agents USING (agent) WHERE name = 'robot'")]
        self.assertEqual(states, ["waiting", "driving"])
        self.assertNotIn("at the stop", (self.out / "run.log").read_text(encoding="utf-8"))
        self.assertEqual(digests(self.drive(*costly)), digests(first))

    def kill(self, after):
        """@param after  s, from when there is a controller."""
        mark = Mark()
        run = self.start(TELEOP, "--no-inspect", "--set", "end.0.at=10 h", env=mark.variables)

        def controllers():
            mark.look()
            return [pid for pid in mark.processes() if name_of(pid) == "ros_base"]
        (controller,) = wait_for(controllers)
        time.sleep(after)
        mark.look()
        send(controller, "SIGKILL")
        finished = run.finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertRegex(finished.err, rf"(process 'robot' \(pid {controller}\) died: .* \(agents robot\)|ros_base killed by signal 9)")
        self.assertEqual(mark.remains_after(GONE_WITHIN), [])

    def test_a_kill_ends_the_run_and_leaves_nothing(self):
        for after in (0, 0.3, 2):  # it begins, its run does, and goes on
            with self.subTest(after):
                self.kill(after)


def name_of(pid):
    try:
        with open(f"/proc/{pid}/comm", encoding="utf-8") as comm:
            return comm.read().strip()
    except OSError:
        return ""


@unittest.skipIf(REFUSED, REFUSED)
class Same(Case):
    def run_of(self, inside, *arguments):
        file = self.folder / "inside.yaml"
        file.write_text(SOURCE_AND_SINK.format(root=ROOT, inside=inside), encoding="utf-8")
        return self.run_baraka(file, "--no-inspect", *arguments)

    def test_those_without_traffic_of_their_own_give_the_fingerprint_of_those_elsewhere(self):
        at_once = ["--set", "controller_latency=0 s"]
        in_process = digests(self.run_of("false", "--controllers", "in-process", *at_once))
        self.assertGreater(self.query("SELECT COUNT(*) FROM messages WHERE fate = 'handed over'")[0][0], 100)
        self.assertEqual(digests(self.run_of("true", *at_once)), in_process)
        self.assertEqual(digests(self.run_of("false", *at_once)), in_process, "over DDS")

    def test_with_a_latency_they_cause_the_same_frames(self):
        messages = "SELECT * FROM messages ORDER BY sender, id"
        frames = self.run_of("false", "--controllers", "in-process")["frames_digest"]
        sent = self.query(messages)
        self.assertEqual(self.run_of("true")["frames_digest"], frames)
        self.assertEqual(self.query(messages), sent)


@unittest.skipIf(REFUSED, REFUSED)
class Faults(Case):
    def fail(self, fault, *arguments, status=1):  # pylint: disable=arguments-differ
        return self.run_baraka(FAULTY, *INSIDE, "--set", f"{ROBOT}.parameters.{fault}=1 s", *arguments, status=status)

    def states(self):
        return self.query("SELECT at_ns, state FROM states ORDER BY at_ns")

    def test_what_ends_a_controller_is_said_as_in_real_time(self):
        for fault in ("throw_at", "exit_at", "leave_at", "abort_at"):
            with self.subTest(fault):
                said = [re.findall(r"error: .*", self.fail(fault, *pace).err) for pace in ([], ["--pace", "realtime"])]
                held, real = ([re.sub(r"pid \d+|1\.\d{9} s", "", line) for line in lines] for lines in said)
                self.assertEqual(held, real)

    def test_one_that_fails_does_so_at_the_same_time_in_each_run(self):
        first = self.fail("abort_at")
        self.assertIn("at 1.000000000 s", first.err)
        self.assertEqual(digests(self.fail("abort_at")), digests(first))

    def test_waiting_takes_simulated_time(self):
        finished = self.fail("nap_at", status=0)
        self.assertEqual(self.states(), [(1_250_000_000, "awake")])
        self.assertIn("control cycles missed: 1\n", (self.out / "run.log").read_text(encoding="utf-8"))
        record = self.out
        repeated = self.fail("nap_at", "--repeat", record, status=0)
        self.assertEqual(digests(repeated), digests(finished))
        self.assertEqual(self.states(), [(1_250_000_000, "awake")])

    def test_one_that_waits_for_too_long_is_a_timeout_of_simulated_time(self):
        finished = self.fail("hang_at", "--set", "end.0.at=20 s")
        self.assertRegex(finished.err, r"process '\w+' \(pid \d+\) did not answer within 10 s of simulated time: .*at 11\.\d+ s")

    def test_one_that_computes_for_too_long_is_a_timeout(self):
        finished = self.fail("spin_at", "--set", "reply_timeout=1 s")
        self.assertRegex(finished.err, r"process '\w+' \(pid \d+\) did not answer within 1 s while it computed: .*at 1\.0+ s")

    def test_the_run_goes_on_without_it_if_it_is_to(self):
        for fault, more in (("abort_at", []), ("hang_at", ["--set", "reply_timeout=1 s"]), ("spin_at", ["--set", "reply_timeout=1 s"])):
            with self.subTest(fault):
                finished = self.fail(fault, "--set", "on_death=silence", *more, status=0)
                self.assertEqual(finished["result"], "done")
                self.assertIn("they fall silent", (self.out / "run.log").read_text(encoding="utf-8"))

    def test_an_interrupt_ends_a_run_whose_controller_computes(self):
        run = self.start(FAULTY, *INSIDE, "--set", f"{ROBOT}.parameters.spin_at=1 s", "--set", "reply_timeout=none")
        log = self.out / "run.log"
        wait_for(lambda: log.exists() and "has run for 4 s without waiting" in log.read_text(encoding="utf-8"))
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish().status, 130)


if __name__ == "__main__":
    unittest.main()
