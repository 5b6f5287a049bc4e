#!/usr/bin/env python3
"""Real robots and motes, but for their devices, which are emulated: daemons, controllers and the
network are what they would be."""
import os
import random
import socket
import subprocess
import sys
import time
import unittest

from baraka import Case, Program, wait_for
from real_agents import (MOTION_CAPTURE, RADIO_PORT, ROBOTS, Network, Place, Process, RealAgents,
                         inside, sha256)
from ros import PEER, needs_peer

# The slow test has more of both.
TRIALS = int(os.environ.get("BARAKA_TRIALS", "5"))
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

    def localised(self, name, pose_of_mote):
        x, y = pose_of_mote
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
        r0, robotino = self.robotino(at_r0, "r0", 1, more=self.localised("r0", (2, 0)))
        r1, tmc200 = self.tmc200(at_r1, "r1", 2, pose=(0.5, 1, 1),
                                 more=self.localised("r1", (2, 0)))
        self.capture_motion(at_r0, "r0", robotino)
        self.capture_motion(at_r1, "r1", tmc200)

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
        # One on a busy machine may be late.
        self.assertLess(sorted(took)[1], COMMAND_TIMEOUT + 0.1, took)

    def test_after_the_daemon_is_killed_they_stand_by_the_rule_of_the_device(self):
        self.wander()
        killed = self.daemon.send("SIGKILL")
        self.assertLess(self.device.await_standing() - killed, self.rule + 0.1)
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
        """Where the service manager keeps a folder for it."""
        self.daemon.end()
        self.environment["RUNTIME_DIRECTORY"] = str(self.folder)
        self.daemon = self.serve_again()
        self.wander()
        self.daemon.send("SIGUSR1")
        self.device.await_standing()
        self.daemon.end()
        self.daemon = self.serve_again()
        controller = self.program(self.place, "wanderer", "--agents", "r0")
        self.daemon.await_text("action refused", "err")
        self.check_standing()
        self.daemon.send("SIGUSR2")
        self.await_moving(controller)
        self.daemon.end()
        self.daemon = self.serve_again()
        self.wander()

    def serve_again(self):
        daemon = self.program(self.place, "baraka-agentd", self.folder / "r0.yaml")
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

    def make(self, *arguments, **keywords):
        return self.robotino(*arguments, **keywords)


class Tmc200Wheels(Wheels, RealAgents):
    rule = 0.2

    def make(self, *arguments, **keywords):
        return self.tmc200(*arguments, **keywords)


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
        inside(here.space, "addr", "del", "10.77.0.1/24", "dev", "eth0")
        here.add_address("10.78.0.1")
        listener.await_text("from 10.78.0.1\n")
        inside(here.space, "link", "del", "eth0")
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

    def test_an_interface_that_is_not_there_is_named_with_those_that_are(self):
        self.check_refused("version: 1\nagent: {name: m0, address: 7, kind: mote}\n"
                           "radio: {interface: nowhere0}\n", r"nowhere0.*lo \(127\.0\.0\.1\)",
                           status=1)

    def test_no_file_is_a_usage_error(self):
        self.assertEqual(Program("baraka-agentd").finish().status, 2)
        self.assertEqual(Program("baraka-agentd", "--help").finish().status, 0)


if __name__ == "__main__":
    unittest.main()
