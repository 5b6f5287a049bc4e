#!/usr/bin/env python3
"""ros_base on a robot, whose daemon lets it open DDS participants of its own on a network interface: it is
driven by a program on another DDS that knows only ROS 2's messages, and tells it where it is."""
import math
import os
import unittest

from baraka import loopback, some_domain, wait_for
from real_agents import Place, RealAgents
from ros import Peer, needs_peer

SPEED, TURN = 0.2, 0.25  # m/s, rad/s


class OnARobot(RealAgents):
    def robot(self, interface, parameters=""):
        """A daemon of a Robotino at the origin, and itself."""
        network = Place(None, "lo", loopback())
        return self.robotino(network, "r0", 1, more=f"controller: {{program: ros_base, air_interface: "
                                                    f"{interface}, parameters: {{{parameters}}}}}\n")

    def start_ros_base(self):
        return self.program(Place(None, "lo", ""), "ros_base", "--agents", "r0")

    @needs_peer
    def test_it_drives_as_it_is_told_stops_when_nothing_comes_and_says_where_it_is(self):
        domain = some_domain(self)
        daemon, robotino = self.robot("lo", f"domain: {domain}, command_timeout: 400 ms")
        controller = self.start_ros_base()
        told = Peer(self, "read", domain, "Odometry", "rt/odom", "TFMessage", "rt/tf", "TFMessage", "rt/tf_static",
                    "JointState", "rt/joint_states", "DiagnosticArray", "rt/diagnostics", "LaserScan", "rt/scan")
        commander = Peer(self, "write", domain, "Twist", "rt/cmd_vel", 20, SPEED, 0, TURN)
        robotino.await_moving()
        wait_for(lambda: robotino.state()["pose"][0] > 0.15)
        commander.end()
        robotino.await_standing()
        x, y, theta = robotino.state()["pose"]
        self.assertGreater(y, 0)

        def last(topic):
            samples = told.samples(topic)
            return samples and samples[-1]

        # The odometry of the wheels settles with the last report.
        wait_for(lambda: last("rt/odom") and abs(last("rt/odom")["position"][0] - x) < 0.02
                 and last("rt/odom")["linear"][0] == 0)
        odometry, transforms = last("rt/odom"), last("rt/tf")
        self.assertAlmostEqual(odometry["position"][1], y, delta=0.02)
        self.assertAlmostEqual(2 * math.atan2(odometry["orientation"][2], odometry["orientation"][3]), theta,
                               delta=0.05)
        self.assertEqual((odometry["frame"], odometry["child"]), ("odom", "base_footprint"))
        transform, *wheels = transforms["transforms"]
        self.assertEqual((transform["parent"], transform["child"]), ("odom", "base_footprint"))
        self.assertEqual([(one["parent"], one["child"]) for one in wheels],
                         [("base_link", f"wheel_{i}_link") for i in range(3)])
        self.assertEqual([(one["parent"], one["child"]) for one in wait_for(lambda: last("rt/tf_static"))["transforms"]],
                         [("base_footprint", "base_link")])
        joints = wait_for(lambda: last("rt/joint_states"))
        self.assertEqual(joints["names"], [f"wheel_{i}_joint" for i in range(3)])
        self.assertGreater(max(abs(angle) for angle in joints["position"]), 0.15 / 0.06, "rad, of a wheel of 6 cm")
        statuses = {one["name"]: one["message"] for one in wait_for(lambda: last("rt/diagnostics"))["status"]}
        self.assertIn(statuses["ros_base: commands"], ("driving", "stopped"))
        self.assertEqual(told.samples("rt/scan"), [], "it has no scanner")
        self.assertAlmostEqual(transform["translation"][0], x, delta=0.02)
        self.assertAlmostEqual(max(one["linear"][0] for one in told.samples("rt/odom")), SPEED, delta=0.02)
        controller.send("SIGTERM")
        controller.finish()
        daemon.send("SIGTERM")
        self.assertEqual(daemon.finish(), 0, str(daemon))

    def test_without_an_interface_it_says_what_to_do_and_nothing_moves(self):
        daemon, robotino = self.robot("lo")
        daemon.send("SIGTERM")
        daemon.finish()
        network = Place(None, "lo", loopback())
        daemon, robotino = self.robotino(network, "r1", 2, more="controller: {program: ros_base}\n")
        controller = self.program(network, "ros_base", "--agents", "r1")
        wait_for(lambda: "air_interface: NAME" in daemon.err.read_text() + controller.err.read_text())
        self.assertEqual(robotino.state()["pose"], [0, 0, 0])

    def test_an_interface_that_is_not_there_is_an_error_with_its_place(self):
        file = self.folder / "robot.yaml"
        file.write_text("version: 1\nagent: {name: m0, address: 1, kind: mote}\nradio: {interface: lo}\n"
                        "controller: {air_interface: wlan77}\n")
        daemon = self.program(Place(None, "lo", ""), "baraka-agentd", file)
        self.assertEqual(daemon.finish(), 2, str(daemon))
        self.assertIn(f"{file}:4:29: controller.air_interface: there is no network interface 'wlan77' here",
                      daemon.err.read_text())


if __name__ == "__main__":
    os.environ.setdefault("BARAKA_NO_NAMESPACES", "1")  # one host is enough
    unittest.main()
