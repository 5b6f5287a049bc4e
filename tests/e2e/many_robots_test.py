#!/usr/bin/env python3
"""Several robots at once: two in the case study, twelve in many_robots.yaml, and broadcasts that meet.
Run with --all it plays all, one process at a time, and prints the tables: 80
runs of two robots, and 40 hours of twelve (half an hour of a processor)."""
import statistics
import sys
import unittest

from baraka import BIN, CASE_STUDY, ROOT, Case

MANY_ROBOTS = ROOT / "config/scenarios/many_robots.yaml"
SHOUTER = ROOT / "tests/e2e/shouter.yaml"
PHASES = ("aligned", "uniform")
IN_PROCESS = ("--controllers", "in-process")
SIDE_BY_SIDE = """version: 1
name: side_by_side
seed: 1
control_phase: aligned
controller_latency: 0 s
radio: {{profile: mobility_framework}}
agents:
  motes:
    name: m{{}}
    mote: {{include: {mote}}}
    poses: [{{x: 0 m, y: 0 m}}, {{x: 1 m, y: 0 m}}, {{x: 100 m, y: 0 m}}]
    controller:
      program: help_mote
      parameters: {{repeat_jitter: {jitter}}}
      overrides:
        - {{agents: m0, parameters: {{help_at: 1 s}}}}
        - {{agents: m1, parameters: {{help_at: 1 s}}}}
end:
  - {{at: 130 s, result: done}}
"""
is_complete = "--all" in sys.argv


def phase(name):
    return ("--set", f"control_phase={name}")


class Call:
    """A mote's call for help, from the REQUEST that begins it to FULFILLED or GAVE_UP."""

    def __init__(self, mote, began):
        self.mote, self.began, self.granted, self.ended, self.end = mote, began, None, None, None

    def took(self):
        return self.ended - self.began


class Hours(Case):
    def calls(self):
        """All calls of the last run, by mote and time [s]."""
        found, current = [], {}
        for mote, at, state in self.query(
                "SELECT agent, at_ns / 1e9, state FROM states JOIN agents USING (agent)"
                " WHERE kind = 'mote' ORDER BY agent, at_ns, states.rowid"):
            if state == "REQUEST" and mote not in current:
                found.append(current.setdefault(mote, Call(mote, at)))
            elif mote in current and state == "WAIT":
                current[mote].granted = current[mote].granted or at
            elif mote in current and state in ("FULFILLED", "GAVE_UP"):
                call = current.pop(mote)
                call.ended, call.end = at, state
        return found

    def check_under_way(self, call, ended):
        """A call without an end is not forgotten: its mote still waits as its rules say, for at most 300 s
        since it last heard from the robot in charge, or 30 s since it last called."""
        (last,), = self.query(f"SELECT max(at_ns) / 1e9 FROM deliveries WHERE receiver = {call.mote}")
        (called,), = self.query(f"SELECT max(sent_ns) / 1e9 FROM messages WHERE sender = {call.mote}")
        self.assertLess(ended - max(last, called), 301, f"mote {call.mote}")

    def messages(self):
        """Delivered, and all, to one agent, but for the last 20 s."""
        return self.query(
            "SELECT sum(verdict IS 'delivered'), count(*) FROM messages WHERE destination != 65535 AND"
            " sent_ns < (SELECT value FROM run WHERE key = 'ended_ns') - 20e9")[0]


