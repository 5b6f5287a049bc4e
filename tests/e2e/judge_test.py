#!/usr/bin/env python3
"""What `baraka check` finds before a run, `baraka run` refuses with the same words, and controllers are
kept from while it lasts."""
import pathlib
import re
import unittest

from baraka import ROOT, Case, Program

HERE = pathlib.Path(__file__).resolve().parent
WANDERER = ROOT / "config/scenarios/wanderer.yaml"
SATURATION = ROOT / "config/scenarios/saturation.yaml"
TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
IN_PROCESS = ["--controllers", "in-process"]
HOSTS = (IN_PROCESS, [])  # in this process; spawned, over DDS


def sets(overrides):
    return [argument for override in overrides for argument in ("--set", override)]


class WhatCannotRun(Case):
    CASES = [
        (WANDERER, ["agents.robots.robot.infrared={mounts: []}"],
         r"program: 'wanderer' needs a channel: r0 has no channel 'infrared'; it has: "
         r"localisation, odometry"),
        (WANDERER, ["end=[{agent: r0, state: LOST, result: a}, {at: 1 s, result: b}]",
                    "agents.robots.controller={program: blind}"],
         r"end\.state: blind declares no state 'LOST'"),
        (WANDERER, ["agents.robots.poses=[{x: 3 m, y: 0 m}]"], r"r0 is 0\.285 m deep in 'east'"),
        (WANDERER, ["agents.robots.poses=[{x: 0 m, y: 0 m}, {x: 0 m, y: 0.3 m}]"],
         r"r1 overlaps r0 by 0\.07 m; they are 0\.3 m apart"),
        (WANDERER, ["agents.robots.robot.wheels.joints=[{distance: 0.132 m, bearing: 0 deg}, "
                    "{distance: 0.132 m, bearing: 90 deg}, {distance: 0.132 m, bearing: 180 deg}]"],
         r"the robot would tip over when it reverses: 0\.15 m/s\^2 lift wheels"),
        (SATURATION, ["agents.sources.controller.parameters.to=snik"],
         r"to: there is no agent 'snik'"),
        (SATURATION, ["agents.sources.controller.parameters.to=s3"], r"to: 's3' is the agent itself"),
        (SATURATION, ["agents.sources.controller.parameters.start=3 s",
                      "agents.sources.controller.parameters.stop=2 s"],
         r"stop: is before `start`: it would never send"),
        (SATURATION, ["agents.sink.controller.parameters.stop=0.5 s"],
         r"stop: is not after `start`: it would never count"),
        (SATURATION, ["radio.propagation=[{model: two_ray_ground}]", "radio.antenna_height=0 m"],
         r"is 0 m of 'sink': with the model two_ray_ground"),
        (SATURATION, ["radio.propagation=[{model: two_ray_interference}]", "radio.antenna_height=0 m"],
         r"is 0 m of 'sink': with the model two_ray_interference"),
        (TWO_MOTES, ["agents.motes.controller.parameters={help_at: 1e300 s}"],
         r"help_at: 1e300 s is above the limit of 1000000000 s"),
    ]

    def test_is_refused_by_check_and_by_run_with_the_same_words(self):
        for scenario, overrides, words in self.CASES:
            with self.subTest(words=words):
                checked = Program("baraka", "check", scenario, *sets(overrides)).finish()
                self.assertEqual(checked.status, 2, str(checked))
                self.assertRegex(checked.err, r"(?m)^(\S+\.yaml:\d+:\d+|--set [\w.]+): .*" + words)
                for host in HOSTS:
                    ran = self.start(scenario, *host, *sets(overrides)).finish()
                    self.assertEqual((ran.status, ran.err), (2, checked.err), str(ran))


class ControllersInside(Case):
    """Only a run can start them: it is the one that has their agents' networks."""
    SCENARIO = """version: 1
name: inside
radio: {profile: ieee80211b}
routing: none
end: [{at: 1 s, result: done}]
agents:
  a: {station: {}, poses: [{x: 0 m, y: 0 m}], network: {}, controller: {program: traffic_sink, inside: true}}
"""

    def setUp(self):
        super().setUp()
        self.scenario = self.folder / "inside.yaml"
        self.scenario.write_text(self.SCENARIO)

    def test_are_refused_by_check_and_by_run_unless_they_are_spawned(self):
        for where in ("in-process", "external"):
            checked, ran = (Program("baraka", *command, self.scenario, "--controllers", where).finish()
                            for command in (["check"], ["run", "--out", self.folder / "out"]))
            self.assertEqual((checked.status, ran.status), (2, 2), str(ran))
            self.assertEqual(checked.err,
                             f"{self.scenario}:7:82: program: 'traffic_sink' is to run inside its agent's network, "
                             f"where only the run can start it: controllers must be spawn, not {where}\n")
            self.assertEqual(checked.err, ran.err)
        self.assertFalse((self.folder / "out").exists(), "judged before anything is written")
        checked = Program("baraka", "check", self.scenario).finish()
        self.assertEqual((checked.status, checked.err), (0, ""))

    def test_are_spawned_in_a_campaign_whatever_its_file_says(self):
        campaign = self.folder / "campaign.yaml"
        for controllers in "", "controllers: in-process\n", "controllers: spawn\n":
            campaign.write_text("version: 1\nname: c\nscenario: inside.yaml\nreplications: 2\n" + controllers)
            checked = Program("baraka", "check", campaign).finish()
            self.assertEqual((checked.status, checked.err), (0, ""), str(checked))


