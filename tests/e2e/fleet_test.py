#!/usr/bin/env python3
"""`baraka fleet`: its numbers are those of the samples in the runs' records, and its answer follows from them."""
import contextlib
import json
import pathlib
import re
import shutil
import sqlite3
import sys
import unittest

from baraka import ROOT, Case, Program, send, wait_for
from private_network import has_networks

SKIPPED = 77
RADIO = {"include": str(ROOT / "config/radios/ieee80211g.yaml"), "data_rate": "6 Mb/s",
         "propagation": [{"model": "log_distance", "exponent": 3}], "bss": {"access_point": "ap"}}
ROBOTS = {"name": "r{}", "station": {}, "circle": {"count": 1, "radius": "5 m"}, "network": {}, "topics": [
    {"name": "rt/{agent}/scan", "size": "4 kB", "rate": "20 Hz", "reliability": "best_effort", "readers": ["base"]},
    {"name": "rt/{agent}/odom", "size": "200 B", "rate": "20 Hz", "reliability": "best_effort", "readers": ["base"]}]}
SCENARIO = {"version": 1, "radio": RADIO, "routing": "none", "end": [{"at": "100 s", "result": "done"}], "agents": {
    "ap": {"name": "ap", "station": {}, "poses": [{"x": "0 m", "y": "0 m"}]},
    "base": {"name": "base", "station": {}, "poses": [{"x": "1 m", "y": "0 m"}], "network": {}},
    "robots": ROBOTS}}
# 6 Mb/s carries each byte twice: two robots of 0.7 Mb/s each fit, five do not.
FLEET = {"version": 1, "scenario": "hall.yaml", "robots": {"group": "robots", "from": 2, "to": 5, "step": 3},
         "need": [{"topic": "*/scan", "delivered": "99 %", "p95": "200 ms"}],
         "warm_up": "2 s", "until": "5 s", "replications": 2}


class Fleets(Case):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.write("hall.yaml", SCENARIO)

    def write(self, name, content):
        """JSON is YAML."""
        file = self.folder / name
        file.write_text(json.dumps(content, indent=1))
        return file

    def begin(self, content, *options, out=None):
        program = Program("baraka", "fleet", self.write("fleet.yaml", content), "--out", out or self.out, *options)
        self.addCleanup(program.clean_up)
        return program

    def fleet(self, content, *options, out=None, status=0):
        finished = self.begin(content, *options, out=out).finish(240)
        self.assertEqual(finished.status, status, str(finished))
        self.assertNotIn("left out", str(finished))
        return finished

    @staticmethod
    def tables(finished):
        """What it printed of its answer, without what differs from one time to another."""
        return finished.out[finished.out.index("\n\n"):finished.out.index("page: ")]

    def samples(self, point):
        """(sent, delivered, writers) of the scans in the window, of a point's runs: from their records alone."""
        found = []
        for run in sorted((self.out / "runs").glob(f"p{point:03}-r*/run.sqlite")):
            with contextlib.closing(sqlite3.connect(f"file:{run}?mode=ro", uri=True)) as database:
                [row] = database.execute(
                    "SELECT COUNT(*), COUNT(left_ns), COUNT(DISTINCT writer) FROM samples JOIN dds_endpoints ON guid = writer"
                    " WHERE topic LIKE 'rt/r%/scan' AND entered_ns >= 2e9 AND NOT (left_ns IS NULL AND verdict IS NULL)").fetchall()
                found.append(row)
        return found


