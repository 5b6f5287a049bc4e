#!/usr/bin/env python3
"""Parameters of every kind, one-hop broadcasts beside floods, names of agents and recorded values: in
process as over DDS, and before a reader of inspection."""
import math
import random
import re
import unittest

from baraka import ROOT, Case, Program, some_domain

GOSSIP = ROOT / "tests/e2e/gossip.yaml"
IN_PROCESS = ["--controllers", "in-process"]
FLOODS = ["--set", "agents.motes.controller.overrides.0.parameters.floods=true"]
M1, M2, ROBOT = 2, 3, 5
MOTE = """version: 1
agent: {{name: m1, address: 2, kind: mote}}
controller: {{program: gossip, parameters: {{friends: [m2, x9]}}}}
radio: {{interface: lo, address: 127.77.{net}.1, port: 7300}}
localisation:
  driver: static
  pose: {{x: 0 m, y: 0 m, yaw: 0 deg}}
  map: [{{name: m2, address: 3, x: 3 m, y: 4 m}}]
"""
WORDS = ["psst", "so, it's"]


class Gossip(Case):
    def states(self):
        """What each agent said it heard, by name."""
        heard = {}
        for name, state in self.query("SELECT name, state FROM states NATURAL JOIN agents ORDER BY at_ns"):
            heard.setdefault(name, []).append(state)
        return heard

    def speakers(self):
        return [name for name, in self.query(
            "SELECT DISTINCT name FROM frames_sent NATURAL JOIN agents WHERE class = 'broadcast' ORDER BY name")]

    def recorded(self, name, agent=ROBOT):
        return self.query(f"SELECT at_ns, value FROM recorded WHERE name = '{name}' AND agent = {agent}"
                          " ORDER BY at_ns")

    def both_ways(self, *arguments):
        """Runs it in process and over DDS, with the same result, and leaves that of the latter."""
        inside = self.run_baraka(GOSSIP, *IN_PROCESS, *arguments)
        rows = self.query("SELECT * FROM recorded ORDER BY rowid")
        outside = self.run_baraka(GOSSIP, *arguments)
        self.assertEqual(inside["fingerprint"], outside["fingerprint"])
        self.assertEqual(rows, self.query("SELECT * FROM recorded ORDER BY rowid"))
        return outside

    def test_a_broadcast_to_neighbours_is_heard_by_them_and_repeated_by_nobody(self):
        self.both_ways()
        words = [f"m1 says news: {word}" for word in WORDS]
        self.assertEqual(self.states(), {"m0": words, "m2": words, "r0": words})
        self.assertEqual(self.speakers(), ["m1"])
        self.assertEqual([value for _, value in self.recorded("news handed over", M1)], [1, 2])
        self.assertEqual(self.query("SELECT reached, verdict FROM broadcasts"), [(3, "delivered")] * 2)

    def test_the_same_as_a_flood_reaches_everyone_because_all_repeat_it(self):
        self.both_ways(*FLOODS)
        words = [f"m1 says news: {word}" for word in WORDS]
        self.assertEqual(self.states(), {name: words for name in ("m0", "m2", "m3", "r0")})
        self.assertEqual(self.speakers(), ["m0", "m1", "m2", "m3", "r0"])

    def test_addresses_are_those_of_the_run_and_of_nobody_for_a_stranger(self):
        self.both_ways()
        found = dict(self.query("SELECT name, value FROM recorded WHERE name LIKE 'address of %'"))
        self.assertEqual(found, {"address of m2": M2, "address of r0": ROBOT, "address of x9": -1})

    def test_a_robot_records_in_each_cycle_the_distance_that_the_poses_say(self):
        self.both_ways()
        (x, y), = self.query(f"SELECT x_m, y_m FROM agents WHERE agent = {M2}")
        poses = {at: math.hypot(px - x, py - y) for at, px, py in self.query(
            f"SELECT at_ns, x_m, y_m FROM poses WHERE agent = {ROBOT}")}
        distances = self.recorded("distance")
        cycles = [i * 100_000_000 for i in range(30)]
        # The robot stands until its first command takes effect: then there is no new pose.
        self.assertEqual([at for at, _ in distances], cycles)
        compared = [(at, d) for at, d in distances if at in poses]
        self.assertGreater(len(compared), 25)
        for at, distance in compared:
            self.assertAlmostEqual(distance, poses[at], delta=1e-9)
        self.assertGreater(abs(distances[-1][1] - distances[0][1]), 0.1, "it drives")

    def test_check_says_what_is_wrong_with_a_parameter_of_each_kind(self):
        where = "agents.motes.controller.overrides.0.parameters"
        for value, message in [("floods=yes", "floods: must be true or false, not 'yes'"),
                               ("topic=rumour", "topic: 'rumour' is not one of gossip, news"),
                               ("times=1 s", "times: must be a list"),
                               ("times=[1 s, 2 m]", "times: item 2: "),
                               ("words=[a, [b]]", "words")]:
            with self.subTest(value=value):
                program = Program("baraka", "check", GOSSIP, "--set", f"{where}.{value}")
                finished = program.finish()
                self.assertEqual(finished.status, 2, str(finished))
                self.assertIn(message, finished.err + finished.out)

    def test_a_reader_of_inspection_sees_what_is_recorded(self):
        domain = some_domain(self)
        echo = Program("baraka", "topic", "echo", "baraka/values", "--domain", domain, "--count", 10)
        self.addCleanup(echo.clean_up)
        self.run_baraka(GOSSIP, "--domain", domain, "--max-speed", 0.3)
        rows = self.query("SELECT at_ns, agents.name, recorded.name, value FROM recorded JOIN agents USING (agent)")
        samples = re.findall(r'stamp:\n  sec: (\d+)\n  nanosec: (\d+)\nagent: "(.*)"\nname: "(.*)"\nvalue: (.*)\n',
                             echo.finish().out)
        self.assertEqual(len(samples), 10)
        for seconds, nanoseconds, agent, name, value in samples:
            self.assertIn((int(seconds) * 10**9 + int(nanoseconds), agent, name, float(value)), rows)


class OnADaemon(Case):
    def test_values_are_shown_and_logged_and_names_are_those_of_the_map(self):
        domain = some_domain(self)
        file = self.folder / "m1.yaml"
        file.write_text(MOTE.format(net=random.randrange(1, 255)))
        daemon = Program("baraka-agentd", file, "--domain", domain, "--no-state", "--log", "debug")
        echo = Program("baraka", "topic", "echo", "baraka/values", "--domain", domain, "--count", 6)
        controller = Program("../tests/gossip", "--agents", "m1", "--domain", domain, "--wait", "60 s")
        for program in (daemon, echo, controller):
            self.addCleanup(program.clean_up)
        # The addresses are said once, perhaps before the reader is there.
        expected = {"distance": "5", "address of m2": "3", "address of x9": "-1"}
        samples = re.findall(r'agent: "m1"\nname: "(.*)"\nvalue: (.*)\n', echo.finish().out)
        self.assertEqual(len(samples), 6)
        for name, value in samples:
            self.assertEqual(value, expected[name])
        daemon.process.terminate()
        said = daemon.finish().err
        for line in ("records address of m2 = 3", "records address of x9 = -1", "records distance = 5"):
            self.assertIn(line, said)


if __name__ == "__main__":
    unittest.main()
