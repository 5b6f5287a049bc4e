#!/usr/bin/env python3
"""Maps of Nav2 as worlds: the shipped office, floors one above the other, and what a campaign knows of a map."""
import pathlib
import subprocess
import sys
import unittest

from baraka import BIN, ROOT, Case

SCENARIO = ROOT / "config/scenarios/office_map.yaml"
MAPS = ROOT / "config/maps"
BENCH = ("--controllers", "in-process")


class Map(Case):
    def scenario(self, world, end="1 s"):
        """Two stations at (0, 0) and (10, 0) m, 1 m above the ground, the first of which broadcasts."""
        file = self.folder / "scenario.yaml"
        file.write_text(f"""
version: 1
world: {world}
radio: {{include: {ROOT}/config/radios/ieee80211g.yaml, obstacles: true, antenna_height: 1 m}}
routing: none
record: {{frames: all}}
agents:
  a:
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    controller: {{program: traffic_source, parameters: {{pattern: periodic, rate: 20 Hz, phase: 0 s, to: neighbours, size: 100}}}}
  b: {{station: {{}}, poses: [{{x: 10 m, y: 0 m}}]}}
end: [{{at: {end}, result: done}}]
""", encoding="utf-8")
        return file

    def wall_map(self, name="wall", columns=4):
        """A wall along y between the stations: 4 cells of 5 cm thick, 2 m long."""
        image = [" ".join(["0"] * columns)] * 40
        (self.folder / f"{name}.pgm").write_text(f"P2 {columns} 40 255\n" + "\n".join(image) + "\n")
        (self.folder / f"{name}.yaml").write_text(
            f"image: {name}.pgm\nresolution: 0.05\norigin: [5.0, -1.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
            "free_thresh: 0.25\n")
        return self.folder / f"{name}.yaml"

    def rssi(self, world):
        self.run_baraka(self.scenario(world), *BENCH)
        [(least, most)] = self.query("SELECT min(rssi_dbm), max(rssi_dbm) FROM frame_ends")
        self.assertAlmostEqual(least, most, delta=1e-9)
        return least

    def test_the_office_is_what_the_program_draws(self):
        subprocess.run([sys.executable, MAPS / "draw_office.py", self.folder], check=True)
        for name in ("office.png", "office.yaml"):
            self.assertEqual((self.folder / name).read_bytes(), (MAPS / name).read_bytes(), name)

    def test_a_robot_drives_ten_minutes_in_the_office_without_a_contact(self):
        self.assertLessEqual(len(SCENARIO.read_text().splitlines()), 25)
        for seed in (1, 2, 3):
            self.run_baraka(SCENARIO, *BENCH, "--seed", seed)
            self.assertEqual(self.query("SELECT wall_steps, object_steps FROM bodies WHERE agent = 2"), [(0, 0)])
            places = {(round(x), round(y)) for x, y in self.query("SELECT x_m, y_m FROM poses WHERE agent = 2")}
            self.assertGreater(len(places), 40)  # it gets around
            [(count,)] = self.query("SELECT count(*) FROM walls")
            self.assertTrue(20 < count < 60, count)

    def test_the_resolved_scenario_has_the_map_and_runs_again(self):
        first = self.run_baraka(SCENARIO, *BENCH, "--until", 5)
        resolved = pathlib.Path(self.out) / "scenario.resolved.yaml"
        text = resolved.read_text()
        self.assertIn(str(MAPS / "office.yaml"), text)
        self.assertNotIn("office0", text)
        again = self.folder / "again.yaml"
        again.write_text(text)
        self.assertEqual(self.run_baraka(again, *BENCH, "--until", 5)["fingerprint"], first["fingerprint"])

    def test_a_setting_changes_the_walls(self):
        self.run_baraka(SCENARIO, *BENCH, "--until", 1)
        [(few,)] = self.query("SELECT count(*) FROM walls")
        self.run_baraka(SCENARIO, *BENCH, "--until", 1, "--set", "world.map.drop_below=0 m")
        [(more,)] = self.query("SELECT count(*) FROM walls")
        self.assertEqual(more, few + 6)  # the legs of chairs

    def test_the_radio_loses_what_the_walls_of_a_map_take(self):
        file = self.wall_map()
        free = self.rssi("{}")
        loss = "radio_loss: {per_crossing: 5 dB, per_metre: 10 dB/m}"
        self.assertAlmostEqual(self.rssi(f"{{map: {{file: {file}, {loss}}}}}"), free - 5 - 10 * 0.2, delta=1e-6)
        self.assertAlmostEqual(self.rssi(f"{{map: {{file: {file}, {loss}, height: 90 cm}}}}"), free, delta=1e-9)

    def test_another_floor_is_above_the_waves_and_not_in_the_plan(self):
        ground, first = self.wall_map("ground"), self.wall_map("first", 8)
        free = self.rssi("{}")
        above = self.rssi(f"{{map: [{{file: {first}, elevation: 3 m}}]}}")
        self.assertEqual(above, free)
        self.assertEqual(self.query("SELECT count(*) FROM walls"), [(0,)])
        self.run_baraka(self.scenario(f"{{map: [{{file: {ground}}}, {{file: {first}, elevation: 3 m}}]}}"), *BENCH)
        self.assertEqual(self.query("SELECT name FROM walls"), [("ground0",)])

    def test_replications_refuse_another_image(self):
        file = self.wall_map()
        scenario = self.scenario(f"{{map: {{file: {file}}}}}")
        runs = self.folder / "runs"
        command = [BIN / "baraka", "run", scenario, *BENCH, "--replications", "2", "--out", runs]
        subprocess.run(command, check=True, capture_output=True)
        again = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.wall_map(columns=3)
        other = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertNotEqual(other.returncode, 0)
        self.assertRegex(other.stderr, "programs: there '.*wall.pgm [0-9a-f]{16}.*', now '.*wall.pgm [0-9a-f]{16}")

    def test_reports_and_checks_know_it(self):
        self.run_baraka(SCENARIO, *BENCH, "--until", 2)
        for command in (["report", self.out], ["check", SCENARIO], ["export", self.out, "walls"]):
            done = subprocess.run([BIN / "baraka", *command], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_broken_image_has_a_message(self):
        self.wall_map()
        image = self.folder / "wall.pgm"
        image.write_bytes(b"P5 100 100 255\nshort")
        done = subprocess.run([BIN / "baraka", "check", self.scenario(f"{{map: {{file: {self.folder}/wall.yaml}}}}")],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr + done.stdout, r"scenario.yaml:3:\d+: world.map.file: .*wall.pgm: ends in row 1")


if __name__ == "__main__":
    unittest.main()
