#!/usr/bin/env python3
"""Laser scanner, sonar, inertial unit, pose and bumper: as their controller meets them over DDS and in process,
and as a reader that knows only ROS 2 sees them, against the record."""
import math
import unittest

from baraka import ROOT, Case, Program, some_domain
from rays import ray_to_box, turned
from ros import Peer, needs_peer

SCENARIO = ROOT / "tests/e2e/sensors.yaml"
READ = ["LaserScan", "rt/b0/scan", "Imu", "rt/b0/imu", "PoseStamped", "rt/b0/pose",
        "Bool", "rt/b0/bumper", "Range", "rt/b0/sonar", "TFMessage", "rt/tf_static", "TFMessage", "rt/tf"]
WALL = 1.5  # m, x of its face
NOSE = 0.037  # m, of the robot ahead of its origin: 69 - 32 mm
SCANNER = (-0.032, 0, 0.182)  # m
BOXES = [(1.6, 0, 0, 0.2, 4), (0, 1, math.radians(30), 0.3, 0.3)]  # x, y, yaw, sizes
SIGMA = 0.01  # m
SONAR = 0.03  # m ahead of its origin
SONAR_SIGMA = 0.005  # m


class Sensors(Case):
    def state(self):
        (text, at), = self.query("SELECT state, at_ns FROM states")
        return text, at

    def test_the_controller_meets_them_over_dds_as_in_process(self):
        inside = self.run_baraka(SCENARIO, "--controllers", "in-process")
        over_dds = self.run_baraka(SCENARIO)
        self.assertEqual(inside["fingerprint"], over_dds["fingerprint"])
        text, at = self.state()
        word, nearest, x, upward = text.split()
        self.assertEqual(word, "bumped")
        # From the scanner to the wall it is 7 cm then: nearer than the least range, which reads
        # -infinity; or the scan is 0.2 s old, and 4 cm at 0.2 m/s.
        self.assertTrue(nearest == "-inf" or 0.12 <= float(nearest) < 0.15, nearest)
        self.assertAlmostEqual(float(x), WALL - NOSE, delta=0.05)  # m, five sigma
        self.assertAlmostEqual(float(upward), 9.81, delta=0.5)  # m/s^2
        self.assertAlmostEqual(at / 1e9, (WALL - NOSE) / 0.2, delta=0.5)  # s

    def test_another_seed_gives_other_noise_and_the_same_motion(self):
        self.run_baraka(SCENARIO, "--controllers", "in-process")
        first = self.state()
        self.run_baraka(SCENARIO, "--controllers", "in-process", "--seed", 2)
        self.assertNotEqual(first[0], self.state()[0])

    def test_echo_prints_them(self):
        domain = some_domain(self)
        self.start(SCENARIO, "--domain", domain, "--max-speed", 0.5)
        for name, pattern in (("scan", r"angle_min: -?[\d.]+\n(.*\n)*ranges: \[([-.\w]+, )+[-.\w]+\]\nintensities: \[\]\n"),
                              ("imu", r"angular_velocity:\n  x: [^\n]+\n(.*\n)*linear_acceleration:\n(  [xy]: .*\n)+  z: \d")):
            echo = Program("baraka", "topic", "echo", f"rt/b0/{name}", "--count", 1, "--domain", domain)
            self.addCleanup(echo.clean_up)
            self.assertRegex(echo.finish().out, pattern)

    @needs_peer
    def test_a_reader_of_ros_2_sees_what_the_geometry_says(self):
        domain = some_domain(self)
        peer = Peer(self, "read", domain, *READ)
        self.run_baraka(SCENARIO, "--max-speed", 4, "--domain", domain)
        peer.end()
        track = {one["t"]: (*one["translation"][:2], 2 * math.atan2(one["rotation"][2], one["rotation"][3]))
                 for sample in peer.samples("rt/tf") for one in sample["transforms"]}
        frames = {one["child"]: one for sample in peer.samples("rt/tf_static")
                  for one in sample["transforms"]}
        self.assertEqual(frames["b0/scan"]["parent"], "b0/base_link")
        for seen, expected in zip(frames["b0/scan"]["translation"], SCANNER):
            self.assertAlmostEqual(seen, expected)
        self.check_scans(peer.samples("rt/b0/scan"), track)
        self.check_imu(peer.samples("rt/b0/imu"))
        self.check_poses(peer.samples("rt/b0/pose"), track)
        self.check_sonar(peer.samples("rt/b0/sonar"), track)
        touched = [sample["data"] for sample in peer.samples("rt/b0/bumper")]
        self.assertIn(True, touched)
        self.assertIn(False, touched)

    def check_scans(self, samples, track):
        self.assertGreater(len(samples), 20)
        hits = 0
        for sample in samples:
            self.assertEqual(sample["frame"], "b0/scan")
            self.assertEqual(len(sample["ranges"]), 360)
            low, high, step, *_ = sample["angles"]
            self.assertAlmostEqual(low, -math.pi, places=5)
            self.assertAlmostEqual(high, math.pi - math.radians(1), places=5)
            self.assertAlmostEqual(step, math.radians(1), places=6)
            for seen, expected in zip(sample["limits"], (0.12, 3.5)):
                self.assertAlmostEqual(seen, expected, places=6)
            if sample["t"] not in track:
                continue
            x, y, theta = track[sample["t"]]
            origin = [a + b for a, b in zip((x, y), turned(theta, *SCANNER[:2]))]
            for i, seen in enumerate(sample["ranges"]):
                angle = theta + low + i * step
                # The scan is up to 0.1 s old, and rays that pass an edge may miss it then.
                nearby = [min(ray_to_box((origin[0] + way, origin[1]), angle + off, box) for box in BOXES)
                          for way in (-0.021, 0, 0.021) for off in (-0.02, 0, 0.02)]
                if not all(0.2 < one < 3.4 for one in nearby):
                    continue
                hits += 1
                self.assertGreater(seen, min(nearby) - 5 * SIGMA)
                self.assertLess(seen, max(nearby) + 5 * SIGMA)
        self.assertGreater(hits, 1000)

    def check_sonar(self, samples, track):
        far = near = 0  # both also on the way back: the reader may have missed the start
        for sample in samples:
            self.assertEqual(sample["frame"], "b0/sonar")
            self.assertEqual(sample["radiation_type"], 0)
            field, low, high, seen = sample["values"]
            self.assertAlmostEqual(field, math.radians(30), places=6)
            self.assertAlmostEqual(low, 0.02, places=6)
            self.assertAlmostEqual(high, 0.6, places=6)
            if sample["t"] not in track:
                continue
            distance = WALL - track[sample["t"]][0] - SONAR  # ahead, where the whole cone meets the wall
            if distance > 0.62:
                far += 1
                self.assertEqual(seen, math.inf)
            elif 0.05 < distance < 0.58:
                near += 1
                # Up to 60 ms old, at 0.2 m/s.
                self.assertAlmostEqual(seen, distance, delta=0.012 + 5 * SONAR_SIGMA + 0.0015)
                self.assertAlmostEqual(seen / 0.003, round(seen / 0.003), delta=1e-3)
        self.assertGreater(far, 10)
        self.assertGreater(near, 10)

    def check_imu(self, samples):
        self.assertGreater(len(samples), 50)
        upward = [sample["linear"][2] for sample in samples]
        self.assertAlmostEqual(sum(upward) / len(upward), 9.81, delta=0.05)
        self.assertEqual(samples[0]["orientation_covariance"][0], -1)
        self.assertEqual(samples[0]["frame"], "b0/imu")
        # It stops on the wall: 0.2 m/s within one cycle of 0.1 s.
        self.assertLess(min(sample["linear"][0] for sample in samples), -0.5)

    def check_poses(self, samples, track):
        compared = 0
        for sample in samples:
            self.assertEqual(sample["frame"], "world")
            if sample["t"] not in track:
                continue
            compared += 1
            for seen, expected in zip(sample["position"], track[sample["t"]]):
                self.assertAlmostEqual(seen, expected, delta=5 * SIGMA)
        self.assertGreater(compared, 20)


if __name__ == "__main__":
    unittest.main()
