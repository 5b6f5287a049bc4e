#!/usr/bin/env python3
"""Division of labour: 25 motes and twelve robots that choose their tasks, and learn from what comes of them.
Run with --all it plays 40 hours, one process at a time, and prints the table; else some minutes of them."""
import collections
import statistics
import sys
import unittest

from baraka import BIN, ROOT
from many_robots_test import IN_PROCESS, PHASES, Hours, phase

SCENARIO = ROOT / "config/scenarios/division_of_labour.yaml"
TASKS = ROOT / "config/tasks"
MOTE, ROBOT = "agents.motes.controller.parameters.", "agents.robots.controller.parameters."
LEAST, MOST, EXPONENT = 0.1, 1, 2  # of config/tasks
is_complete = "--all" in sys.argv


class Call:
    """A mote's need for help: when it came up, its call (REQUEST), the first grant (WAIT) and its end."""

    def __init__(self, mote, needed):
        self.mote, self.needed, self.began, self.granted, self.ended, self.end = mote, needed, None, None, None, None


class Labour(Hours):
    def play(self, *arguments, seed=1, name="uniform", status=0, scenario=SCENARIO, timeout=600):
        return self.run_baraka(scenario, "--seed", seed, *phase(name), *IN_PROCESS, *arguments, status=status,
                               timeout=timeout)

    def calls(self):
        """Of the last run, by mote and need; times in s."""
        rows = self.query("SELECT agent, at_ns / 1e9, 1, 'NEED' FROM recorded WHERE name = 'needs' UNION ALL "
                          "SELECT agent, at_ns / 1e9, 2, state FROM states JOIN agents USING (agent) WHERE kind = 'mote' "
                          "ORDER BY 1, 2, 3")
        found, current = [], {}
        for mote, at, _, what in rows:
            call = current.get(mote)
            if what == "NEED" and call is None:
                found.append(current.setdefault(mote, Call(mote, at)))
            elif what == "REQUEST" and call and call.began is None:
                call.began = at
            elif what == "WAIT" and call:
                call.granted = call.granted or at
            elif what in ("FULFILLED", "GAVE_UP") and call and call.began is not None:
                call.ended, call.end = at, what
                del current[mote]
        return found

    def probabilities(self):
        """{agent: {time [s]: {task: P}}} of the last run."""
        found = collections.defaultdict(lambda: collections.defaultdict(dict))
        for agent, at, name, value in self.query(
                "SELECT a.name, at_ns / 1e9, r.name, value FROM recorded r JOIN agents a USING (agent)"
                " WHERE r.name LIKE 'p\\_%' ESCAPE '\\' ORDER BY r.rowid"):
            found[agent][at][name[2:]] = value
        return found

    def check_probabilities(self):
        """They sum to 1 and stay in the bounds that those of the weights set. @return how many were checked."""
        checked = 0
        for agent, times in self.probabilities().items():
            for at, tasks in times.items():
                low, high, others = LEAST ** EXPONENT, MOST ** EXPONENT, len(tasks) - 1
                self.assertAlmostEqual(sum(tasks.values()), 1, delta=1e-12, msg=f"{agent} at {at} s")
                for task, p in tasks.items():
                    self.assertGreaterEqual(p, low / (low + others * high) - 1e-12, f"{agent} {task} at {at} s")
                    self.assertLessEqual(p, high / (high + others * low) + 1e-12, f"{agent} {task} at {at} s")
                    checked += 1
        return checked

    def outcomes(self):
        """{task: (successes, failures)} of all agents: each records its count when there is one more, and at the end."""
        counts = collections.defaultdict(lambda: [0, 0])
        for name, value in self.query("SELECT name, sum(total) FROM (SELECT name, max(value) AS total FROM recorded WHERE "
                                      "name LIKE 'succeeded%' OR name LIKE 'failed%' GROUP BY name, agent) GROUP BY name"):
            kind, task = name.split("_", 1)
            counts[task][kind == "failed"] += int(value)
        return dict(counts)


