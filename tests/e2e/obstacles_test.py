#!/usr/bin/env python3
"""Walls attenuate as the radio says: with `obstacles: true` a run takes another course, unless the antennas
stand above all walls."""
import unittest

from baraka import CASE_STUDY, Case


class Obstacles(Case):
    def fingerprint(self, *settings):
        arguments = [word for setting in settings for word in ("--set", setting)]
        finished = self.run_baraka(CASE_STUDY, "--until", "5", "--controllers", "in-process", *arguments)
        self.assertEqual(finished["result"], "until")
        return finished["fingerprint"]

    def test_a_wall_between_motes_changes_the_run(self):
        free = self.fingerprint()
        self.assertNotEqual(self.fingerprint("radio.obstacles=true"), free)
        over_the_wall = ("radio.obstacles=true", "radio.antenna_height=1.5 m")  # it is 1 m high
        self.assertEqual(self.fingerprint(*over_the_wall), free)


if __name__ == "__main__":
    unittest.main()
