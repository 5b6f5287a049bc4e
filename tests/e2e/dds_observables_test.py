#!/usr/bin/env python3
"""Observables and numbers of DDS topics, of Cyclone DDS and Fast DDS: what they say is what the rows of samples say, in
runs and in campaigns; what is missing is not zero, and zero is not missing."""
import contextlib
import math
import sqlite3
import sys
import unittest

from baraka import Program, send, wait_for
from campaign_test import Campaigns
from ledger_test import CYCLONE, TESTS
from private_network import has_networks

SKIPPED = 77
# A topic whose name is escaped in those of numbers, which Cyclone DDS does not permit.
LEFT = {"cyclone": "cam_left", "fastdds": "cam.left"}
PARTS = {"cam.left": "cam%2Eleft"}
# The talker sends only if somebody reads, which nobody does of "silent"; its other topics read alike.
SCENARIO = """
version: 1
name: topics
radio: {{profile: ieee80211g, queue_limit: 1000, short_retry_limit: 2, loss: {{probability: 0.25}}}}
agents:
  talker:
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    network: {{}}
    programs:
      - {{name: scan, command: [{load}, --publish, rt/R0/scan, --size, 3000, --rate, 8, --count, 24, --until-matched, 2, {how}],
         environment: {{{environment}}}}}
      - {{name: left, command: [{load}, --publish, {left}, --size, 600, --rate, 8, --count, 10, --until-matched, 1, {how}],
         environment: {{{environment}}}}}
      - {{name: silent, command: [{load}, --publish, silent, --until-matched, 5, {how}], environment: {{{environment}}}}}
  listeners:
    station: {{}}
    poses: [{{x: 5 m, y: 0 m}}, {{x: 0 m, y: 5 m}}]
    network: {{}}
    programs:
      - {{name: scan, command: [{load}, --subscribe, rt/R0/scan, {how}], environment: {{{environment}}}}}
      - {{name: left, command: [{load}, --subscribe, {left}, {how}], environment: {{{environment}}}}}
      - {{name: silent, command: [{load}, --subscribe, silent, {how}], environment: {{{environment}}}}}
  lamp: {{station: {{}}, poses: [{{x: 9 m, y: 9 m}}]}}
end: [{{at: 15 s, result: done}}]
record: {{samples: all}}
"""
SUMS = ("SELECT a.name, o.name, count, last, mean, s.min, s.max FROM observable_sums s JOIN observables o USING (observable) "
        "JOIN agents a USING (agent)")
# By reading agent and topic.
SAMPLES = ("SELECT a.name, topic, COUNT(*), COUNT(left_ns), SUM(left_ns IS NOT NULL AND NOT repaired), SUM(repaired),"
           " SUM(s.repairs), AVG(left_ns - entered_ns) * 1e-9 FROM samples s JOIN dds_endpoints e ON e.guid = s.writer"
           " JOIN agents a ON a.agent = s.receiver GROUP BY 1, 2")
LATENCIES = ("SELECT left_ns - entered_ns FROM samples s JOIN dds_endpoints e ON e.guid = s.writer JOIN agents a ON a.agent ="
             " s.receiver WHERE left_ns IS NOT NULL AND topic = '{}' AND ('{}' IN ('', a.name)) ORDER BY 1")
AIRTIME = ("SELECT a.name, topic, SUM(airtime_ns) * 1e-9 FROM air_accounts JOIN agents a USING (agent) WHERE topic IS NOT NULL"
           " GROUP BY 1, 2")


def observing(*entries):
    return "--set", f"record.observables=[{', '.join(entries)}]"


class Topics(Campaigns):
    def scenario(self, vendor="cyclone"):
        file = self.folder / f"{vendor}.yaml"
        file.write_text(SCENARIO.format(
            load=TESTS / f"{vendor}_load", left=LEFT[vendor], how="--settle, 0.5, --reliable, --keep-all, --for, 13",
            environment=f'CYCLONEDDS_URI: "{CYCLONE.format("udp")}"'))
        return file


