#!/usr/bin/env python3
"""Observables of a run: that they are what they say, and that to look changes nothing."""
import csv
import io
import unittest

from baraka import CASE_STUDY, ROOT, Case, Program

TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
ALL = ["{name: agents.*.*, every: 370 ms, as: quantiles}", "{name: radio.*.*, on: change}",
       "{name: routing.*.*, every: 1 s}", "{name: sensors.r*.odometry.*, on: change, as: histogram}",
       "{name: messages.*.*, on: change, as: counter}"]
SUMS = "SELECT name, agent, s.* FROM observable_sums s JOIN observables USING (observable) ORDER BY 1, 2, 3"
SAMPLES = "SELECT * FROM observable_samples"


def observing(*entries):
    return "--set", f"record.observables=[{', '.join(entries)}]"


class Observables(Case):
    def inside(self, scenario, *arguments, **more):
        return self.run_baraka(scenario, "--controllers", "in-process", *arguments, **more)

    def samples(self, name):
        return self.query("SELECT a.name, at_ns / 1e9, value FROM observable_samples JOIN observables o "
                          f"USING (observable) JOIN agents a USING (agent) WHERE o.name = '{name}'")

    def test_to_look_changes_nothing(self):
        plain = self.inside(CASE_STUDY, "--until", 60)
        looked_at = self.inside(CASE_STUDY, "--until", 60, *observing(*ALL))
        for key in ("fingerprint", "result", "simulated_s", "events", "exchanges"):
            self.assertEqual(plain[key], looked_at[key], key)
        counts = dict(self.query("SELECT name, SUM(count) FROM observable_sums JOIN observables "
                                 "USING (observable) GROUP BY name"))
        agents = self.query("SELECT COUNT(*) FROM agents")[0][0]
        self.assertEqual(counts["agents.x"], (60000 // 370 + 1) * agents)
        self.assertEqual(counts["agents.wheel_speed.0"], 60000 // 370, "a rate has no value at 0")
        self.assertGreater(counts["messages.delay"], 0)

    def test_over_dds_and_in_process_they_are_equal(self):
        inside = self.inside(TWO_MOTES, *observing(*ALL[1:3]))
        rows = self.query(SUMS), self.query(SAMPLES)
        over_dds = self.run_baraka(TWO_MOTES, *observing(*ALL[1:3]))
        self.assertEqual(inside["fingerprint"], over_dds["fingerprint"])
        self.assertEqual(rows, (self.query(SUMS), self.query(SAMPLES)))
        self.assertGreater(len(rows[1]), 0)

    def test_a_repetition_sees_what_the_run_in_real_time_saw(self):
        wanted = observing("{name: agents.r*.*, every: 130 ms}", "{name: radio.*.*, on: change}")
        self.run_baraka(CASE_STUDY, "--pace", "realtime:4", "--until", 6, *wanted)
        first, rows = self.out, (self.query(SUMS), self.query(SAMPLES))
        self.assertEqual(self.query("SELECT COUNT(*) FROM observables WHERE name = 'agents.x'")[0][0], 1)
        self.run_baraka(CASE_STUDY, "--repeat", first, *wanted)
        self.assertEqual(rows, (self.query(SUMS), self.query(SAMPLES)))

    def test_they_are_what_the_run_was(self):
        self.inside(CASE_STUDY, "--until", 30, *observing(
            "{name: agents.r0.x, every: 1 s}", "{name: agents.r0.speed, every: 7 ms, as: histogram, bins: 20}",
            "{name: radio.*.frames_sent, every: 100 s}", "{name: agents.r0.x, as: quantiles}",
            "{name: messages.*.received, every: 30 s}"))
        places = self.samples("agents.x")
        self.assertEqual([at for _, at, _ in places], [float(s) for s in range(31)])
        kept = dict(self.query("SELECT at_ns / 1000000000, p.x_m FROM poses p JOIN agents USING (agent) "
                               "WHERE name = 'r0' AND at_ns % 1000000000 = 0"))
        for _, at, x in places:
            if at in kept:
                self.assertAlmostEqual(x, kept[at], places=12)
        self.assertEqual(self.query("SELECT SUM(count) FROM observable_bins")[0][0], 30000 // 7 + 1)
        self.assertEqual({value for _, _, value in self.samples("radio.frames_sent")}, {0.0})
        received = {who: value for who, at, value in self.samples("messages.received") if at == 30}
        for who, count in self.query("SELECT name, (SELECT COUNT(*) FROM deliveries WHERE receiver = agent) "
                                     "FROM agents"):
            self.assertEqual(received[who], count, who)

    def test_csv_has_them(self):
        self.inside(TWO_MOTES, *observing("{name: radio.m0.idle_share, every: 4 s}"))
        finished = Program("baraka", "export", self.out, "observable_samples").finish()
        rows = list(csv.DictReader(io.StringIO(finished.out)))
        self.assertEqual([int(row["at_ns"]) for row in rows], [4_000_000_000, 8_000_000_000])
        for row in rows:
            self.assertTrue(0.9 < float(row["value"]) <= 1 + 1e-9, row)

    def test_what_controllers_record_is_known_by_its_unit(self):
        self.inside(ROOT / "config/scenarios/two_motes.yaml", "--set", "agents.motes.controller="
                    "{program: traffic_sink}", *observing("{name: controllers.*.goodput, on: change}"))
        self.assertEqual(self.query("SELECT name, unit, count, last FROM observables JOIN observable_sums "
                                    "USING (observable)"), [("controllers.goodput", "bit/s", 1, 0.0)] * 2)
        self.assertEqual(self.query("SELECT program, unit FROM recorded_units WHERE name = 'goodput'"),
                         [("traffic_sink", "bit/s")])

    def test_samples_are_bounded(self):
        self.inside(TWO_MOTES, *observing("{name: radio.m0.queue, every: 10 ms, most: 100}"))
        self.assertEqual(self.query("SELECT left_out, (SELECT COUNT(*) FROM observable_samples), count "
                                    "FROM observables JOIN observable_sums USING (observable)"), [(901, 100, 1001)])

    def mistake(self, entry):
        finished = Program("baraka", "check", TWO_MOTES, *observing(entry)).finish()
        self.assertEqual(finished.status, 2, finished)
        return finished.err

    def test_a_name_that_nothing_has_is_a_mistake(self):
        for entry, words in (
                ("{name: agent.*.x}", "did you mean 'agents'?"),
                ("{name: agents.r*.x}", "'r*' matches no agent"),
                ("{name: agents.*.spead}", "did you mean 'speed'?"),
                ("{name: agents.x}", "must have three parts"),
                ("{name: sensors.*.odometry.x}", "have no 'odometry.x' in sensors"),
                ("{name: agents.*.x, every: 1 s, on: change}", "cannot be combined with on"),
                ("{name: agents.*.x, bins: 3}", "needs `as: histogram`"),
                ("{name: agents.*.x, as: histogram, range: [1, 1]}", "must begin below its end"),
                ("{name: agents.*.x}, {name: agents.m0.x, every: 2 s}", "asked for at"),
                ("{name: agents.*.x, as: sample}", "is not one of samples, histogram")):
            self.assertIn(words, self.mistake(entry), entry)


if __name__ == "__main__":
    unittest.main()
