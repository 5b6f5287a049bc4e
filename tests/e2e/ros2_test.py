#!/usr/bin/env python3
"""ros_base by the conventions of ROS 2, as a reader on Cyclone DDS sees it that has its types from ROS 2's own IDL names:
messages, rates, frames, QoS, the names of nodes."""
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

from baraka import BIN, ROOT, Case
from ros2 import DEADLINE, DURABILITY, ENDPOINTS, PROGRAMS, Qos, RELIABILITY, SCENARIO, Tree, listen, program_of, reader, refused, writer
from teleop_behind_a_wall_test import needs_namespaces

sys.path.insert(0, str(ROOT / "tests/validation"))
from teleop import is_behind_the_wall, operator_at  # noqa: E402

NS = 1_000_000_000
RADIUS, HALF_TRACK, TORQUE, SPEED_LIMIT = 0.033, 0.08, 1.4, 6.67  # config/robots/turtlebot3_burger.yaml
YAW, EAST, WEST = math.radians(30), 1.95, -1.45  # tests/e2e/ros_base.yaml: start, inner faces of the walls

SENSOR_DATA, KEPT = Qos(reliable=False), Qos(kept=True)  # rmw_qos_profile_sensor_data; transient local
ALL = [reader("Odometry", "rt/r0/odom"), reader("TFMessage", "rt/tf"), reader("TFMessage", "rt/tf_static", KEPT),
       reader("LaserScan", "rt/r0/scan", SENSOR_DATA), reader("Imu", "rt/r0/imu"),
       reader("JointState", "rt/r0/joint_states"), reader("BatteryState", "rt/r0/battery_state"),
       reader("Bool", "rt/r0/bumper"), reader("String", "rt/r0/robot_description", KEPT),
       reader("DiagnosticArray", "rt/diagnostics"),
       reader("ParticipantEntitiesInfo", "ros_discovery_info", KEPT)]
CIRCLE = program_of("driver", ["ros_peer", "write", "0", "Twist", "rt/r0/cmd_vel", "20", "0.1", "0", "0.4"])
needs_endpoints = unittest.skipUnless(
    ENDPOINTS.exists(), "no ros_endpoints: Cyclone DDS was not there (cyclonedds-dev) when this was built")


def intervals(samples, key="written"):
    times = [sample[key] for sample in samples]
    return [after - before for before, after in zip(times, times[1:])]


def yaw_of(rotation):
    return 2 * math.atan2(rotation[2], rotation[3])


