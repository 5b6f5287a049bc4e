#!/usr/bin/env python3
"""`baraka topic from` against what others see in the same recordings: tshark in captures of DDS programs, the
ledger of a run in the capture of its air, and Python's SQLite that wrote a bag."""
import collections
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import wire
from baraka import BIN, ROOT, Case, Program

CAPTURES = sorted((ROOT / "tests/unit/sim/air/ledger/captures").glob("*.pcap"))
BAGS = ROOT / "tests/unit/hal/files/recording/bags"
REFUSED = wire.why_not()  # networks, on this machine; "": nothing
# rosbag2_storage_sqlite3 in Humble.
TABLES = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
                    offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
"""
METADATA = """rosbag2_bagfile_information:
  version: 5
  storage_identifier: sqlite3
  duration: {{nanoseconds: 9900000000}}
  starting_time: {{nanoseconds_since_epoch: 1700000000000000000}}
  message_count: {count}
  topics_with_message_count: []
  compression_format: "{compression}"
  compression_mode: "{mode}"
  relative_file_paths: [{files}]
"""


def topic_from(file, status=0):
    finished = Program("baraka", "topic", "from", file).finish()
    assert finished.status == status, finished
    return finished


def rows(out):
    """Number of samples and least, median and largest size by topic, of those with samples."""
    found = re.findall(r"^# (\S+|UDP to port \d+) +\S+ +(\d+) +(?:-|\S+ Hz) +(?:-|\S+ \S+) +(\d+) +(\d+) +(\d+) ", out, re.M)
    return {name: tuple(map(int, numbers)) for name, *numbers in found}


def field(element, name):
    return element.find(f".//field[@name='{name}']")


def seen_by_tshark(capture):
    """Samples of DATA and DATA_FRAG by topic, and datagrams of UDP that are not RTPS by port."""
    command = ["tshark", "-r", capture, "-T", "pdml"]
    document = subprocess.run(command, capture_output=True, check=True).stdout
    writers, topics, flows = collections.defaultdict(set), {}, collections.Counter()
    for packet in xml.etree.ElementTree.fromstring(document).iter("packet"):
        rtps = [one for one in packet.findall("proto") if one.get("name") == "rtps"]
        udp = packet.find("proto[@name='udp']")
        if udp is not None and not rtps:
            flows[f"UDP to port {field(udp, 'udp.dstport').get('show')}"] += 1
        for message in rtps:
            prefix = field(message, "rtps.guidPrefix.src").get("value")
            for one in message.findall("field[@name='rtps.sm.id']"):
                if int(one.get("show"), 16) not in (0x15, 0x16):
                    continue
                writer = field(one, "rtps.sm.wrEntityId").get("value")
                topic = field(one, "rtps.param.topicName")
                if writer == "000003c2" and topic is not None:
                    guid = next(e for e in one.iter("field") if "PID_ENDPOINT_GUID" in e.get("show", ""))
                    topics[re.sub(r"\W", "", guid.get("value"))[8:40]] = topic.get("show")
                if int(writer, 16) & 0xc0 != 0xc0:
                    writers[prefix + writer].add(field(one, "rtps.sm.seqNumber").get("show"))
    samples = collections.Counter()
    for guid, numbers in writers.items():
        samples[topics[guid]] += len(numbers)
    return samples + flows


class Recordings(Case):
    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_captures_hold_what_tshark_sees(self):
        self.assertEqual(len(CAPTURES), 4)
        for capture in CAPTURES:
            ours = {name: numbers[0] for name, numbers in rows(topic_from(capture).out).items()}
            self.assertGreater(len(ours), 0)
            self.assertEqual(ours, dict(seen_by_tshark(capture)), capture)

    def test_captures_are_the_same_in_the_forms_that_editcap_writes(self):
        for capture in CAPTURES:
            expected = topic_from(capture).out.split("\n", 1)[1].replace(str(capture), "FILE")
            for form in ("pcapng", "nsecpcap"):
                file = self.folder / f"{form}.cap"
                subprocess.run(["editcap", "-F", form, capture, file], check=True)
                self.assertEqual(topic_from(file).out.split("\n", 1)[1].replace(str(file), "FILE"), expected)

    def test_a_capture_that_is_cut_off_is_refused_and_editcap_helps(self):
        cut, whole = self.folder / "cut.pcap", self.folder / "whole.pcap"
        cut.write_bytes(CAPTURES[0].read_bytes()[:-10])
        said = topic_from(cut, status=1).err
        self.assertRegex(said, r"cut\.pcap: byte \d+: the file ends within packet \d+: \d+ of its \d+ bytes are there; `editcap`")
        subprocess.run(["editcap", cut, whole], check=False, capture_output=True)
        self.assertGreater(len(rows(topic_from(whole).out)), 0)

    @unittest.skipIf(REFUSED, REFUSED)
    def test_the_capture_of_our_air_holds_the_samples_of_the_ledger(self):
        """Through an access point, which sends everything again; and with A-MSDUs."""
        if shutil.which("ddsperf") is None:
            self.skipTest("no ddsperf")
        for scenario, *arguments in (
                ("dds_through_access_point",),
                ("dds_camera_over_wifi", "--set", "radio.include=../radios/ieee80211n.yaml",
                 "--set", "radio.aggregation.max_amsdu=7935", "--until", "12")):
            out = self.folder / scenario
            finished = Program("baraka", "run", scenario, "--seed", 1, *arguments, "--set", "record.air=air.pcapng",
                               "--out", out).finish(timeout=300)
            self.assertEqual(finished.status, 0, finished)
            with sqlite3.connect(out / "run.sqlite") as database:
                ledger = dict(database.execute(
                    "SELECT e.topic, MAX(s.samples) FROM sample_sums s JOIN dds_endpoints e ON e.guid = s.writer GROUP BY 1"))
            seen = rows(topic_from(out / "air.pcapng").out)
            self.assertGreater(len(ledger), 1)
            for topic, samples in ledger.items():
                # The ledger counts a sample once its reader is known on both sides: the first may come before.
                self.assertIn(seen[topic][0] - samples, (0, 1), topic)

    def write_bag(self, name, messages, prepare=lambda data: data):
        with sqlite3.connect(self.folder / name) as database:
            database.executescript(TABLES)
            for number, (topic, kind, qos) in enumerate((
                    ("/tf_static", "tf2_msgs/msg/TFMessage", (1, 1, 1, 1)),
                    ("/scan", "sensor_msgs/msg/LaserScan", (1, 5, 2, 2)),
                    ("/odom", "nav_msgs/msg/Odometry", (3, 0, 1, 2))), 1):
                history, depth, reliability, durability = qos
                database.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', ?)", (
                    number, topic, kind, f"- history: {history}\n  depth: {depth}\n  reliability: {reliability}\n"
                                         f"  durability: {durability}\n  deadline:\n    sec: 2147483647\n    nsec: 4294967295"))
            database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", [
                (topic, 1_700_000_000_000_000_000 + at, prepare(b"\0\1\0\0" + bytes(size - 4))) for topic, at, size in messages])
        database.close()

    def messages(self):
        yield 1, 0, 420
        for i in range(100):
            yield 2, 100_000_000 * i, 2960
        for i in range(495):
            yield 3, 20_000_000 * i, 724

    def check_bag(self, path, note=""):
        out = topic_from(path).out
        self.assertEqual(rows(out), {"rt/tf_static": (1, 420, 420, 420), "rt/scan": (100, 2960, 2960, 2960),
                                     "rt/odom": (495, 724, 724, 724)})
        self.assertIn("""  - name: 'rt/{agent}/scan'  # rt/scan, sensor_msgs/msg/LaserScan
    size: 2960 B
    rate: 10 Hz
    reliability: best_effort
    history: 5
    durability: volatile
