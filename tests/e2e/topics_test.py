#!/usr/bin/env python3
"""Agents' `topics:` are on the air as they are stated: sizes, instants, QoS, of both vendors and between them, in lock-step."""
import collections
import json
import os
import pathlib
import shutil
import socket
import statistics
import subprocess
import sys
import unittest

from baraka import ROOT, Case, Program
from private_network import has_networks

SKIPPED = 77
VENDORS = "cyclonedds", "fastdds"
BAG = pathlib.Path(__file__).resolve().parents[1] / "unit/hal/files/recording/bags/plain.mcap"
EPOCH = 1767225600 * 10 ** 9  # 1 January 2026: CLOCK_REALTIME at the begin of a run in lock-step
SCENARIO = """
version: 1
name: topics
seed: {seed}
radio: {{profile: ieee80211g, queue_limit: 1000, loss: {{probability: {loss}}}, short_retry_limit: {retries}}}
routing: none
agents:
  base:
    name: base
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    network: {{}}
    dds: {{vendor: {reader}, start: {late}}}
  robots:
    name: r{{}}
    station: {{}}
    grid: {{columns: {robots}, rows: 1, spacing: [1 m, 1 m], origin: [1 m, 0 m]}}
    network: {{}}
    dds: {{vendor: {writer}}}
    topics:
{topics}
record: {{samples: all, frames: counts, air: air.pcapng}}
end: [{{at: {end} s, result: done}}]
"""


def item(**keys):
    keys = {"readers": "[base]", **keys}
    return "      - {" + ", ".join(f"{key}: {value}" for key, value in keys.items()) + "}"


