#!/usr/bin/env python3
"""The base field of AntHocNet, shortened: messages of moving stations arrive over several hops, the same seed gives the
same run, and keys of other algorithms are mistakes."""
import unittest

from baraka import ROOT, Case

FIELD = ROOT / "config/scenarios/anthocnet_base_field.yaml"
SHORT = ("--controllers", "in-process", "--no-inspect", "--set", "end=[{at: 40 s, result: done}]")
# All sources from the beginning.
AT_ONCE = ("--set", "agents.sources.controller.overrides=["
           + ", ".join(f"{{agents: s{i}, parameters: {{to: t{i}}}}}" for i in range(20)) + "]")


class BaseField(Case):
    def test_messages_arrive_over_several_hops_and_the_seed_decides_all(self):
        runs = [self.run_baraka(FIELD, *SHORT, *AT_ONCE)["fingerprint"] for _ in range(2)]
        self.assertEqual(runs[0], runs[1])
        sent, arrived = self.query("SELECT count(*), sum(verdict = 'delivered') FROM messages")[0]
        self.assertGreaterEqual(sent, 20 * 39)
        self.assertGreater(arrived, 0.5 * sent)
        farthest, = self.query("SELECT max(transmissions) FROM deliveries")[0]
        self.assertGreaterEqual(farthest, 4)

    def test_keys_of_another_algorithm_are_mistakes(self):
        for setting, said in (("{algorithm: anthocnet, beta: 3}", "beta"), ("{algorithm: ants, beta_data: 3}", "beta_data"),
                              ("{algorithm: anthocnet, hello_destinations: 21}", "20")):
            with self.subTest(setting=setting):
                finished = self.run_baraka(FIELD, *SHORT, "--set", f"routing={setting}", status=2)
                self.assertIn(said, finished.err)


if __name__ == "__main__":
    unittest.main()
