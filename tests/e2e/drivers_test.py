#!/usr/bin/env python3
"""The drivers against emulated devices, each a process of its own."""
import json
import math
import os
import signal
import sys
import time
import unittest

from emulated import HARDWARE, Case, Emulator, Probe, Robotino

CONNECTED = "connected"
# A busy machine holds up a command or the device's emulator until the device stops by its rule. A driver that leaves it
# without commands, or forgets the timeout, does so each time.
ATTEMPTS = 8


def drive_for(probe, velocity, seconds):
    """Drives as a controller does: the velocity again every 50 ms."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        probe.ask("drive {} {} {}".format(*velocity))
        time.sleep(0.05)


class Wheels:
    """What holds for every driver of wheels."""
    rule = None       # s, of the device
    tolerance = None  # of velocities, m/s and rad/s

    command_timeout = "60 s"  # longer than a test, but where it is about that

    def begin(self, env=None):
        self.emulate()
        self.probe = self.started(self.drivers(env=env))
        self.await_connection()

    def await_connection(self):
        self.wait_for(lambda: self.probe.condition()[0] == CONNECTED, "connected")

    def await_moving(self):
        return self.await_truth(lambda truth: truth["moving"], "the wheels turn")

    def await_truth(self, holds, what):
        """The first state of the device of which that holds: a busy machine may not keep it up."""
        def fitting():
            truth = self.truth()
            return truth if holds(truth) else None
        return self.wait_for(fitting, what)

    def await_standing(self):
        self.wait_for(lambda: not self.truth()["moving"], "the wheels stand")
        return self.truth()

    def test_one_command_keeps_the_wheels_turning(self):
        self.begin()
        for _ in range(ATTEMPTS):
            stops = self.truth()["stops_by_rule"]
            self.assertEqual(self.probe.ask("drive 0.2 0.1 0.3"), "ok")
            self.await_moving()
            time.sleep(1)
            truth = self.truth()
            if truth["moving"] and truth["stops_by_rule"] == stops:
                break
        else:
            self.fail(f"the wheels stopped by the device's rule each time: {truth}")
        self.near(truth["velocity"], [0.2, 0.1, 0.3], self.tolerance)
        self.assertEqual(self.probe.ask("stop_and_wait 5"), "ok")
        self.assertFalse(self.truth()["moving"])
        self.assertEqual(self.truth()["rejected"], 0)

    def test_a_command_holds_for_the_command_timeout_unless_it_is_kept(self):
        self.command_timeout = "500 ms"
        self.begin()
        for _ in range(ATTEMPTS):
            stops = self.truth()["stops_by_rule"]
            self.probe.ask("drive 0.2 0 0")
            self.await_moving()
            for _ in range(12):
                self.probe.ask("keep")
                time.sleep(0.1)
            turned = self.truth()["moving"]  # kept for more than twice as long
            truth = self.await_standing()
            if turned and truth["stops_by_rule"] == stops:
                break
        else:
            self.fail(f"stopped although kept, or by the device's rule, each time: {truth}")
        self.probe.ask("keep")
        time.sleep(0.3)
        self.assertFalse(self.truth()["moving"], "one that ran out does not come back")
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()

    def test_no_command_from_before_a_suspension_is_sent_after_it(self):
        """The computer sleeps for ten seconds while the wheels turn; its other clocks stand."""
        asleep = self.folder / "asleep"
        asleep.write_bytes(bytes(8))
        self.command_timeout = "500 ms"
        self.begin(env={"LD_PRELOAD": os.environ["SUSPEND"], "SUSPENDED": str(asleep)})
        for slept in range(10, 60, 10):
            self.probe.ask("drive 0.2 0 0")
            self.await_moving()
            self.probe.process.send_signal(signal.SIGSTOP)
            self.await_nothing_under_way()
            asleep.write_bytes(slept.to_bytes(8, sys.byteorder))
            before = len(self.commands())
            self.probe.process.send_signal(signal.SIGCONT)
            self.wait_for(lambda: len(self.commands()) > before + 3, "the driver goes on")
            self.assertEqual([any(c) for c in self.commands()[before:]].count(True), 0,
                             self.commands()[before:])

    def await_nothing_under_way(self):
        seen = -1
        while seen != len(self.commands()):
            seen = len(self.commands())
            time.sleep(0.02)

    def commands(self):
        """Velocities that the device was told, in order."""
        lines = self.log.read_text().splitlines(keepends=True)
        events = [json.loads(line) for line in lines if line.endswith("\n")]
        return [e["velocity"] for e in events if e["event"] == "command"]

    def test_the_device_stops_when_the_driver_is_killed(self):
        self.begin()
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()
        killed = self.probe.kill()
        truth = self.await_standing()
        self.assertGreaterEqual(truth["stops_by_rule"], 1)
        self.assertLessEqual(truth["stopped_at"] - killed, self.rule + 0.001)

    def test_the_driver_stops_the_wheels_when_it_ends(self):
        self.begin()
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()
        self.probe.process.stdin.write("quit\n")
        self.assertEqual(self.probe.process.wait(10), 0)
        truth = self.await_standing()
        self.assertEqual(truth["stops_by_rule"], 0)

    def test_velocities_beyond_the_limits_keep_their_direction(self):
        self.begin()
        self.probe.ask("drive 30 40 0")
        self.near(self.await_moving()["velocity"], [0.3, 0.4, 0], self.tolerance, "0.5 m/s are allowed")
        self.probe.ask("drive 0 0 -50")
        turning = self.await_truth(lambda truth: truth["velocity"][2] < 0, "turns")
        self.near(turning["velocity"], [0, 0, -1], self.tolerance, "1 rad/s is allowed")
        self.assertIn("must be finite", self.probe.ask("drive nan 0 0"))
        self.assertIn("must be finite", self.probe.ask("drive 0 0 inf"))

    def check_odometry_follows_the_truth(self, tolerance):
        self.begin()
        self.wait_for(lambda: self.probe.numbers("state"), "odometry, which begins where it is first read")
        drive_for(self.probe, (0.3, 0.1, 0.5), 1)
        self.assertEqual(self.probe.ask("stop_and_wait 5"), "ok")
        self.await_standing()
        truth = self.seen_from_the_start(self.truth()["pose"])
        self.assertGreater(math.hypot(*truth[:2]), 0.15)

        def agrees():
            odometry = self.probe.numbers("state")
            return odometry and all(math.isclose(a, b, abs_tol=tolerance)
                                    for a, b in zip(odometry[0][:3], truth))
        self.wait_for(agrees, f"odometry of {truth}, within {tolerance}")

    def seen_from_the_start(self, pose):
        x, y, theta = self.start
        dx, dy, turned = pose[0] - x, pose[1] - y, pose[2] - theta
        return [math.cos(theta) * dx + math.sin(theta) * dy,
                math.cos(theta) * dy - math.sin(theta) * dx,
                math.atan2(math.sin(turned), math.cos(turned))]

    def check_the_driver_comes_back_after_the_device(self):
        self.begin()
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()
        self.lose_device()
        self.wait_for(lambda: self.probe.condition()[0] != CONNECTED, "noticed")
        self.assertTrue(self.probe.ask("drive 0.2 0 0").startswith("error"))
        self.wait_for(lambda: self.probe.ask("state").startswith("error"), "old odometry is refused")
        self.emulate()
        self.await_connection()
        self.assertGreaterEqual(self.probe.condition()[1]["connections"], 2)
        time.sleep(0.3)
        self.assertFalse(self.truth()["moving"], "an old command must not move the robot")
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()
        self.wait_for(lambda: self.probe.numbers("state"), "odometry again")


class RobotinoWheels(Wheels, Case):
    rule = 0.2
    tolerance = 1e-9
    start = [2, 1, 2.5]
    port = 0

    def emulate(self):
        self.log = self.folder / "log"
        self.robot = self.started(Robotino("--pose", *self.start, "--log", self.log,
                                           port=self.port))
        self.port = self.robot.port

    def lose_device(self):
        self.robot.kill()

    def truth(self):
        return self.robot.state()

    def drivers(self, env=None):
        return Probe(HARDWARE / "robotino.yaml", "wheels.host=127.0.0.1",
                     f"wheels.port={self.port}", "infrared.host=127.0.0.1",
                     f"infrared.port={self.port}", "limits={linear: 0.5 m/s, angular: 1 rad/s}",
                     f"command_timeout={self.command_timeout}", env=env)

    def test_odometry_follows_the_truth(self):
        self.check_odometry_follows_the_truth(1e-6)

    def test_the_driver_comes_back_after_the_device(self):
        self.check_the_driver_comes_back_after_the_device()

    def test_a_device_that_is_not_there_yet_is_found_later(self):
        self.emulate()
        self.robot.kill()
        self.probe = self.started(self.drivers())
        self.wait_for(lambda: self.probe.condition()[1]["failures"] >= 2, "tried twice")
        self.assertIn("http://127.0.0.1", self.probe.ask("wheels"))
        self.emulate()
        self.await_connection()

    def test_bad_answers_are_errors_and_pass(self):
        self.begin()
        self.wait_for(lambda: self.probe.numbers("state"), "odometry")
        for kind in ("status_500", "bad_json", "short", "truncated", "huge", "stall", "trickle"):
            with self.subTest(kind):
                self.robot.fault("odometry", kind)
                self.wait_for(lambda: self.probe.ask("state").startswith("error"), "an error")
                self.assertEqual(self.probe.condition()[0], CONNECTED, "commands go another way")
                self.robot.fault("odometry", "none")
                self.wait_for(lambda: self.probe.numbers("state"), "odometry again")
        self.assertGreaterEqual(self.probe.condition()[1]["bad_answers"], 3)

    def test_odometry_that_no_longer_advances_is_refused(self):
        self.begin()
        self.wait_for(lambda: self.probe.numbers("state"), "odometry")
        self.robot.fault("odometry", "frozen")
        self.wait_for(lambda: "no reading for more than 0.5 s" in self.probe.ask("state"), "stale")

    def test_a_device_that_refuses_commands_is_lost_and_found(self):
        self.begin()
        for kind in ("status_500", "stall"):
            with self.subTest(kind):
                self.probe.ask("drive 0.2 0 0")
                self.await_moving()
                self.robot.fault("omnidrive", kind)
                self.wait_for(lambda: self.probe.condition()[0] != CONNECTED, "noticed")
                self.await_standing()
                self.robot.fault("omnidrive", "none")
                self.await_connection()
                self.assertFalse(self.truth()["moving"])


class RobotinoInfrared(Case):
    def begin(self, *overrides):
        world = self.folder / "world.json"
        # A wall 0.2 m in front of the body's edge, a post 0.1 m to the left at 80 degrees.
        left = math.radians(80)
        post = [(0.225 + 0.1 + 0.03) * math.cos(left), (0.225 + 0.1 + 0.03) * math.sin(left), 0.03]
        world.write_text(json.dumps({"walls": [[0.425, -1, 0.425, 1]], "cylinders": [post]}))
        self.robot = self.started(Robotino("--world", world))
        self.probe = self.started(Probe(
            HARDWARE / "robotino.yaml", "wheels.host=127.0.0.1", f"wheels.port={self.robot.port}",
            "infrared.host=127.0.0.1", f"infrared.port={self.robot.port}", *overrides))
        return self.wait_for(lambda: self.probe.numbers("infrared"), "readings")

    def test_the_array_gives_metres_and_volts_per_sensor(self):
        metres, volts, (age,) = self.begin()
        self.assertEqual(len(metres), 9)
        self.assertAlmostEqual(metres[0], 0.2, places=6)
        self.assertAlmostEqual(metres[2], 0.1, places=6)
        # 0.225 m from the edge along 40 degrees: (0.425 - 0.225 cos 40) / cos 40 = 0.330 m, beyond
        # the 0.30 m that the sensor promises.
        self.assertTrue(math.isnan(metres[1]) and math.isnan(metres[4]), metres)
        # Sharp GP2D120 at 10 cm: 1.1 … 1.4 V by the data sheet, nothing near: some 0.2 V
        self.assertTrue(1.1 < volts[2] < 1.4 and volts[4] < 0.4, volts)
        self.assertLess(age, 0.5)

    def test_an_array_that_counts_clockwise_is_turned_round(self):
        metres, _, _ = self.begin("infrared.clockwise=true")
        self.assertAlmostEqual(metres[7], 0.1, places=6)  # at 280 degrees

    def test_a_robot_with_six_sensors_gets_the_nearer_of_two_neighbours(self):
        metres, _, _ = self.begin("robot={include: ../robots/robertino.yaml}")
        self.assertEqual(len(metres), 6)
        self.assertAlmostEqual(metres[0], 0.2, places=6)
        self.assertAlmostEqual(metres[1], 0.1, places=6)  # at 60 degrees, between 40 and 80

    def test_bad_answers_are_errors_and_pass(self):
        self.begin()
        for kind in ("status_500", "bad_json", "short", "truncated", "huge", "stall"):
            with self.subTest(kind):
                self.robot.fault("distancesensorarray", kind)
                self.wait_for(lambda: self.probe.ask("infrared").startswith("error"), "an error")
                self.robot.fault("distancesensorarray", "none")
                self.wait_for(lambda: self.probe.numbers("infrared"), "readings again")


class Tmc200Wheels(Wheels, Case):
    rule = 0.2
    tolerance = 4e-3  # half a count of 3600 rpm / 16 / 1024: 0.5 mm/s at the wheel, 3.5 mrad/s
    start = [2, 1, 2.5]

    def emulate(self):
        self.state = self.folder / "state.json"
        self.control = self.folder / "control"
        self.line = self.folder / "tty"
        self.log = self.folder / "log"
        self.state.unlink(missing_ok=True)
        self.board = self.started(Emulator("tmc200.py", "--link", self.line, "--pose", *self.start,
                                           "--state", self.state, "--control", self.control,
                                           "--log", self.log))

    def lose_device(self):
        self.board.kill()

    def truth(self):
        def fresh():
            state = json.loads(self.state.read_text()) if self.state.exists() else None
            return state if state and state["now"] >= asked else None
        asked = time.monotonic()
        return self.wait_for(fresh, "a fresh state")

    def drivers(self, env=None):
        return Probe(HARDWARE / "tmc200.yaml", f"wheels.device={self.line}", "infrared={driver: none}",
                     "limits={linear: 0.5 m/s, angular: 1 rad/s}",
                     f"command_timeout={self.command_timeout}", *self.overrides, env=env)

    overrides = ()

    def test_odometry_follows_the_truth(self):
        self.check_odometry_follows_the_truth(0.06)  # 0.3 m/s for 150 ms, when busy

    def test_the_driver_comes_back_after_the_device(self):
        self.check_the_driver_comes_back_after_the_device()

    def test_the_controller_is_set_up(self):
        self.begin()
        truth = self.truth()
        self.assertEqual(truth["mode"], 1)
        self.assertAlmostEqual(truth["cut_off"], 0.2)
        # 2 pi 4 cm / (16 * 1000 steps) = 15.7 um: 31 half micrometres
        self.assertEqual(truth["encoders"], [[1000, 3600, 31]] * 3)
        self.assertEqual(truth["rejected"], 0)

    def test_a_garbled_line_is_passed_over_and_silence_is_not(self):
        self.begin()
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()
        self.control.write_text("garbage")
        self.wait_for(lambda: self.probe.condition()[1]["bad_answers"] > 0, "noticed")
        self.control.write_text("")
        self.wait_for(lambda: self.probe.ask("stop_and_wait 5") == "ok", "recovered")
        for kind in ("silent", "error", "flood"):
            with self.subTest(kind):
                self.await_connection()
                self.control.write_text(kind)
                self.wait_for(lambda: self.probe.condition()[0] != CONNECTED, "noticed")
                self.wait_for(lambda: self.probe.ask("state").startswith("error"), "refused")
                self.control.write_text("")
                self.await_connection()

    def test_motors_wired_the_other_way_round_turn_the_right_way(self):
        self.overrides = ("wheels.motor.inverted=true",)
        self.emulate_inverted()
        self.probe = self.started(self.drivers())
        self.await_connection()
        self.probe.ask("drive 0.2 0 0")
        self.await_moving()
        self.near(self.truth()["velocity"], [0.2, 0, 0], self.tolerance)
        self.wait_for(lambda: (self.probe.numbers("state") or [[0] * 7])[0][3] > 0.19, "odometry")

    def emulate_inverted(self):
        self.emulate()
        self.board.kill()
        self.board = self.started(Emulator("tmc200.py", "--link", self.line, "--inverted",
                                           "--state", self.state, "--control", self.control))


class IioInfrared(Case):
    def begin(self, *arguments):
        world = self.folder / "world.json"
        world.write_text(json.dumps({"walls": [[0.685, -1, 0.685, 1]]}))  # 0.5 m from the edge
        self.adc = self.folder / "iio:device0"
        self.state = self.folder / "state.json"
        self.converter = self.started(Emulator("iio.py", self.adc, "--world", world, "--pose-from",
                                               self.state, *arguments))
        self.probe = self.started(Probe(HARDWARE / "tmc200.yaml", f"infrared.folder={self.adc}",
                                        f"wheels.device={self.folder / 'none'}"))
        return self.wait_for(lambda: self.probe.numbers("infrared"), "readings")

    def test_counts_become_volts_and_metres(self):
        metres, volts, (age,) = self.begin()
        # Sharp GP2D12 at 50 cm: 0.63 V by the data sheet's curve
        self.assertAlmostEqual(volts[0], 0.63, delta=0.03)
        self.assertAlmostEqual(metres[0], 0.5, delta=0.005)
        self.assertTrue(all(math.isnan(m) for m in metres[2:5]), metres)
        self.assertLess(age, 0.5)

    def test_an_offset_is_added_to_the_counts(self):
        metres, _, _ = self.begin("--offset", "-300", "--scale", "0.5")
        self.assertAlmostEqual(metres[0], 0.5, delta=0.005)

    def test_readings_follow_the_body(self):
        self.begin()
        self.state.write_text(json.dumps({"pose": [0.3, 0, 0]}))
        self.wait_for(lambda: abs(self.probe.numbers("infrared")[0][0] - 0.2) < 0.005, "0.2 m")

    def test_a_converter_that_goes_is_lost_and_found(self):
        self.begin()
        self.converter.kill()
        moved = self.adc.with_name("moved")
        self.adc.rename(moved)
        self.wait_for(lambda: "in_voltage" in self.probe.ask("infrared"), "an error")
        self.assertEqual(self.probe.condition("sensors")[0], "disconnected")
        moved.rename(self.adc)
        self.wait_for(lambda: self.probe.numbers("infrared"), "readings again")

    def test_an_attribute_that_is_no_number_is_an_error(self):
        self.begin()
        self.converter.kill()
        (self.adc / "in_voltage3_raw").write_text("12x\n")
        self.wait_for(lambda: "'12x' is not a number" in self.probe.ask("infrared"), "an error")
        (self.adc / "in_voltage3_raw").write_text("12\n")
        self.wait_for(lambda: self.probe.numbers("infrared"), "readings again")


if __name__ == "__main__":
    unittest.main()