class Minutes(Labour):
    def test_five_minutes_of_all_tasks(self):
        for name in PHASES:
            with self.subTest(phase=name):
                finished = self.play("--until", 300, name=name)
                self.assertEqual(finished["result"], "until")
                self.assertNotIn("warning", finished.err)
                self.assertGreater(self.check_probabilities(), 500)
                topics = {topic for topic, in self.query("SELECT DISTINCT topic FROM messages")}
                self.assertEqual(topics, {"temperature", "audio", "video", "help", "patrol"})
                outcomes = self.outcomes()
                for task in ("temperature", "audio", "video", "patrol", "idle"):
                    self.assertGreater(outcomes[task][0], 0, task)
                self.assertGreater(outcomes["answer"][1], 0, "somebody is refused")
                calls = self.calls()
                self.assertEqual(len(calls), 3, "another mote every two minutes")
                for call in calls:
                    self.assertIsNotNone(call.granted, f"mote {call.mote}")

    def test_over_dds_and_in_process_it_is_the_same(self):
        until = ("--until", 30)
        expected = self.play(*until)["fingerprint"]
        self.assertEqual(self.run_baraka(SCENARIO, "--seed", 1, *until)["fingerprint"], expected)

    def split(self, tasks):
        """Share of the agents with those tasks that are far from undecided at the end, |P - 0.5| > 0.3."""
        last = [times[max(times)] for times in self.probabilities().values()]
        ends = [p for p in last if set(p) == set(tasks)]
        return sum(abs(p[tasks[0]] - 0.5) > 0.3 for p in ends) / len(ends)

    def test_a_population_splits_where_one_task_succeeds_for_one_half_and_the_other_for_the_other(self):
        # A receipt cannot come within no time: temperature pays for the even rows of motes, audio for the odd ones.
        scenario = self.folder / "split.yaml"
        hasty = ", ".join(f"{{agents: m{i}, parameters: {{{'audio' if i // 5 % 2 == 0 else 'temperature'}: "
                          "{needed: 1, within: 0 s}}}" for i in range(25) if i != 12)
        scenario.write_text(f"version: 1\ninclude: {SCENARIO}\nagents:\n  motes:\n    controller:\n"
                            f"      parameters: {{tasks: [temperature, audio], rest: 2 s}}\n      overrides: [{hasty}]\n")
        self.play("--until", 150, scenario=scenario)
        self.assertGreaterEqual(self.split(["temperature", "audio"]), 0.6)
        self.check_probabilities()
        # Without the difference nobody has a reason.
        scenario.write_text(f"version: 1\ninclude: {SCENARIO}\nagents:\n  motes:\n    controller:\n"
                            f"      parameters: {{tasks: [temperature, audio], rest: 2 s}}\n      overrides: []\n")
        self.play("--until", 150, scenario=scenario)
        self.assertLess(self.split(["temperature", "audio"]), 0.2)

    def test_the_exponent_sharpens_and_the_variable_rule_hastens(self):
        def spread(*more):
            self.play("--until", 200, *more)
            last = [times[max(times)] for agent, times in self.probabilities().items() if agent.startswith("r")]
            return statistics.mean(max(p.values()) - min(p.values()) for p in last)
        plain = spread()
        self.assertGreater(spread("--set", ROBOT + "weights.exponent=6"), plain)
        self.assertGreater(spread("--set", ROBOT + "weights.rule=variable"), plain)


