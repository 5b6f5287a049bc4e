#!/usr/bin/env python3
"""The radio config/radios/equal_power_disk.yaml is what its first lines say: the same power up to 300 m, nothing beyond, and
no frame survives another one that overlaps with it."""
import unittest

from baraka import ROOT, Case

SCENARIO = """
version: 1
name: overlap
seed: 1
controller_latency: 0 s
radio: {{include: {radio}, data_rate: 2 Mb/s, basic_rates: [1 Mb/s, 2 Mb/s]}}
routing: none
record: {{frames: all}}
agents:
  receiver:
    name: receiver
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    controller: {{program: traffic_sink, parameters: {{topic: t}}}}
  senders:                      # 305 m apart: they do not hear each other
    name: s{{}}
    station: {{}}
    poses: [{{x: 5.5 m, y: 0 m}}, {{x: -299.5 m, y: 0 m}}]
    controller: {{program: traffic_source, parameters: {{pattern: saturated, backlog: 2, to: receiver, topic: t, size: 64}}}}
  outside:                      # of both senders, 0.5 m too far from the receiver
    name: outside
    station: {{}}
    poses: [{{x: 0 m, y: 300.5 m}}]
    controller: {{program: traffic_sink, parameters: {{topic: t}}}}
end:
  - {{at: 5 s, result: done}}
"""
# Of data frames at the receiver: begin and end at the transmitter, who sent it, how it ended.
AT_RECEIVER = ("SELECT f.at_ns, f.at_ns + f.airtime_ns, f.transmitter, e.verdict, e.rssi_dbm FROM frames f JOIN frame_ends e "
               "USING (frame) JOIN agents a ON a.agent = e.agent WHERE a.name = 'receiver' AND f.class = 'unicast' "
               "ORDER BY f.at_ns")
MOST_DELAY = 1100  # ns: 300 m and some


def overlap(one, other):
    """By more than what the way of either makes of it."""
    return min(one[1], other[1]) - max(one[0], other[0]) > MOST_DELAY


def apart(one, other):
    return max(one[0], other[0]) - min(one[1], other[1]) > MOST_DELAY


class EqualPowerDisk(Case):
    def setUp(self):
        super().setUp()
        scenario = self.folder / "overlap.yaml"
        scenario.write_text(SCENARIO.format(radio=ROOT / "config/radios/equal_power_disk.yaml"))
        self.run_baraka(scenario, "--controllers", "in-process", "--no-inspect")

    def test_no_frame_survives_an_overlap_and_each_without_one_arrives(self):
        frames = self.query(AT_RECEIVER)
        overlapping = alone = 0
        for i, frame in enumerate(frames):
            others = [one for one in frames[max(0, i - 5):i + 6] if one[2] != frame[2]]
            if any(overlap(frame, one) for one in others):
                overlapping += 1
                self.assertNotEqual(frame[3], "delivered", frame)
            elif all(apart(frame, one) for one in others):
                alone += 1
                self.assertIn(frame[3], ("delivered", "receiver transmitting"), frame)
        self.assertGreater(overlapping, 100)
        self.assertGreater(alone, 50)

    def test_near_and_far_arrive_with_the_same_power(self):
        powers = {sender: rssi for _, _, sender, _, rssi in self.query(AT_RECEIVER)}
        self.assertEqual(len(powers), 2)
        for rssi in powers.values():
            self.assertAlmostEqual(rssi, -50, delta=1e-3)  # dB

    def test_nothing_is_heard_beyond_300_m(self):
        heard, = self.query("SELECT count(*) FROM receptions r JOIN agents a USING (agent) WHERE a.name = 'outside'")[0]
        self.assertEqual(heard, 0)
        self.assertEqual(self.query("SELECT sum(count) FROM faint")[0][0] or 0, 0)  # nor does it disturb anyone
        audible, = self.query("SELECT count(*) FROM receptions r JOIN agents a USING (agent) WHERE a.name = 'receiver'")[0]
        self.assertGreater(audible, 0)


if __name__ == "__main__":
    unittest.main()
