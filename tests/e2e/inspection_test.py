#!/usr/bin/env python3
"""What a run shows to a reader that knows only ROS 2, against the run's record; and that neither
readers nor their absence change the run."""
import math
import unittest

from baraka import CASE_STUDY, Case, some_domain, wait_for
from rays import ray_to_box, turned
from ros import Peer, needs_peer

READ = ["Clock", "rt/clock", "TFMessage", "rt/tf", "TFMessage", "rt/tf_static",
        "Odometry", "rt/r0/odom", "Range", "rt/r0/range", "MarkerArray", "rt/markers"]
UNTIL = 40  # s; the robot meets the wall within
AT_THE_WALL = 9_000_000_000  # ns
CONTROL_PERIOD = 100_000_000  # ns
MARKER_PERIOD = 100_000_000  # ns, the least


def quaternion(theta):
    return [0, 0, math.sin(theta / 2), math.cos(theta / 2)]


def heading(rotation):
    return 2 * math.atan2(rotation[2], rotation[3])


def range_tolerance(metres):
    """Four standard deviations of the noise (15 mV) on 5 V / 1024 * (6787 / (cm + 4) + 3), and what
    the robot drives while the sensor holds its value: 38.3 ms at 0.94 m/s."""
    volts_per_metre = 5 / 1024 * 6787 / (100 * metres + 4) ** 2 * 100
    return 4 * 0.015 / volts_per_metre + 0.036


