#!/usr/bin/env python3
"""Scenarios as environments: equal to runs with controllers, equal when repeated, and with the interfaces of others."""
import importlib.util
import os
import resource
import sys
import unittest

from baraka import BIN, ROOT, Case

WANDERER = ROOT / "config/scenarios/wanderer.yaml"
MISSING = [name for name in ("numpy", ) if importlib.util.find_spec(name) is None]
if not (BIN / "libbaraka_python.so").exists():
    MISSING.append("a build with Python's headers and pybind11")
TWO = """version: 1
name: two
seed: 1
radio: {{profile: ieee80211b}}
world: {{walls: [{{name: wall, size: [0.2 m, 4 m, 0.5 m], position: [1 m, 0 m]}}]}}
agents:
  robots:
    name: r{{}}
    robot: {{include: {root}/config/robots/{robot}.yaml}}
    poses: [{{x: 0 m, y: 0 m}}, {{x: 0 m, y: 2 m}}, {{x: 0 m, y: -2 m}}]
    controller: {{program: wanderer}}
end:
  - {{at: 3 s, result: done}}
"""


def nothing(*_):
    return 0


class Environments(Case):
    @classmethod
    def setUpClass(cls):
        os.environ["BARAKA_CONTROLLER_PATH"] = str(ROOT / "tests/e2e/python")
        del sys.modules["baraka"]  # the file beside this one; from here on it is the package
        sys.path.insert(0, str(BIN / "python"))
        import baraka as package
        cls.baraka, cls.Environment = package, package.Environment

    def environment(self, *arguments, **keywords):
        return self.Environment(*arguments, **keywords)

    def play(self, environment, seed, action):
        environment.reset(seed=seed)
        seen = []
        while True:
            observation, reward, terminated, truncated, info = environment.step(action)
            seen.append(observation.tobytes())
            if truncated or terminated:
                return seen, info

    def test_an_episode_is_the_run_of_a_controller_that_does_the_same(self):
        environment = self.environment(WANDERER, "r0", nothing, until=20)
        for seed in (1, 2):
            _, info = self.play(environment, seed, [0.2, 0, 0.3])
            run = self.run_baraka(WANDERER, "--seed", seed, "--until", "20s", "--controllers", "in-process", "--set",
                                  "control_phase=aligned", "--set", "agents.robots.controller.program=steady.py", "--set",
                                  "agents.robots.controller.parameters={}")
            self.assertEqual(info["fingerprint"], run["fingerprint"])
            self.assertEqual(info["result"], "until")

    def test_equal_seeds_give_equal_episodes_and_others_do_not(self):
        environment = self.environment(WANDERER, "r0", nothing, until=5)
        first, again, other = (self.play(environment, seed, [0.2, 0, 0.3])[0] for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_several_episodes_side_by_side_do_not_disturb_each_other(self):
        alone = [self.play(self.environment(WANDERER, "r0", nothing, until=3), seed, [0.2, 0, 0.3])[1]["fingerprint"]
                 for seed in range(3)]
        environments = [self.environment(WANDERER, "r0", nothing, until=3) for _ in range(3)]
        for seed, one in enumerate(environments):
            one.reset(seed=seed)
        ends = [None] * 3
        while None in ends:
            for i, one in enumerate(environments):
                if ends[i] is None:
                    *_, truncated, info = one.step([0.2, 0, 0.3])
                    ends[i] = info["fingerprint"] if truncated else None
        self.assertEqual(ends, alone)

    def two(self, robot="robertino"):
        file = self.folder / "two.yaml"
        file.write_text(TWO.format(root=ROOT, robot=robot))
        return file

    def test_several_robots_are_driven_as_in_pettingzoo(self):
        environment = self.environment(self.two(), ["r1", "r0"], lambda o, a, n, i: i["pose"][0], channels=["odometry"])
        observations, infos = environment.reset(seed=1)
        self.assertEqual(environment.possible_agents, ["r1", "r0"])
        self.assertEqual(set(observations), {"r0", "r1"})
        for _ in range(20):
            observations, rewards, terminated, truncated, infos = environment.step({"r0": [0.2, 0, 0], "r1": [0, 0.2, 0]})
        self.assertGreater(infos["r0"]["pose"][0], 0.2)
        self.assertGreater(infos["r1"]["pose"][1], 2.2)
        self.assertEqual(rewards, {name: info["pose"][0] for name, info in infos.items()})
        self.assertAlmostEqual(observations["r0"][0], infos["r0"]["pose"][0], delta=0.02)  # odometry
        self.assertEqual(environment.agents, ["r1", "r0"])
        while not truncated["r0"]:
            *_, truncated, infos = environment.step({"r0": [0, 0, 0], "r1": [0, 0, 0]})
        self.assertEqual((environment.agents, infos["r0"]["result"]), ([], "done"))

    def test_robots_that_are_not_driven_have_their_controllers(self):
        ends = {speed: self.play(self.environment(self.two(), "r0", nothing, set=[
            f"agents.robots.controller.parameters={{speed: {speed} m/s}}"]), 1, [0, 0, 0])[1] for speed in (0.1, 0.3)}
        for info in ends.values():
            self.assertLess(abs(info["pose"][0]), 0.02)  # driven: it stands, whatever its controller would do
        self.assertNotEqual(ends[0.1]["fingerprint"], ends[0.3]["fingerprint"])  # the others drive at that speed

    def test_rewards_and_terminals_get_both_observations_and_the_action(self):
        seen = []
        environment = self.environment(WANDERER, "r0", lambda *all_of: seen.append(all_of) or len(seen), until=5,
                                       terminal=lambda before, action, after, info: info["now"] > 1.0)
        first, _ = environment.reset(seed=1)
        steps = 0
        while True:
            observation, reward, terminated, truncated, info = environment.step([0.1, 0, 0])
            steps += 1
            self.assertEqual(reward, steps)
            if terminated:
                break
        self.assertFalse(truncated)
        self.assertEqual(seen[0][0].tobytes(), first.tobytes())
        self.assertEqual(seen[-1][2].tobytes(), observation.tobytes())
        self.assertEqual([list(one[1]) for one in seen], [[0.1, 0, 0]] * steps)
        self.assertEqual(steps, 11)
        with self.assertRaisesRegex(RuntimeError, "reset"):
            environment.step([0, 0, 0])

    def test_spaces_follow_channels_and_wheels(self):
        omni = self.environment(WANDERER, "r0", nothing, channels=["infrared"])
        self.assertEqual(omni.action_space.shape, (3, ))
        self.assertEqual(omni.observation_space.shape, (6, ))
        differential = self.environment(self.two("turtlebot3_burger"), "r0", nothing, channels=["odometry", "scan"],
                                        set=["agents.robots.controller={program: steady.py}"])
        self.assertEqual(differential.action_space.shape, (2, ))  # it cannot drive sideways
        self.assertAlmostEqual(differential.action_space.high[0], 6.67 * 0.033, places=9)  # wheel speed times radius
        self.assertEqual(differential.observation_space.shape, (6 + 360, ))
        self.assertEqual(differential.observation_space.high[-1], 3.5)
        observation, _ = differential.reset(seed=3)
        for _ in range(10):
            observation, *_ = differential.step(differential.action_space.sample())
        self.assertTrue(differential.observation_space.contains(observation))
        self.assertFalse(differential.observation_space.contains(observation[1:]))
        space = differential.action_space
        space.seed(5)
        first = space.sample()
        space.seed(5)
        self.assertTrue((first == space.sample()).all() and first in space)

    def test_scenarios_and_controllers_that_come_along_are_found_by_name(self):
        environment = self.environment("many_robots", "r3", nothing, until=2)
        _, info = self.play(environment, 5, [0, 0, 0])
        self.assertEqual(info["result"], "until")

    def test_mistakes(self):
        environment = self.environment(WANDERER, "r0", nothing, until=5)
        environment.reset(seed=1)
        for call, error, words in (
                (lambda: self.environment(WANDERER, "r9", nothing), RuntimeError, "'r9' is not in the scenario"),
                (lambda: self.environment(WANDERER, [], nothing), RuntimeError, "names none"),
                (lambda: self.environment(WANDERER, ["r0", "r0"], nothing), RuntimeError, "named twice"),
                (lambda: self.environment("/nowhere.yaml", "r0", nothing), RuntimeError, "/nowhere.yaml"),
                (lambda: self.environment(WANDERER, "r0", nothing, set=["sed=1"]), RuntimeError, "did you mean 'seed'"),
                (lambda: self.environment(WANDERER, "r0", nothing, channels=["smell"]), ValueError, "no channel 'smell'"),
                (lambda: environment.step([0, 0]), ValueError, r"shape \(2,\), not \(3,\)"),
                (lambda: environment.step([float("nan"), 0, 0]), ValueError, "not finite"),
                (lambda: environment.reset(seed=-1), ValueError, "seed: -1"),
                (lambda: self.environment(WANDERER, "r0", nothing).step([0, 0, 0]), RuntimeError, "reset")):
            with self.assertRaisesRegex(error, words):
                call()
        environment.step([0, 0, 0])  # a refused call has ended nothing

    def test_a_thousand_resets_leave_nothing(self):
        environment = self.environment(WANDERER, "r0", nothing, until=5)

        def reset(count):
            for seed in range(count):
                environment.reset(seed=seed)
                environment.step([0.2, 0, 0])

        reset(100)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, len(os.listdir("/proc/self/fd"))
        reset(1000)
        environment.close()
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, len(os.listdir("/proc/self/fd"))
        self.assertLess(after[0] - before[0], 1000)  # KiB: one of them that stayed would take more than 1 KiB each
        self.assertLessEqual(after[1], before[1])
        self.assertEqual(len(os.listdir("/proc/self/task")), 1)


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: needs {', '.join(MISSING)}")
        sys.exit(77)
    unittest.main()
