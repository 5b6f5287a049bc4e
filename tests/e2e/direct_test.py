#!/usr/bin/env python3
"""Agents without routing and without bodies, and shipped traffic: the radio from YAML alone. Figures are
those of the analytic tests of the library (tests/analytic/radio), which has them from ns-3.37."""
import math
import statistics
import unittest

from baraka import ROOT, Case, Program

SCENARIOS = ROOT / "config/scenarios"


class Direct(Case):
    def play(self, scenario, *arguments, dds=False):
        """The run's own values: {agent: {name: value}}."""
        where = () if dds else ("--controllers", "in-process")
        self.finished = self.run_baraka(SCENARIOS / f"{scenario}.yaml", *arguments, *where)
        self.assertEqual(self.finished["result"], "until" if "--until" in arguments else "done")
        recorded = {}
        for agent, name, value in self.query("SELECT a.name, r.name, r.value FROM recorded r "
                                             "JOIN agents a USING (agent)"):
            recorded.setdefault(agent, {})[name] = value
        return recorded

    def assert_within(self, found, expected, share):
        self.assertLessEqual(abs(found - expected), share * expected, f"{found} instead of {expected}")

    def goodput(self, scenario, sink, *arguments, seeds=(1,)):
        """Mb/s, mean of seeds."""
        return statistics.mean(self.play(scenario, "--seed", seed, *arguments)[sink]["goodput"]
                               for seed in seeds) / 1e6

    def test_saturation_is_that_of_the_library(self):
        for senders, rts, expected in ((1, False, 6.048), (5, False, 6.261), (10, False, 6.001),
                                       (10, True, 4.778)):
            found = self.goodput("saturation", "sink", "--set", f"agents.sources.circle.count={senders}",
                                 "--set", f"radio.rts_threshold={0 if rts else 2347}")
            self.assert_within(found, expected, 0.015)

    def test_a_saturated_source_is_told_of_every_message(self):
        recorded = self.play("saturation", "--until", 1)
        sources = [values for name, values in recorded.items() if name != "sink"]
        self.assertEqual(len(sources), 10)
        for values in sources:
            ended = values["handed_over"] + values["failed"] + values["queue_full"]
            self.assertEqual(values["sent"] - ended, 2)  # its backlog

    def test_hidden_terminals_are_rescued_by_rts_at_2_mb_per_s(self):
        without = self.goodput("hidden_terminal", "receiver")
        with_rts = self.goodput("hidden_terminal", "receiver", "--set", "radio.rts_threshold=0")
        self.assertGreater(with_rts, 1.8 * without)
        self.assert_within(without, 0.612, 0.12)  # as in hidden_terminal_test.cpp
        self.assert_within(with_rts, 1.374, 0.05)

    def test_the_range_is_that_of_the_power_law(self):
        recorded = self.play("range")
        # 40 mW, -82 dBm, Friis at 2.412 GHz.
        reach = 299792458 / 2.412e9 / (4 * math.pi) * math.sqrt(40 / 10 ** -8.2)
        for post in range(20):
            received = recorded[f"p{post}"]["received"]
            self.assertEqual(received > 0, 50 * (post + 1) < reach, f"p{post}")
            if received:
                self.assertGreaterEqual(received, recorded["sender"]["sent"] - 2)
        # The walker leaves it at 20 m/s: it hears 20 messages a second until then.
        self.assert_within(recorded["walker"]["received"], (reach - 1) / 20 * 20, 0.007)

    def test_the_near_station_starves_the_far_one(self):
        near, far = {}, {}
        for margin in ("10 dB", "none"):
            recorded = self.play("near_far", "--set", f"radio.capture_margin={margin}")
            near[margin], far[margin] = (recorded[name]["handed_over"] for name in ("near", "far"))
        self.assertGreater(near["10 dB"], 5 * far["10 dB"])
        self.assertGreater(near["10 dB"], 1.02 * near["none"])

    def test_a_source_keeps_its_rate_with_a_latency(self):
        recorded = self.play("handover", "--until", 3, "--set", "controller_latency=10 ms")
        self.assertIn(recorded["walker"]["sent"], range(395, 402))  # from 1 s on, 200 a second

    def test_in_real_time_no_timer_is_set_in_the_past(self):
        recorded = self.play("handover", "--until", 4, "--pace", "realtime:20")
        self.assertGreater(recorded["walker"]["sent"], 0)
        self.assertNotIn("set_timer", (self.out / "run.log").read_text())

    def test_paths_are_recorded_and_closed_form(self):
        self.play("range", "--until", 10)
        poses = self.query("SELECT p.at_ns / 1e9, p.x_m FROM poses p JOIN agents a USING (agent) "
                           "WHERE a.name = 'walker'")
        self.assertGreaterEqual(len(poses), 99)  # every 100 ms
        for at, x in poses:
            self.assertAlmostEqual(x, 1 + 20 * at, places=6)
        (kinds,), = self.query("SELECT count(*) FROM agents WHERE kind = 'station'")
        self.assertEqual(kinds, 22)

    def test_over_dds_it_is_the_same(self):
        for scenario, until in (("range", 3), ("hidden_terminal", 0.3)):
            in_process = self.play(scenario, "--until", until)
            first = self.finished["fingerprint"]
            self.assertEqual(self.play(scenario, "--until", until, dds=True), in_process)
            self.assertEqual(self.finished["fingerprint"], first, scenario)

    def test_the_case_study_of_one_hop_needs_no_ants(self):
        arguments = ("--until", 40, "--controllers", "in-process")
        case_study = SCENARIOS / "case_study.yaml"
        routed = self.run_baraka(case_study, *arguments)
        (searches,), = self.query("SELECT count(*) FROM discoveries")
        direct = self.run_baraka(case_study, *arguments, "--set", "routing=none")
        (none,), = self.query("SELECT count(*) FROM discoveries")
        motes_alone = self.run_baraka(case_study, *arguments, "--set", "agents.motes.routing=none")
        every_group = self.run_baraka(case_study, *arguments, "--set", "routing=none", "--set",
                                      "agents.motes.routing=ants", "--set", "agents.robots.routing=ants")
        self.assertGreater(searches, 0)
        self.assertEqual(none, 0)
        self.assertEqual(every_group["fingerprint"], routed["fingerprint"])
        for other in (direct, motes_alone):
            self.assertNotEqual(other["fingerprint"], routed["fingerprint"])
        # Messages have fates and verdicts as ever.
        self.assertEqual(self.query("SELECT count(*) FROM messages WHERE verdict IS NULL AND fate IS NULL "
                                    "AND sent_ns < 39e9"), [(0,)])

    def test_mistakes_are_told(self):
        def check(*overrides):
            arguments = [part for override in overrides for part in ("--set", override)]
            finished = Program("baraka", "check", SCENARIOS / "range.yaml", *arguments).finish()
            self.assertEqual(finished.status, 2, str(finished))
            return finished.err

        self.assertIn("routing: 'nobody' is not", check("routing=nobody"))
        self.assertIn("agents.walker.routing: 'oadv' is not one of ants, anthocnet, aodv, flooding, static, none",
                      check("agents.walker.routing=oadv"))
        self.assertIn("line.speed: 0 m/s is below", check("agents.walker.station.path.line.speed=0 m/s"))
        self.assertIn("line: cannot be combined with circle", check("agents.posts.circle={count: 2, radius: 1 m}"))
        self.assertIn("is not one of saturated", check("agents.sender.controller.parameters.pattern=wild"))
        self.assertIn("to: there is no agent 'ghost'", check("agents.sender.controller.parameters.to=ghost"))


if __name__ == "__main__":
    unittest.main()