""", out)
        self.assertIn("    rate: 50 Hz\n    reliability: reliable\n    history: 10\n", out)
        self.assertIn("transient_local\n", out)
        self.assertIn(note, out)

    def test_a_bag_of_rosbag2(self):
        self.write_bag("bag_0.db3", self.messages())
        self.check_bag(self.folder / "bag_0.db3", "# there is no metadata.yaml beside the file, nor is one needed")
        self.check_bag(self.folder, "# there is no metadata.yaml: the 1 file of the folder")
        metadata = self.folder / "metadata.yaml"
        metadata.write_text(METADATA.format(count=596, compression="", mode="", files="bag_0.db3"))
        for path in (self.folder, metadata, self.folder / "bag_0.db3"):
            self.check_bag(path)

    def test_a_compressed_bag_of_rosbag2(self):
        self.write_bag("bag_0.db3", self.messages())
        subprocess.run(["zstd", "-q", "--rm", self.folder / "bag_0.db3", "-o", self.folder / "bag_0.db3.zstd"], check=True)
        (self.folder / "metadata.yaml").write_text(
            METADATA.format(count=596, compression="zstd", mode="FILE", files="bag_0.db3.zstd"))
        self.check_bag(self.folder)

    def test_messages_that_are_compressed_have_the_size_that_they_had(self):
        frames = {}

        def compressed(data):
            if data not in frames:
                frames[data] = subprocess.run(["zstd", "-q", "-c", "--stream-size", str(len(data))], input=data,
                                              capture_output=True, check=True).stdout
            return frames[data]

        self.write_bag("bag_0.db3", self.messages(), compressed)
        (self.folder / "metadata.yaml").write_text(
            METADATA.format(count=596, compression="zstd", mode="MESSAGE", files="bag_0.db3"))
        self.check_bag(self.folder)

    def test_a_file_of_mcap(self):
        self.assertEqual(rows(topic_from(BAGS / "zstd.mcap").out), {
            "rt/tf_static": (1, 104, 104, 104), "rt/scan": (10, 400, 405, 409), "rt/odom": (10, 80, 80, 80)})

    def test_what_cannot_be_read_is_refused_with_a_reason(self):
        for content, name, reason in (
                (b"#ROSBAG V2.0\n" + bytes(100), "old.bag", "byte 0: it is a bag of ROS 1, which is not read: convert it"),
                (b"hello, world", "a.mcap", "byte 0: it is not an MCAP file: it begins with 68 65 6c 6c 6f"),
                (b"", "empty.db3", "it is not a SQLite database, as a .db3 of rosbag2 is: it is empty"),
                (b"mass: 3 kg\n", "metadata.yaml", "there is no rosbag2_bagfile_information")):
            (self.folder / name).write_bytes(content)
            said = topic_from(self.folder / name, status=1).err
            self.assertTrue(said.startswith("error: "), said)
            self.assertIn(f"{self.folder / name}:", said)
            self.assertIn(reason, said)


if __name__ == "__main__":
    if not BIN.is_dir():
        sys.exit("BARAKA_BIN is no folder")
    unittest.main()