class ManyRobots(Hours):
    def test_the_calls_of_ten_minutes_are_taken_up(self):
        for name, seed in (("aligned", 1), ("uniform", 2)):
            with self.subTest(phase=name, seed=seed):
                finished = self.run_baraka(MANY_ROBOTS, "--seed", seed, "--until", 600, *phase(name), *IN_PROCESS)
                self.assertEqual(finished["result"], "until")
                calls = self.calls()
                self.assertEqual(len({call.mote for call in calls}), 5, "another mote every 2 minutes")
                for call in calls:
                    # Two retries of a search at most: 10 s; the MAC, jitter and the way: far below 1 s.
                    self.assertLess(call.granted - call.began, 11)
                    self.assertNotEqual(call.end, "GAVE_UP")
                self.assertIn("FULFILLED", [call.end for call in calls])
                delivered, sent = self.messages()
                self.assertGreater(sent, 100)
                self.assertGreaterEqual(delivered / sent, 0.99)
                self.assertNotIn("warning", finished.err)

    def test_over_dds_and_in_process_they_are_the_same(self):
        for name in PHASES:
            with self.subTest(phase=name):
                until = ("--until", 30, *phase(name))
                expected = self.run_baraka(MANY_ROBOTS, *until, *IN_PROCESS)["fingerprint"]
                self.assertEqual(self.run_baraka(MANY_ROBOTS, *until)["fingerprint"], expected)
        one_each = ("--set", "agents.robots.controller.processes=12")  # with the phases of the last, which are drawn
        self.assertEqual(self.run_baraka(MANY_ROBOTS, *until, *one_each)["fingerprint"], expected)

    def play_two_robots(self, other, name, seed):
        finished = self.run_baraka(CASE_STUDY, "--seed", seed, *phase(name), *IN_PROCESS, "--set",
                                   f"agents.robots.poses=[{{x: 8 m, y: 8 m}}, {other}]")
        self.assertEqual(finished["result"], "arrived")
        (searches, failed), = self.query("SELECT count(*), sum(NOT found) FROM discoveries")
        self.assertGreater(searches, 10)
        self.assertEqual(failed, 0)
        (arrived,), = self.query("SELECT name FROM states JOIN agents USING (agent)"
                                 " WHERE state = 'ARRIVED'")
        return arrived

    def test_two_robots_in_the_case_study_serve_the_mote_between_them(self):
        arrived = []
        for other in ("{x: 8 m, y: 9 m}", "{x: 6 m, y: 4 m}"):
            for name in PHASES:
                for seed in range(1, 21 if is_complete else 3):
                    with self.subTest(other=other, phase=name, seed=seed):
                        arrived.append(self.play_two_robots(other, name, seed))
        self.assertEqual(set(arrived), {"r0", "r1"}, "either may be the one")
        print(f"two robots: {len(arrived)} runs, r0 arrived in {arrived.count('r0')}, r1 in "
              f"{arrived.count('r1')}", file=sys.stderr)

    def test_without_jitter_of_retries_two_aligned_robots_lose_every_search(self):
        finished = self.run_baraka(
            CASE_STUDY, *IN_PROCESS, "--until", 100, "--set", "routing.retry_jitter=0", "--set",
            "agents.robots.poses=[{x: 8 m, y: 8 m}, {x: 6 m, y: 4 m}]")
        (searches, found), = self.query("SELECT count(*), sum(found) FROM discoveries")
        self.assertGreater(searches, 3)
        self.assertEqual(found, 0)
        self.assertEqual(finished["result"], "until")

    def play_calls_side_by_side(self, jitter):
        """Two motes 1 m apart call at the same instant; @return how many of their calls reached none."""
        scenario = self.folder / "side_by_side.yaml"
        scenario.write_text(SIDE_BY_SIDE.format(mote=ROOT / "config/robots/mote.yaml", jitter=jitter))
        finished = self.run_baraka(scenario, *IN_PROCESS)
        (calls, lost), = self.query("SELECT count(*), sum(reached = 0) FROM broadcasts")
        self.assertEqual(calls, 8, "four each")
        return lost, finished

    def test_repeated_calls_come_apart(self):
        lost, finished = self.play_calls_side_by_side(0)
        self.assertEqual(lost, 8)
        self.assertIn("topic 'help': none of 8 messages of m0, m1 arrived at anyone", finished.err)
        lost, finished = self.play_calls_side_by_side(0.1)
        self.assertEqual(lost, 2, "the first ones")
        self.assertNotIn("arrived at anyone", finished.err)


