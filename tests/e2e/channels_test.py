#!/usr/bin/env python3
"""Channels from measurement: antennas that turn with a robot, and the trace of a drive that is played."""
import bisect
import math
import unittest

from baraka import ROOT, Case, Program

WAVELENGTH = 299792458 / 2.412e9
LISTENS = "controller: {program: traffic_sink, parameters: {topic: t}}"
SATURATED = "controller: {program: traffic_source, parameters: {topic: t, pattern: saturated, to: b, size: 1000}}"
TURNING = """version: 1
name: turning
record: {frames: all, pose_period: 20 ms}
routing: none
radio: {profile: ieee80211b, propagation: [{model: friis}]}
agents:
  a:
    name: a
    station: {}
    poses: [{x: 20 m, y: 0 m}]
    controller: {program: traffic_source, parameters: {topic: t, pattern: periodic, rate: 20 Hz, to: everyone, size: 50}}
  r:
    name: r
    %s
    poses: [{x: 0 m, y: 0 m}]
    radio: {antenna: {pattern: beam, width: 60 deg, height: 90 deg, back: 25 dB}}
    controller: %s
end: [{at: 13 s, result: done}]
"""
DRIVE = """version: 1
name: drive
record: {frames: all}
routing: none
radio:
  profile: ieee80211g
  rate_control: minstrel
  propagation: [%s]
agents:
  a: {name: a, station: {%s}, poses: [{x: 5 m, y: 0 m}], %s}
  b: {name: b, station: {}, poses: [{x: 0 m, y: 0 m}], %s}
end: [{at: 60 s, result: done}]
"""
# From 5 m to 65 m and back.
PATH = "path: {waypoints: {points: [{x: 65 m, y: 0 m}, {x: 5 m, y: 0 m}], speed: 2 m/s}}"


class Channels(Case):
    def play(self, name, text, *arguments):
        file = self.folder / name
        file.write_text(text)
        self.assertEqual(self.run_baraka(file, "--controllers", "in-process", *arguments)["result"], "done")

    def poses(self, name):
        """(ns, x, y, heading) at each instant, headings continuous."""
        found = []
        for at, x, y, angle in self.query("SELECT at_ns, poses.x_m, poses.y_m, poses.theta_rad FROM poses "
                                          f"JOIN agents USING (agent) WHERE name = '{name}' ORDER BY at_ns"):
            if found:
                angle = found[-1][3] + math.remainder(angle - found[-1][3], 2 * math.pi)
            found.append((at, x, y, angle))
        return found

    def turns(self, body, controller):
        """RSSI of a station 20 m away follows the beam of a body that turns once around."""
        self.play("turning.yaml", TURNING % (body, controller))
        poses = self.poses("r")
        angles = [pose[3] for pose in poses]
        self.assertGreater(max(angles) - min(angles), 6, "a whole turn")
        levels = self.query("SELECT f.at_ns, rssi_dbm FROM frame_ends JOIN frames f USING (frame) "
                            "JOIN agents ON agents.agent = frame_ends.agent WHERE name = 'r'")
        self.assertGreater(len(levels), 200)
        expected = []
        for at, level in levels:
            i = min(max(bisect.bisect(poses, (at,)), 1), len(poses) - 1)
            (begin, *before), (end, *after) = poses[i - 1], poses[i]
            share = min(max((at - begin) / (end - begin), 0), 1)
            x, y, heading = [p + share * (q - p) for p, q in zip(before, after)]
            friis = 10 * math.log10(40) + 20 * math.log10(WAVELENGTH / (4 * math.pi * math.hypot(20 - x, y)))
            off = math.remainder(math.atan2(-y, 20 - x) - heading, 2 * math.pi) / math.radians(60)
            expected.append(friis - min(12 * off * off, 25))
            # dB: at 80 degrees 0.5 dB per degree; the pose of the last step of the physics is 0.5 degrees old.
            self.assertAlmostEqual(level, expected[-1], delta=0.4, msg=f"{at} ns")
        self.assertGreater(max(expected) - min(expected), 24)

    def test_rssi_follows_the_heading_of_a_robot_that_turns(self):
        self.turns(f"robot: {{include: {ROOT / 'config/robots/robertino.yaml'}}}",
                   "{program: eight, parameters: {speed: 0.01 m/s, radius: 0.01 m}}")

    def test_rssi_follows_the_heading_of_a_path(self):
        self.turns("station: {path: {circle: {radius: 0.5 m, speed: 0.3 m/s}}}",
                   "{program: traffic_sink, parameters: {topic: t}}")

    def throughput(self):
        """Mb/s of the sink."""
        return self.query("SELECT sum(count) FROM packets JOIN agents USING (agent) WHERE name = 'b'")[0][0] * 8e3 / 60e6

    def test_a_drive_that_is_played_has_its_throughput(self):
        law = "{model: log_distance, exponent: 3}, {model: shadowing, sigma: 3 dB, decorrelation_distance: 5 m}"
        self.play("drive.yaml", DRIVE % (law, PATH, SATURATED, LISTENS), "--seed", "1")
        driven = self.throughput()
        trace = self.folder / "drive.csv"
        exported = Program("baraka", "export", self.out, "--format", "links", "-o", trace).finish()
        self.assertEqual(exported.status, 0, str(exported))
        lines = trace.read_text().splitlines()
        self.assertEqual(lines[0], "from,to,time_s,rssi_dbm")
        self.assertGreater(len(lines), 5000)
        levels = [float(line.split(",")[3]) for line in lines[1:]]
        self.assertGreater(max(levels) - min(levels), 25, "dB between near and far")
        played = "{model: measured, file: drive.csv, tx_power: 16.020599913 dBm, silence: 100 ms}"
        for seed in ("2", "3", "4"):
            self.play("replay.yaml", DRIVE % (played, "", SATURATED, LISTENS), "--seed", seed)
            print(f"driven {driven:.3f} Mb/s, played with seed {seed} {self.throughput():.3f} Mb/s")
            self.assertAlmostEqual(self.throughput() / driven, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
