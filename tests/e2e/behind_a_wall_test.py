#!/usr/bin/env python3
"""A robot that drives behind a wall: what arrives of each frame, and whether it is received, beside the closed form with
an intersection of its own (tests/validation/scenarios.py)."""
import pathlib
import sys
import unittest

from baraka import ROOT, Case

sys.path.insert(0, str(ROOT / "tests/validation"))
from runs import Run  # noqa: E402
from scenarios import WALL, inside, rssi_behind_a_wall, way_of_the_robot  # noqa: E402

SCENARIO = ROOT / "config/scenarios/behind_a_wall.yaml"
EDGE = 0.15     # m: as far from the shadow's edge a place between two recorded poses is not exact enough to judge
SENSITIVITY = -82


def is_near_the_edge(x, y):
    """Whether the wall is hit from one side of this place and not from the other."""
    return (inside((x - EDGE, y), WALL) > 0) != (inside((x + EDGE, y), WALL) > 0)


class BehindAWall(Case):
    def drive(self, *settings):
        finished = self.run_baraka(SCENARIO, "--controllers", "in-process", *settings)
        self.assertEqual(finished["result"], "done")
        way = way_of_the_robot(Run(pathlib.Path(self.out)))
        self.assertGreater(len(way), 950)  # 20 a second, 50 s
        self.assertLess(way[0][0], -19)
        self.assertGreater(way[-1][0], 19)
        return way

    def test_frames_are_lost_where_the_wall_stands_between(self):
        lost = {True: 0, False: 0}
        for x, y, rssi, delivered in self.drive():
            if is_near_the_edge(x, y):
                continue
            expected = rssi_behind_a_wall((x, y))
            self.assertAlmostEqual(rssi, expected, delta=0.05, msg=f"dBm, at {x}, {y}")
            self.assertEqual(delivered, expected >= SENSITIVITY, f"at {x}, {y}")
            lost[inside((x, y), WALL) > 0] += not delivered
        self.assertGreater(lost[True], 400)  # 20 m of the way
        self.assertEqual(lost[False], 0)

    def test_without_obstacles_all_arrive(self):
        for x, y, rssi, delivered in self.drive("--set", "radio.obstacles=false"):
            self.assertAlmostEqual(rssi, rssi_behind_a_wall((x, y), has_wall=False), delta=0.05)
            self.assertTrue(delivered, f"at {x}, {y}")

    def test_another_material_takes_as_much_as_it_says(self):
        way = self.drive("--set", "world.walls=[{size: [10 m, 30 cm, 2 m], position: [0 m, 5 m], "
                                  "radio_loss: {per_crossing: 3 dB, per_metre: 10 dB/m}}]")
        for x, y, rssi, delivered in way:
            if is_near_the_edge(x, y):
                continue
            length = inside((x, y), WALL)
            loss = 3 + 10 * length if length > 0 else 0
            self.assertAlmostEqual(rssi, rssi_behind_a_wall((x, y), has_wall=False) - loss, delta=0.1)
        self.assertTrue(any(delivered and inside((x, y), WALL) > 0 for x, y, _, delivered in way))

    def test_over_dds_it_is_the_same(self):
        prints = [self.run_baraka(SCENARIO, "--until", 16, *where)["fingerprint"]
                  for where in (("--controllers", "in-process"), ())]
        self.assertEqual(prints[0], prints[1])


if __name__ == "__main__":
    unittest.main()
