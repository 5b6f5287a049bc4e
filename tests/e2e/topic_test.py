#!/usr/bin/env python3
"""`baraka topic` against a run under way, and against a program that is none of ours."""
import os
import re
import signal
import subprocess

import private_network
from baraka import BIN, CASE_STUDY, Case, Program, some_domain, unittest, wait_for
from ros import Peer, needs_peer

PERIOD = 0.1  # s of simulated time between two samples of rt/clock in the case study
TOPICS = {
    "rt/clock": "rosgraph_msgs::msg::dds_::Clock_",
    "rt/tf": "tf2_msgs::msg::dds_::TFMessage_",
    "rt/tf_static": "tf2_msgs::msg::dds_::TFMessage_",
    "rt/markers": "visualization_msgs::msg::dds_::MarkerArray_",
    "rt/r0/odom": "nav_msgs::msg::dds_::Odometry_",
    "rt/r0/range": "sensor_msgs::msg::dds_::Range_",
    "rt/baraka/message_fates": "baraka_msgs::msg::dds_::MessageFate_",
    "rt/baraka/frames": "baraka_msgs::msg::dds_::Frame_",
    "rt/baraka/routes": "baraka_msgs::msg::dds_::Route_",
    "rt/baraka/controller_states": "baraka_msgs::msg::dds_::ControllerState_",
    "rt/baraka/values": "baraka_msgs::msg::dds_::Value_",
    "rt/baraka/link_quality": "baraka_msgs::msg::dds_::LinkQuality_",
}


class Topics(Case):
    def setUp(self):
        super().setUp()
        self.domain = some_domain(self)

    def start_run(self, speed):
        """A run that goes on until the test ends."""
        return self.start(CASE_STUDY, "--domain", self.domain, "--max-speed", speed)

    def start_topic(self, *arguments):
        program = Program("baraka", "topic", *arguments, "--domain", self.domain)
        self.addCleanup(program.clean_up)
        return program

    def topic(self, *arguments, status=0):
        finished = self.start_topic(*arguments).finish()
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def list(self):
        """Type, writers and readers by name; none while nobody is there yet."""
        rows = [re.fullmatch(r"(\S+)  (\S+)  writers: (\d+)  readers: (\d+)", line).groups()
                for line in self.start_topic("list").finish().out.splitlines()]
        return {name: (kind, int(writers), int(readers)) for name, kind, writers, readers in rows}

    def test_list_of_an_empty_domain_says_so(self):
        self.assertIn(f"error: no topic is published in domain {self.domain}; ", self.topic("list", status=1).err)

    def test_list_shows_every_topic_of_a_run_with_its_type(self):
        self.start_run(5)
        found = wait_for(lambda: len(topics := self.list()) >= len(TOPICS) and topics, timeout=40)
        self.assertEqual(found, {name: (kind, 1, 0) for name, kind in TOPICS.items()})

    def test_info_tells_the_settings_and_that_somebody_reads(self):
        self.start_run(5)
        self.start_topic("echo", "clock")
        info = wait_for(lambda: (i := self.topic("info", "/clock")) and "ers: []" not in i.out and i,
                        timeout=40)  # both are found
        self.assertRegex(
            info.out, r"topic: rt/clock\ntype: rosgraph_msgs::msg::dds_::Clock_\nkeyed: false\n"
            r"writers:\n  - {participant: [0-9a-f]{24}, reliability: reliable, durability: volatile}\n"
            r"readers:\n  - {participant: [0-9a-f]{24}, reliability: reliable, durability: volatile}\n")
        kept = self.topic("info", "rt/tf_static")
        self.assertIn("durability: transient_local", kept.out)
        self.assertIn("durability: transient_local", self.topic("info", "/markers").out)

    def test_echo_prints_a_document_per_sample(self):
        self.start_run(5)
        documents = self.topic("echo", "rt/clock", "--count", 5).out.split("---\n")
        times = [int(sec) + int(ns) / 1e9 for sec, ns in re.findall(
            r"clock:\n  sec: (\d+)\n  nanosec: (\d+)\n", "".join(documents))]
        self.assertEqual(len(times), 5)
        self.assertEqual(len(documents), 6)
        for earlier, later in zip(times, times[1:]):
            self.assertGreater(later, earlier)
            self.assertAlmostEqual((later - earlier) / PERIOD, round((later - earlier) / PERIOD))
        for name in ("tf", "tf_static", "/r0/odom", "r0/range", "/markers"):
            document = self.topic("echo", name, "--count", 1).out
            self.assertIn('frame_id: "', document)
            self.assertNotIn("hexadecimal", document)

    def test_echo_decodes_our_own_messages(self):
        self.start_run(20)
        frame = self.topic("echo", "rt/baraka/frames", "--count", 1, "--timeout", 60).out
        self.assertRegex(frame, r'frame_type: "(data|rts|cts|ack)"\n')
        link = self.topic("echo", "rt/baraka/link_quality", "--count", 1, "--timeout", 60).out
        self.assertRegex(link, r'receiver: "\w+"\ntransmitter: "\w+"\nrssi_dbm: -\d+')

    def test_hz_and_bw_measure(self):
        self.start_run(2)  # 20 samples per second of wall time, fewer if the machine is busy
        rate = self.topic("hz", "clock", "--count", 41)
        self.assertEqual(rate["samples"], "41")
        self.assertTrue(4 < float(rate["rate_hz"]) < 30, str(rate))
        least, most = map(float, re.search(r"min: ([\d.]+), max: ([\d.]+)", rate.out).groups())
        self.assertTrue(least <= 1 / float(rate["rate_hz"]) <= most, str(rate))
        width = self.topic("bw", "clock", "--count", 11)
        self.assertEqual(float(width["bytes_per_sample"]), 12)  # encapsulation, two numbers
        self.assertGreater(float(width["bytes_per_s"]), 0)

    def test_an_unknown_topic_is_an_error_that_says_which_there_are(self):
        self.start_run(5)
        wait_for(lambda: "rt/clock" in self.list(), timeout=40)
        finished = self.topic("echo", "clokc", "--timeout", "3", status=1)
        self.assertIn(f"no topic 'clokc' is published in domain {self.domain}; there are:\n",
                      finished.err)
        for name in TOPICS:
            self.assertIn(f"  {name}\n", finished.err)

    def test_an_empty_domain_has_no_topics(self):
        self.assertEqual(self.list(), {})
        finished = self.topic("info", "clock", "--timeout", "1", status=1)
        self.assertIn("there are no topics", finished.err)

    def test_echo_ends_with_its_writer(self):
        run = self.start_run(5)
        echo = self.start_topic("echo", "clock")
        wait_for(lambda: self.list().get("rt/clock", ("", 0, 0))[2] == 1, timeout=40)
        run.process.send_signal(signal.SIGINT)
        run.finish()
        finished = echo.finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertIn("the last writer has left", finished.err)
        self.assertIn("clock:", finished.out)

    @needs_peer
    def test_samples_of_unknown_types_are_shown_as_bytes(self):
        Peer(self, "write", self.domain, "String", "rt/chatter", 20, 0)
        self.assertEqual(self.topic("info", "chatter")["type"], "std_msgs::msg::dds_::String_")
        document = self.topic("echo", "chatter", "--count", 1).out
        # Encapsulation CDR_LE with two bytes of padding (OMG DDS-XTypes 1.3, 7.6.3.1.2), length with
        # the zero byte, "hello", padding.
        self.assertEqual(document, "type: std_msgs::msg::dds_::String_\nbytes: 16\nhexadecimal:\n"
                         "  00 01 00 02 06 00 00 00 68 65 6c 6c 6f 00 00 00\n---\n")


