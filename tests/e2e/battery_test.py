#!/usr/bin/env python3
"""A battery, as the controllers of a robot and a mote meet it over DDS and in process, and as a reader that
knows only ROS 2 sees it."""
import unittest

from baraka import ROOT, Case, some_domain
from ros import Peer, needs_peer

SCENARIO = ROOT / "tests/e2e/battery.yaml"
AFTER = 10  # s, when the controllers say what they see
QUIET = 5 + 0.8  # W, of the robot without its motors
ROBOT = 20 * 3600  # J
MOTE = 100  # J


class Battery(Case):
    def states(self):
        return dict(self.query("SELECT name, state FROM states JOIN agents USING (agent)"))

    def test_the_controllers_meet_it_over_dds_as_in_process(self):
        inside = self.run_baraka(SCENARIO, "--controllers", "in-process")
        states = self.states()
        over_dds = self.run_baraka(SCENARIO)
        self.assertEqual(inside["fingerprint"], over_dds["fingerprint"])
        self.assertEqual(states, self.states())

        self.assertEqual(states["o0"], "no battery")
        charge, voltage, current, energy, capacity = map(float, states["m0"].split())
        self.assertAlmostEqual(charge, 1 - 1.5 * AFTER / MOTE, places=6)
        self.assertAlmostEqual(energy, MOTE - 1.5 * AFTER, places=6)
        self.assertEqual(capacity, MOTE)
        self.assertAlmostEqual(voltage, 3, places=6)
        self.assertAlmostEqual(current, 1.5 / 3, places=6)

        charge, voltage, current, energy, capacity = map(float, states["b0"].split())
        # A tenth of the robot's is 72 times what the mote's holds.
        self.assertEqual(capacity, ROBOT)
        self.assertAlmostEqual(energy, charge * ROBOT, delta=1e-4)
        drawn = (0.1 - charge) * ROBOT
        # Motors: 1 kg to 0.2 m/s, and the caster; no more than 1 W all the way. Heat of the battery: 1 %.
        self.assertGreater(drawn, QUIET * AFTER)
        self.assertLess(drawn, (QUIET + 1) * AFTER * 1.02)
        open_voltage = 9.6 + charge * 3
        self.assertAlmostEqual(voltage, open_voltage - 0.1 * current, places=4)
        self.assertGreater(voltage * current, QUIET)

    def use(self):
        """Energy drawn, load, and time off, by name."""
        rows = self.query("SELECT name, energy_j, load_j, off_ns FROM agent_use JOIN agents USING (agent)")
        return {name: values for name, *values in rows}

    def test_it_gives_what_it_holds_and_no_more(self):
        for when_empty, off, load in (("off", 9, 1), ("stay_up", 0, 10)):
            battery = "[{kind: battery, capacity: 1 J, full_voltage: 3 V, idle_power: 0.5 W, " \
                      f"radio: {{listen: 0.5 W}}, when_empty: {when_empty}}}]"
            self.run_baraka(SCENARIO, "--controllers", "in-process", "--set", f"agents.motes.mote.sensors={battery}",
                            "--until", 10)
            energy, drawn, off_ns = self.use()["m0"]
            self.assertAlmostEqual(energy, 1, delta=1e-12)
            self.assertAlmostEqual(drawn, load, delta=1e-11)
            self.assertEqual(off_ns, off * 10 ** 9)
            self.assertEqual(self.use()["o0"], [None, None, 0])

    def test_what_moves_costs(self):
        drawn = []
        for speed in (0, 0.1, 0.2):
            self.run_baraka(SCENARIO, "--controllers", "in-process", "--set",
                            f"agents.robots.controller.parameters.speed={speed} m/s")
            drawn.append((0.1 - float(self.states()["b0"].split()[0])) * ROBOT)
        # At rest: U I = P + R I^2 with the open voltage of 9.9 V.
        current = (9.9 - (9.9 ** 2 - 4 * 0.1 * QUIET) ** 0.5) / 0.2
        self.assertAlmostEqual(drawn[0], 9.9 * current * AFTER, delta=0.05)
        self.assertGreater(drawn[1], drawn[0] + 0.005)  # J: 1 kg at 0.1 m/s
        self.assertGreater(drawn[2], drawn[1] + 0.015)

    @needs_peer
    def test_a_reader_of_ros_2_sees_it_empty(self):
        domain = some_domain(self)
        peer = Peer(self, "read", domain, "BatteryState", "rt/b0/battery", "BatteryState", "rt/m0/battery")
        self.run_baraka(SCENARIO, "--max-speed", 4, "--domain", domain)
        peer.end()
        mote = peer.samples("rt/m0/battery")
        self.assertGreater(len(mote), 50)
        for sample in mote:
            seconds = sample["t"] / 1e9
            voltage, current, percentage = sample["values"]
            self.assertAlmostEqual(percentage, 1 - 1.5 * seconds / MOTE, places=5)
            self.assertAlmostEqual(voltage, 3, places=5)
            if seconds > 0:
                self.assertAlmostEqual(current, -0.5, places=5)
            self.assertEqual(sample["present"], 1)
        robot = peer.samples("rt/b0/battery")
        self.assertEqual(robot[0]["frame"], "b0/base_link")
        charges = [sample["values"][2] for sample in robot]
        self.assertEqual(charges, sorted(charges, reverse=True))


if __name__ == "__main__":
    unittest.main()