class Topics(Case):
    def play(self, *items, writer="cyclonedds", reader="cyclonedds", robots=1, seed=1, end=6, loss=0, retries=7, late="0 s",
             out=None):
        self.runs += 1
        self.scenario = scenario = self.folder / f"topics{self.runs}.yaml"
        scenario.write_text(SCENARIO.format(topics="\n".join(items), **{
            key: value for key, value in locals().items() if key not in ("items", "self", "scenario", "out")}))
        self.out = out or self.folder / f"out{self.runs}"
        finished = self.start(scenario, out=self.out).finish(300)
        self.assertEqual(finished.status, 0, finished)
        for log in self.out.glob("*.topics.log"):
            self.assertEqual(log.read_text(), "", log)
        return finished

    def journal(self, agent):
        return json.loads((self.out / f"{agent}.topics.json").read_text())

    def written(self, agent):
        return {one["topic"]: one for one in self.journal(agent)["written"]}

    def received(self, agent):
        return {(one["topic"], one["writer"]): one for one in self.journal(agent)["received"]}

    def samples(self, topic, receiver="base"):
        """(entered_ns, bytes, delivered, repairs) in order."""
        return self.query(f"""SELECT entered_ns, bytes, left_ns IS NOT NULL, repairs FROM samples s
            JOIN dds_endpoints e ON e.guid = s.writer JOIN agents a ON a.agent = s.receiver
            WHERE e.topic = '{topic}' AND a.name = '{receiver}' ORDER BY sequence_number""")

    def test_sizes_on_the_wire_are_those_stated_for_each_pair_of_vendors(self):
        stated = {"fixed": "[8 kB]", "small": "[8 B]", "large": "[200 kB]", "list": "[1 kB, 2 kB, 64 B]"}
        for writer in VENDORS:
            for reader in VENDORS:
                with self.subTest(writer=writer, reader=reader):
                    items = [item(name=f"'{{agent}}/{name}'", size=size, rate="4 Hz") for name, size in stated.items()]
                    items.append(item(name="'{agent}/range'", size="{from: 100 B, to: 120 B}", rate="20 Hz"))
                    self.play(*items, writer=writer, reader=reader)
                    sizes = {name: [row[1] for row in self.samples(f"r0/{name}")] for name in (*stated, "range")}
                    self.assertEqual(set(sizes["fixed"]), {8000})
                    self.assertEqual(set(sizes["small"]), {8})
                    self.assertEqual(set(sizes["large"]), {200000})
                    turn = [1000, 2000, 64]
                    self.assertEqual(sizes["list"], [turn[i % 3] for i in range(len(sizes["list"]))])
                    # A multiple of four on the wire: RTPS pads the last word (DDS-XTypes 1.3, 7.6.3.1.2).
                    self.assertEqual(set(sizes["range"]), set(range(100, 121, 4)))
                    for name in sizes:
                        self.assertEqual(len(sizes[name]), self.written("r0")[f"r0/{name}"]["samples"], name)
                        self.assertEqual(self.written("r0")[f"r0/{name}"]["refused"], 0)
                        got = self.received("base")[f"r0/{name}", "r0"]
                        self.assertEqual(got["samples"], len(sizes[name]), name)
                        self.assertGreater(got["first_ns"], EPOCH + 10 ** 9)

    def test_instants_are_periodic_with_jitter_poisson_and_in_bursts(self):
        for vendor in VENDORS:
            with self.subTest(vendor):
                self.play(item(name="periodic", size="100 B", rate="20 Hz"),
                          item(name="jitter", size="100 B", rate="20 Hz", jitter="5 ms"),
                          item(name="poisson", size="100 B", poisson="40 Hz"),
                          item(name="bursts", size="100 B", bursts="{rate: 2 Hz, samples: 5, spacing: 4 ms}"),
                          writer=vendor, end=41)
                at = {topic: [row[0] for row in self.samples(topic)] for topic in ("periodic", "jitter", "poisson", "bursts")}
                period = 50_000_000
                self.assertIn(len(at["periodic"]), (799, 800, 801))
                gaps = [b - a for a, b in zip(at["periodic"], at["periodic"][1:])]
                self.assertEqual({round(gap / 1000) for gap in gaps}, {period // 1000})  # nothing but rounding
                deviations = [t - at["jitter"][0] - i * period for i, t in enumerate(at["jitter"])]
                self.assertLessEqual(max(deviations) - min(deviations), 10_000_000)
                # Uniform over +-5 ms: variance (5 ms)^2 / 3; the sample variance's standard error is 0.89 / sqrt(n) of it.
                self.assertAlmostEqual(statistics.variance(deviations) / (5e6 ** 2 / 3), 1, delta=5 * 0.89 / 800 ** 0.5)
                gaps = [(b - a) / 1e9 for a, b in zip(at["poisson"], at["poisson"][1:])]
                # Exponential: mean and deviation 25 ms; the sample variance's standard error is sqrt(8 / n) of it.
                self.assertAlmostEqual(statistics.mean(gaps) * 40, 1, delta=5 / len(gaps) ** 0.5)
                self.assertAlmostEqual(statistics.variance(gaps) * 1600, 1, delta=5 * (8 / len(gaps)) ** 0.5)
                self.assertAlmostEqual(len(gaps), 1600, delta=5 * 1600 ** 0.5)
                first = at["bursts"][0]
                for i, t in enumerate(at["bursts"]):
                    self.assertAlmostEqual(t - first, i // 5 * 500_000_000 + i % 5 * 4_000_000, delta=1000)

    def test_losses_are_repaired_for_reliable_topics_only(self):
        """Of Fast DDS 2.9, KEEP_LAST: with KEEP_ALL its reader accepts no sample while too many before it are missing,
        and at this loss none at all; so does a program of others (dds_load)."""
        for vendor, history, under_way in ("cyclonedds", "all", 5), ("fastdds", 100, 20 * 4):  # heartbeats each 3 s
            with self.subTest(vendor):
                self.play(item(name="safe", size="1 kB", rate="20 Hz", history=history),
                          item(name="fast", size="1 kB", rate="20 Hz", reliability="best_effort"),
                          writer=vendor, reader=vendor, loss=0.1, retries=1, end=30)
                safe, fast = self.samples("safe"), self.samples("fast")
                self.assertGreater(sum(row[3] for row in safe), 20)
                self.assertEqual(sum(row[3] for row in fast), 0)
                self.assertGreaterEqual(self.received("base")["safe", "r0"]["samples"], len(safe) - under_way)
                share = self.received("base")["fast", "r0"]["samples"] / len(fast)
                self.assertAlmostEqual(share, 0.9, delta=5 * (0.09 / len(fast)) ** 0.5)

    def test_late_readers_of_transient_local_topics_get_the_history(self):
        for writer in VENDORS:
            for reader in VENDORS:
                with self.subTest(writer=writer, reader=reader):
                    self.play(item(name="map", size="1 kB", rate="2 Hz", durability="transient_local", history=3),
                              item(name="odom", size="1 kB", rate="2 Hz", history=3),
                              writer=writer, reader=reader, late="20 s", end=40)
                    written = self.written("r0")["map"]["samples"]
                    got = self.received("base")["map", "r0"]
                    # From the match on, and the three before it.
                    matched = (got["first_ns"] - EPOCH) / 1e9
                    self.assertGreater(matched, 20)
                    since = (40 - matched) * 2
                    self.assertAlmostEqual(got["samples"], since + 3, delta=1)
                    self.assertLess(got["samples"], written)
                    self.assertAlmostEqual(self.received("base")["odom", "r0"]["samples"], since, delta=1.5)

    @unittest.skipUnless(shutil.which("tshark"), "needs tshark")
    def test_a_deadline_is_announced_by_writers_and_readers(self):
        for vendor in VENDORS:
            with self.subTest(vendor):
                self.play(item(name="a", size="100 B", rate="10 Hz", deadline="250 ms"), writer=vendor, reader=vendor, end=3)
                fields = subprocess.run(["tshark", "-r", self.out / "air.pcapng", "-Y", "rtps.param.topicName == \"a\"", "-V"],
                                        capture_output=True, text=True, check=True).stdout
                for kind in "PUBLICATIONS", "SUBSCRIPTIONS":
                    self.assertRegex(fields, rf"(?s)writerEntityId: ENTITYID_BUILTIN_{kind}_WRITER(?:(?!writerEntityId).)*"
                                             r"lease_duration: 0\.250000 sec \(0s \+ 0x40000000\)")

    def test_an_equal_seed_gives_equal_frames_and_another_seed_others(self):
        items = (item(name="'rt/{agent}/scan'", size="8 kB", rate="10 Hz", jitter="5 ms", reliability="best_effort"),
                 item(name="'rt/{agent}/odom'", size="{from: 100 B, to: 900 B}", poisson="20 Hz", readers="[base, 'r*']"))
        for vendor in VENDORS:
            with self.subTest(vendor):
                digests, journals = [], []
                for seed in (5, 5, 6):
                    digests.append(self.play(*items, writer=vendor, reader=vendor, robots=3, seed=seed)["frames_digest"])
                    journals.append([self.journal(agent) for agent in ("base", "r0", "r1", "r2")])
                self.assertEqual(digests[0], digests[1])
                self.assertNotEqual(digests[0], digests[2])
                self.assertEqual(journals[0], journals[1])
                self.assertNotEqual(journals[0], journals[2])

    def test_two_runs_at_once_do_not_disturb_each_other(self):
        one = item(name="'rt/{agent}/scan'", size="8 kB", rate="10 Hz")
        alone = self.play(one, robots=2)["frames_digest"]
        both = [self.start(self.scenario, out=self.folder / f"beside{i}") for i in range(2)]
        for run in both:
            finished = run.finish()
            self.assertEqual(finished.status, 0, finished)
            self.assertEqual(finished["frames_digest"], alone)

    def test_twelve_robots_write_and_read_each_others_topics(self):
        for writer in VENDORS:
            with self.subTest(writer):
                self.play(item(name="'rt/{agent}/odom'", size="100 B", rate="1 Hz", readers="[base, 'r*']"),
                          writer=writer, reader=writer, robots=12, end=30)
                for reader in ("base", *(f"r{i}" for i in range(12))):
                    got = self.received(reader)
                    for i in range(12):
                        if reader == f"r{i}":
                            self.assertNotIn((f"rt/r{i}/odom", f"r{i}"), got)
                        else:
                            self.assertGreater(got[f"rt/r{i}/odom", f"r{i}"]["samples"], 10, (reader, i))

    def test_a_topic_that_all_write_is_read_from_each_other_and_not_from_oneself(self):
        for vendor in VENDORS:
            with self.subTest(vendor):
                self.play(item(name="tf", size="100 B", rate="10 Hz", readers="[base, 'r*']"), writer=vendor, robots=3)
                for i in range(3):
                    self.assertEqual(set(self.received(f"r{i}")), {("tf", f"r{j}") for j in range(3) if j != i})
                self.assertEqual(set(self.received("base")), {("tf", f"r{j}") for j in range(3)})
                self.assertEqual(self.written("base"), {})

    def test_a_recording_is_played_with_its_sizes_instants_and_qos(self):
        for vendor in VENDORS:
            with self.subTest(vendor):
                self.play(item(**{"from": BAG}), writer=vendor, robots=2)
                begins = collections.defaultdict(set)
                for robot in "r0", "r1":
                    scan = self.samples(f"rt/{robot}/scan")
                    # As recorded: 400 to 409 bytes, padded to words.
                    self.assertEqual([-(-row[1] // 4) * 4 for row in scan], [-(-size // 4) * 4 for size in range(400, 410)])
                    for i, row in enumerate(scan):
                        self.assertAlmostEqual(row[0] - scan[0][0], i * 100_000_000, delta=10_000)
                    odom = self.samples(f"rt/{robot}/odom")
                    self.assertEqual([row[1] for row in odom], [80] * 10)
                    self.assertAlmostEqual(odom[0][0] - scan[0][0], 12_000_000, delta=10_000)
                    begins["scan"].add(scan[0][0])
                self.assertEqual(len(begins["scan"]), 2)
                qos = dict(self.query("SELECT topic, reliability || ', ' || durability FROM dds_endpoints WHERE kind = 'writer'"))
                self.assertEqual(qos["rt/r0/scan"], "best effort, volatile")
                self.assertEqual(qos["rt/r0/odom"], "reliable, volatile")
                self.assertEqual(qos["rt/r0/tf_static"], "reliable, transient local")

    def test_a_recording_that_repeats_goes_on(self):
        self.play(item(**{"from": BAG}, name="'*/scan'", repeat="true"), end=11)
        got = self.received("base")["rt/r0/scan", "r0"]["samples"]
        # At least nine of ten seconds, ten samples in each 0.92 s.
        self.assertAlmostEqual(got, 10 * 9.5 / 0.92, delta=7)

    def test_writes_that_block_are_refused_in_time_and_delay_no_other_topic(self):
        """Cyclone DDS blocks a reliable writer with KEEP_ALL for up to 100 ms: 32 Mb/s do not go over 54 Mb/s of g."""
        self.play(item(name="much", size="200 kB", rate="20 Hz", history="all"), item(name="little", size="100 B", rate="20 Hz"))
        much, little = self.written("r0")["much"], self.written("r0")["little"]
        self.assertGreater(much["refused"], 0)
        self.assertGreater(much["latest_ns"], 10 ** 7)
        self.assertEqual((little["refused"], little["latest_ns"]), (0, 0))
        self.assertIn(little["samples"], (99, 100))

    def test_flows_of_udp_are_sent_and_received(self):
        plan = {"domain": 0, "seed": 1, "begin_ns": 10 ** 9, "writes": [], "reads": [], "flows": [], "ports": []}
        flow = {"port": 9000, "to": ["10.77.0.2", "10.77.0.3"], "repeat_after_ns": 0, "spread_ns": 0,
                "recorded": [[0, 100], [10 ** 6, 1472], [2 * 10 ** 6, 5000]]}
        scenario = ("version: 1\nradio: {profile: ieee80211g}\nrouting: none\nrecord: {air: air.pcapng}\n"
                    "end: [{at: 4 s, result: done}]\nagents:\n")
        for i, more in enumerate(({"flows": [flow]}, {"ports": [9000]}, {"ports": [9000]})):
            journal = self.folder / f"journal{i}.json"
            file = self.folder / f"plan{i}.json"
            file.write_text(json.dumps({**plan, **more, "name": f"a{i}", "journal": str(journal)}))
            command = f"[{os.environ['BARAKA_BIN']}/baraka-topics-{VENDORS[i % 2]}, {file}]"
            scenario += (f"  a{i}: {{name: a{i}, station: {{}}, poses: [{{x: {i} m, y: 0 m}}], network: {{address: 10.77.0.{i + 1}/16}},"
                         f" programs: [{{name: p, command: {command}}}]}}\n")
        (self.folder / "flows.yaml").write_text(scenario)
        self.run_baraka(self.folder / "flows.yaml")
        journals = [json.loads((self.folder / f"journal{i}.json").read_text()) for i in range(3)]
        self.assertEqual([(one["port"], one["samples"], one["refused"]) for one in journals[0]["datagrams_sent"]], [(9000, 6, 0)])
        for journal in journals[1:]:
            (got,) = journal["datagrams_received"]
            self.assertEqual((got["port"], got["sender"], got["samples"]), (9000, "10.77.0.1", 3))
            # 1 s, the recording's shift below 1 s, up to 10 ms until the program starts, and the first datagram's way.
            self.assertTrue(10 ** 9 < got["first_ns"] - EPOCH < 2.1 * 10 ** 9, got)
            self.assertAlmostEqual(got["last_ns"] - got["first_ns"], 2 * 10 ** 6, delta=4 * 10 ** 6)
        self.assertGreater(self.query("SELECT SUM(bits) FROM air_accounts WHERE port = 9000")[0][0], 8 * 2 * 6572)
        # The same from what was on the air there: to each of two, six datagrams to the port.
        self.play(item(**{"from": self.out / "air.pcapng"}, name="none", flows="true", readers="[base, r1]"), robots=2)
        for agent, others in ("base", ["10.77.0.2", "10.77.0.3"]), ("r1", ["10.77.0.2"]), ("r0", []):
            received = [(one["port"], one["sender"], one["samples"]) for one in self.journal(agent)["datagrams_received"]]
            self.assertEqual(received, [(9000, sender, 6) for sender in others], agent)
        self.assertEqual(self.journal("r0")["datagrams_sent"][0]["samples"], 12)
        self.assertEqual(self.journal("r1")["datagrams_sent"][0]["samples"], 6)

    def test_what_a_run_recorded_is_played_again(self):
        self.play(item(name="scan", size="[8 kB, 1 kB]", rate="10 Hz", jitter="9 ms", deadline="500 ms", reliability="best_effort"))
        first, air = self.samples("scan"), self.out / "air.pcapng"
        self.play(item(**{"from": air}, rename="{scan: again}"), end=8)
        again = self.samples("again")
        # The recording begins with the first sample whose writer is known.
        self.assertGreater(len(again), len(first) - 5)
        self.assertEqual([row[1] for row in again], [row[1] for row in first[-len(again):]])
        gaps = [[b[0] - a[0] for a, b in zip(rows, rows[1:])] for rows in (first[-len(again):], again)]
        for one, other in zip(*gaps):
            self.assertAlmostEqual(one, other, delta=3 * 10 ** 6)  # a capture tells when frames left, not when they were written
        printed = Program("baraka", "topic", "from", air).finish()
        self.assertEqual(printed.status, 0, printed)
        items = printed.out[printed.out.index("topics:\n") + len("topics:\n"):].splitlines()
        self.play(*("    " + line for line in items))
        self.assertEqual({row[1] for row in self.samples("r0/scan")}, {8000, 1000})

    def participants(self):
        """Of DDS, by agent, that had a writer or reader of a topic."""
        rows = self.query("""SELECT DISTINCT a.name, substr(e.guid, 1, 12) FROM dds_endpoints e
            JOIN agents a ON a.agent = e.agent WHERE e.topic NOT LIKE '%DCPS%' AND e.topic != ''""")
        return collections.Counter(name for name, _ in rows)

    def test_each_topic_may_have_participants_of_its_own_and_so_has_their_recording(self):
        for vendor in VENDORS:
            with self.subTest(vendor):
                own = {"size": "1 kB", "rate": "10 Hz", "participants": "topic"}
                self.play(item(name="a", **own), item(name="b", **own), item(name="c", size="64 B", rate="5 Hz"),
                          writer=vendor, reader=vendor)
                self.assertEqual(self.participants(), {"r0": 3, "base": 3})
                self.assertEqual(set(self.written("r0")), {"a", "b", "c"})
                self.assertEqual({topic for topic, _ in self.received("base")}, {"a", "b", "c"})
                air = self.out / "air.pcapng"
                offsets = {}
                for name, keys, participants in (("recorded", {"spread": "0 s"}, 3), ("agent", {"participants": "agent"}, 1),
                                                 ("spread", {"spread": "1 s"}, 3)):
                    self.play(item(**{"from": air}, rename="{a: a, b: b, c: c}", **keys), writer=vendor, reader=vendor, end=8)
                    self.assertEqual(self.participants(), {"r0": participants, "base": participants}, name)
                    self.assertEqual(set(self.written("r0")), {"a", "b", "c"})
                    first = {topic: self.samples(topic)[0][0] for topic in "abc"}
                    offsets[name] = [(first[topic] - first["a"]) / 1e6 for topic in "bc"]  # ms
                for one, other, spread in zip(*(offsets[name] for name in ("recorded", "agent", "spread"))):
                    self.assertAlmostEqual(one, other, delta=3)
                    self.assertGreater(abs(one - spread), 10)

    def test_participants_end_together_when_one_fails(self):
        topic = {"qos": {"reliable": True, "transient_local": False, "history": 10}, "sizes": [64],
                 "rhythm": {"rate": 10, "jitter_ns": 0}}
        (self.folder / "plan.json").write_text(json.dumps({
            "name": "a", "domain": 0, "seed": 1, "begin_ns": 0, "journal": str(self.folder / "journal.json"), "reads": [],
            "writes": [{"topic": "a", "participant": 1, **topic}, {"topic": "not a name", "participant": 2, **topic}],
            "flows": [], "ports": []}))
        done = subprocess.run([f"{os.environ['BARAKA_BIN']}/baraka-topics-cyclonedds", self.folder / "plan.json"],
                              capture_output=True, text=True, check=False, timeout=300)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("topic not a name cannot be created", done.stderr)
        self.assertEqual(json.loads((self.folder / "journal.json").read_text())["written"][0]["topic"], "a")

    def test_players_refuse_what_is_no_plan(self):
        (self.folder / "none.json").write_text("{}")
        for vendor in VENDORS:
            program = f"{os.environ['BARAKA_BIN']}/baraka-topics-{vendor}"
            for arguments, status, said in (([], 2, "usage:"), (["/nowhere.json"], 1, "/nowhere.json: cannot be read"),
                                            ([self.folder / "none.json"], 1, "none.json: ")):
                done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, status, done.stderr)
                self.assertIn(said, done.stderr)

    def test_a_port_that_is_taken_is_named(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("0.0.0.0", 0))
            port = taken.getsockname()[1]
            (self.folder / "plan.json").write_text(json.dumps({
                "name": "a", "domain": 0, "seed": 1, "begin_ns": 0, "journal": str(self.folder / "journal.json"), "reads": [],
                "writes": [], "flows": [], "ports": [port]}))
            done = subprocess.run([f"{os.environ['BARAKA_BIN']}/baraka-topics-cyclonedds", self.folder / "plan.json"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(f"UDP port {port}: Address already in use", done.stderr)

    def test_a_profile_that_the_vendor_refuses_fails_the_run(self):
        (self.folder / "bad.xml").write_text("<CycloneDDS><Domain><Nonsense>1</Nonsense></Domain></CycloneDDS>")
        self.scenario = self.folder / "bad.yaml"
        self.scenario.write_text(SCENARIO.format(
            topics=item(name="a", size="8 B", rate="1 Hz"), writer="cyclonedds", reader="cyclonedds", robots=1, seed=1, end=3, loss=0,
            retries=7, late="0 s").replace("dds: {vendor: cyclonedds}", "dds: {profile: bad.xml}"))
        finished = self.run_baraka(self.scenario, status=1)
        self.assertIn("program topics of r0 exited with status 1; see r0.topics.log", str(finished))
        self.assertIn("participant cannot be created", (self.out / "r0.topics.log").read_text())

    def test_the_shipped_scenario_carries_four_robots_and_not_eight(self):
        shares = []
        for columns in 2, 4:
            finished = self.run_baraka(ROOT / "config/scenarios/topics_on_an_access_point.yaml",
                                       "--set", f"agents.robots.grid.columns={columns}")
            self.assertEqual(finished["result"], "done")
            (share,), = self.query("""SELECT SUM(s.delivered) * 1.0 / SUM(s.samples) FROM sample_sums s
                JOIN dds_endpoints e ON e.guid = s.writer WHERE e.topic LIKE '%/scan'""")
            shares.append(share)
        self.assertGreater(shares[0], 0.99)
        self.assertLess(shares[1], 0.1)

    def test_a_profile_changes_what_participants_do(self):
        """Announcements each half second instead of each 30 s."""
        one = item(name="a", size="100 B", rate="1 Hz")
        counts = []
        for profile in None, ROOT / "config/dds/cyclone_spdp_500ms.xml":
            self.runs += 1
            scenario = self.folder / f"profile{self.runs}.yaml"
            text = SCENARIO.format(topics=one, writer="cyclonedds", reader="cyclonedds", robots=1, seed=1, end=20, loss=0,
                                   retries=7, late="0 s")
            if profile:
                text = text.replace("dds: {vendor: cyclonedds}", f"dds: {{vendor: cyclonedds, profile: {profile}}}")
            scenario.write_text(text)
            self.out = self.folder / f"profile_out{self.runs}"
            finished = self.start(scenario, out=self.out).finish(300)
            self.assertEqual(finished.status, 0, finished)
            (count,), = self.query("""SELECT SUM(submessages) FROM air_accounts JOIN agents USING (agent)
                WHERE purpose = 'SPDP' AND air_accounts.kind = 'DATA' AND name = 'r0'""")
            counts.append(count)
        self.assertGreater(counts[1], counts[0] + 30, counts)


if __name__ == "__main__":
    if not has_networks():
        print("skipped: needs user namespaces and /dev/net/tun", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
