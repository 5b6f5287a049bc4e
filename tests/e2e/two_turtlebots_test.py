#!/usr/bin/env python3
"""config/scenarios/two_turtlebots.yaml: one robot sees the goal, the other is told of it, and both end there."""
from baraka import ROOT, Case, unittest

SCENARIO = ROOT / "config/scenarios/two_turtlebots.yaml"


class TwoTurtlebots(Case):
    def states(self):
        """Of each robot, in order of time."""
        found = {}
        for name, state in self.query("SELECT name, state FROM states JOIN agents USING (agent) ORDER BY at_ns"):
            found.setdefault(name, []).append(state)
        return found

    def test_one_finds_the_goal_and_tells_the_other_in_process_and_over_dds(self):
        prints = []
        for how in ("in-process", "spawn"):
            finished = self.run_baraka(SCENARIO, "--controllers", how)
            self.assertEqual(finished["result"], "met")
            self.assertEqual(sorted(self.states().values()),
                             [["SEARCHING", "FOUND", "ARRIVED"], ["SEARCHING", "TOLD", "ARRIVED"]])
            self.assertEqual(self.query("SELECT sum(wall_steps) FROM bodies"), [(0,)])
            prints.append(finished["fingerprint"])
        self.assertEqual(prints[0], prints[1])

    def test_without_reach_of_the_radio_nobody_is_told(self):
        self.run_baraka(SCENARIO, "--controllers", "in-process", "--set", "radio={profile: ideal, range: 1 mm}",
                        "--until", 40)
        self.assertNotIn("TOLD", sum(self.states().values(), []))
        self.assertIn("FOUND", sum(self.states().values(), []))


if __name__ == "__main__":
    unittest.main()
