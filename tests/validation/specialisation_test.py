#!/usr/bin/env python3
"""The statistic of docs/scenarios/division_of_labour.md on made histories: of agents that specialise and of agents that do
not, and its parts by hand."""
import math
import random
import sqlite3
import unittest

import labour
import specialisation
from specialisation import Population, Verdict, blocks_of, dip, dispersion, holm, p_of, rank_correlation, share_between

AGENTS, TASKS = 12, 3


def made(chance, success, tasks_of=lambda agent: range(TASKS)):
    """An hour of every agent: a task every minute, drawn among its own ones, that succeeds with the given probability."""
    return [[(60.0 * (i + 1), chance.choice(list(tasks_of(agent))), chance.random() < success) for i in range(60)]
            for agent in range(AGENTS)]


def p_value(populations, shuffles, seed):
    return Verdict(populations, shuffles, seed).p()


class Histories(unittest.TestCase):
    def test_an_outcome_at_a_cut_belongs_to_the_block_that_ends(self):
        history = [(0.0, 0, True), (600.0, 1, True), (600.1, 2, False), (3600.0, 0, False)]
        blocks = blocks_of(history)
        self.assertEqual([len(one) for one in blocks], [2, 1, 0, 0, 0, 1])

    def test_replayed_weights_are_those_of_the_rule(self):
        # 0.55, 0.5: P = 0.3025 / 0.5525. Twelve successes stop at 1, thirty failures at 0.1.
        _, ends = Population([[(1.0, 0, True)], [(float(i), 1, True) for i in range(12)],
                              [(float(i), 0, False) for i in range(30)]], 2).observed()
        for found, expected in zip(ends, (0.3025 / 0.5525, 0.25 / 1.25, 0.01 / 0.26)):
            self.assertAlmostEqual(found[0], expected, delta=1e-15)

    def test_probabilities_are_averaged_over_time_from_half_an_hour_on(self):
        # One success at 900 s does not count before, all the second half hour after; another at 2700 s halves it.
        replay = specialisation.Replay(2)
        blocks = blocks_of([(900.0, 0, True), (2700.0, 0, True)])
        mean, _ = replay.history(blocks, range(6))
        first, second = 0.3025 / 0.5525, 0.36 / 0.61
        self.assertAlmostEqual(mean[0], (first + second) / 2, delta=1e-15)
        self.assertAlmostEqual(sum(mean), 1, delta=1e-15)

    def test_what_was_computed_once_is_the_same_again(self):
        chance = random.Random(3)
        population = Population(made(chance, 0.6), TASKS)
        once = population.observed()
        for _ in range(5):
            population.exchanged(chance)
        self.assertEqual(population.observed(), once)


class Dispersion(unittest.TestCase):
    def test_it_is_the_variance_summed_over_tasks(self):
        # 0.2, 0.4, 0.6: variance 0.04, of each of two tasks.
        self.assertAlmostEqual(dispersion([[0.2, 0.8], [0.4, 0.6], [0.6, 0.4]], [[0, 1, 2]]), 0.08, delta=1e-15)

    def test_differences_between_classes_do_not_count(self):
        values = [[0.0], [0.0], [1.0], [1.0]]
        self.assertEqual(dispersion(values, [[0, 1], [2, 3]]), 0)
        self.assertAlmostEqual(dispersion(values, [[0, 1, 2, 3]]), 1 / 3, delta=1e-15)