class Inspection(Case):
    def setUp(self):
        super().setUp()
        self.domain = some_domain(self)

    def watch(self):
        """Runs the case study's beginning with a reader that was there first. On a machine with much
        else to do they may meet late: then once more, slower."""
        for speed in (10, 5, 2):
            peer = Peer(self, "read", self.domain, *READ)
            finished = self.run_baraka(CASE_STUDY, "--until", UNTIL, "--max-speed", speed,
                                       "--domain", self.domain)
            self.assertIn(f"inspect domain: {self.domain}\n", finished.err)
            peer.end()
            first = {topic: peer.samples(topic)[:1] for topic in READ[1::2]}
            if all(first.values()) and first["rt/r0/range"][0]["t"] < AT_THE_WALL:
                return peer
        return self.fail(f"they did not meet in time: {first}")

    @needs_peer
    def test_a_reader_of_ros_2_sees_what_the_record_says(self):
        peer = self.watch()
        robot, = [row[0] for row in self.query("SELECT agent FROM agents WHERE name = 'r0'")]
        self.poses = {at: (x, y, theta) for at, x, y, theta in self.query(
            f"SELECT at_ns, x_m, y_m, theta_rad FROM poses WHERE agent = {robot}")}
        self.check_clock(peer.samples("rt/clock"))
        transforms = [one for sample in peer.samples("rt/tf") for one in sample["transforms"]]
        track = self.check_robot([t for t in transforms if t["child"] == "r0/base_link"])
        self.check_motes([t for t in transforms if t["child"] != "r0/base_link"])
        static = peer.samples("rt/tf_static")[-1]["transforms"]
        self.check_odometry(peer.samples("rt/r0/odom"), static, track)
        self.check_ranges(peer.samples("rt/r0/range"), static, track)
        self.check_markers(peer.samples("rt/markers"))

    def check_markers(self, samples):
        """Of the Robertino: a wide and a narrow cylinder, and an arrow."""
        sizes = {0: (3, [0.37, 0.37, 0.19]), 1: (3, [0.2, 0.2, 0.21])}
        drawn, times, compared = {}, [], 0
        for sample in samples:
            times.append(max(marker["t"] for marker in sample["markers"]))
            for marker in sample["markers"]:
                self.assertEqual((marker["frame"], marker["action"], marker["rest"]), ("world", 0, 0))
                drawn[marker["ns"], marker["id"]] = marker
                if marker["ns"] != "r0" or marker["id"] not in sizes:
                    continue
                kind, size = sizes[marker["id"]]
                self.assertEqual(marker["type"], kind)
                for seen, expected in zip(marker["scale"], size):
                    self.assertAlmostEqual(seen, expected, delta=1e-12)
                if marker["t"] in self.poses:
                    compared += 1
                    self.assertEqual(marker["position"][:2], list(self.poses[marker["t"]][:2]))
        self.assertGreater(compared, 20)
        periods = [later - earlier for earlier, later in zip(times, times[1:])]
        self.assertGreaterEqual(min(periods), MARKER_PERIOD)
        walls = {("walls/" + name, x, y, dx, dy) for name, x, y, dx, dy in self.query(
            "SELECT name, x_m, y_m, size_x_m, size_y_m FROM walls")}
        self.assertEqual({(ns, *m["position"][:2], *m["scale"][:2]) for (ns, _), m in drawn.items()
                          if ns.startswith("walls/")}, walls)
        agents = {name for name, in self.query("SELECT name FROM agents")}
        self.assertEqual({ns for ns, _ in drawn if not ns.startswith("walls/")}, agents)

    @needs_peer
    def test_who_comes_late_is_shown_the_walls_and_all_bodies(self):
        run = self.start(CASE_STUDY, "--max-speed", 2, "--domain", self.domain)
        first = Peer(self, "read", self.domain, "MarkerArray", "rt/markers")
        wait_for(lambda: first.samples("rt/markers"), timeout=40)
        late = Peer(self, "read", self.domain, "MarkerArray", "rt/markers")
        agents = 26
        def names():
            return {m["ns"] for sample in late.samples("rt/markers") for m in sample["markers"]}
        wait_for(lambda: len({n for n in names() if not n.startswith("walls/")}) == agents
                 and any(n.startswith("walls/") for n in names()), timeout=40)
        run.clean_up()

    def check_clock(self, samples):
        times = [sample["t"] for sample in samples]
        self.assertGreater(len(times), 100)
        self.assertEqual(times, sorted(set(times)))
        self.assertTrue(all(t % CONTROL_PERIOD == 0 for t in times))
        self.assertLessEqual(times[-1], UNTIL * 1_000_000_000)

    def check_robot(self, transforms):
        """@return pose (x, y, theta) by time."""
        compared = 0
        for one in transforms:
            self.assertEqual(one["parent"], "world")
            if one["t"] not in self.poses:
                continue
            compared += 1
            x, y, theta = self.poses[one["t"]]
            self.assertEqual(one["translation"], [x, y, 0])
            for seen, expected in zip(one["rotation"], quaternion(theta)):
                self.assertAlmostEqual(seen, expected, delta=1e-15)
        self.assertGreater(compared, 10)
        return {t["t"]: (*t["translation"][:2], heading(t["rotation"])) for t in transforms}

    def check_motes(self, transforms):
        places = dict(self.query("SELECT name || '/base_link', x_m || ' ' || y_m FROM agents"))
        self.assertEqual({t["child"] for t in transforms}, set(places) - {"r0/base_link"})
        for one in transforms:
            expected = [*map(float, places[one["child"]].split()), 0]
            for seen, coordinate in zip(one["translation"], expected):
                self.assertAlmostEqual(seen, coordinate, delta=0.01)  # m; they settle on the ground

    def check_odometry(self, samples, static, track):
        """The wheels slip a little: 0.8 mm in a run of 40 s without a touch."""
        start, = [t for t in static if t["child"] == "r0/odom"]
        self.assertEqual(start["parent"], "world")
        self.assertEqual(start["translation"][:2], [8, 8])
        compared = 0
        for sample in samples:
            self.assertEqual((sample["frame"], sample["child"]), ("r0/odom", "r0/base_link"))
            if sample["t"] not in track:
                continue
            compared += 1
            x, y, theta = track[sample["t"]]
            dx, dy = turned(heading(start["rotation"]), *sample["position"][:2])
            self.assertLess(math.hypot(8 + dx - x, 8 + dy - y), 0.005)  # m
            self.assertAlmostEqual(heading(sample["orientation"]), theta, delta=1e-4)
        self.assertGreater(compared, 100)

    def check_ranges(self, samples, static, track):
        """Of the Sharp GP2D12 that the robot's file names: 0.1 to 0.8 m, 5 degrees. Compared where
        the distance is not at the edge."""
        mounts = {t["child"]: (t["translation"], heading(t["rotation"])) for t in static
                  if t["parent"] == "r0/base_link"}
        self.assertEqual({s["frame"] for s in samples}, set(mounts))
        self.assertEqual(len(mounts), 6)
        boxes = self.query("SELECT x_m, y_m, yaw_rad, size_x_m, size_y_m FROM walls")
        near = far = 0
        for sample in samples:
            *limits, metres = sample["values"]
            for limit, expected in zip(limits, (math.radians(5), 0.1, 0.8)):
                self.assertAlmostEqual(limit, expected, delta=1e-7)  # single precision
            self.assertEqual(sample["radiation_type"], 1)  # infrared
            if sample["t"] not in track:
                continue
            x, y, theta = track[sample["t"]]
            mount, direction = mounts[sample["frame"]]
            dx, dy = turned(theta, *mount[:2])
            rays = [theta + direction + limits[0] * (k / 10 - 0.5) for k in range(11)]
            expected = min(ray_to_box((x + dx, y + dy), ray, box) for ray in rays for box in boxes)
            if 0.15 < expected < 0.65:
                near += 1
                self.assertAlmostEqual(metres, expected, delta=range_tolerance(expected))
            elif expected > 1:
                far += 1
                self.assertEqual(metres, math.inf)
        self.assertGreater(near, 10)
        self.assertGreater(far, 100)

    def fingerprint(self, *arguments):
        # How long this takes on a busy computer is no claim of these tests.
        finished = self.run_baraka(CASE_STUDY, "--until", UNTIL, *arguments, timeout=400)
        return finished["fingerprint"], finished

    @needs_peer
    def test_readers_change_nothing_not_even_one_that_never_takes(self):
        alone, finished = self.fingerprint("--no-inspect")
        self.assertNotIn("inspect domain", finished.err)
        self.assertEqual(self.fingerprint()[0], alone)
        watched = Peer(self, "read", self.domain, *READ)
        self.assertEqual(self.fingerprint("--domain", self.domain, "--max-speed", "15")[0], alone)
        self.assertTrue(watched.lines(), "the reader saw nothing")
        watched.end()
        held = Peer(self, "hold", self.domain, *READ)
        self.assertEqual(self.fingerprint("--domain", self.domain, "--max-speed", "15")[0], alone)
        seen = held.lines()
        self.assertEqual(max(line["matched"] for line in seen), len(READ) / 2)
        self.assertGreater(seen[-1]["rejections"], 0, "its queues were never full")

    @needs_peer
    def test_a_run_with_its_controllers_in_process_shows_itself_where_it_is_told_to(self):
        peer = Peer(self, "read", self.domain, "Clock", "rt/clock")
        inside = ["--controllers", "in-process"]
        alone, finished = self.fingerprint(*inside)
        self.assertNotIn("inspect domain", finished.err)
        shown, _ = self.fingerprint(*inside, "--inspect-domain", self.domain, "--max-speed", "15")
        self.assertEqual(shown, alone)
        self.assertTrue(peer.lines())


if __name__ == "__main__":
    unittest.main()