class Warnings(Case):
    def test_are_told_with_their_place_and_change_neither_status_nor_outcome(self):
        doubtful = sets(["radio.noise_floor=-60 dBm"])
        checked = Program("baraka", "check", TWO_MOTES, *doubtful).finish()
        self.assertEqual(checked.status, 0, str(checked))
        self.assertRegex(checked.err, r"--set radio.noise_floor: warning: -60 dBm is above the "
                                      r"sensitivity, -85 dBm")
        self.assertRegex(checked.out, ": ok")
        ran = self.start(TWO_MOTES, *IN_PROCESS, *doubtful).finish()
        self.assertEqual(ran.status, 0, str(ran))
        self.assertIn(checked.err.splitlines()[0], ran.err)

    def test_are_told_of_parameters_that_hardly_work_together(self):
        for overrides, words in (
                (["agents.sources.controller.parameters.rate=5 Hz"],
                 r"warning: rate: has no effect: a saturated source sends as fast as it can"),
                (["agents.sources.controller.parameters.pattern=periodic"],
                 r"warning: backlog: has no effect: `pattern` is periodic, it is for saturated"),
                (["agents.sources.controller.parameters.topic=T"],
                 r"warning: topic: no agent receives the topic 'T'; agents receive: 't'"),
                (["agents.sink.controller.parameters.topic=other"],
                 r"warning: topic: no agent receives the topic 't'; agents receive: 'other'")):
            with self.subTest(overrides=overrides):
                checked = Program("baraka", "check", SATURATION, *sets(overrides)).finish()
                self.assertEqual(checked.status, 0, str(checked))
                self.assertRegex(checked.err, r"^(\S+\.yaml:\d+:\d+|--set [\w.]+): " + words + "\n$")
                ran = self.start(SATURATION, *IN_PROCESS, "--until", "0.1", *sets(overrides)).finish()
                self.assertIn(checked.err, ran.err)
        # Without a sink messages are load on the air.
        load = sets(["agents.sink.controller={program: traffic_source}"])
        self.assertEqual(Program("baraka", "check", SATURATION, *load).finish().err, "")

    def test_are_told_of_robots_and_hardware_files_too(self):
        tall = "[{cylinder: {radius: 0.2 m, bottom: 0.02 m, top: %s m}, mass: 20 kg}]"
        for file, override in (
                ("robots/robotino.yaml", "link.collision=" + tall % 0.95),
                ("hardware/robotino.yaml", "robot.link.collision=" + tall % 0.95)):
            with self.subTest(file=file):
                checked = Program("baraka", "check", ROOT / "config" / file, "--set", override).finish()
                self.assertEqual(checked.status, 0, str(checked))
                self.assertRegex(checked.err, r"robotino\.yaml:\d+:\d+: warning: .*wheels\.joints: the "
                                              r"robot is close to tipping over")

    def test_what_cannot_be_checked_is_told_as_that(self):
        waits = sets(["end=[{agent: r0, state: LOST, result: a}, {at: 1 s, result: b}]"])
        checked = Program("baraka", "check", WANDERER, *waits).finish()
        self.assertEqual(checked.status, 0, str(checked))
        self.assertIn("states of wanderer: not checked, it declares none", checked.err)


class OptionalChannels(Case):
    def test_are_given_where_they_are_and_done_without_elsewhere(self):
        fingerprints = set()
        for host in HOSTS:
            finished = self.run_baraka(HERE / "blind.yaml", *host)
            self.assertEqual(finished["result"], "done")
            fingerprints.add(finished["fingerprint"])
            states = self.query("SELECT DISTINCT name, state FROM states JOIN agents USING (agent) "
                                "ORDER BY name, at_ns")
            self.assertEqual(states, [("b0", "BLIND"), ("s0", "SEES")])
            log = (self.out / "run.log").read_text()
            self.assertRegex(log, "b0.*no channel 'infrared': the agent has none")
        self.assertEqual(len(fingerprints), 1)


class Inventions(Case):
    def test_a_state_that_is_not_declared_is_refused_and_told_once(self):
        for host in HOSTS:
            self.run_baraka(HERE / "blind.yaml", *host,
                            *sets(["agents.seeing.controller.parameters={lies: 1}"]))
            self.assertEqual(self.query("SELECT count(*) FROM states WHERE state = 'DREAMS'"), [(0,)])
            told = re.findall("(?m)s0: state: 'DREAMS' is not one of the states that the controller "
                              "declares: SEES, BLIND$", (self.out / "run.log").read_text())
            self.assertEqual(len(told), 1)

    def test_topics_have_a_limit_that_is_told_once(self):
        fingerprints = set()
        for host in HOSTS:
            finished = self.run_baraka(HERE / "inventor.yaml", *host)
            fingerprints.add(finished["fingerprint"])
            state, = self.query("SELECT state FROM states WHERE state != 'granted 0 of 0'")
            # Control cycles at 0.1 s, 0 s included if phases are aligned: some 100 in 10 s.
            self.assertRegex(state[0], r"^granted 256 of (198|2\d\d)000$")
            self.assertNotIn("actions refused", finished.err)
            log = (self.out / "run.log").read_text()
            told = re.findall(r"(?m)m0: send: 'topic \d+' would be topic 257 of this agent, at most "
                              r"256 are allowed$", log)
            self.assertEqual(len(told), 1, log)
            self.assertRegex(log, r"at most 256 are allowed \(10000 times by now\)")
        self.assertEqual(len(fingerprints), 1)


if __name__ == "__main__":
    unittest.main()
