#!/usr/bin/env python3
"""What the benches compute of runs, against tables and by hand."""
import math
import unittest

import pairs


class Pairs(unittest.TestCase):
    def test_limits_of_t_are_those_of_the_tables(self):
        for level, df, limit in ((0.95, 1, 12.7062), (0.95, 9, 2.26216), (0.95, 19, 2.09302), (0.999, 19, 3.88341)):
            self.assertAlmostEqual(pairs.t_quantile(level, df), limit, delta=1e-4 * limit)

    def test_a_mean_has_the_interval_of_student(self):
        # 1, 2, 3: mean 2, standard error 1 / sqrt(3), t 4.30265.
        mean, half = pairs.mean_interval([1, 2, 3])
        self.assertEqual(mean, 2)
        self.assertAlmostEqual(half, 4.30265 / math.sqrt(3), delta=1e-4)
        self.assertEqual(pairs.mean_interval([5]), (5, math.inf))

    def test_a_geometric_interval_stays_positive(self):
        # Logarithms 0 and ln 16: mean ln 4, half 12.7062 ln 16 / 2.
        mean, low, high = pairs.geometric_interval([1, 16])
        self.assertAlmostEqual(mean, 4, delta=1e-12)
        self.assertAlmostEqual(math.log(high), math.log(4) + 12.7062 * math.log(16) / 2, delta=1e-3)
        self.assertAlmostEqual(low * high, 16, delta=1e-9)
        self.assertGreater(low, 0)

    def test_pairs_are_judged_by_their_differences(self):
        # Differences 1, 2, 3: t = 2 sqrt(3), p = 0.0742 with 2 degrees of freedom: 1 - t / sqrt(t^2 + 2).
        mean, _, p = pairs.paired([10, 20, 30], [11, 22, 33])
        self.assertEqual(mean, 2)
        t = 2 * math.sqrt(3)
        self.assertAlmostEqual(p, 1 - t / math.sqrt(t * t + 2), delta=1e-9)
        self.assertEqual(pairs.paired([1, 2], [1, 2])[2], 1)

    def test_signs_are_flipped_in_all_ways(self):
        # 1, 2, 3 all positive: only all of one sign is as far, 2 of 8.
        self.assertEqual(pairs.sign_flip_p([0, 0, 0], [1, 2, 3]), 2 / 8)
        # 1 + 2 - 3 = 0: every choice is.
        self.assertEqual(pairs.sign_flip_p([0, 0, 3], [1, 2, 0]), 1)

    def test_quantiles_lie_between_the_values(self):
        self.assertEqual([pairs.quantile([4, 1, 2], one) for one in (0, 0.25, 0.5, 0.75, 1)], [1, 1.5, 2, 3, 4])

    def test_shares_stay_in_their_range(self):
        low, high = pairs.wilson(0, 10)
        self.assertAlmostEqual(low, 0, delta=1e-12)
        self.assertAlmostEqual(high, 0.2775, delta=5e-5)


if __name__ == "__main__":
    unittest.main()