class Answer(Fleets):
    def test_two_robots_fit_and_five_do_not_because_the_air_is_full(self):
        finished = self.fleet(FLEET)
        self.assertRegex(finished.out, r"(?m)^2 robots with the scenario's profile\. With 5, \*/scan fails first: (?:delivered|some samples) .*"
                                       r"Cause: the air is full \(the medium at .* has frames to send in ")
        for point, robots in (1, 2), (2, 5):
            runs = self.samples(point)
            self.assertEqual(len(runs), 2)
            told = float(re.search(rf"(?m)^{robots} +rt/\*/scan +>?([\d.]+) %", finished.out).group(1))
            share = 50 * sum(delivered / sent for sent, delivered, _ in runs)
            if all(writers == robots for _, _, writers in runs):
                self.assertAlmostEqual(told, share, delta=0.0501)
            else:  # what a writer wrote without knowing its reader is not in the record
                self.assertEqual(point, 2)
                self.assertLess(told, share)
        page = pathlib.Path(finished["page"]).read_text()
        self.assertIn("the air is full", page)
        self.assertEqual(page.count("<svg"), 3)
        self.assertNotIn("http:", page.replace("http://www.w3.org", ""), "it needs no network")

    def test_profiles_and_radios_are_compared(self):
        content = {**FLEET, "robots": {"group": "robots", "from": 2, "to": 2}, "replications": 1,
                   "radios": {"slow": {"radio.data_rate": "6 Mb/s"}, "fast": {"radio.data_rate": "54 Mb/s"}},
                   "profiles": {"default": {}, "one_frame": {"vendor": "cyclonedds", "file": "cyclone_one_frame.xml"}}}
        finished = self.fleet(content)
        air = {}
        for name in "slow, default", "slow, one_frame", "fast, default", "fast, one_frame":
            part = finished.out.split(f"\n{name}\n", 1)[1]
            air[name] = float(re.search(r"(?m)^all transmissions +([\d.]+) %", part).group(1))
        self.assertLess(air["fast, default"], 0.5 * air["slow, default"])
        self.assertNotEqual(air["slow, default"], air["slow, one_frame"])
        self.assertRegex(finished.out, r"(?m)^slow: at least 2 robots with profile \w+\. Of the others, profile \w+ holds as many")
        best = set(re.findall(r"(?m)^(?:slow|fast): at least 2 robots with profile (\w+)", finished.out))
        self.assertEqual("MaxMessageSize" in pathlib.Path(finished["page"]).read_text(), "one_frame" in best,
                         "the XML of a best profile, and of no other, is on the page")

    def test_a_reader_that_is_out_of_range_is_told(self):
        scenario = json.loads(json.dumps(SCENARIO))
        scenario["agents"]["base"]["poses"] = [{"x": "5 km", "y": "0 m"}]
        self.write("hall.yaml", scenario)
        finished = self.fleet({**FLEET, "robots": {"group": "robots", "from": 1, "to": 1}, "replications": 1})
        self.assertRegex(finished.out, r"(?m)^fewer than 1 robots with .*\*/scan fails first: some samples never arrive\. Cause: no access point")


    def test_robots_with_bodies_drive_while_they_are_asked_and_walls_cut_them_off(self):
        scenario = json.loads(json.dumps(SCENARIO))
        robots = scenario["agents"]["robots"]
        del robots["station"]
        robots |= {"robot": {"include": str(ROOT / "config/robots/robertino.yaml")},
                   "controller": {"program": "wanderer", "parameters": {"speed": "0.3 m/s"}}}
        scenario["radio"]["obstacles"] = True
        scenario["agents"]["base"]["poses"] = [{"x": "1 m", "y": "0 m"}]
        self.write("hall.yaml", scenario)
        ring = [{"name": f"wall{i}", "size": ["40 m", "20 cm", "2 m"] if i < 2 else ["20 cm", "40 m", "2 m"],
                 "position": [f"{x} m", f"{y} m"], "radio_loss": {"per_crossing": "60 dB"}}
                for i, (x, y) in enumerate([(0, 3), (0, -3), (3, 0), (-3, 0)])]
        finished = self.fleet({**FLEET, "robots": {"group": "robots", "from": 1, "to": 2}, "replications": 1,
                               "sites": {"open": {}, "walled": {"world.walls": ring}}})
        self.assertRegex(finished.out, r"(?m)^open: at least 2 robots ")
        self.assertRegex(finished.out, r"(?m)^walled: fewer than 1 robots .*Cause: no access point")
        with contextlib.closing(sqlite3.connect(f"file:{self.out}/runs/p002-r01/run.sqlite?mode=ro", uri=True)) as database:
            [[least]] = database.execute("""SELECT MIN(way) FROM (SELECT MAX(ABS(p.x_m - q.x_m) + ABS(p.y_m - q.y_m)) way FROM poses p
                JOIN poses q USING (agent) JOIN agents USING (agent) WHERE name LIKE 'r_' GROUP BY agent)""").fetchall()
        self.assertGreater(least, 0.5)

    def test_paths_in_the_file_are_relative_to_it(self):
        shutil.copy(ROOT / "tests/unit/hal/files/recording/bags/plain.mcap", self.folder / "lab.mcap")
        finished = self.fleet({**FLEET, "robots": {"group": "robots", "from": 1, "to": 1}, "replications": 1, "until": "4 s",
                               "need": [{"topic": "*/scan", "delivered": "99 %"}],
                               "set": {"agents.robots.topics": [{"from": "lab.mcap", "repeat": True, "readers": ["base"]}]}})
        self.assertRegex(finished.out, r"(?m)^1 +rt/\*/scan ")


