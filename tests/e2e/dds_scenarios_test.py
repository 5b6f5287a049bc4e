#!/usr/bin/env python3
"""The scenarios of DDS over the air do what their pages say, with Cyclone's ddsperf as it comes."""
import math
import shutil
import sys
import unittest

from baraka import ROOT, Case
from private_network import is_possible
import ddsperf

SKIPPED = 77
SCENARIOS = ROOT / "config/scenarios"
US = 1e-6


def airtime(payload_bytes, rate):
    """Of a data frame of 802.11g that carries so many bytes of IP, s: IEEE Std 802.11-2016, 17.4.3, with the signal
    extension of 18.3.2.4; 24 bytes of header, 8 of LLC and SNAP, 4 of FCS."""
    bits_per_symbol = 4e-6 * rate
    return (20 + 4 * -(-(16 + 8 * (payload_bytes + 36) + 6) // bits_per_symbol) + 6) * US


class DdsScenarios(Case):
    def play(self, name, *settings):
        finished = self.run_baraka(SCENARIOS / f"{name}.yaml", *settings)
        return finished

    def said(self, program):
        return (self.out / f"{program}.log").read_text()

    def frames(self, condition):
        (count,), = self.query(f"SELECT coalesce(sum(frames), 0) FROM air_accounts WHERE {condition}")
        return count

    def test_two_stations_measure_round_trips(self):
        finished = self.play("dds_two_stations")
        self.assertEqual(finished["result"], "ping")
        seconds = ddsperf.round_trips(self.said("pinger.ping"))
        self.assertGreater(sum(one.count for one in seconds), 150, self.said("pinger.ping"))
        # There and back, each a frame that carries 64 bytes of sample; DIFS before the second, behind the acknowledgement of
        # the first, which goes out at once.
        least = 2 * airtime(64, 54e6) + 10 * US + 50 * US
        shortest = min(one.least for one in seconds)
        self.assertGreater(shortest, least)
        self.assertLess(shortest, 2 * least, "no time of this computer is in it")
        self.assertGreater(self.frames("purpose = 'user' AND kind = 'DATA'"), 2 * 150)
        self.assertEqual(self.frames("purpose = 'network' AND kind = 'TCP'"), 0)

    def test_an_operator_drives_four_robots_through_their_access_point(self):
        finished = self.play("robots_on_an_access_point")
        self.assertEqual(finished["result"], "done")
        told = {(agent, name): value for agent, name, value in self.query(
            "SELECT a.name, r.name, MAX(value) FROM recorded r JOIN agents a USING (agent) GROUP BY 1, 2")}
        robots = [f"r{i}" for i in range(4)]
        for robot in robots:
            self.assertGreater(told[robot, "commands"], 0.8 * told["operator", "commands"], told)
            # Circles of 0.5 m: nobody is farther from where they began than the diameter.
            ways = self.query(f"SELECT p.x_m, p.y_m FROM poses p JOIN agents a USING (agent) WHERE a.name = '{robot}' ORDER BY at_ns")
            far = max(math.dist(ways[0], place) for place in ways)
            self.assertGreater(far, 0.9)
            self.assertLess(far, 1.1)
        self.assertGreater(told["operator", "odometry"], 0)
        # All of it went through the access point, which is no DDS program: it only relays.
        (ap,), = self.query("SELECT agent FROM agents WHERE name = 'ap'")
        (relayed,), = self.query(f"SELECT SUM(count) FROM relays WHERE agent = {ap} AND verdict = 'delivered'")
        self.assertGreater(relayed, sum(told[robot, "commands"] for robot in robots))

    def test_all_find_each_other_in_the_storm(self):
        for count in (4, 10):
            with self.subTest(count):
                self.play("dds_discovery_storm", "--set", f"agents.robots.circle.count={count}")
                for i in range(count):
                    self.assertEqual(len(ddsperf.others(self.said(f"r{i}.ddsperf"))), count - 1, f"r{i}")
                self.assertGreater(self.frames("purpose = 'SPDP'"), count)
                self.assertGreater(self.frames("purpose = 'SEDP'"), count * (count - 1))

    def test_images_delay_commands(self):
        finished = self.play("dds_camera_over_wifi")
        self.assertEqual(finished["result"], "command")
        seconds = ddsperf.round_trips(self.said("operator.command"))
        before = [one.median for one in seconds if 1.5 <= one.at <= 4.5]
        during = [one.p99 for one in seconds if one.at >= 7]
        self.assertTrue(before and during, self.said("operator.command"))
        self.assertGreater(sorted(during)[len(during) // 2], 2 * sorted(before)[len(before) // 2])
        total = ddsperf.received(self.said("operator.screen"))[-1][1]
        self.assertGreater(total, 15)

    def test_the_access_point_carries_everything(self):
        finished = self.play("dds_through_access_point", "--set", "record.air=air.pcapng")
        self.assertEqual(finished["result"], "ping")
        seconds = ddsperf.round_trips(self.said("operator.ping"))
        self.assertGreater(sum(one.count for one in seconds), 100, self.said("operator.ping"))
        # There and back through it: four frames.
        self.assertGreater(min(one.least for one in seconds), 4 * (airtime(64, 24e6) + 50 * US))
        direct = self.query("SELECT count(*) FROM frames_sent f JOIN agents a USING (agent) JOIN agents b"
                            " ON b.agent = f.peer WHERE a.name <> 'ap' AND b.name <> 'ap'")
        self.assertEqual(direct, [(0,)])


if __name__ == "__main__":
    if not is_possible() or shutil.which("ddsperf") is None:
        print("skipped: needs user namespaces and ddsperf (cyclonedds-tools)", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