class Sizes(Labour):
    """Other numbers of agents than 25 and twelve."""

    def scenario(self, motes, robots):
        text = f"""version: 1
name: some
seed: 1
controller_latency: 0 s
radio: {{profile: mobility_framework, lengths: bytes}}
localisation: {{range: 300 m}}
agents:
"""
        if motes:
            text += f"""  motes:
    name: m{{}}
    mote: {{include: {ROOT}/config/robots/mote.yaml}}
    poses: [{', '.join(f'{{x: {100 * i} m, y: 0 m}}' for i in range(motes))}]
    controller:
      program: labour_mote
      parameters: {{include: {TASKS}/mote.yaml, sink: m0, rest: 5 s, help: {{at: 10 s}}}}
"""
        if robots:
            text += f"""  robots:
    name: r{{}}
    robot: {{include: {ROOT}/config/robots/robertino.yaml}}
    poses: [{', '.join(f'{{x: 20 m, y: {10 * (i + 1)} m}}' for i in range(robots))}]
    controller:
      program: labour_robot
      parameters: {{include: {TASKS}/robot.yaml, sink: m0, patrol: {{posts: [m0]}}}}
"""
        file = self.folder / "some.yaml"
        file.write_text(text + "end: [{at: 400 s, result: done}]\n")
        return file

    def test_two_motes_and_a_robot(self):
        # That robot may well choose something else for as long as a mote calls.
        finished = self.play(scenario=self.scenario(2, 1))
        self.assertEqual(finished["result"], "done")
        self.check_probabilities()
        ends = [call.end for call in self.calls()]
        self.assertEqual(len(ends), 2)
        self.assertEqual(self.outcomes()["help"], [ends.count("FULFILLED"), ends.count("GAVE_UP")])
        # Not so if there is nothing else.
        self.play("--set", ROBOT + "tasks=[answer]", scenario=self.scenario(2, 1))
        self.assertEqual([call.end for call in self.calls()], ["FULFILLED", "FULFILLED"])
        self.assertEqual(self.outcomes()["answer"][0], 2)

    def test_without_a_robot_calls_are_given_up(self):
        self.play(scenario=self.scenario(2, 0))
        self.assertEqual({call.end for call in self.calls()}, {"GAVE_UP"})
        self.assertEqual(self.outcomes()["help"], [0, 2])

    def test_without_a_mote_it_says_what_is_missing(self):
        finished = self.play(scenario=self.scenario(0, 2), status=2)
        self.assertIn("there is no agent 'm0'", finished.err)

    def test_robots_that_only_answer_need_no_mote(self):
        finished = self.play("--set", ROBOT + "tasks=[answer, idle]", scenario=self.scenario(0, 12))
        self.assertEqual(finished["result"], "done")

    def test_a_misspelt_parameter_is_a_mistake_with_its_place(self):
        file = self.scenario(2, 1)
        file.write_text(file.read_text().replace("rest: 5 s", "rest: 5 s, video: {siez: 5}"))
        finished = self.play(scenario=file, status=2)
        self.assertIn("some.yaml:14:", finished.err)
        self.assertIn("video.siez: is not a parameter of labour_mote; did you mean 'video.size'?", finished.err)


class FortyHours(Labour):
    """division_of_labour.yaml with the needs of one hour, one of every mote, and time for their calls to end."""

    def judge_hour(self, name, seed):
        finished = self.play("--set", MOTE + "help.every=never", "--set", "end=[{at: 5400 s, result: done}]", seed=seed,
                             name=name)
        self.assertEqual(finished["result"], "done")
        self.check_probabilities()
        calls = self.calls()
        self.assertEqual(len(calls), 25)
        for call in calls:
            if call.end is None:
                self.assertIsNotNone(call.began, f"mote {call.mote} never called")
                self.check_under_way(call, 5400)
        ends = [call.end for call in calls]
        waited = [call.began - call.needed for call in calls]
        took = [call.ended - call.began for call in calls if call.end == "FULFILLED"]
        print(f"{name:8} {seed:4} {ends.count('FULFILLED'):8} {ends.count('GAVE_UP'):7} {ends.count(None):9} "
              f"{statistics.median(waited):6.0f} {max(waited):6.0f} {statistics.median(took):6.0f} {max(took):6.0f} "
              f"{float(finished['wall_s']):6.1f}", file=sys.stderr)
        return ends

    @unittest.skipUnless(is_complete, "40 hours: run with --all")
    def test_nineteen_calls_of_twenty_are_answered(self):
        print("\nphase    seed answered gave_up under_way  waits    max answer    max wall_s", file=sys.stderr)
        ends = collections.defaultdict(list)
        for seed in range(1, 21):
            for name in PHASES:
                ends[name] += self.judge_hour(name, seed)
        for name, some in ends.items():
            print(f"{name}: {some.count('FULFILLED')} of {len(some)} answered, {some.count('GAVE_UP')} given up, "
                  f"{some.count(None)} under way", file=sys.stderr)
            self.assertGreaterEqual(some.count("FULFILLED") / len(some), 0.95)


if __name__ == "__main__":
    if not (BIN / "baraka").exists():
        sys.exit(77)
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
