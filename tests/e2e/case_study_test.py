#!/usr/bin/env python3
"""The case study of the paper, played to its end and judged by what is known independently of it:
the network's links, the least delays, that the robot arrives and does not touch the wall."""
import unittest

from baraka import CASE_STUDY, Case, Program

# Neighbours of each mote, row by row from the bottom: Friis with a wavelength of 0.125 m, 2 mW and
# -85 dBm reaches 250.16 m on a grid of 125 m.
DEGREES = [5, 7, 8, 7, 5, 7, 10, 11, 10, 7, 8, 11, 12, 11, 8, 7, 10, 11, 10, 7, 5, 7, 8, 7, 5]
# 802.11 at 11 Mb/s with RTS/CTS, 272-bit headers and nothing in them, ns: DIFS + RTS + SIFS + CTS +
# SIFS + DATA; and a broadcast of the forward ant plus a unicast of the backward one.
LEAST_DELAY = 695454
LEAST_DISCOVERY = 962181
# Each further hop adds at least SIFS + ACK + DIFS + RTS + SIFS + CTS + SIFS + DATA.
LEAST_FURTHER_HOP = 907636


class CaseStudy(Case):
    def test_over_dds_in_two_processes_the_robot_arrives_and_the_report_says_so(self):
        finished = self.run_baraka(CASE_STUDY)
        self.assertEqual(finished["result"], "arrived")
        for key in ("fingerprint", "simulated_s", "wall_s", "real_time_factor", "events",
                    "exchanges"):
            self.assertRegex(finished[key], r"^[0-9a-f.]+$")
        report = Program("baraka", "report", self.out).finish()
        self.assertEqual(report.status, 0, str(report))
        self.assertRegex(report.out, r"mobility_framework +1 +arrived")
        self.assertIn("102 links", report.out)
        self.assertEqual(self.run_baraka(CASE_STUDY, "--controllers", "in-process")["fingerprint"], finished["fingerprint"])

    def test_ten_seeds_hold_what_does_not_depend_on_calibration(self):
        outs, near_the_wall, paths, times = [], 0, [], []
        for seed in range(1, 11):
            finished = self.run_baraka(CASE_STUDY, "--seed", seed, "--controllers", "in-process")
            self.assertEqual(finished["result"], "arrived", f"seed {seed}")
            outs.append(self.out)
            times.append(float(finished["simulated_s"]))
            (clearance, path, contacts), = self.query(
                "SELECT clearance_m, path_m, wall_steps FROM bodies JOIN agents USING (agent)"
                " WHERE name = 'r0'")
            near_the_wall += clearance < 0.8
            paths.append(path)
            self.assertEqual(contacts, 0, f"seed {seed} touches the wall")
        self.assertGreaterEqual(near_the_wall, 8)
        straight = (242 ** 2 + 367 ** 2) ** 0.5  # from (8, 8) to (250, 375) m
        self.assertLessEqual(sum(paths) / 10, 2 * straight)
        self.assertLessEqual(max(paths), 4 * straight)
        self.assertTrue(400 <= sum(times) / 10 <= 1000, times)
        self.check_delays(outs)

    def longest_search(self, seed, *more):
        """@return begin and duration, ns, of the longest search of the first 130 s for a route that found one."""
        self.run_baraka(CASE_STUDY, "--seed", seed, "--controllers", "in-process", "--until", 130, *more)
        return self.query("SELECT ended_ns - took_ns, took_ns FROM discoveries WHERE found ORDER BY took_ns DESC LIMIT 1")[0]

    def test_a_short_jitter_loses_searches_to_collisions_of_their_own_ants(self):
        short = ("--set", "routing.jitter_max=1 ms", "--set", "routing.retry_jitter=0")
        for seed in range(1, 11):
            begin, took = self.longest_search(seed, *short)
            if took > 1e9:
                break
        self.assertTrue(5e9 < took < 5.1e9, f"{took} ns: repeated once, after 5 s")
        ends = dict(self.query(
            "SELECT verdict, count(*) FROM frame_ends e JOIN frames f USING (frame) JOIN agents a ON a.agent = e.agent WHERE "
            f"a.name = 'm17' AND packet = 'forward ant' AND f.at_ns BETWEEN {begin} AND {begin + 1e9} GROUP BY verdict"))
        self.assertNotIn("delivered", ends)
        self.assertGreater(sum(ends.values()), 0, "copies came, and met")
        self.assertLessEqual(set(ends), {"collision", "preamble missed"}, "none was taken by a loss")
        self.assertLess(self.longest_search(seed)[1], 0.2e9, "not with the jitter as it ships")

    def check_delays(self, outs):
        delays, discoveries = [], []
        for out in outs:
            delays += self.query(
                "SELECT delay_ns, transmissions FROM deliveries JOIN messages USING (sender, id)"
                " WHERE destination != 65535", out)
            discoveries += self.query("SELECT took_ns FROM discoveries WHERE found", out)
        for delay, hops in delays:
            self.assertGreaterEqual(delay, LEAST_DELAY + (hops - 1) * LEAST_FURTHER_HOP)
        self.assertGreater(len({hops for _, hops in delays}), 3, "paths of several lengths")
        self.assertEqual(min(delays)[0], LEAST_DELAY)
        self.assertEqual(min(discoveries)[0], LEAST_DISCOVERY)

    def test_the_network_has_the_links_of_the_geometry(self):
        self.run_baraka(CASE_STUDY, "--until", "0.5", "--controllers", "in-process")
        links = self.query("SELECT a.name, b.name FROM links JOIN agents a ON a.agent = links.a"
                           " JOIN agents b ON b.agent = links.b")
        motes = [link for link in links if all(name.startswith("m") for name in link)]
        self.assertEqual(len(motes), 102)
        degrees = [sum(f"m{i}" in link for link in motes) for i in range(25)]
        self.assertEqual(degrees, DEGREES)

    def test_other_radios_side_by_side(self):
        outs = []
        for profile in ("mobility_framework", "ideal", "disk"):
            self.run_baraka(CASE_STUDY, "--controllers", "in-process", "--until", 60, "--set",
                            f"radio.profile={profile}")
            outs.append(self.out)
        report = Program("baraka", "report", *outs).finish()
        self.assertEqual(report.status, 0, str(report))
        self.assertRegex(report.out, r"figure +paper +basis +mobility_framework +ideal +disk")


if __name__ == "__main__":
    unittest.main()