class Observables(Topics):
    def sums(self):
        return {(agent, name): row for agent, name, *row in self.query(SUMS)}

    def test_they_are_at_the_end_what_the_rows_of_samples_say(self):
        for vendor in "cyclone", "fastdds":
            with self.subTest(vendor=vendor):
                self.run_baraka(self.scenario(vendor), *observing(
                    "{name: dds.*.*.*, every: 100 ms}", "{name: dds.*.*.latency, on: change, as: histogram}"))
                self.check_countable()
                last = {key: row[1] for key, row in self.sums().items()}
                rows = self.query(SAMPLES)
                self.assertEqual({(agent, topic) for agent, topic, *_ in rows},
                                 {(f"listeners{i}", topic) for i in (0, 1) for topic in ("rt/R0/scan", LEFT[vendor])})
                for agent, topic, samples, delivered, first_try, repaired, repairs, _ in rows:
                    for value, wanted in (("samples", samples), ("delivered", delivered), ("first_try", first_try),
                                          ("repaired", repaired), ("repairs", repairs),
                                          ("delivered_share", delivered / samples)):
                        self.assertEqual(last[agent, f"dds.{topic}.{value}"], wanted, (agent, topic, value))
                sent = dict(self.query("SELECT topic, COUNT(DISTINCT sequence_number) FROM samples JOIN dds_endpoints ON guid ="
                                       " writer GROUP BY 1"))
                self.assertEqual(sent, {topic: last["talker0", f"dds.{topic}.sent"] for topic in sent})
                for agent, topic, airtime in self.query(AIRTIME):
                    self.assertAlmostEqual(last[agent, f"dds.{topic}.airtime"], airtime, places=9)
                (newest,), = self.query("SELECT MAX(entered_ns) FROM samples s JOIN dds_endpoints e ON e.guid = s.writer WHERE"
                                        " left_ns IS NOT NULL AND topic = 'rt/R0/scan' AND receiver = 2")
                agent, = self.query("SELECT name FROM agents WHERE agent = 2")[0]
                self.assertAlmostEqual(last[agent, "dds.rt/R0/scan.age"], 15 - newest / 1e9, places=9)
                shares = self.query("SELECT SUM(value) * 0.1 FROM observable_samples JOIN observables USING (observable)"
                                    " WHERE name = 'dds.rt/R0/scan.air_share' AND agent = 1")[0][0]
                self.assertAlmostEqual(shares, last["talker0", "dds.rt/R0/scan.airtime"], delta=1e-3,
                                       msg="shares of 100 ms each; what came before the first is missing")

    def test_each_latency_is_one_of_a_sample(self):
        self.run_baraka(self.scenario(), *observing("{name: 'dds.listeners?.rt/*/scan.latency', on: change}",
                                                    "{name: dds.*.*.*ed, on: change, as: counter}"))
        for agent in "listeners0", "listeners1":
            seen = self.query("SELECT value FROM observable_samples JOIN observables o USING (observable) JOIN agents a USING"
                              f" (agent) WHERE o.name = 'dds.rt/R0/scan.latency' AND a.name = '{agent}' ORDER BY 1")
            self.assertEqual([round(value * 1e9) for value, in seen],
                             [ns for ns, in self.query(LATENCIES.format("rt/R0/scan", agent))])
            count, last, *_ = self.sums()[agent, "dds.rt/R0/scan.delivered"]
            self.assertEqual(count, last, "one for each that arrived")
        self.assertEqual({name for _, name in self.sums()},
                         {f"dds.{topic}.{value}" for topic in ("rt/R0/scan", "cam_left", "silent")
                          for value in ("delivered", "repaired")} | {"dds.rt/R0/scan.latency"})

    def test_what_is_missing_is_not_zero_and_zero_is_not_missing(self):
        self.run_baraka(self.scenario(), *observing("{name: dds.*.silent.*, every: 1 s}"))
        sums = self.sums()
        for value in "samples", "delivered", "first_try", "repaired", "repairs":
            count, last, *_ = sums["listeners0", f"dds.silent.{value}"]
            self.assertGreater(count, 10)
            self.assertEqual(last, 0)
        for value in "latency", "age", "delivered_share":
            self.assertEqual(sums["listeners0", f"dds.silent.{value}"][0], 0, value)
        self.assertEqual(sums["talker0", "dds.silent.sent"][1], 0)
        self.assertNotIn(("talker0", "dds.silent.samples"), sums, "it does not read")
        self.assertFalse([agent for agent, _ in sums if agent == "lamp0"])
        (first,), = self.query("SELECT MIN(at_ns) FROM observable_samples")
        (told,), = self.query("SELECT MIN(told_ns) FROM dds_endpoints WHERE topic = 'silent'")
        self.assertEqual(first // 10**9, told // 10**9 + 1, "none before the topic was announced")

    def test_to_look_changes_nothing(self):
        plain = self.run_baraka(self.scenario())
        tables = [self.query(f"SELECT * FROM {table} ORDER BY 1, 2, 3") for table in ("samples", "sample_sums", "air_accounts")]
        looked_at = self.run_baraka(self.scenario(), *observing("{name: dds.*.*.*, every: 37 ms}",
                                                                "{name: dds.*.*.*, on: change, as: counter}"))
        for key in ("fingerprint", "frames_digest", "events"):
            self.assertEqual(plain[key], looked_at[key], key)
        self.assertEqual(tables, [self.query(f"SELECT * FROM {table} ORDER BY 1, 2, 3")
                                  for table in ("samples", "sample_sums", "air_accounts")])

    def test_they_do_not_need_samples_to_be_recorded(self):
        self.run_baraka(self.scenario("fastdds"), *observing("{name: dds.*.cam.left.delivered, every: 1 s}"), "--set",
                        "record.samples=none")
        self.assertEqual(self.query("SELECT COUNT(*) FROM sample_sums"), [(0,)])
        self.assertEqual(self.sums()["listeners0", "dds.cam.left.delivered"][1], 10)

    def test_a_name_that_no_topic_can_have_is_a_mistake(self):
        for name, words in (("dds.*.*.latencyy", "did you mean 'latency'?"), ("dds.lamp0.*.*", "lamp0 have no programs with"),
                            ("dds.nobody.*.*", "'nobody' matches no agent"), ("dds.talker0.scan", "must be TOPIC.VALUE"),
                            ("dds.talker0", "must have three parts")):
            finished = Program("baraka", "check", self.scenario(), *observing(f"{{name: {name}}}")).finish()
            self.assertEqual(finished.status, 2, finished)
            self.assertIn(words, finished.err)
        finished = Program("baraka", "check", self.scenario(), *observing("{name: dds.*.not/there/yet.age}")).finish()
        self.assertEqual(finished.status, 0, finished)


class InCampaigns(Topics):
    def content(self, vendor="cyclone", **more):
        return {"scenario": str(self.scenario(vendor)), "replications": 2, "vary": {"radio.loss.probability": [0, 0.25]}, **more}

    def numbers(self, run):
        return {(name, agent): value for name, agent, value in self.ask(
            f"SELECT name, agent, value FROM measurements JOIN observables USING (observable) WHERE run = {run}")}

    def rows(self, run, sql):
        folder, = self.ask(f"SELECT folder FROM runs WHERE run = {run}")[0]
        with contextlib.closing(sqlite3.connect(f"file:{self.out / folder / 'run.sqlite'}?mode=ro", uri=True)) as database:
            return database.execute(sql).fetchall()

    def check_quantiles(self, numbers, run, topic, part, agent):
        latencies = [ns * 1e-9 for ns, in self.rows(run, LATENCIES.format(topic, agent))]
        for share in 0.5, 0.95, 0.99:
            exact = latencies[max(1, math.ceil(share * len(latencies))) - 1]
            self.assertAlmostEqual(numbers[f"dds.{part}.latency.p{100 * share:.0f}", agent], exact, delta=exact / 64)
        self.assertAlmostEqual(numbers[f"dds.{part}.latency.mean", agent], sum(latencies) / len(latencies), places=9)

    def test_numbers_are_what_the_rows_of_samples_say(self):
        for vendor in "cyclone", "fastdds":
            with self.subTest(vendor=vendor):
                self.out = self.folder / vendor
                self.campaign(self.content(vendor, keep="all", replications=1), "--jobs", 2)
                for run in 1, 2:
                    self.check_numbers(run, LEFT[vendor])

    def check_numbers(self, run, left):
        numbers = self.numbers(run)
        totals = {}
        for agent, topic, samples, delivered, first_try, repaired, repairs, mean in self.rows(run, SAMPLES):
            part = PARTS.get(topic, topic)
            of = f"dds.{part}."
            self.assertEqual([numbers[of + value, agent] for value in ("samples", "delivered", "repaired", "repairs")],
                             [samples, delivered, repaired, repairs])
            self.assertAlmostEqual(numbers[of + "delivered_share", agent], delivered / samples)
            self.assertAlmostEqual(numbers[of + "first_try_share", agent], first_try / samples)
            self.assertAlmostEqual(numbers[of + "latency.mean", agent], mean, places=9)
            self.check_quantiles(numbers, run, topic, part, agent)
            total = totals.setdefault(part, [0, 0])
            totals[part] = [total[0] + samples, total[1] + delivered]
        self.assertEqual(set(totals), {"rt/R0/scan", PARTS.get(left, left)})
        for part, (samples, delivered) in totals.items():
            self.assertEqual((numbers[f"dds.{part}.samples", ""], numbers[f"dds.{part}.delivered", ""]), (samples, delivered))
        self.check_quantiles(numbers, run, "rt/R0/scan", "rt/R0/scan", "")
        self.assertEqual(numbers["dds.samples", ""], sum(samples for samples, _ in totals.values()))
        for agent, topic, airtime in self.rows(run, AIRTIME):
            part = PARTS.get(topic, topic)
            self.assertAlmostEqual(numbers[f"dds.{part}.airtime", agent], airtime, places=9)
            self.assertAlmostEqual(numbers[f"dds.{part}.air_share", agent], airtime / 15, places=9)
        self.assertAlmostEqual(sum(value for (name, _), value in numbers.items() if name.startswith("air.") and
                                   name.endswith(".airtime")), numbers["frames.airtime", ""], places=9)
        self.assertEqual(numbers["dds.silent.samples", "listeners0"], 0)
        self.assertNotIn(("dds.silent.delivered_share", "listeners0"), numbers)
        self.assertNotIn(("dds.silent.samples", "talker0"), numbers)
        lost = sum(value for (name, _), value in numbers.items() if name.startswith("dds.rt/R0/scan.lost."))
        self.assertEqual(lost, numbers["dds.rt/R0/scan.samples", ""] - numbers["dds.rt/R0/scan.delivered", ""] -
                         numbers["dds.rt/R0/scan.under_way", ""])
        self.assertIn(("dds.rt/R0/scan.lost.queue_full", ""), numbers, "which none was, and it is no less a number")

    def test_a_report_compares_them_and_a_figure_draws_them(self):
        self.campaign(self.content("fastdds", replications=3), "--jobs", 2)
        name = "dds.rt/R0/scan.first_try_share"
        report = Program("baraka", "report", self.out, "--figure", name, "--as", "table").finish()
        self.assertRegex(report.out, r"(?m)^0 +3 +1 +[0-9.]+ +1 ", "without loss all arrive at once; and an interval")
        row = next(line.split() for line in report.out.splitlines() if line.startswith("0.25 "))
        values = [value for value, in self.ask(
            "SELECT value FROM measurements JOIN observables USING (observable) JOIN runs USING (run) WHERE name = "
            f"'{name}' AND agent = '' AND point = 2")]
        self.assertAlmostEqual(float(row[2]), sum(values) / 3, delta=1e-3)
        self.assertTrue(float(row[3]) < float(row[2]) < float(row[4]), row)
        figure = self.folder / "latency.svg"
        drawn = Program("baraka", "report", self.out, "--figure", "dds.listeners1.cam%2Eleft.latency.p95", "-o", figure).finish()
        self.assertEqual(drawn.status, 0, str(drawn))
        self.assertIn("latency.p95", figure.read_text(encoding="utf-8"))
        pattern = "dds.*.first_try_share"
        several = Program("baraka", "report", self.out, "--figure", pattern, "--as", "table").finish()
        topics = {name for name, in self.ask(f"SELECT DISTINCT name FROM observables WHERE name GLOB '{pattern}'")}
        self.assertGreater(len(topics), 1)
        self.assertIn(report.out.strip(), several.out)
        tables = [line.split(": ")[0] for line in several.out.splitlines() if "mean over runs" in line]
        self.assertEqual(tables, sorted(topics), several.out)
        drawn = Program("baraka", "report", self.out, "--figure", pattern, "-o", figure).finish()
        self.assertNotEqual(drawn.status, 0)
        self.assertIn(f"a file has one figure, and {pattern} stands for {len(topics)}: dds.", drawn.err)

    def test_an_interrupted_campaign_goes_on_and_each_run_is_the_single_run(self):
        content = self.content(replications=8)
        program = self.begin(content, "--jobs", 2)
        wait_for(lambda: self.done() >= 2)
        send(program.process.pid, "SIGINT")
        self.assertEqual(program.finish().status, 130)
        self.assertLess(self.done(), 16)
        self.assertGreater(int(self.campaign(content, "--jobs", 2)["kept"]), 1)
        prints = [value for value, in self.ask("SELECT fingerprint FROM runs ORDER BY run")]
        self.assertEqual(len(set(prints)), 16)
        single = self.start(self.scenario(), "--seed", 3, "--set", "radio.loss.probability=0.25", out=self.folder / "one").finish()
        self.assertEqual(single["fingerprint"], prints[10])

    def test_controllers_inside_networks_are_spawned(self):
        self.campaign({"scenario": "robots_on_an_access_point", "until": "8 s", "replications": 2}, "--jobs", 2)
        self.assertEqual(self.ask("SELECT value FROM campaign WHERE key = 'controllers'"), [("spawn",)])
        for run in 1, 2:
            numbers = self.numbers(run)
            self.assertGreater(numbers["dds.rt/r0/odom.samples", "operator"], 50)
            self.assertGreater(numbers["dds.rt/r0/odom.airtime", "ap"], 0, "the access point sends it on")

    def test_the_pace_is_the_campaigns(self):
        content = self.content(replications=1, vary={"radio.loss.probability": [0]}, until="4 s", pace="realtime")
        finished = self.campaign(content)
        self.assertIn("in real time (realtime): runs of equal seeds differ", finished.out)
        self.assertEqual(self.ask("SELECT value FROM campaign WHERE key = 'pace'"), [("realtime",)])
        self.assertGreater(self.ask("SELECT wall_s FROM runs")[0][0], 4)
        self.assertIn("in real time (realtime)", Program("baraka", "report", self.out).finish().out)
        refused = self.campaign({**content, "pace": "lockstep"}, status=2)
        self.assertIn("pace: there 'realtime', now 'lockstep'", refused.err)
        for pace, words in ("realtime:2", "F must be from 0.01 to 1"), ("fast", "'fast' is not one of lockstep, realtime"):
            wrong = Program("baraka", "check", self.write({**content, "pace": pace})).finish()
            self.assertEqual(wrong.status, 2, str(wrong))
            self.assertRegex(wrong.err, r"speeds\.yaml:1:\d+: pace: .*" + words)


if __name__ == "__main__":
    if not has_networks() or not (TESTS / "cyclone_load").exists():
        print("skipped: needs cyclone_load, user namespaces and /dev/net/tun", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