@unittest.skipUnless(private_network.is_possible(), "this user may make no namespaces")
class WithoutDomain(Case):
    """`baraka topic` without --domain, in a network of its own: other runs of this machine are not seen there."""

    def setUp(self):
        super().setUp()
        self.network = private_network.PrivateNetwork(1, bridge=False)
        self.network.__enter__()
        self.addCleanup(self.network.__exit__)
        self.env = {name: value for name, value in os.environ.items() if name not in ("BARAKA_DOMAIN", "ROS_DOMAIN_ID")}

    def start_run(self, *arguments):
        """A run that goes on until the test ends; returns when it is shown."""
        self.runs += 1
        log = self.folder / f"run{self.runs}.log"
        with open(log, "w") as err:
            run = subprocess.Popen(self.network.command(
                0, BIN / "baraka", "run", CASE_STUDY, "--out", self.folder / f"run{self.runs}",
                "--max-speed", 2, *arguments), env=self.env, stdout=subprocess.DEVNULL, stderr=err)
        self.addCleanup(run.wait)
        self.addCleanup(run.send_signal, signal.SIGINT)
        wait_for(lambda: "inspect domain: " in log.read_text() or run.poll() is not None, timeout=40)
        self.assertIsNone(run.poll(), log.read_text())
        return run

    def topic(self, *arguments, **variables):
        return subprocess.run(self.network.command(0, BIN / "baraka", "topic", *arguments),
                              env={**self.env, **variables}, capture_output=True, text=True, check=False)

    def test_a_run_is_found_where_it_is_shown(self):
        for controllers in (["spawn", "--domain", 3], ["in-process"]):
            with self.subTest(controllers[0]):
                run = self.start_run("--inspect-domain", 9, "--controllers", *controllers)
                echoed = self.topic("echo", "clock", "--count", "1", "--timeout", "60", ROS_DOMAIN_ID="8")
                self.assertEqual(echoed.returncode, 0, echoed.stderr)
                self.assertIn("clock:\n", echoed.stdout)
                self.assertIn("no topic is published in domain 8; ", self.topic("list", BARAKA_DOMAIN="8").stderr)
                run.send_signal(signal.SIGINT)
                run.wait()
                self.assertIn("no topic is published in domain 1; ", self.topic("list").stderr)

    def test_of_two_runs_one_has_to_be_chosen(self):
        self.start_run("--inspect-domain", 9, "--controllers", "in-process")
        self.start_run("--domain", 3)
        asked = self.topic("list")
        self.assertEqual((asked.returncode, asked.stdout), (2, ""))
        self.assertIn("show topics in the domains 3, 9: choose one by --domain N", asked.stderr)
        chosen = self.topic("echo", "clock", "--count", "1", "--timeout", "60", "--domain", "9")
        self.assertIn("clock:\n", chosen.stdout, chosen.stderr)


if __name__ == "__main__":
    unittest.main()