class GoingOn(Fleets):
    def players(self):
        """Processes that play topics of this test's runs."""
        found = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                words = (process / "cmdline").read_bytes()
                found += [process.name] if b"baraka-topics" in words and str(self.folder).encode() in words else []
        return found

    def test_after_ctrl_c_it_goes_on_to_the_same_answer(self):
        scenario = json.loads(json.dumps(SCENARIO))
        for topic in scenario["agents"]["robots"]["topics"]:
            topic["participants"] = "topic"  # players of several processes
        self.write("hall.yaml", scenario)
        content = {**FLEET, "replications": 1, "robots": {"group": "robots", "from": 1, "to": 3, "step": 2}}
        whole = self.fleet(content, out=self.folder / "whole")
        program = self.begin(content)
        wait_for(lambda: any(self.out.glob("runs/*/run.sqlite")) and self.players())
        send(program.process.pid, "SIGINT")
        self.assertEqual(program.finish().status, 130)
        wait_for(lambda: not self.players())
        self.assertEqual(self.tables(self.fleet(content)), self.tables(whole))
        self.assertEqual(self.tables(self.fleet(content, "--status")), self.tables(whole))

    def test_a_narrower_need_takes_no_new_runs(self):
        small = {**FLEET, "robots": {"group": "robots", "from": 2, "to": 2}}
        self.fleet(small)
        again = self.begin({**small, "need": [{"topic": "*/scan", "p95": "1 us"}]}, "--status").finish()
        self.assertRegex(again.out, r"fewer than 2 robots .* 95 % latency .*, asked 1 us")

    def test_numbers_that_are_added_later_are_those_of_their_cases(self):
        content = {**FLEET, "replications": 1, "until": "3 s", "radios": {"slow": {}, "fast": {"radio.data_rate": "54 Mb/s"}},
                   "robots": {"group": "robots", "from": 1, "to": 1}}
        more = {**content, "robots": {"group": "robots", "from": 1, "to": 2}}
        self.fleet(content)
        self.assertEqual(self.tables(self.fleet(more)), self.tables(self.fleet(more, out=self.folder / "whole")))
        other = self.begin({**content, "robots": {"group": "robots", "from": 3, "to": 3}}, "--status").finish()
        self.assertEqual(other.status, 2)
        self.assertIn("has no case 'slow, 3 robots'", other.err)

    def test_other_xml_under_the_same_name_is_not_the_same_fleet(self):
        profile = self.folder / "own.xml"
        profile.write_text((ROOT / "config/dds/cyclone_one_frame.xml").read_text())
        content = {**FLEET, "replications": 1, "until": "3 s", "robots": {"group": "robots", "from": 1, "to": 1},
                   "profiles": {"own": {"vendor": "cyclonedds", "file": "own.xml"}}}
        self.fleet(content)
        profile.write_text(profile.read_text().replace("1400 B", "60000 B"))
        refused = self.begin(content).finish()
        self.assertEqual(refused.status, 2, str(refused))
        self.assertIn("own.xml", refused.err)


class Mistakes(Fleets):
    def refused(self, content, *words):
        finished = Program("baraka", "check", self.write("fleet.yaml", content)).finish()
        self.assertNotEqual(finished.status, 0)
        for word in words:
            self.assertIn(word, finished.err)

    def test_each_has_its_place(self):
        robots = FLEET["robots"]
        self.refused({**FLEET, "robots": {**robots, "group": "robot"}}, "fleet.yaml:", "has no group 'robot', only ap, base, robots")
        self.refused({**FLEET, "robots": {**robots, "group": "base"}}, "hall.yaml:", "placed one by one")
        self.refused({**FLEET, "robots": {**robots, "to": 1}}, "fleet.yaml:", "robots.to: must not be less than `from`")
        self.refused({**FLEET, "need": [{"topic": "*/scan"}]}, "fleet.yaml:", "needs a limit")
        self.refused({**FLEET, "need": []}, "must have at least one")
        self.refused({**FLEET, "need": [{"topic": "*/scan", "delivered": "101 %"}]}, "fleet.yaml:", "101 % is above the limit of 1")
        self.refused({**FLEET, "profiles": {"a": {"file": "no.xml"}}}, "fleet.yaml:", "no.xml")
        self.refused({**FLEET, "profiles": {"a": {"vendor": "fastdds", "file": "cyclone_one_frame.xml"}}}, "fleet.yaml:",
                     "cyclone_one_frame.xml is not XML of fastdds")
        self.refused({**FLEET, "profiles": {"a": {"vendor": "opendds"}}}, "fleet.yaml:", "not one of cyclonedds, fastdds")
        self.refused({**FLEET, "radios": {"a": {"radio.data_rat": "6 Mb/s"}}}, "fleet.yaml:", "data_rat")
        self.refused({**FLEET, "until": "1 s"}, "fleet.yaml:", "must be later than `warm_up`")

    def test_a_need_about_no_topic_is_told_before_the_first_run(self):
        for need in ({"topic": "*/scnn", "delivered": "99 %"}, {"topic": "*/scan", "readers": "r0", "delivered": "99 %"}):
            content = {**FLEET, "need": [{"topic": "*/scan", "p95": "1 s"}, need]}
            words = "fleet.yaml:", "need: no topic like", "(5 robots); there are rt/*/odom, rt/*/scan to base"
            self.refused(content, *words)
            refused = self.begin(content).finish()
            self.assertEqual(refused.status, 2, str(refused))
            self.assertIn(words[-1], refused.err)
            self.assertFalse(self.out.exists())
            two = {**content, "radios": {"fast": {}, "slow": {"radio.data_rate": "6 Mb/s"}}}
            refused = self.begin(two).finish()
            self.assertEqual(refused.err.count("need: no topic like"), 1, refused.err)
            self.assertIn("(fast, 5 robots)", refused.err)


if __name__ == "__main__":
    if not has_networks():
        print("skipped: needs user namespaces and /dev/net/tun", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
