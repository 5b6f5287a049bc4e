#!/usr/bin/env python3
"""The numbers of the measurements of DDS: quantiles, intervals, who is not dominated, what journals add up to."""
import math
import pathlib
import random
import tempfile
import unittest

import dds_links
import figures
import journals
import own


class Figures(unittest.TestCase):
    def test_quantiles_lie_between_the_values(self):
        values = [1.0, 2.0, 4.0, 8.0]
        self.assertEqual([figures.quantile(values, share) for share in (0, 0.5, 1)], [1, 3, 8])
        self.assertAlmostEqual(figures.quantile(values, 0.9), 4 + 0.7 * 4)
        self.assertEqual(figures.quantile([3.0], 0.99), 3)

    def test_intervals_hold_the_truth_nineteen_times_in_twenty(self):
        stream = random.Random(7)
        trials, held = 200, 0
        for trial in range(trials):
            values = [stream.gauss(0, 1) for _ in range(60)]
            low, high = figures.interval(values, figures.median, seed=trial, resamples=200)
            held += low <= 0 <= high
        # 95 % of 200, and three standard deviations of that count.
        self.assertGreater(held, 190 - 3 * math.sqrt(200 * 0.95 * 0.05))

    def test_blocks_that_are_alike_inside_widen_the_interval(self):
        stream = random.Random(7)
        blocks = [[centre + stream.gauss(0, 0.01) for _ in range(100)] for centre in (1, 2, 3, 4, 5)]
        pooled = [value for block in blocks for value in block]
        low, high = figures.blocks_interval(blocks, figures.median, resamples=200)
        within = figures.interval(pooled, figures.median, resamples=200)
        self.assertGreater(high - low, 5 * (within[1] - within[0]))

    def test_the_exponent_of_a_power_is_found(self):
        slope, error = figures.growth_exponent([(n, 3 * n ** 1.7) for n in (5, 10, 20, 40)])
        self.assertAlmostEqual(slope, 1.7)
        self.assertAlmostEqual(error, 0)
        self.assertEqual(figures.growth_exponent([(1, 1), (2, 4)]), (2, None))

    def test_rows_that_no_other_beats_are_kept(self):
        rows = [{"name": "good", "share": 0.9, "late": 1}, {"name": "slower", "share": 0.9, "late": 2},
                {"name": "surer", "share": 1.0, "late": 5}, {"name": "none", "share": None, "late": 0},
                {"name": "twin", "share": 0.9, "late": 1}]
        kept = figures.not_dominated(rows, {"share": 1, "late": -1})
        self.assertEqual([row["name"] for row in kept], ["good", "surer", "twin"])

    def test_numbers_read_well(self):
        self.assertEqual([figures.number(one) for one in (0.012345, 1.0, 99.96, 123.4, 7, None, "a", 0.0)],
                         ["0.0123", "1.00", "100.0", "123", "7", "-", "a", "0.0"])

    def test_tables_are_markdown(self):
        self.assertEqual(figures.table(["name", "n"], [["a", 1], ["bc", 20]]),
                         "| name |  n |\n|------|---:|\n| a    |  1 |\n| bc   | 20 |")


HEAD = "event,topic,wall_ns,mono_ns,writer,number,size,took_ns,ok,stamp_ns\n"


class Journals(unittest.TestCase):
    def journals(self, *texts):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        files = {}
        for i, text in enumerate(texts):
            files[i] = pathlib.Path(folder.name) / f"{i}.csv"
            files[i].write_text(HEAD + text)
        return files

    def test_shares_and_latencies_add_up(self):
        found = journals.totals(self.journals(
            "created,,0,0,0,,,,,\nreaders,t,500,500,0,2,,,,\n"
            "write,t,1000,1000,0,0,64,5,1,\nwrite,t,2000,2000,0,1,64,5,0,\nwrite,t,3000,3000,0,2,64,5,1,\n",
            "created,t,0,0,1,,,,,\nreceive,t,1500,1500,0,0,64,,,1000\nreceive,t,3700,3700,0,2,64,,,3000\n",
            "created,t,0,0,2,,,,,\nreceive,t,1600,1600,0,0,64,,,1000\nreceive,t,37"))
        self.assertEqual((found.offered, found.written, found.expected, found.received), (3, 2, 4, 3))
        self.assertEqual(found.delivered, 0.75)
        self.assertEqual([round(1e9 * one) for one in found.pooled()], [500, 600, 700])

    def test_a_reader_counts_once_it_is_known(self):
        found = journals.totals(self.journals(
            "created,,0,0,0,,,,,\nwrite,t,100,100,0,0,64,5,1,\nreaders,t,500,500,0,1,,,,\nwrite,t,1000,1000,0,1,64,5,1,\n",
            "created,t,0,0,1,,,,,\n"))
        self.assertEqual((found.written, found.expected, found.received, found.delivered), (2, 1, 0, 0))

    def test_all_are_matched_when_the_last_one_is(self):
        texts = ["created,t,1000,0,0,,,,,\nreaders,t,1500,0,0,1,,,,\nwriters,t,1700,0,0,1,,,,\nwriters,t,1800,0,0,0,,,,\n",
                 "created,t,1100,0,1,,,,,\nwriters,t,1500,0,1,1,,,,\nreaders,t,2900,0,1,1,,,,\n"]
        self.assertAlmostEqual(journals.matched_after(self.journals(*texts), 1), 1900e-9)
        self.assertIsNone(journals.matched_after(self.journals(texts[0], "created,t,1,0,1,,,,,\n"), 1))


class Runs(unittest.TestCase):
    def test_runs_are_in_lock_step_unless_a_factor_is_given(self):
        self.assertEqual([own.pace(factor) for factor in (None, own.LOCKSTEP, 0.05)], ["lockstep", "lockstep", "realtime:0.05"])

    def test_costs_add_up(self):
        rows = [{"simulated": 20.0, "wall": 1.5}, {"simulated": 30.0, "wall": 2.5}]
        self.assertEqual(own.costs(rows), "2 runs, 50 s simulated in 4 s: 12.5 times real time")

    def test_the_line_of_a_second_is_printed_a_little_later(self):
        there = {"first_least": "1.0", "first_most": "3.1"}
        self.assertEqual([dds_links.is_inside(value, there) for value in (0.5, 1, 2.5, 3, 4)],
                         [False, True, True, True, False])
        self.assertTrue(dds_links.is_inside(8, {"first_least": "8.2", "first_most": "15.3"}), "8.2 ends the eighth second")


if __name__ == "__main__":
    unittest.main()
