#!/usr/bin/env python3
"""Real robots and motes, but for their devices, which are emulated: daemons, controllers and the
network are what they would be."""
import math
import os
import random
import re
import socket
import subprocess
import sys
import time
import unittest

from baraka import Case, Program, loopback, wait_for
from real_agents import (EMULATORS, MOTION_CAPTURE, RADIO_PORT, ROBOTS, Device, Network, Place,
                         Process, RealAgents, inside, sha256)
from ros import PEER, needs_peer

# The slow test has more of both.
TRIALS = int(os.environ.get("BARAKA_TRIALS", "5"))
SUSPENSIONS = int(os.environ.get("BARAKA_SUSPENSIONS", "4"))
GARBAGE = int(os.environ.get("BARAKA_GARBAGE", "50000"))
COMMAND_TIMEOUT = 0.5  # s, of the robots' files
WANDERS = "controller: {program: wanderer}"

SCENARIO = f"""version: 1
name: two_worlds
seed: 1
radio: {{profile: disk, range: 100 m}}
agents:
  motes:
    name: m{{}}
    mote: {{include: {ROBOTS}/mote.yaml}}
    poses: [{{x: 2 m, y: 0 m}}]
    controller: {{program: help_mote, parameters: {{help_at: 1 s}}}}
  robots:
    name: r{{}}
    robot: {{include: {ROBOTS}/robertino.yaml}}
    poses: [{{x: 0 m, y: 0 m}}]
    controller:
      program: help_robot
      parameters: {{speed: 0.4 m/s, near: 0.6 m, reached: 0.5 m}}
end:
  - {{agent: m0, state: FULFILLED, after: 0 s, result: arrived}}
  - {{at: 120 s, result: timeout}}
expect:
  - {{result: arrived}}
"""


@unittest.skipUnless(MOTION_CAPTURE.exists(),
                     "no motion capture: Cyclone DDS was not there (cyclonedds-dev)")
class OneFileTwoWorlds(RealAgents):
    """The same programs drive simulated and real agents."""

    def simulate(self):
        scenario = self.folder / "two_worlds.yaml"
        scenario.write_text(SCENARIO)
        return self.run_baraka(scenario, "--controllers", "spawn")

    def localised(self, place, name, pose_of_mote):
        """The rest of a robot's file, given the robot."""
        x, y = pose_of_mote

        def file(device):
            self.capture_motion(place, name, device)
            return f"""
controller:
  program: help_robot
  parameters: {{speed: 0.4 m/s, near: 0.6 m, reached: 0.5 m}}
localisation:
  driver: pose_topic
  topic: /mocap/{name}/pose
  map: [{{name: m0, address: 3, x: {x} m, y: {y} m}}]
limits: {{linear: 0.4 m/s, angular: 1 rad/s}}
"""
        return file

    def arrives(self, place_of_robot, robot, device, place_of_mote, mote):
        """A mote calls for help and the robot comes, each with a controller of its own."""
        before = mote.err.read_text().count("state FULFILLED")
        robot_controller = self.program(place_of_robot, "help_robot", "--agents", robot)
        mote_controller = self.program(place_of_mote, "help_mote", "--agents", "m0")
        try:
            wait_for(lambda: mote.err.read_text().count("state FULFILLED") > before, 60)
        except AssertionError:
            raise AssertionError(f"{robot} does not arrive\n{device.state()}\n{mote}\n"
                                 f"{robot_controller}\n{mote_controller}") from None
        for controller in (robot_controller, mote_controller):
            controller.send("SIGTERM")
            controller.finish()
        x, y, _ = device.state()["pose"]
        return ((x - 2) ** 2 + y ** 2) ** 0.5

    def test_the_same_programs_drive_simulated_and_real_agents(self):
        sums = {program: sha256(program) for program in ("help_robot", "help_mote")}
        self.assertEqual(self.simulate()["result"], "arrived")

        network = Network(self, 3)
        if not network.has_namespaces:
            print("no right to make network namespaces: on loopback addresses", flush=True)
        at_r0, at_r1, at_m0 = network.places
        mote = self.mote(at_m0, "m0", 3, 2, 0, "help_at: 1 s")
        r0, robotino = self.robotino(at_r0, "r0", 1, more=self.localised(at_r0, "r0", (2, 0)))
        r1, tmc200 = self.tmc200(at_r1, "r1", 2, pose=(0.5, 1, 1),
                                 more=self.localised(at_r1, "r1", (2, 0)))

        self.assertLess(self.arrives(at_r0, "r0", robotino, at_m0, mote), 0.8)
        self.assertEqual(tmc200.state()["pose"][:2], [0.5, 1], "nobody drove the other one")
        self.assertLess(self.arrives(at_r1, "r1", tmc200, at_m0, mote), 0.8)

        for daemon in (mote, r0, r1):
            daemon.send("SIGTERM")
            self.assertEqual(daemon.finish(), 0, str(daemon))
            self.assertGreater(daemon["frames_sent"], 3, str(daemon))
            self.assertGreater(daemon["frames_received"], 3, str(daemon))
            self.assertEqual(daemon["datagrams_malformed"], 0)
        for device in (robotino, tmc200):
            self.assertEqual(device.state()["rejected"], 0)
            self.assertFalse(device.state()["moving"])
        self.assertEqual(sums, {program: sha256(program) for program in sums})


