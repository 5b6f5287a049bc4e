#!/usr/bin/env python3
"""Robots in URDF and SDF, as a user has them: in a scenario, as a robot file, without the program that reads them."""
import os
import pathlib
import shutil
import subprocess
import unittest

from baraka import BIN, ROOT, Case, Program

ROBOTS = ROOT / "tests/unit/programs/models/robots"
BURGER = ROBOTS / "turtlebot3_burger.urdf"
DRIVE = "{left: wheel_left_joint, right: wheel_right_joint, casters: caster_back_link}"
LIMITS = "wheels: {wheel: {limit: {effort: 1.4 N m, velocity: 6.67 rad/s}}}"


@unittest.skipUnless((BIN / "baraka-sdf").exists(), "needs libsdformat-dev, libassimp-dev and libtinyxml2-dev")
class Models(Case):
    def scenario(self, robot):
        """The room of two TurtleBots, with other robots."""
        file = self.folder / "scenario.yaml"
        text = (ROOT / "config/scenarios/two_turtlebots.yaml").read_text()
        file.write_text(text.replace("include: ../robots/turtlebot3_burger.yaml", robot.replace("\n", "\n      ")))
        return file

    def burger(self):
        return self.scenario(f"urdf: {BURGER}\ndrive: {DRIVE}\n{LIMITS}\nencoder_steps: 4096")

    def alone(self, reader=None):
        """`baraka` in a folder without baraka-sdf, or with a program in its place."""
        folder = self.folder / "bin"
        folder.mkdir()
        shutil.copy(BIN / "baraka", folder)
        if reader is not None:
            (folder / "baraka-sdf").write_text(reader)
            (folder / "baraka-sdf").chmod(0o755)
        done = subprocess.run([folder / "baraka", "check", self.burger()], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=60, env={**os.environ, "PATH": "/usr/bin:/bin",
                                                          "BARAKA_CONTROLLER_PATH": str(BIN)})
        self.assertEqual(done.returncode, 2, done)
        return done.stderr

    def test_a_robot_in_urdf_does_its_task_and_again_the_same(self):
        first = self.run_baraka(self.burger(), "--controllers", "in-process")
        self.assertEqual(first["result"], "met")
        again = self.run_baraka(self.burger(), "--controllers", "in-process")
        self.assertEqual(first["fingerprint"], again["fingerprint"])

    def test_the_printed_robot_file_is_the_same_robot(self):
        printed = Program("baraka", "robot", "from", BURGER, "--drive", DRIVE).finish()
        self.assertEqual(printed.status, 0, printed)
        (self.folder / "burger.yaml").write_text(printed.out)
        by_yaml = self.run_baraka(self.scenario(f"include: {self.folder}/burger.yaml\n{LIMITS}\nencoder_steps: 4096"),
                                  "--controllers", "in-process")
        by_urdf = self.run_baraka(self.burger(), "--controllers", "in-process")
        self.assertEqual(by_yaml["fingerprint"], by_urdf["fingerprint"])

    def test_check_says_once_what_is_left_out(self):
        file = self.scenario(f"urdf: {ROBOTS}/left_out.urdf\ndrive: {{left: left_joint, right: right_joint}}")
        done = Program("baraka", "check", file, env={"BARAKA_CONTROLLER_PATH": str(BIN)}).finish()
        self.assertEqual(done.err.count("<transmission> 'left_transmission'"), 1, done)
        self.assertIn("left_out.urdf:65:1: warning: agents.robots.robot: is left out: the motion of the revolute joint "
                      "'shoulder': it is held at 0", done.err)

    def test_without_the_reader_the_message_names_its_package(self):
        said = self.alone()
        self.assertRegex(said, r"scenario\.yaml:\d+:13: agents\.robots\.robot\.urdf: robots in URDF and SDF are read by baraka-sdf, "
                               "which is not installed: `apt install baraka-sdf`")

    def test_a_reader_that_crashes_is_a_mistake_at_the_key(self):
        said = self.alone("#!/bin/sh\nkill -SEGV $$\n")
        self.assertRegex(said, r"scenario\.yaml:\d+:13: agents\.robots\.robot\.urdf: baraka-sdf ended by a signal: Segmentation fault")


if __name__ == "__main__":
    unittest.main()
