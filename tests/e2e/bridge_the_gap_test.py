#!/usr/bin/env python3
"""The example of the paper's introduction: delivery before a relay fails, while it is missing, and after a robot has
taken its place."""
import pathlib
import sys
import unittest

from baraka import ROOT, Case

sys.path.insert(0, str(ROOT / "tests/validation"))
from gap import FAILS, bridged_at, delivery  # noqa: E402
from runs import Run  # noqa: E402

SCENARIO = ROOT / "config/scenarios/bridge_the_gap.yaml"
BEYOND = ("m3", "m4", "m5")


class BridgeTheGap(Case):
    def play(self, *arguments, status=0):
        finished = self.run_baraka(SCENARIO, "--controllers", "in-process", *arguments, status=status)
        return finished, Run(pathlib.Path(self.out))

    def test_delivery_comes_back_with_the_robot(self):
        finished, run = self.play()
        self.assertEqual(finished["result"], "bridged")
        there = bridged_at(run)
        self.assertGreater(there["r0"], FAILS + 60)     # 61 m at 0.8 m/s, and what comes before
        self.assertNotIn("r1", there)
        before, during, after = delivery(run, BEYOND)
        self.assertGreater(before, 0.95)
        self.assertLess(during, 0.05)
        self.assertGreater(after, 0.9)
        # Those on the sink's side never noticed.
        for share in delivery(run, ("m1",)):
            self.assertGreater(share, 0.95)

    def test_the_better_robot_goes(self):
        full = "[{kind: battery, capacity: 40 Wh, charge: 0.9, full_voltage: 25.4 V, empty_voltage: 22 V, " \
               "resistance: 100 mohm, idle_power: 10 W, radio: {listen: 0.8 W}}]"
        # With a full battery the nearer one is better. The scenario expects the other.
        _, run = self.play("--set", f"agents.tired.robot.sensors={full}", status=3)
        self.assertEqual(list(bridged_at(run)), ["r1"])
        # If energy does not count, it goes as it is.
        _, run = self.play("--set", "agents.tired.controller.parameters={energy_weight: 0}",
                           "--set", "agents.rested.controller.parameters={energy_weight: 0}", status=3)
        self.assertEqual(list(bridged_at(run)), ["r1"])

    def test_a_small_full_battery_has_less_than_a_large_one(self):
        battery = "[{{kind: battery, capacity: {} Wh, charge: {}, full_voltage: 25.4 V, idle_power: 10 W, " \
                  "radio: {{listen: 0.8 W}}}}]"
        # The nearer one has 14 kJ, all it can hold; the other one has 43 kJ, less than a third.
        finished, run = self.play("--set", f"agents.tired.robot.sensors={battery.format(4, 1)}",
                                  "--set", f"agents.rested.robot.sensors={battery.format(40, 0.3)}")
        self.assertEqual(finished["result"], "bridged")
        self.assertEqual(list(bridged_at(run)), ["r0"])

    def test_if_the_better_one_dies_on_the_way_the_other_goes(self):
        _, run = self.play("--set", "events=[{at: 60 s, do: [{kill: m2}, {switch_off: m2}]}, "
                                    "{when: {agent: r0, state: GO_TO_GAP}, do: [{kill: r0}, {switch_off: r0}]}]", status=3)
        self.assertEqual(list(bridged_at(run)), ["r1"])

    def test_over_dds_it_is_the_same(self):
        prints = [self.run_baraka(SCENARIO, "--until", 100, *where)["fingerprint"]
                  for where in (("--controllers", "in-process"), ())]
        self.assertEqual(prints[0], prints[1])


if __name__ == "__main__":
    unittest.main()
