#!/usr/bin/env python3
"""Packet error rates from a file: what they do, and that a run is known by their content, not by their file."""
import unittest

from baraka import Case, Program

SCENARIO = """version: 1
name: table
seed: 3
controller_latency: 0 s
routing: none
record: {frames: all}
radio: {profile: ieee80211n, aggregation: {max_ampdu: 0}, error_table: tables/per.csv}
agents:
  a: {name: a, station: {}, poses: [{x: 0 m, y: 0 m}],
      controller: {program: traffic_source, parameters: {topic: t, to: b, pattern: periodic, rate: 50 Hz, size: 500}}}
  b: {name: b, station: {}, poses: [{x: 5 m, y: 0 m}], controller: {program: traffic_sink, parameters: {topic: t}}}
end: [{at: 2 s, result: done}]
"""
IN_PROCESS = ("--controllers", "in-process")


class ErrorTable(Case):
    def setUp(self):
        super().setUp()
        self.scenario = self.folder / "scenario.yaml"
        self.scenario.write_text(SCENARIO)
        (self.folder / "tables").mkdir()

    def write_table(self, per, mode="HT7", low=1):
        """Above 1 dB the error rate is `per`."""
        (self.folder / "tables/per.csv").write_text(f"mode,size,snr_db,per\n{mode},500,0,{low}\n{mode},500,1,{per}\n")

    def play(self, *arguments):
        finished = self.run_baraka(self.scenario, *IN_PROCESS, *arguments)
        (sent, again), = self.query("SELECT count(*), sum(retry) FROM frames WHERE class = 'unicast'")
        return finished["fingerprint"], again / sent

    def test_its_content_decides_what_arrives_and_is_part_of_the_run(self):
        self.write_table(0)
        right, retries = self.play()
        self.assertEqual(retries, 0)
        self.write_table(0.4)
        recorded, retries = self.play()
        self.assertNotEqual(recorded, right)
        self.assertAlmostEqual(retries, 0.4, delta=0.1)  # of 167 frames; 0.1: 2.6 standard deviations
        first = self.out
        self.assertIn("HT7,500,1,0.4", (first / "scenario.resolved.yaml").read_text())
        self.write_table(0, mode="HT6")
        self.assertEqual(self.play()[0], right, "other modes keep the formula, with which all arrive")
        (self.folder / "tables/per.csv").unlink()
        again = self.run_baraka(first / "scenario.resolved.yaml", *IN_PROCESS)
        self.assertEqual(again["fingerprint"], recorded, "without the file")

    def test_another_content_is_another_experiment(self):
        self.write_table(0)
        series = ("run", self.scenario, *IN_PROCESS, "--replications", 2, "--out", self.folder / "series")
        self.assertEqual(Program("baraka", *series).finish().status, 0)
        self.write_table(0.5)
        refused = Program("baraka", *series).finish()
        self.assertEqual(refused.status, 2)
        self.assertIn("another scenario", refused.err)

    def test_a_mistake_has_the_line_of_the_table(self):
        self.write_table(0.5, low=0.1)
        finished = Program("baraka", "check", self.scenario).finish()
        self.assertEqual(finished.status, 2)
        self.assertEqual(finished.err, f"{self.scenario}:7:72: radio.error_table: {self.folder}/tables/per.csv:3: "
                         "per: 0.5 is above that of the row before, 0.1, which has a lower SNR\n")


if __name__ == "__main__":
    unittest.main()
