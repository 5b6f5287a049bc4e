#!/usr/bin/env python3
"""What a scenario's `events` do, in process and over DDS, as the results tell."""
import collections
import unittest

from baraka import ROOT, Case

SCENARIO = ROOT / "tests/e2e/events.yaml"
S = 10 ** 9
CAPACITY = 40 * 3600  # J


class Events(Case):
    @classmethod
    def setUpClass(cls):
        cls.once = None

    def play(self, *arguments):
        return self.run_baraka(SCENARIO, "--controllers", "in-process", *arguments)

    def at(self, name, table="states", more=""):
        """Times in s of an agent's rows."""
        key = "sender" if table == "messages" else "agent"
        time = "sent_ns" if table == "messages" else "at_ns"
        return [ns / S for ns, in self.query(
            f"SELECT {time} FROM {table} t JOIN agents a ON a.agent = t.{key} WHERE a.name = '{name}' {more} ORDER BY 1")]

    def pose(self, name, at):
        return self.query(f"SELECT p.x_m, p.y_m, p.theta_rad FROM poses p JOIN agents a USING (agent) WHERE name = '{name}' "
                          f"AND at_ns <= {at} * {S} ORDER BY at_ns DESC LIMIT 1")[0]

    def test_in_process_and_over_dds_are_equal(self):
        inside = self.play()
        rows = self.query("SELECT * FROM events")
        over_dds = self.run_baraka(SCENARIO)
        self.assertEqual(inside["fingerprint"], over_dds["fingerprint"])
        self.assertEqual(rows, self.query("SELECT * FROM events"))
        shared = self.run_baraka(SCENARIO, "--set", "agents.motes.controller.processes=3")
        self.assertEqual(inside["fingerprint"], shared["fingerprint"])
        self.assertNotIn("warning", over_dds.err)

    def test_in_real_time_and_repeated_from_its_record_they_are_equal(self):
        live = self.run_baraka(SCENARIO, "--pace", "realtime:10")
        rows = self.query("SELECT * FROM events")
        self.assertEqual(live["result"], "done")
        self.assertGreaterEqual(len(rows), 15)
        repeated = self.run_baraka(SCENARIO, "--repeat", self.out, "--controllers", "in-process")
        self.assertEqual(live["fingerprint"], repeated["fingerprint"])
        self.assertEqual(rows, self.query("SELECT * FROM events"))
        nothing = self.run_baraka(SCENARIO, "--repeat", self.folder / "nothing", status=2)
        self.assertIn(f"--repeat: '{self.folder / 'nothing'}' holds no result", nothing.err)

    def test_they_are_part_of_the_identity_and_do_what_they_say(self):
        finished = self.play()
        done = self.query("SELECT at_ns, action, name FROM events LEFT JOIN agents USING (agent)")
        self.assertEqual([(ns / S, action, name) for ns, action, name in done][:6],
                         [(2, "kill", "m1"), (2, "restart", "m2"), (4, "restart", "m1"), (4, "add", "m3"),
                          (5, "switch_off", "r1"), (5, "set", "r0")])
        counts = collections.Counter(action for _, action, _ in done)
        self.assertEqual(counts, {"kill": 1, "restart": 2, "add": 1, "switch_off": 1, "set": 5, "switch_on": 1, "move": 1,
                                  "drain": 2, "jam": 1, "remove": 1})
        self.controllers_die_and_begin_anew()
        self.agents_come_and_go()
        self.robots_are_moved_and_switched()
        without = self.play("--set", "events=[]")
        self.assertNotEqual(finished["fingerprint"], without["fingerprint"])
        self.assertEqual(self.query("SELECT COUNT(*) FROM events"), [(0,)])

    def controllers_die_and_begin_anew(self):
        # m1 says nothing for 2 s and then begins with its first state, as does m2 at once.
        sent = self.at("m1", "messages")
        self.assertTrue(any(1 < at < 2 for at in sent))
        self.assertEqual([at for at in sent if 2.01 < at < 4], [])
        self.assertTrue(any(4 < at < 5 for at in sent))
        for name, start in (("m1", 4), ("m2", 2)):
            again = self.at(name, more="AND state = 'CONNECTED'")[1]
            self.assertAlmostEqual(again, start, delta=0.011)

    def agents_come_and_go(self):
        sent = self.at("m3", "messages")
        self.assertGreaterEqual(min(sent), 4)
        removed = self.at("m3", "events", "AND action = 'remove'")
        # As r0's battery is drained: within a control cycle.
        self.assertEqual(len(removed), 1)
        self.assertTrue(8 <= removed[0] <= 8.1, removed)
        self.assertLessEqual(max(sent), removed[0] + 0.011)
        self.assertEqual([at for at in self.at("m3", "poses") if not 4 <= at <= removed[0]], [])

    def robots_are_moved_and_switched(self):
        x, y, yaw = self.pose("r0", 7.9)
        self.assertLess(abs(x), 0.1)
        self.assertTrue(30 <= y < 30.5, y)
        self.assertAlmostEqual(yaw, 1.5708, delta=0.05)
        # The 20 m that it was moved it did not go.
        (path,), = self.query("SELECT path_m FROM bodies JOIN agents USING (agent) WHERE name = 'r0'")
        self.assertLess(path, 5)
        # Without power it rolls to a stand; with it, it goes on.
        before, off, on = (self.pose("r1", at)[0] for at in (5, 6.9, 12.9))
        self.assertLess(off - before, 1.2)
        self.assertGreater(on - off, 1)

    def test_a_jammer_takes_the_air(self):
        def delivered(*arguments):
            """Between 50 ms after its beginning, for what was on its way, and its end."""
            self.play("--until", 11, *arguments)
            return self.query(f"SELECT COUNT(*) FROM deliveries WHERE at_ns BETWEEN 9.05 * {S} AND 10 * {S}")[0][0]

        def jam(duty, power="100 mW", duration="1 s"):
            return f"events=[{{at: 9 s, do: [{{jam: {{position: [10 m, 5 m], power: {power}, duration: {duration}, " \
                   f"duty_cycle: {duty}}}}}]}}]"
        without = delivered("--set", "events=[]")
        self.assertGreater(without, 10)
        self.assertEqual(delivered("--set", jam(1)), 0)
        self.assertGreater(delivered("--set", jam(1, duration="500 ms")), 0)
        # Too weak to be sensed or to disturb; in bursts, between which there is time to send.
        self.assertEqual(delivered("--set", jam(1, "0.000001 mW")), without)
        self.assertGreater(delivered("--set", jam(0.2)), without / 2)

    def test_misspelt_states_are_found_by_check(self):
        finished = self.run_baraka(SCENARIO, "--set", "end=[{when: {any: 'm*', state: CONECTED}, result: done}]", status=2)
        self.assertIn("end.when.state: gap_mote declares no state 'CONECTED'; did you mean 'CONNECTED'?", finished.err)


if __name__ == "__main__":
    unittest.main()