class Wheels:
    """However a program ends, the wheels stand."""
    rule = None  # s, of the device

    def setUp(self):
        super().setUp()
        self.place = Network(self, 1).places[0]
        self.daemon, self.device = self.make(self.place, "r0", 1, more=WANDERS)

    def wander(self):
        controller = self.program(self.place, "wanderer", "--agents", "r0")
        self.await_moving(controller)
        return controller

    def await_moving(self, controller):
        try:
            self.device.await_moving()
        except AssertionError:
            raise AssertionError(f"the wheels stand\n{self.daemon}\n{controller}") from None

    def check_standing(self):
        """For longer than anything could still be under way."""
        time.sleep(0.3)
        self.assertFalse(self.device.state()["moving"])

    def test_after_the_controller_is_killed_they_stand_within_the_command_timeout(self):
        took = []
        for _ in range(TRIALS):
            controller = self.wander()
            killed = controller.send("SIGKILL")
            took.append(self.device.await_standing() - killed)
            self.assertLess(took[-1], COMMAND_TIMEOUT + 0.1)
            self.check_standing()
            controller.finish()
        print(f"stood after {1e3 * min(took):.0f} to {1e3 * max(took):.0f} ms in {TRIALS} trials", flush=True)

    def test_while_the_controller_is_halted_they_stand_and_then_go_on(self):
        controller = self.wander()
        took = []
        for _ in range(3):
            halted = controller.send("SIGSTOP")
            took.append(self.device.await_standing() - halted)
            self.check_standing()
            controller.send("SIGCONT")
            self.await_moving(controller)
        print(f"stood after {1e3 * min(took):.0f} to {1e3 * max(took):.0f} ms", flush=True)
        # One on a busy machine may be late.
        self.assertLess(sorted(took)[1], COMMAND_TIMEOUT + 0.1, took)

    def test_after_a_suspension_no_old_command_moves_them(self):
        """Daemon and controller are halted, as by a computer that sleeps; the daemon wakes first."""
        moved = []
        for trial in range(SUSPENSIONS):
            controller = self.wander()
            halted = [self.daemon, controller]
            for one in halted if trial % 2 else reversed(halted):  # either has the last word
                one.send("SIGSTOP")
            self.device.await_standing()
            time.sleep(COMMAND_TIMEOUT + random.uniform(0, 0.1))
            before = self.device.state()
            self.daemon.send("SIGCONT")
            wait_for(lambda: self.device.state()["commands"] > before["commands"])
            self.check_standing()
            moved.append(math.dist(before["pose"][:2], self.device.state()["pose"][:2]))
            controller.send("SIGCONT")
            self.await_moving(controller)
            controller.end()
            self.device.await_standing()
        print(f"moved {1e3 * max(moved):.1f} mm at most in {len(moved)} suspensions, at all in "
              f"{sum(map(bool, moved))}", flush=True)
        self.assertEqual(moved, [0] * SUSPENSIONS)

    def test_after_the_daemon_is_killed_they_stand_by_the_rule_of_the_device(self):
        self.wander()
        killed = self.daemon.send("SIGKILL")
        took = self.device.await_standing() - killed
        print(f"stood after {1e3 * took:.0f} ms", flush=True)
        self.assertLess(took, self.rule + 0.1)
        self.assertEqual(self.device.state()["stops_by_rule"], 1)
        self.check_standing()

    def check_emergency_stop(self, pull, release):
        """@param pull  returns when, on time.monotonic()."""
        controller = self.wander()
        took = []
        for _ in range(TRIALS):
            pulled = pull()
            took.append(self.device.await_standing() - pulled)
            self.check_standing()
            release()
            self.await_moving(controller)
        print(f"stood after at most {1e3 * max(took):.1f} ms, half of {TRIALS} within "
              f"{1e3 * sorted(took)[len(took) // 2]:.1f} ms", flush=True)
        # One on a busy machine may be late; more than half of them may not.
        self.assertLess(sorted(took)[len(took) // 2], 0.05, took)
        self.assertLess(max(took), COMMAND_TIMEOUT, took)
        self.assertEqual(self.device.state()["stops_by_rule"], 0)

    def test_an_emergency_stop_outranks_the_controller_until_it_is_released(self):
        self.check_emergency_stop(lambda: self.daemon.send("SIGUSR1"),
                                  lambda: self.daemon.send("SIGUSR2"))

    @needs_peer
    def test_a_program_of_ros_2_may_pull_the_emergency_stop_and_release_it(self):
        button = subprocess.Popen(
            self.place.command(PEER, "switch", self.domain, "Bool", "rt/r0/emergency_stop"),
            stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env={**os.environ, **self.environment})
        self.addCleanup(button.communicate)
        self.assertIn("ready", button.stderr.readline())

        def press(value):
            at = time.monotonic()
            button.stdin.write(value)
            button.stdin.flush()
            return at
        self.check_emergency_stop(lambda: press("1"), lambda: press("0"))

    def test_an_emergency_stop_outlives_the_daemon(self):
        self.wander()
        self.daemon.send("SIGUSR1")
        self.device.await_standing()
        wait_for((self.folder / "state/baraka/r0.emergency_stop").exists)
        self.daemon.end()  # as kill -9
        self.daemon = self.serve_again()
        self.daemon.await_text("the emergency stop of an earlier run is in force", "err")
        controller = self.program(self.place, "wanderer", "--agents", "r0")
        self.daemon.await_text("action refused", "err")
        self.check_standing()
        self.daemon.send("SIGUSR2")
        self.await_moving(controller)
        self.daemon.end()
        self.daemon = self.serve_again()
        self.wander()

    def serve_again(self, *arguments):
        daemon = self.program(self.place, "baraka-agentd", self.folder / "r0.yaml", *arguments)
        daemon.await_text("ready: ")
        return daemon

    def test_sigterm_stops_them_first_and_then_everything_else(self):
        controller = self.wander()
        asked = self.daemon.send("SIGTERM")
        self.assertEqual(self.daemon.finish(), 0, str(self.daemon))
        self.assertLess(self.device.await_standing() - asked, 0.3)
        self.assertEqual(self.device.state()["stops_by_rule"], 0, "by a command, not by silence")
        self.assertEqual(controller.finish(), 0, f"it was told to stop\n{controller}")
        self.assertGreater(self.daemon["steps"], 0)

    def test_controllers_come_and_go_and_nobody_else_gets_the_robot(self):
        for _ in range(2):
            controller = self.wander()
            rival = self.program(self.place, "wanderer", "--agents", "r0")
            rival.await_text("taken", "err")
            rival.end()
            controller.send("SIGTERM")
            controller.finish()
            self.device.await_standing()
        self.daemon.send("SIGTERM")
        self.assertEqual(self.daemon.finish(), 0)
        self.assertEqual(self.daemon["controllers"], 2)


class RobotinoWheels(Wheels, RealAgents):
    rule = 0.2

    def test_a_daemon_that_shall_forget_says_so(self):
        self.daemon.end()
        self.daemon = self.serve_again("--no-state")
        self.daemon.await_text("an emergency stop is forgotten when the daemon restarts", "err")
        self.daemon.send("SIGUSR1")
        self.daemon.await_text("EMERGENCY STOP", "err")
        self.daemon.end()
        self.daemon = self.serve_again("--no-state")
        self.wander()

    @needs_peer
    def test_after_a_suspension_nothing_moves_them_that_was_sent_by_hand_before(self):
        self.daemon.end()
        self.daemon, self.device = self.make(self.place, "r0", 1, more="controller: {program: teleop}")
        for _ in range(SUSPENSIONS):
            hand = Process(self, self.place, PEER, "write", self.domain, "Twist", "rt/r0/cmd_vel", 20,
                           0.2, 0, 0, env=self.environment)
            self.device.await_moving()
            self.daemon.send("SIGSTOP")
            time.sleep(0.1)  # what it sends meanwhile waits
            hand.end()
            self.device.await_standing()
            time.sleep(COMMAND_TIMEOUT)
            before = self.device.state()
            self.daemon.send("SIGCONT")
            wait_for(lambda: self.device.state()["commands"] > before["commands"] + 10)
            self.assertEqual(self.device.state()["pose"], before["pose"])

    def test_it_is_no_clock_of_others_and_its_stamps_are_the_time_of_day(self):
        """Of ROS 2's programs here none has use_sim_time."""
        other = self.mote(Place(self.place.space, "lo", "127.81.0.1"), "m0", 3, 0, 0)

        def seen():
            look = self.program(self.place, "baraka", "topic", "list")
            look.finish()  # it looks for a moment, in which a busy machine may find nothing
            return look.out.read_text()

        listed = wait_for(lambda: "rt/r0/odom" in (text := seen()) and text)
        self.assertNotIn("rt/clock", listed)
        echo = self.program(self.place, "baraka", "topic", "echo", "rt/r0/odom", "--count", 3)
        self.assertEqual(echo.finish(60), 0, str(echo))
        stamps = [int(n) for n in re.findall(r"\bsec: (\d+)", echo.out.read_text())]
        self.assertEqual(len(stamps), 3, str(echo))
        self.assertTrue(all(abs(stamp - time.time()) < 60 for stamp in stamps), stamps)
        other.end()

    def make(self, *arguments, **keywords):
        return self.robotino(*arguments, **keywords)


class Tmc200Wheels(Wheels, RealAgents):
    rule = 0.2

    def make(self, *arguments, **keywords):
        return self.tmc200(*arguments, **keywords)


class LostSensors:
    """A channel that the controller asked for falls silent while the wheels turn, and comes back."""
    localisation = "{driver: static, pose: {x: 0 m, y: 0 m}}"

    def begin(self, rule, localisation=localisation, capture=False):
        self.place = Network(self, 1).places[0]
        rule = "" if rule == "the default" else f"on_lost_sensor: {rule}\n"

        def file(device):
            if capture:
                self.capture = self.capture_motion(self.place, "r0", device)
            return f"controller: {{program: sensing}}\n{rule}localisation: {localisation}\n"
        self.daemon, self.device = self.make(self.place, "r0", 1, more=file)
        self.controller = self.program(self.place, "sensing", "--agents", "r0")
        self.daemon.await_text("state has odometry infrared localisation", "err")
        self.device.await_moving()

    def check(self, rule, channel, lose, bring_back):
        lost = time.monotonic()
        lose()
        log = self.daemon.err
        has = [name for name in ("odometry", "infrared", "localisation") if name != channel]
        self.daemon.await_text(f"state has {' '.join(has)}\n", "err")
        self.assertEqual(log.read_text().count(f"{channel}: lost ("), 1, str(self.daemon))
        if rule == "ignore":
            self.assertIn("the wheels may turn", log.read_text())
            time.sleep(0.5)
            self.device.await_moving()  # on a busy machine they stand for a while by the device's rule
            self.assertNotIn("action refused", log.read_text())
        else:
            self.assertIn("the wheels stand until it is back", log.read_text())
            took = self.device.await_standing() - lost
            print(f"{channel} lost: stood after {1e3 * took:.0f} ms", flush=True)
            self.assertEqual(self.device.state()["stops_by_rule"], 0, "by a command")
            time.sleep(0.5)
            self.assertFalse(self.device.state()["moving"])
            self.daemon.await_text(f"action refused: set_body_velocity: no {channel}", "err")
        self.assertEqual(log.read_text().count(f"{channel}: back"), 0)
        bring_back()
        self.daemon.await_text(f"{channel}: back", "err")
        self.device.await_moving()
        self.assertEqual(log.read_text().count(f"{channel}: lost ("), 1)
        self.assertEqual(log.read_text().count(f"{channel}: back"), 1)


class RobotinoLostSensors(LostSensors, RealAgents):
    def make(self, *arguments, **keywords):
        return self.robotino(*arguments, **keywords)

    def check_fault(self, rule, channel, path, kind):
        self.begin(rule)
        self.check(rule, channel, lambda: self.set_fault(path, kind), self.faults.unlink)

    def set_fault(self, path, kind):
        whole = self.folder / "new_faults.json"
        whole.write_text(f'{{"{path}": "{kind}"}}')
        whole.rename(self.faults)

    def test_without_odometry_the_wheels_stand(self):
        self.check_fault("the default", "odometry", "odometry", "stall")

    def test_without_odometry_the_wheels_turn_if_that_is_to_be_ignored(self):
        self.check_fault("ignore", "odometry", "odometry", "status_500")

    def test_odometry_that_does_not_advance_is_lost(self):
        self.check_fault("stop", "odometry", "odometry", "frozen")

    def test_without_infrared_the_wheels_stand(self):
        self.check_fault("stop", "infrared", "distancesensorarray", "stall")

    def test_without_infrared_the_wheels_turn_if_that_is_to_be_ignored(self):
        self.check_fault("ignore", "infrared", "distancesensorarray", "bad_json")

    def check_poses(self, rule):
        self.begin(rule, "{driver: pose_topic, topic: /mocap/r0/pose}", capture=True)
        self.check(rule, "localisation", lambda: self.capture.send("SIGSTOP"),
                   lambda: self.capture.send("SIGCONT"))

    @unittest.skipUnless(MOTION_CAPTURE.exists(), "no motion capture: no Cyclone DDS")
    def test_without_poses_the_wheels_stand(self):
        self.check_poses("stop")

    @unittest.skipUnless(MOTION_CAPTURE.exists(), "no motion capture: no Cyclone DDS")
    def test_without_poses_the_wheels_turn_if_that_is_to_be_ignored(self):
        self.check_poses("ignore")

    def test_what_the_controller_does_not_ask_for_stops_nothing(self):
        self.place = Network(self, 1).places[0]
        self.daemon, self.device = self.make(self.place, "r0", 1, more=WANDERS)
        self.program(self.place, "wanderer", "--agents", "r0")
        self.device.await_moving()
        self.set_fault("odometry", "stall")
        self.daemon.await_text("odometry: lost (", "err")
        time.sleep(0.5)
        self.device.await_moving()
        self.assertNotIn("action refused", self.daemon.err.read_text())


class Tmc200LostSensors(LostSensors, RealAgents):
    def make(self, *arguments, **keywords):
        return self.tmc200(*arguments, **keywords)

    def check_converter(self, rule):
        self.begin(rule)
        folder, away = self.folder / "iio-r0", self.folder / "away"
        self.check(rule, "infrared", lambda: folder.rename(away),
                   lambda: away.rename(folder))

    def test_without_the_converter_the_wheels_stand(self):
        self.check_converter("stop")

    def test_without_the_converter_the_wheels_turn_if_that_is_to_be_ignored(self):
        self.check_converter("ignore")


class Readiness(RealAgents):
    """Ready is who has heard all its devices."""

    def setUp(self):
        super().setUp()
        self.manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(self.manager.close)
        self.manager.bind(str(self.folder / "notify"))
        self.manager.settimeout(30)
        self.environment["NOTIFY_SOCKET"] = str(self.folder / "notify")

    def await_notice(self, start):
        while True:
            notice = self.manager.recv(1000).decode()
            if notice.startswith(start):
                return notice
            self.assertFalse(notice.startswith("READY"), notice)

    def check_waits(self, daemon, *devices):
        """Says twice what it waits for, and is not ready."""
        for device in devices:
            self.assertRegex(self.await_notice("STATUS=waiting for"), device + r" \(.+\)")
        wait_for(lambda: daemon.err.read_text().count("waiting for") >= 2)
        self.assertEqual(daemon.out.read_text(), "")

    def test_a_robot_that_is_switched_on_later_is_waited_for(self):
        place = Place(None, "lo", loopback())
        with socket.socket() as reserved:
            reserved.bind(("127.0.0.1", 0))
            port = reserved.getsockname()[1]
        daemon = self.start_serving(place, "r0", 1, f"""
robot: {{include: {ROBOTS}/robotino.yaml}}
wheels: {{driver: robotino_rest, host: 127.0.0.1, port: {port}}}
infrared: {{driver: robotino_rest, host: 127.0.0.1, port: {port}}}
{WANDERS}
""")
        controller = self.program(place, "wanderer", "--agents", "r0")
        self.check_waits(daemon, "wheels", "infrared")
        robot = Device(self, place, "robotino.py", "--port", port, ready="listening: ")
        self.await_notice("READY=1")
        daemon.await_text("ready: r0 (robot, address 1)")
        robot.await_moving()  # its controller has been there all the time
        controller.end()

    def test_one_sensor_is_enough_to_wait_for(self):
        place = Place(None, "lo", loopback())
        device = Device(self, place, "tmc200.py", ready="device: ")
        adc = self.folder / "iio-late"
        daemon = self.start_serving(place, "r0", 1, f"""
robot: {{include: {ROBOTS}/robertino.yaml}}
wheels:
  driver: tmc200
  device: {device.announced}
  motor: {{encoder_lines: 500, gear: 16, max_speed: 3600 rpm}}
infrared:
  driver: iio
  folder: "{adc}"
  channels: [voltage0, voltage1, voltage2, voltage3, voltage4, voltage5]
""")
        self.check_waits(daemon, "infrared")
        Process(self, place, sys.executable, EMULATORS / "iio.py", adc)
        self.await_notice("READY=1")
        daemon.await_text("ready: ")

    def test_an_interface_that_has_no_address_yet_is_waited_for(self):
        network = Network(self, 1)
        if not network.has_namespaces:
            self.skipTest("no right to make network namespaces")
        here, = network.places
        inside(here.space, "addr del 10.77.0.1/24 dev eth0")
        here.address = None
        daemon = self.start_serving(here, "m0", 1, "localisation: {driver: none}\n")
        self.check_waits(daemon, "radio")
        here.add_address("10.78.0.1")
        self.await_notice("READY=1")
        daemon.await_text("radio 10.78.0.1:7300")


class Radio(RealAgents):
    def test_goes_on_when_its_interface_gets_another_address_or_was_away(self):
        network = Network(self, 2)
        if not network.has_namespaces:
            self.skipTest("no right to make network namespaces")
        here, there = network.places
        there.add_address("10.78.0.2")
        here.address = None  # whatever the interface has
        daemon = self.mote(here, "m0", 1, 0, 0)
        listener = Process(self, there, sys.executable, "-uc", LISTENER)
        listener.await_text("from 10.77.0.1\n")
        inside(here.space, "addr del 10.77.0.1/24 dev eth0")
        here.add_address("10.78.0.1")
        listener.await_text("from 10.78.0.1\n")
        inside(here.space, "link del eth0")
        daemon.await_text("no network interface 'eth0'", "err")
        network.plug_in(0, "10.78.0.3")
        listener.await_text("from 10.78.0.3\n")
        daemon.send("SIGTERM")
        self.assertEqual(daemon.finish(), 0, str(daemon))


LISTENER = f"""
import socket
radio = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
radio.bind(("", {RADIO_PORT}))
while True:
    print("from", radio.recvfrom(2000)[1][0])
"""


class Garbage(RealAgents):
    def test_at_the_radio_port_is_counted_and_changes_nothing(self):
        network = random.randrange(1, 255)
        a, b = [Place(None, "lo", f"127.78.{network}.{i}") for i in (1, 2)]
        caller = self.mote(a, "m0", 3, 0, 0, "help_at: 1 s, repeat_after: 1 s")
        listener = self.mote(b, "m1", 4, 0, 0)
        controller = self.program(a, "help_mote", "--agents", "m0")
        flood((b.address, RADIO_PORT), GARBAGE)
        try:
            caller.await_text("state GAVE_UP", "err", 60)
        except AssertionError as error:
            raise AssertionError(f"{error}\n{controller}\n{listener}") from None
        for daemon in (listener, caller):
            daemon.send("SIGTERM")
            self.assertEqual(daemon.finish(), 0, str(daemon))
        # The kernel drops what the daemon has no time for.
        self.assertGreater(listener["datagrams_malformed"], GARBAGE / 100)
        self.assertLessEqual(listener["datagrams_malformed"], GARBAGE)
        self.assertGreater(listener["frames_received"], 0, "and it still hears its neighbour")
        self.assertEqual(listener["frames_malformed"], 0)


def flood(to, count):
    """Random and truncated datagrams."""
    generator = random.Random(1)
    good = b"BRKA\x01\x00\x00\x09\x00\x20" + bytes(32)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as source:
        for i in range(count):
            if i % 2:
                datagram = generator.randbytes(generator.randrange(100))
            else:
                datagram = good[:generator.randrange(len(good))]
            source.sendto(datagram, to)


class CommandLine(Case):
    def check_refused(self, text, *expected, status=2):
        file = self.folder / "robot.yaml"
        file.write_text(text)
        finished = Program("baraka-agentd", file, "--domain", "39").finish()
        self.assertEqual(finished.status, status, str(finished))
        for one in expected:
            self.assertRegex(finished.err, one)

    def test_every_mistake_of_a_file_has_its_place(self):
        self.check_refused("version: 1\nagent: {name: m0, address: 70000, kind: moat}\n"
                           "radio: {interface: lo}\nspeed: 3\n",
                           r"robot\.yaml:2:\d+: .*address", r"robot\.yaml:2:\d+: .*kind",
                           r"robot\.yaml:4:1: .*speed")

    def check_radio_refused(self, radio, *expected):
        self.check_refused("version: 1\nagent: {name: m0, address: 7, kind: mote}\n"
                           f"radio: {radio}\n", *expected)

    def test_an_interface_that_is_not_there_is_named_with_those_that_are(self):
        self.check_radio_refused("{interface: nowhere0}",
                                 r"robot\.yaml:3:20: radio\.interface: .*nowhere0.*lo \(127\.0\.0\.1\)")

    def test_an_address_that_the_interface_does_not_have_has_its_place(self):
        self.check_radio_refused("{interface: lo, address: 10.9.9.9}",
                                 r"robot\.yaml:3:33: radio\.address: .*10\.9\.9\.9")
        self.check_radio_refused("{interface: lo, address: here}",
                                 r"robot\.yaml:3:33: radio\.address: 'here' is not an IPv4 address")

    def test_a_wrong_value_from_the_command_line_is_named_once(self):
        file = self.folder / "mote.yaml"
        file.write_text("version: 1\nagent: {name: m0, address: 7, kind: mote}\n"
                        "radio: {interface: lo}\n")
        for arguments, expected in (
                (["--set", "radio.interface=nowhere0"], r"^--set radio\.interface: no network"),
                (["--inspect-address", "10.9.9.9"],
                 r"^error: --inspect-address: no network interface has the address 10\.9\.9\.9"),
                (["--inspect-address", "here"], "^error: --inspect-address: 'here' is not an IPv4")):
            finished = Program("baraka-agentd", file, *arguments).finish()
            self.assertEqual(finished.status, 2, str(finished))
            self.assertRegex(finished.err, expected)

    def test_a_port_that_is_taken_may_be_free_in_a_moment(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as holder:
            holder.bind(("127.0.0.1", 0))
            port = holder.getsockname()[1]
            self.check_refused("version: 1\nagent: {name: m0, address: 7, kind: mote}\n"
                               f"radio: {{interface: lo, port: {port}}}\n",
                               f"127.0.0.1:{port}.*in use", status=1)

    def test_a_domain_that_is_none_is_a_usage_error(self):
        file = self.folder / "mote.yaml"
        file.write_text("version: 1\nagent: {name: m0, address: 7, kind: mote}\n"
                        "radio: {interface: lo}\n")
        for program in (["baraka-agentd", file], ["baraka", "topic", "list"],
                        ["help_mote", "--agents", "m0"]):
            for domain in ("red", "233", "-1"):
                finished = Program(*program, env={"BARAKA_DOMAIN": domain}).finish()
                self.assertEqual(finished.status, 2, str(finished))
                self.assertIn(f"BARAKA_DOMAIN is '{domain}'", finished.err)

    def test_a_file_that_cannot_be_read_is_a_usage_error(self):
        for file in (self.folder, self.folder / "none.yaml"):
            finished = Program("baraka-agentd", file).finish()
            self.assertEqual(finished.status, 2, str(finished))
            self.assertIn(str(file), finished.err)

    def test_without_a_folder_for_the_emergency_stop_it_does_not_start(self):
        robot = self.folder / "r0.yaml"
        robot.write_text(f"""version: 1
agent: {{name: r0, address: 7, kind: robot}}
radio: {{interface: lo}}
robot: {{include: {ROBOTS}/robotino.yaml}}
wheels: {{driver: robotino_rest, host: 127.0.0.1}}
""")
        no_folder = self.folder / "file"
        no_folder.write_text("")
        nowhere = {"STATE_DIRECTORY": "", "XDG_STATE_HOME": "", "HOME": ""}
        for arguments, environment in (([], {**nowhere, "XDG_STATE_HOME": str(no_folder)}),
                                       ([], {**nowhere, "HOME": str(no_folder)}),
                                       ([], {**nowhere, "STATE_DIRECTORY": f"{no_folder}/r0:/x"}),
                                       ([], nowhere),
                                       (["--state", no_folder / "r0"], {})):
            finished = Program("baraka-agentd", robot, *arguments, env=environment).finish()
            self.assertEqual(finished.status, 2, str(finished))
            self.assertRegex(finished.err, "emergency stop would be forgotten.*--state.*--no-state")

    def test_no_file_is_a_usage_error(self):
        self.assertEqual(Program("baraka-agentd").finish().status, 2)
        self.assertEqual(Program("baraka-agentd", "--help").finish().status, 0)


if __name__ == "__main__":
    unittest.main()
