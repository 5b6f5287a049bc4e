#!/usr/bin/env python3
"""config/scenarios/push_boxes.yaml: robots push movables, and results have their poses."""
from baraka import ROOT, Case, unittest

SCENARIO = ROOT / "config/scenarios/push_boxes.yaml"


class PushBoxes(Case):
    def test_robots_push_some_and_leave_others(self):
        prints = [self.run_baraka(SCENARIO, "--controllers", how)["fingerprint"] for how in ("in-process", "in-process")]
        self.assertEqual(prints[0], prints[1])
        self.assertEqual(self.query("SELECT form, COUNT(*) FROM movables GROUP BY form ORDER BY form"),
                         [("box", 88), ("cylinder", 6), ("sphere", 6)])
        self.assertEqual(self.query("SELECT COUNT(*) FROM movable_poses WHERE at_ns = 0"), [(100,)])
        moved = self.query("SELECT COUNT(*) FROM (SELECT MAX(x_m) - MIN(x_m) AS x, MAX(y_m) - MIN(y_m) AS y "
                           "FROM movable_poses GROUP BY movable) WHERE x > 0.1 OR y > 0.1")[0][0]
        self.assertGreater(moved, 10)
        self.assertLess(moved, 90)
        # In the hall, and not in the ground: half of the least size is 0.1 m.
        self.assertEqual(self.query("SELECT COUNT(*) FROM movable_poses WHERE ABS(x_m) > 5 OR ABS(y_m) > 5 OR z_m < 0.095"),
                         [(0,)])
        self.assertGreater(self.query("SELECT SUM(object_steps) FROM bodies")[0][0], 100)


if __name__ == "__main__":
    unittest.main()