@needs_namespaces
@needs_endpoints
class Topics(Case):
    """While the robot drives a circle."""

    @classmethod
    def setUpClass(cls):
        case = cls("run")
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        cls.ears = listen(case, [*ALL, ("silent", "Twist", "rt/r0/cmd_vel", Qos())], more=[CIRCLE],
                          settings=["agents.robot.controller.parameters.pose_covariance_diagonal=[0.1, 0.1, 0, 0, 0, 0.2]"])
        cls.tree = Tree(cls.ears.samples("rt/tf"), cls.ears.samples("rt/tf_static"))

    def run(self, *arguments):  # also the name of the method that setUpClass gives
        return super().run(*arguments)

    def test_each_is_heard_at_the_rate_of_its_device(self):
        for topic, period, least in (("odom", 100, 95), ("imu", 100, 95), ("joint_states", 100, 95), ("battery_state", 100, 95),
                                     ("bumper", 100, 95), ("scan", 200, 45)):
            samples = self.ears.samples("rt/r0/" + topic)
            self.assertGreaterEqual(len(samples), least, topic)
            self.assertEqual(set(intervals(samples)), {period * NS // 1000}, topic)
        self.assertEqual(set(intervals(self.ears.samples("rt/tf"))), {NS // 10})
        self.assertEqual(set(intervals(self.ears.samples("rt/diagnostics"))), {NS})
        for topic in ("rt/tf_static", "rt/r0/robot_description", "ros_discovery_info"):
            self.assertEqual(len(self.ears.samples(topic)), 1, topic)

    def test_stamps_are_the_clock_of_the_process_when_they_are_written(self):
        for topic in ("odom", "imu", "joint_states", "battery_state", "scan"):
            for sample in self.ears.samples("rt/r0/" + topic):
                self.assertEqual(sample["t"], sample["written"], topic)

    def test_odometry_and_joint_states_tell_of_the_same_motion(self):
        odometry = {sample["t"]: sample for sample in self.ears.samples("rt/r0/odom")}
        joints = self.ears.samples("rt/r0/joint_states")
        self.assertAlmostEqual(max(one["linear"][0] for one in odometry.values()), 0.1, delta=0.01)
        self.assertAlmostEqual(max(one["angular"][2] for one in odometry.values()), 0.4, delta=0.02)
        for one in joints:
            self.assertEqual((one["names"], one["frame"]), (["wheel_left_joint", "wheel_right_joint"], "base_link"))
            v, omega = odometry[one["t"]]["linear"][0], odometry[one["t"]]["angular"][2]
            for velocity, side in zip(one["velocity"], (-1, 1)):
                self.assertAlmostEqual(velocity * RADIUS, v + side * HALF_TRACK * omega, places=9)
        first, last = joints[0], joints[-1]
        turned = [RADIUS * (b - a) for a, b in zip(first["position"], last["position"])]
        headings = [yaw_of(odometry[one["t"]]["orientation"]) for one in (first, last)]
        turn = (turned[1] - turned[0]) / (2 * HALF_TRACK)
        self.assertGreater(turn, 3, "rad: more than half a circle")
        self.assertAlmostEqual(math.remainder(headings[1] - headings[0] - turn, 2 * math.pi), 0, places=6)

    def test_covariances_are_those_asked_for_and_otherwise_not_known(self):
        for sample in self.ears.samples("rt/r0/odom"):
            diagonal = [sample["pose_covariance"][7 * i] for i in range(6)]
            self.assertEqual(diagonal, [0.1, 0.1, 0, 0, 0, 0.2])
            self.assertEqual(sum(map(abs, sample["pose_covariance"])), sum(diagonal))
            self.assertEqual(set(sample["twist_covariance"]), {0})
        for sample in self.ears.samples("rt/r0/imu"):
            self.assertEqual(sample["orientation_covariance"][0], -1, "no orientation is measured")

    def test_sensors_tell_what_they_measure(self):
        imu = self.ears.samples("rt/r0/imu")
        mean = [sum(one["linear"][i] for one in imu) / len(imu) for i in range(3)]
        self.assertAlmostEqual(mean[2], 9.81, delta=0.1)
        self.assertAlmostEqual(sum(one["angular"][2] for one in imu[20:]) / len(imu[20:]), 0.4, delta=0.02)
        for one in self.ears.samples("rt/r0/battery_state"):
            voltage, current, percentage = one["values"]
            self.assertTrue(one["present"] and 12 < voltage < 12.6 and -2 < current < 0 and 0.99 < percentage <= 1, one)
        self.assertEqual({one["data"] for one in self.ears.samples("rt/r0/bumper")}, {False})
        for one in self.ears.samples("rt/r0/scan"):
            self.assertEqual(len(one["ranges"]), 360)
            for found, expected in zip(one["angles"], (-math.pi, math.pi - math.radians(1), math.radians(1), 0, 0.2)):
                self.assertAlmostEqual(found, expected, places=6)
            for found, expected in zip(one["limits"], (0.12, 3.5)):
                self.assertAlmostEqual(found, expected, places=6)

    def test_diagnostics_have_a_status_of_each_device_and_of_the_commands(self):
        for sample in self.ears.samples("rt/diagnostics"):
            self.assertEqual([one["name"] for one in sample["status"]],
                             [f"ros_base: {device}" for device in ("odometry", "scan", "imu", "bumper", "battery", "commands")])
            self.assertEqual({one["hardware_id"] for one in sample["status"]}, {"r0"})
            self.assertEqual({one["level"] for one in sample["status"]}, {0})
        commands = sample["status"][-1]
        self.assertEqual(commands["message"], "driving")
        self.assertGreater(int(commands["values"]["commands"]), 100)

    def test_every_frame_is_in_odom_and_at_every_stamp(self):
        frames = ["base_footprint", "base_link", "base_scan", "imu_link", "wheel_left_link", "wheel_right_link", "caster_0_link"]
        self.assertEqual(sorted(self.tree.parents), sorted(frames))
        for frame in frames:
            way = self.tree.chain(frame)
            self.assertEqual(way[-1], "odom", way)
        for topic in ("odom", "scan", "imu", "joint_states", "battery_state"):
            for sample in self.ears.samples("rt/r0/" + topic):
                self.assertIn(sample.get("child", sample["frame"]), frames, topic)
                for frame in frames:
                    self.assertIsNotNone(self.tree.transform(frame, sample["t"]), f"{topic}: {frame} at {sample['t']}")

    def test_transforms_are_the_odometry_and_the_mounts(self):
        for sample in self.ears.samples("rt/r0/odom"):
            self.assertEqual((sample["frame"], sample["child"]), ("odom", "base_footprint"))
            one = self.tree.transform("base_footprint", sample["t"])
            self.assertEqual((one["translation"], one["rotation"]), (sample["position"], sample["orientation"]))
        mounts = {frame: self.tree.fixed[frame]["translation"] for frame in ("base_link", "base_scan", "imu_link", "caster_0_link")}
        self.assertEqual(mounts, {"base_link": [0, 0, 0], "base_scan": [-0.032, 0, 0.182], "imu_link": [-0.032, 0, 0.078],
                                  "caster_0_link": [-0.081, 0, 0.006]})

    def test_scans_by_way_of_their_frames_are_the_walls(self):
        """A scan is measured up to a control period before its stamp: 0.04 rad at up to 3.5 m, 1 cm; noise of 1 cm."""
        off, points = [], 0
        for sample in self.ears.samples("rt/r0/scan"):
            base = self.tree.transform("base_footprint", sample["t"])
            heading = yaw_of(base["rotation"])
            mount = self.tree.fixed["base_scan"]["translation"]
            for i, distance in enumerate(sample["ranges"]):
                if not math.isfinite(distance):
                    continue
                angle = sample["angles"][0] + i * sample["angles"][2]
                x, y = mount[0] + distance * math.cos(angle), mount[1] + distance * math.sin(angle)
                x, y = (base["translation"][0] + math.cos(heading) * x - math.sin(heading) * y,
                        base["translation"][1] + math.sin(heading) * x + math.cos(heading) * y)
                world = math.cos(YAW) * x - math.sin(YAW) * y
                off.append(min(abs(world - EAST), abs(world - WEST)))
                points += 1
        self.assertGreater(points, 45 * 50)
        off.sort()
        self.assertLess(off[len(off) // 2], 0.03, "half of them")
        self.assertLess(off[int(0.99 * len(off))], 3.5 * 0.04 + 0.05, "99 %")

    def test_the_description_is_a_robot_whose_links_are_the_frames(self):
        robot = xml.fromstring(self.ears.samples("rt/r0/robot_description")[0]["data"])
        self.assertEqual((robot.tag, robot.get("name")), ("robot", "turtlebot3_burger"))
        self.assertEqual(sorted(link.get("name") for link in robot.iter("link")), sorted(self.tree.parents))
        joints = {joint.find("child").get("link"): joint for joint in robot.iter("joint")}
        for child, joint in joints.items():
            self.assertEqual({joint.find("parent").get("link")}, self.tree.parents[child])
            at = [float(word) for word in joint.find("origin").get("xyz").split()]
            one = self.tree.transform(child, self.ears.samples("rt/r0/odom")[0]["t"])
            self.assertEqual(at, one["translation"], child)
        for side in ("left", "right"):
            wheel = joints[f"wheel_{side}_link"]
            self.assertEqual((wheel.get("name"), wheel.get("type")), (f"wheel_{side}_joint", "continuous"))
            self.assertEqual(wheel.find("axis").get("xyz"), "0 1 0")
            limit = wheel.find("limit")
            self.assertEqual((float(limit.get("effort")), float(limit.get("velocity"))), (TORQUE, SPEED_LIMIT))
        (base,) = [link for link in robot.iter("link") if link.get("name") == "base_link"]
        sizes = [box.get("size") for box in base.iterfind("collision/geometry/box")]
        self.assertEqual(sizes, ["0.138 0.14 0.14", "0.138 0.14 0.042", "0.066 0.178 0.05"])
        self.assertEqual(list(robot.iter("inertial")), [], "its masses are not known to a controller")

    @unittest.skipUnless(shutil.which("check_urdf"), "no check_urdf (liburdfdom-tools) here")
    def test_the_parser_of_ros_reads_the_description(self):
        file = self.folder / "r0.urdf"
        file.write_text(self.ears.samples("rt/r0/robot_description")[0]["data"])
        said = subprocess.run(["check_urdf", file], capture_output=True, text=True, check=True).stdout
        self.assertIn("root Link: base_footprint has 1 child(ren)", said)
        for frame in self.tree.parents:
            self.assertIn(frame, said)

    def test_the_node_and_its_endpoints_are_what_discovery_says(self):
        (info,) = self.ears.samples("ros_discovery_info")
        (node,) = info["nodes"]
        self.assertEqual((node["namespace"], node["name"]), ("/r0", "ros_base"))
        rest = "00" * 8  # gids have 24 bytes in Humble
        peers = {topic: self.ears.peers(topic) for _, _, topic, _ in self.ears.endpoints}
        (participant,) = {peer["participant"] for topic in peers for peer in peers[topic] if topic != "rt/r0/cmd_vel"}
        self.assertEqual(info["gid"], participant + rest)
        self.assertEqual(self.ears.user_data()[participant], b"enclave=/;\0")
        written = [one for topic in peers if topic not in ("rt/r0/cmd_vel", "ros_discovery_info") for one in peers[topic]]
        self.assertEqual(sorted(node["writers"]), sorted(one["peer"] + rest for one in written))
        self.assertEqual(node["readers"], [one["peer"] + rest for one in peers["rt/r0/cmd_vel"]])


# Offered by ros_base, as the drivers of Humble do: turtlebot3_node, tf2_ros, hls_lfcd_lds_driver, robot_state_publisher,
# diagnostic_updater, rosbag2's clock, rmw.
OFFERED = {"rt/r0/scan": SENSOR_DATA, "rt/clock": SENSOR_DATA, "rt/tf_static": KEPT, "rt/r0/robot_description": KEPT,
           "ros_discovery_info": KEPT}
# Who would be at the other end, and what it asks for or, of commands, offers.
PAIRS = [("nav2_amcl, slam_toolbox, rviz2", reader("LaserScan", "rt/r0/scan", SENSOR_DATA)),
         ("a node with the default profile", reader("LaserScan", "rt/r0/scan", Qos())),
         ("a node that wants the last scan", reader("LaserScan", "rt/r0/scan", Qos(reliable=False, kept=True))),
         ("nav2's odometry smoother, SystemDefaultsQoS", reader("Odometry", "rt/r0/odom", Qos())),
         ("a node with SensorDataQoS", reader("Odometry", "rt/r0/odom", SENSOR_DATA)),
         ("a node that wants the last odometry", reader("Odometry", "rt/r0/odom", KEPT)),
         ("a node with a deadline of 200 ms", reader("Odometry", "rt/r0/odom", Qos(deadline=200))),
         ("tf2_ros, DynamicListenerQoS", reader("TFMessage", "rt/tf", Qos())),
         ("rviz2 with best-effort transforms", reader("TFMessage", "rt/tf", SENSOR_DATA)),
         ("tf2_ros's StaticListenerQoS on the wrong topic", reader("TFMessage", "rt/tf", KEPT)),
         ("tf2_ros, StaticListenerQoS", reader("TFMessage", "rt/tf_static", KEPT)),
         ("a node with the default profile", reader("TFMessage", "rt/tf_static", Qos())),
         ("robot_localization, SensorDataQoS", reader("Imu", "rt/r0/imu", SENSOR_DATA)),
         ("a node with the default profile", reader("Imu", "rt/r0/imu", Qos())),
         ("robot_state_publisher, SensorDataQoS", reader("JointState", "rt/r0/joint_states", SENSOR_DATA)),
         ("nav2's battery conditions", reader("BatteryState", "rt/r0/battery_state", Qos())),
         ("a node with SensorDataQoS", reader("Bool", "rt/r0/bumper", SENSOR_DATA)),
         ("rviz2's robot model", reader("String", "rt/r0/robot_description", KEPT)),
         ("a node with the default profile", reader("String", "rt/r0/robot_description", Qos())),
         ("diagnostic_aggregator", reader("DiagnosticArray", "rt/diagnostics", Qos())),
         ("rclcpp's time source, ClockQoS", reader("Clock", "rt/clock", SENSOR_DATA)),
         ("a node with the default profile", reader("Clock", "rt/clock", Qos())),
         ("rmw_fastrtps, rmw_cyclonedds", reader("ParticipantEntitiesInfo", "ros_discovery_info", KEPT)),
         ("nav2's controller, teleop_twist_keyboard", writer("Twist", "rt/r0/cmd_vel", Qos())),
         ("a joystick with SensorDataQoS", writer("Twist", "rt/r0/cmd_vel", SENSOR_DATA)),
         ("a node that keeps its last command", writer("Twist", "rt/r0/cmd_vel", KEPT))]
LATE = "2 s"  # when they come: after what is written once


@needs_namespaces
@needs_endpoints
class Pairs(Case):
    """Publishers and subscribers of ros_base and of Humble's nodes match by the rules of OMG DDS 1.4, 2.2.3."""

    def check(self, ears, offered_of):
        """@param offered_of  QoS of ros_base's endpoint of a topic."""
        for number, (kind, _, topic, qos) in enumerate(ears.endpoints):
            ours = offered_of(topic)
            policies = refused(ours, qos) if kind == "reader" else refused(qos, ours)
            with self.subTest(topic=topic, kind=kind, qos=qos):
                matched, refusals = ears.of(number, "peer"), ears.of(number, "incompatible")
                self.assertEqual(len(matched), 0 if policies else 1)
                self.assertEqual([line["policy"] for line in refusals], policies[:1])
                if matched:
                    self.assertEqual((matched[0]["reliable"], matched[0]["kept"]), (ours.reliable, ours.kept))

    def test_each_pair_matches_or_does_not_as_the_standard_says(self):
        self.assertGreaterEqual(len(PAIRS), 20)
        ears = listen(self, [pair for _, pair in PAIRS], start=LATE, settings=[
            "agents.robot.controller.parameters.publish_clock=true", "agents.robot.controller.parameters.use_sim_time=true"])
        self.check(ears, lambda topic: OFFERED.get(topic, Qos()))
        self.assertEqual({refusal["policy"] for refusal in ears.lines if "incompatible" in refusal},
                         {RELIABILITY, DURABILITY, DEADLINE}, "each rule was applied")
        # What a match is good for: who comes late gets what is kept, and asks for it; the rest gets what comes.
        once = {"rt/tf_static", "rt/r0/robot_description", "ros_discovery_info"}
        for number, (kind, _, topic, qos) in enumerate(ears.endpoints):
            if kind == "reader":
                heard = len(ears.of(number, "written"))
                matched = bool(ears.of(number, "peer"))
                with self.subTest(topic=topic, qos=qos):
                    if topic in once:
                        self.assertEqual(heard, 1 if matched and qos.kept else 0)
                    else:
                        self.assertEqual(heard > 5, matched, heard)
        stamps = [one["t"] for one in ears.samples("rt/clock")]
        self.assertEqual(set(intervals(ears.samples("rt/clock"), "t")), {NS // 10})
        self.assertTrue(2 * NS < stamps[0] < 3 * NS and stamps[-1] < 10 * NS, "the time of the run")
        odometry = [one["t"] for one in ears.of(3, "written")]
        self.assertGreater(len(set(odometry) & set(stamps)), 60, "stamps are those of the clock")

    def test_other_reliabilities_can_be_asked_for(self):
        parameters = "agents.robot.controller.parameters."
        endpoints = [reader("LaserScan", "rt/r0/scan", Qos()), reader("Odometry", "rt/r0/odom", Qos()),
                     reader("Odometry", "rt/r0/odom", SENSOR_DATA), writer("Twist", "rt/r0/cmd_vel", SENSOR_DATA)]
        ears = listen(self, endpoints, settings=[parameters + "best_effort_topics=[odom]", parameters + "best_effort=true"])
        self.check(ears, lambda topic: SENSOR_DATA if topic in ("rt/r0/odom", "rt/r0/cmd_vel") else Qos())


@needs_namespaces
@needs_endpoints
class Offers(Case):
    def heard(self, endpoints, *parameters, more=()):
        """Topics of which something was heard."""
        settings = [f"agents.robot.controller.parameters.{one}" for one in parameters]
        ears = listen(self, endpoints, settings=[*settings, *more, "end.0.at=3 s"])
        return {topic for _, _, topic, _ in endpoints if ears.peers(topic)}, ears

    def test_only_what_the_robot_has_a_device_for(self):
        bare = f"agents.robot.robot={{include: {ROOT}/config/robots/robertino.yaml}}"
        found, ears = self.heard(ALL, more=[bare])
        missing = {f"rt/r0/{topic}" for topic in ("scan", "imu", "battery_state", "bumper")}
        self.assertEqual(found, {topic for _, _, topic, _ in ALL} - missing)
        names = ears.samples("rt/r0/joint_states")[0]["names"]
        self.assertEqual(names, ["wheel_0_joint", "wheel_1_joint", "wheel_2_joint"])

    def test_only_what_it_is_asked_for(self):
        found, ears = self.heard(ALL, "topics=[odom, tf]")
        self.assertEqual(found, {"rt/r0/odom", "rt/tf"})
        self.assertEqual(set(ears.user_data().values()), {b""})
        (sizes,) = {len(one["transforms"]) for one in ears.samples("rt/tf")}
        self.assertEqual(sizes, 1, "the wheels' are those of joint_states")

    def test_other_names_and_frames(self):
        endpoints = [reader("LaserScan", "rt/r0/front/scan", SENSOR_DATA), reader("TFMessage", "rt/r0/tf"),
                     reader("TFMessage", "rt/tf"), reader("Odometry", "rt/r0/odom"), reader("TFMessage", "rt/tf_static", KEPT),
                     writer("TwistStamped", "rt/drive"), writer("Twist", "rt/r0/cmd_vel")]
        found, ears = self.heard(endpoints, 'remap=["scan:=front/scan", "/tf:=tf", "cmd_vel:=/drive"]', 'frame_prefix="{}/"',
                                 "use_stamped_vel=true")
        self.assertEqual(found, {"rt/r0/front/scan", "rt/r0/tf", "rt/r0/odom", "rt/tf_static", "rt/drive"})
        states = [state for (state,) in self.query("SELECT state FROM states ORDER BY at_ns")]
        self.assertEqual(states, ["waiting", "driving"], "by TwistStamped")
        (odometry,) = {(one["frame"], one["child"]) for one in ears.samples("rt/r0/odom")}
        self.assertEqual(odometry, ("r0/odom", "r0/base_footprint"))
        self.assertEqual({one["frame"] for one in ears.samples("rt/r0/front/scan")}, {"r0/base_scan"})
        tree = Tree(ears.samples("rt/r0/tf"), ears.samples("rt/tf_static"))
        self.assertEqual({tree.chain(frame)[-1] for frame in tree.parents}, {"r0/odom"})

    def test_what_a_program_of_its_own_agent_hears_is_not_on_the_air(self):
        ears = program_of("ears", ["ros_endpoints", "0", "reader,Odometry,rt/r0/odom,reliable,volatile"])
        self.run_baraka(SCENARIO, "--no-inspect", "--set", f"agents.robot.programs=[{ears}]", "--set", "end.0.at=3 s", env=PROGRAMS)
        heard = [line for line in (self.out / "r0.ears.log").read_text().splitlines() if "written" in line]
        self.assertGreater(len(heard), 20)
        told = self.query("SELECT COALESCE(SUM(bits), 0) FROM air_topics WHERE topic = 'rt/r0/odom'")
        self.assertEqual(told, [(0,)])

    def test_rates_follow_the_control_cycle_and_the_device(self):
        endpoints = [reader("Odometry", "rt/r0/odom"), reader("LaserScan", "rt/r0/scan", SENSOR_DATA)]
        _, ears = self.heard(endpoints, more=["control_period=50 ms", "agents.robot.robot.sensors={remove: [scan], add: ["
                                               "{kind: scan, min_range: 12 cm, max_range: 3.5 m, period: 250 ms}]}"])
        self.assertEqual(set(intervals(ears.samples("rt/r0/odom"))), {NS // 20})
        self.assertEqual(set(intervals(ears.samples("rt/r0/scan"))), {NS // 4})


@needs_namespaces
@needs_endpoints
class NavigatorBehindAWall(Case):
    SCENARIO = ROOT / "tests/e2e/navigator_behind_a_wall.yaml"
    GOAL, BOX, LANE = (2, 8), (0.6, 8), 8  # m in the world
    TIMEOUT, PERIOD = 0.5, 0.1             # s

    def poses(self):
        return self.query("SELECT at_ns / 1e9, p.x_m, p.y_m FROM poses p JOIN agents a USING (agent) WHERE a.name = 'robot' ORDER BY 1")

    def said(self):
        lines = (self.out / "operator.navigator.log").read_text().splitlines()
        return [json.loads(line) for line in lines if line.startswith("{")]

    def test_the_goal_is_reached_around_a_box_and_in_spite_of_a_wall(self):
        self.run_baraka(self.SCENARIO, "--no-inspect", env=PROGRAMS)
        poses, states = self.poses(), self.query("SELECT at_ns / 1e9, state FROM states ORDER BY at_ns")
        self.assertEqual([state for _, state in states], ["waiting", "driving", "stopped", "driving"])
        (_, _), (_, _), (stopped, _), (again, _) = states

        # The wall is between them from a command time-out before the robot stops until it goes on.
        behind = [t for t, x, _ in poses if is_behind_the_wall(operator_at(t), x)]
        self.assertAlmostEqual(stopped, behind[0] + self.TIMEOUT, delta=2 * self.PERIOD)
        standing = [x for t, x, _ in poses if t <= again][-1]
        back = min(i * 0.05 for i in range(1200) if i * 0.05 > stopped and not is_behind_the_wall(operator_at(i * 0.05), standing))
        self.assertAlmostEqual(again, back, delta=1)

        # It stands at the goal, which it has told the program, and came no nearer to the box than half its own length.
        x, y = poses[-1][1:]
        self.assertLess(math.dist((x, y), self.GOAL), 0.15)
        (reached,) = [line for line in self.said() if "reached" in line]
        self.assertAlmostEqual(reached["x"], x + 3, delta=0.05)
        self.assertAlmostEqual(reached["y"], y - self.LANE, delta=0.05)
        clearance = min(max(abs(px - self.BOX[0]), abs(py - self.BOX[1])) - 0.2 for _, px, py in poses)
        self.assertGreater(clearance, 0.07, "m from the box's faces")

    def test_the_program_may_have_a_root_of_its_own(self):
        """As ROS 2 has on a computer with another system: a tree of files, in which the program finds its libraries and
        baraka's."""
        with tempfile.TemporaryDirectory(prefix="baraka-root-", dir="/var/tmp") as folder:  # /tmp is each agent's own
            root, program = pathlib.Path(folder), BIN.parent / "tests/ros_navigator"
            ours = sorted(BIN.glob("libbaraka_*.so"))
            libraries = subprocess.run(["ldd", program, *ours], capture_output=True, text=True, check=True).stdout
            for file in {*map(pathlib.Path, re.findall(r"(/\S+) \(0x", libraries)), *ours, program}:
                copy = root / file.relative_to("/")
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy)
            for name in ("proc", "dev", "tmp", "run"):
                (root / name).mkdir(exist_ok=True)
            command = f"for f in proc dev tmp run; do mount --rbind /$f {root}/$f || exit 1; done; exec chroot {root} {program} 0 5 0"
            self.run_baraka(self.SCENARIO, "--no-inspect", "--set",
                            f"agents.operator.programs=[{program_of('navigator', ['sh', '-c', command])}]")
        self.assertEqual(len([line for line in self.said() if "reached" in line]), 1)

    def test_without_its_scanner_it_drives_into_the_box(self):
        """Its wheels turn on, so that odometry reaches the goal."""
        self.run_baraka(self.SCENARIO, "--no-inspect", "--set", "world.walls.0.radio_loss.per_crossing=0 dB", "--set",
                        "agents.robot.controller.parameters.topics=[odom, tf, tf_static]", env=PROGRAMS)
        self.assertLess(max(x for _, x, _ in self.poses()), self.BOX[0])


if __name__ == "__main__":
    unittest.main()