class Verdicts(unittest.TestCase):
    def test_agents_that_always_do_the_same_task_are_found(self):
        chance = random.Random(1)
        own = [Population(made(chance, 0.8, lambda agent: [agent % TASKS]), TASKS) for _ in range(2)]
        verdict = Verdict(own, 99, 2)
        self.assertEqual(verdict.p(), 1 / 100)
        self.assertGreater(min(verdict.ratios()), math.log(2))

    def test_agents_to_whom_other_tasks_succeed_are_found(self):
        chance = random.Random(5)
        histories = [[(at, task, (task == agent % TASKS) == (chance.random() < 0.9)) for at, task, _ in history]
                     for agent, history in enumerate(made(chance, 1))]
        self.assertEqual(p_value([Population(histories, TASKS)], 99, 2), 1 / 100)

    def test_agents_without_a_difference_are_told_apart_by_chance_only(self):
        # p is uniform then: below 0.2 in a fifth of the trials, 4 sigma of it aside.
        chance, trials = random.Random(7), 100
        few = sum(p_value([Population(made(chance, 0.6), TASKS)], 19, trial) <= 0.2 for trial in range(trials))
        self.assertLess(abs(few - 0.2 * trials), 4 * math.sqrt(trials * 0.2 * 0.8))

    def test_a_difference_between_classes_is_none_within_them(self):
        chance = random.Random(9)
        halves = [list(range(AGENTS // 2)), list(range(AGENTS // 2, AGENTS))]
        histories = made(chance, 0.8, lambda agent: [0, 1] if agent < AGENTS // 2 else [1, 2])
        self.assertEqual(p_value([Population(histories, TASKS)], 99, 1), 1 / 100)
        self.assertGreater(p_value([Population(histories, TASKS, halves)], 99, 1), 0.05)

    def test_agents_exchange_blocks_of_the_same_time_within_their_class_only(self):
        # Everyone's blocks have an outcome of their own; exchanged, each is still there once, in its class.
        histories = [[(600.0 * block + 1, agent, True) for block in range(6)] for agent in range(4)]
        population = Population(histories, 4, [[0, 1], [2, 3]])
        seen = []
        population.measured = lambda owners: seen.append(owners)
        population.exchanged(random.Random(1))
        for owner in seen[0]:
            self.assertEqual(sorted(owner[:2]), [0, 1])
            self.assertEqual(sorted(owner[2:]), [2, 3])

    def test_the_observation_counts_among_what_chance_gives(self):
        self.assertEqual(p_of(3, [1, 2, 3, 4]), 3 / 5)
        self.assertEqual(p_of(9, [1, 2, 3, 4]), 1 / 5)

    def test_several_hypotheses_are_adjusted_together(self):
        for found, expected in zip(holm([0.01, 0.04, 0.03]), (0.03, 0.06, 0.06)):
            self.assertAlmostEqual(found, expected, delta=1e-15)


class Dip(unittest.TestCase):
    def test_it_is_a_quarter_for_two_points_and_least_for_equal_distances(self):
        self.assertAlmostEqual(dip([0.0] * 50 + [1.0] * 50), 0.25, delta=1e-12)
        self.assertAlmostEqual(dip([i / 10 for i in range(100)]), 1 / 200, delta=1e-12)

    def test_an_atom_at_the_mode_is_no_second_one(self):
        self.assertLess(dip([0.0] * 900 + [i / 100 for i in range(1, 101)]), 0.01)

    def test_two_peaks_are_told_from_one(self):
        chance = random.Random(11)
        one = [chance.gauss(0, 1) for _ in range(240)]
        two = [chance.gauss(6 * (i % 2), 1) for i in range(240)]
        # A uniform distribution is the unimodal one whose samples have the greatest dips.
        uniform = sorted(dip([chance.random() for _ in range(240)]) for _ in range(100))
        self.assertLess(dip(one), uniform[94])
        self.assertGreater(dip(two), 2 * uniform[-1])

    def test_a_mirror_changes_nothing(self):
        chance = random.Random(13)
        values = [chance.gauss(3 * (i % 3), 0.5) for i in range(60)]
        self.assertAlmostEqual(dip(values), dip([-one for one in values]), delta=1e-12)


class MadeRun:
    """The tables of a result that labour.py reads."""

    def __init__(self, states=(), recorded=()):
        self.database = sqlite3.connect(":memory:")
        self.database.executescript(
            "CREATE TABLE agents (agent, name, kind); INSERT INTO agents VALUES (1, 'm0', 'mote'), (2, 'm1', 'mote'), "
            "(3, 'r0', 'robot'); CREATE TABLE states (agent, at_ns, state); CREATE TABLE recorded (agent, at_ns, name, value);")
        self.database.executemany("INSERT INTO states VALUES (?, ? * 1e9, ?)", states)
        self.database.executemany("INSERT INTO recorded VALUES (?, ? * 1e9, ?, ?)", recorded)

    def query(self, sql):
        return self.database.execute(sql).fetchall()


class Results(unittest.TestCase):
    def test_every_need_counts_however_it_stands_at_the_end(self):
        run = MadeRun(
            recorded=[(1, 1, "needs", 1), (1, 300, "needs", 2), (1, 600, "needs", 3), (2, 1, "needs", 1), (2, 500, "needs", 2)],
            states=[(1, 2, "REQUEST"), (1, 3, "WAIT"), (1, 100, "FULFILLED"), (1, 301, "REQUEST"), (1, 400, "GAVE_UP"),
                    (1, 601, "REQUEST"), (1, 602, "WAIT"), (2, 1, "REQUEST"), (2, 90, "FULFILLED"), (3, 90, "ARRIVED")])
        self.assertEqual(dict(labour.calls(run)), {labour.ANSWERED: 2, labour.GIVEN_UP: 1, labour.UNDER_WAY: 1,
                                                   labour.NOT_CALLED: 1})

    def test_a_history_has_each_outcome_once(self):
        # At the end each agent records its counts again.
        run = MadeRun(recorded=[(1, 5, "succeeded_audio", 1), (1, 9, "failed_audio", 1), (1, 12, "succeeded_audio", 2),
                                (3, 12, "failed_idle", 1), (1, 99, "succeeded_audio", 2), (1, 99, "failed_audio", 1),
                                (1, 99, "failed_video", 0)])
        self.assertEqual(labour.histories(run), {"m0": [(5, "audio", True), (9, "audio", False), (12, "audio", True)],
                                                 "r0": [(12, "idle", False)]})

    def test_p_settles_where_it_comes_near_its_last_value_for_good(self):
        steps = [(0, 0.25), (10, 0.41), (20, 0.3), (30, 0.38), (40, 0.4)]
        self.assertEqual(labour.settled_at(steps), 30)
        self.assertEqual(labour.settled_at([(0, 0.25)]), 0)

    def test_the_rings_are_those_of_the_links(self):
        # 125 m grid, 250.2 m: twelve motes within reach of the middle (tests/e2e/case_study_test.py has its degree).
        self.assertEqual([len(ring) for ring in labour.rings()], [1, 12, 12])


class Correlations(unittest.TestCase):
    def test_ranks_are_compared(self):
        self.assertAlmostEqual(rank_correlation([1, 2, 3, 4], [1, 8, 27, 64]), 1)
        # Ranks 1, 2.5, 2.5, 4 and 4, 2, 3, 1: covariance -4.5, squares 4.5 and 5.
        self.assertAlmostEqual(rank_correlation([1, 2, 2, 3], [9, 5, 7, 1]), -4.5 / math.sqrt(4.5 * 5))

    def test_the_share_between_classes(self):
        # Means 1 and 3 about 2: 4 of the 8 squares.
        self.assertAlmostEqual(share_between([0, 2, 2, 4], [[0, 1], [2, 3]]), 4 / 8)


if __name__ == "__main__":
    unittest.main()
