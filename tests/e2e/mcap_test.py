#!/usr/bin/env python3
"""`baraka export --format`: CSV of every table, and an MCAP file as npm's @mcap/core and @foxglove's
readers of ROS 2 messages see it, against the run's record. They know nothing of this project: what
they read a message by is in the file."""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import unittest

from baraka import BIN, CASE_STUDY, ROOT, Case, Program
from topic_test import TOPICS as LIVE

SKIPPED = 77
MODULES = BIN.parent / "mcap_reader"
DECODE = ROOT / "tests/e2e/mcap/decode.mjs"
VIEWERS = ROOT / "config/viewers"
PUBLISHED = {  # by schema: how many definitions of published packages are in it
    "tf2_msgs/msg/TFMessage": 7, "visualization_msgs/msg/MarkerArray": 13,
    "geometry_msgs/msg/PoseStamped": 6, "nav_msgs/msg/Odometry": 10, "sensor_msgs/msg/Range": 3,
    "baraka_msgs/msg/Frame": 2, "baraka_msgs/msg/MessageFate": 1, "baraka_msgs/msg/ControllerState": 1,
    "baraka_msgs/msg/Route": 2,
}


def stamp(message):
    return message["sec"] * 1_000_000_000 + message["nanosec"]


class Decoded:
    """What the readers printed of a file."""

    def __init__(self, file):
        done = subprocess.run(["node", DECODE, MODULES, file], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        self.schemas = {line["schema"]: line for line in lines if "definitions" in line}
        self.channels = {line["channel"]: line for line in lines if "channel" in line}
        self.metadata = {line["metadata"]: line["values"] for line in lines if "metadata" in line}
        self.messages = [line for line in lines if "topic" in line]

    def on(self, topic):
        return [(line["at"], line["message"]) for line in self.messages if line["topic"] == topic]


class Exported(Case):
    """With the case study's beginning as a file."""

    SCENARIO = CASE_STUDY
    ARGUMENTS = ["--until", 60, "--set", "record={frames: all, readings: all}"]

    @classmethod
    def setUpClass(cls):
        case = cls("run")
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        case.run_baraka(cls.SCENARIO, "--controllers", "in-process", *cls.ARGUMENTS)
        cls.result, cls.file = case.out, case.folder / "run.mcap"
        finished = Program("baraka", "export", cls.result, "--format", "mcap", "-o", cls.file).finish()
        case.assertEqual(finished.status, 0, str(finished))
        cls.decoded = Decoded(cls.file)


class Mcap(Exported):
    def number(self, sql):
        return self.query(sql, self.result)[0][0]

    def test_every_channel_has_as_many_messages_as_the_record_has_rows(self):
        instants = "SELECT COUNT(DISTINCT at_ns) FROM "
        expected = {
            "/tf_static": 1,
            "/tf": self.number(instants + "poses"),
            "/markers": 1 + self.number(instants + "poses"),
            "/r0/pose": self.number("SELECT COUNT(*) FROM poses JOIN agents USING (agent) WHERE name = 'r0'"),
            "/r0/odom": self.number("SELECT COUNT(*) FROM readings WHERE channel = 'odometry'"),
            "/r0/range": 6 * self.number("SELECT COUNT(*) FROM readings WHERE channel = 'infrared'"),
            "/baraka/routes": self.number("SELECT COUNT(*) FROM routes"),
            "/baraka/frames": self.number("SELECT COUNT(*) FROM frames"),
            "/baraka/message_fates": self.number(
                "SELECT (SELECT COUNT(*) FROM messages WHERE fate IS NOT NULL) + COUNT(*) FROM deliveries"),
            "/baraka/controller_states": self.number("SELECT COUNT(*) FROM states"),
        }
        self.assertTrue(all(expected.values()), expected)
        self.assertEqual({topic: len(self.decoded.on(topic)) for topic in self.decoded.channels}, expected)
        self.assertEqual({topic: of["counted"] for topic, of in self.decoded.channels.items()}, expected)

    def test_definitions_are_those_that_are_published(self):
        self.assertEqual({name: of["compared"] for name, of in self.decoded.schemas.items()}, PUBLISHED)
        for name, of in self.decoded.schemas.items():
            self.assertEqual(of["encoding"], "ros2msg")
            self.assertEqual(of["definitions"], PUBLISHED[name] + name.startswith("baraka_msgs/"))
        for of in self.decoded.channels.values():
            self.assertEqual(of["messageEncoding"], "cdr")

    def test_our_own_definitions_are_those_of_the_idl(self):
        idl = (ROOT / "idl/inspect.idl").read_text()
        known = {"octet": "uint8", "short": "int16", "boolean": "bool", "double": "float64", "unsigned short": "uint16",
                 "unsigned long": "uint32", "builtin_interfaces::msg::dds_::Time_": "builtin_interfaces/Time",
                 "builtin_interfaces::msg::dds_::Duration_": "builtin_interfaces/Duration"}
        shown = pathlib.Path(ROOT / "idl/ros/schemas.cpp").read_text()
        for name in ("Frame", "MessageFate", "ControllerState", "Route", "Value"):
            members = idl.split(f"@final struct {name}_ {{", 1)[1].split("};", 1)[0].splitlines()
            declared = [line.split(";")[0].strip().rpartition(" ") for line in members if ";" in line]
            lines = "".join(f"{known.get(kind, kind)} {member}\\n" for kind, _, member in declared)
            text = shown.split(f'{{"baraka_msgs/{name}",', 1)[1].split("}", 1)[0]
            self.assertEqual("".join(text.split('"')[1::2]), lines, name)

    def test_messages_come_by_time_with_their_own_counts(self):
        times = [message["at"] for message in self.decoded.messages]
        self.assertEqual(times, sorted(times))
        for topic in self.decoded.channels:
            counts = [m["sequence"] for m in self.decoded.messages if m["topic"] == topic]
            self.assertEqual(counts, list(range(len(counts))))

    def test_poses_are_those_of_the_record(self):
        rows = {(name, at): (x, y, theta) for name, at, x, y, theta in self.query(
            "SELECT name, at_ns, x, y, t FROM (SELECT agent, at_ns, p.x_m x, p.y_m y, p.theta_rad t "
            "FROM poses p) JOIN agents USING (agent)", self.result)}
        moved = {(one["child_frame_id"].removesuffix("/base_link"), at): one
                 for at, message in self.decoded.on("/tf") for one in message["transforms"]}
        self.assertEqual(set(moved), set(rows))
        for key, (x, y, theta) in rows.items():
            place, turn = moved[key]["transform"]["translation"], moved[key]["transform"]["rotation"]
            self.assertEqual((place["x"], place["y"], place["z"]), (x, y, 0))
            self.assertAlmostEqual(math.remainder(2 * math.atan2(turn["z"], turn["w"]) - theta, math.tau), 0,
                                   delta=1e-14)
            self.assertEqual(stamp(moved[key]["header"]["stamp"]), key[1])
        for at, message in self.decoded.on("/r0/pose"):
            place = message["pose"]["position"]
            self.assertEqual((place["x"], place["y"]), rows["r0", at][:2])

    def test_frames_and_states_are_those_of_the_record(self):
        names = {65535: "everyone", 65534: "neighbours", **dict(self.query("SELECT agent, name FROM agents",
                                                                          self.result))}
        rows = sorted((at, names[a], names[b], kind if kind not in ("broadcast", "unicast") else "data",
                       sequence, bool(retry), bits, airtime, *mode)
                      for at, a, b, kind, sequence, retry, bits, airtime, *mode in self.query(
                          "SELECT at_ns, transmitter, receiver, class, sequence, retry, bits, airtime_ns, "
                          "ifnull(rate_bps, 0), ifnull(modulation, ''), ifnull(mcs, -1), ifnull(streams, 0), "
                          "ifnull(width_mhz, 0), ifnull(guard_ns, 0), ifnull(category, ''), ampdu FROM frames", self.result))
        shown = sorted((stamp(m["stamp"]), m["transmitter"], m["receiver"], m["frame_type"],
                        m["sequence_number"], m["retry"], m["bits"], stamp(m["airtime"]),
                        *(m[key] for key in ("rate", "modulation", "mcs", "streams", "width", "guard_interval",
                                             "access_category", "ampdu")))
                       for _, m in self.decoded.on("/baraka/frames"))
        self.assertEqual(shown, rows)
        states = sorted((at, names[agent], state) for agent, at, state in self.query(
            "SELECT agent, at_ns, state FROM states", self.result))
        self.assertEqual(sorted((at, m["agent"], m["state"])
                                for at, m in self.decoded.on("/baraka/controller_states")), states)

    def test_the_walls_and_all_bodies_are_drawn(self):
        walls = self.decoded.on("/markers")[0][1]["markers"]
        placed = {(m["ns"], m["pose"]["position"]["x"], m["scale"]["x"], m["scale"]["y"]) for m in walls}
        self.assertEqual(placed, {(f"walls/{name}", x, dx, dy) for name, x, dx, dy in self.query(
            "SELECT name, x_m, size_x_m, size_y_m FROM walls", self.result)})
        drawn = {m["ns"] for _, message in self.decoded.on("/markers")[1:] for m in message["markers"]}
        self.assertEqual(drawn, {name for name, in self.query("SELECT name FROM agents", self.result)})

    def test_the_file_says_which_run_it_is(self):
        told = self.decoded.metadata["baraka"]
        for key in ("scenario", "seed", "version", "fingerprint"):
            self.assertEqual(told[key], str(self.number(f"SELECT value FROM run WHERE key = '{key}'")))


class Sensors(Exported):
    """Every kind of sensor."""

    SCENARIO = ROOT / "tests/e2e/sensors.yaml"
    ARGUMENTS = ["--until", 3, "--set", "record={readings: all, pose_period: 100 ms}"]
    KINDS = {"scan": "sensor_msgs/msg/LaserScan", "imu": "sensor_msgs/msg/Imu", "sonar": "sensor_msgs/msg/Range",
             "pose": "geometry_msgs/msg/PoseStamped", "bumper": "std_msgs/msg/Bool"}

    def readings(self, channel):
        return [(at, [math.nan if value == "-" else float(value) for value in reading.split()])
                for at, reading in self.query("SELECT at_ns, reading FROM readings WHERE "
                                              f"channel = '{channel}' ORDER BY at_ns", self.result)]

    def test_every_kind_has_its_type_and_all_its_readings(self):
        for name, kind in self.KINDS.items():
            self.assertEqual(self.decoded.channels[f"/b0/{name}"]["schema"], kind)
            self.assertEqual([at for at, _ in self.decoded.on(f"/b0/{name}")],
                             [at for at, _ in self.readings(name)], name)
            self.assertGreater(len(self.readings(name)), 0)
        self.assertEqual([at for at, _ in self.decoded.on("/b0/true_pose")],
                         [at for at, in self.query("SELECT at_ns FROM poses ORDER BY 1", self.result)])
        for name, of in self.decoded.schemas.items():
            self.assertEqual(of["compared"], of["definitions"] - name.startswith("baraka_msgs/"), name)

    def test_values_are_those_of_the_record(self):
        def shown(value):
            return math.inf if math.isnan(value) else value
        for (_, message), (_, values) in zip(self.decoded.on("/b0/scan"), self.readings("scan")):
            self.assertEqual(len(message["ranges"]), len(values))
            for seen, value in zip(message["ranges"], values):
                self.assertAlmostEqual(float(seen), shown(value), delta=1e-6)  # single precision
        for (_, message), (_, values) in zip(self.decoded.on("/b0/imu"), self.readings("imu")):
            seen = [message[key][axis] for key in ("angular_velocity", "linear_acceleration") for axis in "xyz"]
            self.assertEqual(seen, values)
            self.assertEqual(message["orientation_covariance"][0], -1)
        for (_, message), (_, values) in zip(self.decoded.on("/b0/sonar"), self.readings("sonar")):
            self.assertAlmostEqual(float(message["range"]), shown(values[0]), delta=1e-6)
            self.assertEqual(message["radiation_type"], 0)


class Viewers(Exported):
    """What the files of config/viewers name is there: in an exported file and in a run under way
    (topic_test.py compares its list with what `baraka topic list` shows)."""

    FILE_ONLY = {"/r0/pose"}
    DISPLAYS = {"MarkerArray": "visualization_msgs", "Odometry": "nav_msgs", "Range": "sensor_msgs"}

    @staticmethod
    def rviz():
        """Topic by kind of display."""
        text = (VIEWERS / "baraka.rviz").read_text()
        return {kind: topic for kind, topic in re.findall(
            r"- Class: rviz_default_plugins/(\w+)\n(?:(?!    - Class).*\n)*?      Topic:\n(?:        .*\n)*?"
            r"        Value: (\S+)\n", text)}

    @staticmethod
    def foxglove():
        """Paths of messages, and topics."""
        panels = json.loads((VIEWERS / "foxglove_layout.json").read_text())["configById"].values()
        for panel in panels:
            yield from panel.get("topics", {})
            yield from (path["value"] for path in panel.get("paths", []))
            yield from filter(None, [panel.get("topicPath")])

    def check(self, topic):
        if topic not in self.FILE_ONLY:
            self.assertIn("rt" + topic, LIVE)
        self.assertIn(topic, self.decoded.channels)

    def test_rviz(self):
        self.assertEqual(set(self.rviz()), set(self.DISPLAYS))
        for kind, topic in self.rviz().items():
            self.check(topic)
            name = f"{self.DISPLAYS[kind]}::msg::dds_::{kind}_"
            self.assertEqual(LIVE["rt" + topic], name)
            self.assertEqual(self.decoded.channels[topic]["schema"], f"{self.DISPLAYS[kind]}/msg/{kind}")
        frames = set(re.findall(r"(?:Fixed|Target|Reference) Frame: (\S+)", (VIEWERS / "baraka.rviz").read_text()))
        known = {name for _, message in self.decoded.on("/tf") for one in message["transforms"]
                 for name in (one["header"]["frame_id"], one["child_frame_id"])}
        self.assertLessEqual(frames, known)

    def test_foxglove(self):
        paths = list(self.foxglove())
        mounts = {one["child_frame_id"] for _, message in self.decoded.on("/tf_static")
                  for one in message["transforms"]}
        self.assertGreater(len(paths), 8)
        for path in paths:
            topic, wanted, members = re.fullmatch(r'([\w/]+)(?:\{([\w.]+=="[^"]+")\})?((?:\.\w+)*)', path).groups()
            self.check(topic)
            messages = [message for _, message in self.decoded.on(topic)]
            if wanted:
                field, value = wanted.split('"')[0].removesuffix("=="), wanted.split('"')[1]
                seen = {member(message, field) for message in messages}
                self.assertIn(value, seen | mounts, path)  # a sensor may have seen nothing
            if members:
                self.assertNotIsInstance(member(messages[0], members[1:]), dict, path)

    def test_panels_of_the_layout_are_described(self):
        layout = json.loads((VIEWERS / "foxglove_layout.json").read_text())

        def leaves(part):
            return [part] if isinstance(part, str) else leaves(part["first"]) + leaves(part["second"])
        self.assertEqual(sorted(leaves(layout["layout"])), sorted(layout["configById"]))


def member(message, path):
    for name in path.split("."):
        message = message[name]
    return message


class Csv(Case):
    def test_every_table_is_a_file(self):
        self.run_baraka(CASE_STUDY, "--controllers", "in-process", "--until", 20)
        folder = self.folder / "tables"
        finished = Program("baraka", "export", self.out, "--format", "csv", "-o", folder).finish()
        self.assertEqual(finished.status, 0, str(finished))
        tables = [name for name, in self.query("SELECT name FROM sqlite_master WHERE type <> 'index' "
                                               "AND name NOT LIKE 'sqlite_%'")]
        self.assertEqual({file.name for file in folder.iterdir()}, {f"{name}.csv" for name in tables})
        for name in tables:
            with (folder / f"{name}.csv").open(newline="") as file:
                rows = sum(1 for _ in csv.reader(file)) - 1
            self.assertEqual(rows, self.query(f"SELECT COUNT(*) FROM {name}")[0][0], name)
        alone = Program("baraka", "export", self.out, "poses", "--format", "csv").finish()
        self.assertEqual(alone.out, (folder / "poses.csv").read_bytes().decode().replace("\r\n", "\n"))

    def test_what_cannot_be_is_said(self):
        self.run_baraka(CASE_STUDY, "--controllers", "in-process", "--until", 1)
        for arguments, words in ((["--format", "mcap"], "-o is missing"), (["--format", "csv"], "-o is missing"),
                                 (["poses", "--format", "mcap", "-o", "x"], "no TABLE"),
                                 (["--describe", "--format", "csv"], "--describe has no --format")):
            finished = Program("baraka", "export", self.out, *arguments).finish()
            self.assertEqual(finished.status, 2, str(finished))
            self.assertIn(words, finished.err)
        (self.out / "scenario.resolved.yaml").unlink()
        file = self.folder / "kept.mcap"
        file.write_text("an earlier one")
        finished = Program("baraka", "export", self.out, "--format", "mcap", "-o", file).finish()
        self.assertNotEqual(finished.status, 0)
        self.assertIn("scenario.resolved.yaml", finished.err)
        self.assertEqual(file.read_text(), "an earlier one")


if __name__ == "__main__":
    if not (MODULES / "node_modules").exists():
        print(f"skipped: no npm modules in {MODULES}: cmake --build {BIN.parent} --target mcap_reader")
        if unittest.main(argv=[sys.argv[0], "Csv"], exit=False).result.wasSuccessful():
            sys.exit(SKIPPED)
        sys.exit(1)
    unittest.main()