class Broadcasts(Case):
    def rows(self):
        return self.query("SELECT reached, addressees, verdict, count(*) FROM broadcasts GROUP BY 1, 2, 3")

    def test_aligned_ones_that_nobody_repeats_are_told(self):
        finished = self.run_baraka(SHOUTER, *phase("aligned"), *IN_PROCESS)
        # 100 ms, 200 ms, ... 11.9 s, of two robots
        self.assertEqual(self.rows(), [(0, 1, "receiver transmitting", 2 * 119)])
        self.assertEqual(self.query("SELECT DISTINCT verdict FROM requests"), [("transmitted",)])
        # What the controller is told is what its radio knows.
        self.assertEqual(self.query("SELECT DISTINCT fate FROM messages"), [("handed over",)])
        self.assertEqual(self.query("SELECT count(*) FROM states WHERE state = 'HANDED_OVER 119'"), [(2,)])
        warning = ("topic 'ping': none of 238 messages of r0, r1 arrived at anyone; "
                   "receiver transmitting (238)")
        self.assertIn(warning, finished.err)
        self.assertIn(warning, (self.out / "run.log").read_text())

    def test_with_a_uniform_phase_timers_of_start_differ_and_broadcasts_arrive(self):
        finished = {}
        for where in ((), IN_PROCESS):
            finished[where] = self.run_baraka(SHOUTER, *phase("uniform"), *where)
            self.assertNotIn("arrived at anyone", finished[where].err)
        self.assertEqual(finished[()]["fingerprint"], finished[IN_PROCESS]["fingerprint"])
        reached = sum(count for got, _, _, count in self.rows() if got == 1)
        sent = sum(count for _, _, _, count in self.rows())
        self.assertGreaterEqual(sent, 2 * 118)
        # Relays of the other's last one may meet them; they last 1 % of the time.
        self.assertGreater(reached / sent, 0.9)

    def started(self):
        return dict(self.query("SELECT name, at_ns FROM states JOIN agents USING (agent)"
                               " WHERE state = 'STARTED'"))

    def test_in_real_time_agents_start_at_their_phase_too(self):
        self.run_baraka(SHOUTER, *phase("uniform"), *IN_PROCESS)
        phases = self.started()
        self.assertEqual(len(set(phases.values())), 2)
        for how in ((), IN_PROCESS):
            self.run_baraka(SHOUTER, *phase("uniform"), "--pace", "realtime:10", *how)
            for robot, at in self.started().items():
                # Named when the answer takes effect: not before the event, in the simulator's time.
                self.assertGreaterEqual(at, phases[robot])

    def test_a_run_that_ends_before_anybody_starts_lets_controllers_go(self):
        for until in (0, 1e-6):
            finished = self.run_baraka(SHOUTER, *phase("uniform"), "--until", until)
            self.assertEqual(finished["result"], "until")


class FortyHours(Hours):
    """Hours of many_robots.yaml: a call every two minutes, those of the last 600 s uncounted."""

    def judge_hour(self, name, seed):
        finished = self.run_baraka(MANY_ROBOTS, "--seed", seed, *phase(name), *IN_PROCESS, timeout=600)
        self.assertEqual(finished["result"], "done")
        calls = [call for call in self.calls() if call.began <= 3000]
        for call in calls:
            if call.end is None:
                self.check_under_way(call, 3600)
        ends = [call.end for call in calls]
        took = [call.took() for call in calls if call.end == "FULFILLED"]
        searches = self.query("SELECT took_ns / 1e6, found FROM discoveries")
        times = sorted(ms for ms, found in searches if found)
        delivered, sent = self.messages()
        quartiles = " ".join(f"{q:7.2f}" for q in statistics.quantiles(times))
        print(f"{name:8} {seed:4} {len(calls):5} {ends.count('FULFILLED'):8} {ends.count('GAVE_UP'):7} "
              f"{ends.count(None):9} {statistics.median(took):6.0f} {max(took):6.0f} {delivered:6}/{sent:<6} "
              f"{len(searches):6} {len(searches) - len(times):6} {sum(ms > 3700 for ms in times):6} "
              f"{sum(ms > 7400 for ms in times):6} {times[0]:8.6f} {quartiles} {times[-1]:8.2f}",
              file=sys.stderr)
        return ends, times

    @unittest.skipUnless(is_complete, "40 hours: run with --all")
    def test_nineteen_calls_of_twenty_are_answered(self):
        print("\nphase    seed calls answered gave_up under_way median    max  delivered/sent searches "
              "failed >3.7s >7.4s  min_ms, quartiles [ms], max [ms]", file=sys.stderr)
        for name in PHASES:
            ends, times = [], []
            for seed in range(1, 21):
                of_hour, searches = self.judge_hour(name, seed)
                ends += of_hour
                times += searches
            times.sort()
            quantiles = {q: times[int(q * (len(times) - 1))] for q in (0.25, 0.5, 0.75, 0.9, 0.99, 0.999)}
            print(f"{name}: {ends.count('FULFILLED')} of {len(ends)} answered, "
                  f"{ends.count('GAVE_UP')} given up, {ends.count(None)} under way; searches [ms]: min "
                  f"{times[0]:.6f} " + " ".join(f"q{q} {t:.2f}" for q, t in quantiles.items()) +
                  f" max {times[-1]:.2f}", file=sys.stderr)
            self.assertEqual(len(ends), 20 * 25)
            self.assertGreaterEqual(ends.count("FULFILLED") / len(ends), 0.95)


if __name__ == "__main__":
    if not (BIN / "baraka").exists():
        sys.exit(77)
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
