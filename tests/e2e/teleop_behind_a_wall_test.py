#!/usr/bin/env python3
"""config/scenarios/teleop_behind_a_wall.yaml: an operator drives a robot over the simulated air. What of that arrives is
beside the closed form of the wall's shadow. But in one test the operator is on Cyclone DDS, which knows nothing of this
project, in place of the scenario's own."""
import os
import pathlib
import subprocess
import sys
import unittest

from baraka import BIN, ROOT, Case, wait_for
from ros import needs_peer

sys.path.insert(0, str(ROOT / "tests/validation"))
from runs import Run  # noqa: E402
from teleop import Drive  # noqa: E402

SCENARIO = ROOT / "config/scenarios/teleop_behind_a_wall.yaml"
PROGRAMS = {"PATH": f"{BIN.parent / 'tests'}:{os.environ['PATH']}"}  # ros_peer
CYCLONE = "agents.operator={name: operator, station: {path: {line: {speed: 1.2 m/s, length: 22 m, pause: 60 s}}}, " \
          "poses: [{x: -13 m, y: 0 m}], network: {address: 10.77.0.1/16}, programs: [{name: commands, " \
          "command: [ros_peer, write, '0', Twist, rt/cmd_vel, '20', '0.5', '0', '0']}]}"
REAL_TIME = ["--pace", "realtime"]
RATE, PERIOD, TIMEOUT, SPEED = 20, 0.1, 0.5, 0.5  # 1/s, s, s, m/s: of the scenario


def may_make_namespaces():
    return os.access("/dev/net/tun", os.R_OK | os.W_OK) and subprocess.run(
        ["unshare", "-Urn", "--pid", "--fork", "true"], capture_output=True).returncode == 0


needs_namespaces = unittest.skipUnless(may_make_namespaces(), "no namespaces or /dev/net/tun here")


def descendants(pid, name):
    """Processes of that name below another one."""
    parents, names = {}, {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:
            continue  # it has ended meanwhile
        one = int(stat.parent.name)
        parents[one] = int(text.rpartition(")")[2].split()[1])
        names[one] = text[text.index("(") + 1:text.rindex(")")]
    found = []
    for one in parents:
        above = one
        while above in parents and above != pid:
            above = parents[above]
        if above == pid and names[one] == name:
            found.append(one)
    return found


@needs_namespaces
@needs_peer
class TeleopBehindAWall(Case):
    def drive(self):
        return Drive(Run(pathlib.Path(self.out)))

    def test_the_robot_stops_where_the_wall_says_and_goes_on_behind_it(self):
        self.check_shadow(self.run_baraka(SCENARIO, "--set", CYCLONE, env=PROGRAMS), late=0)

    def test_so_it_does_in_real_time(self):
        finished = self.run_baraka(SCENARIO, "--set", CYCLONE, *REAL_TIME, env=PROGRAMS)
        self.check_shadow(finished, late=float(finished["control_jitter_max_s"]))

    def check_shadow(self, finished, late):
        """@param late  s, of control cycles."""
        self.assertEqual(finished["result"], "done")
        drive = self.drive()
        first = drive.commands[0][0]
        lost, back = drive.shadow()
        self.assertLess(first, lost - 2, "discovery took too long to see anything")

        # Nearly all commands come where there is sight, and none behind the wall. A command is read at the next
        # control cycle; in a second in which this machine has no time for the operator it sends fewer.
        seen = [drive.received(second, second + 1) for second in range(int(first) + 1, int(lost))]
        self.assertGreaterEqual(min(seen), 0.5 * RATE, seen)
        self.assertGreaterEqual(sum(seen) / len(seen), 0.75 * RATE, seen)
        self.assertEqual(drive.received(lost + 2 * PERIOD + late, back), 0)

        # It stops within its time-out and a control cycle after the last command that came.
        last = [t for t, _ in drive.commands if t < back][-1]
        (stopped,) = [t for t, state in drive.states if state == "stopped"]
        self.assertGreaterEqual(stopped - last, TIMEOUT)
        self.assertLessEqual(stopped - last, TIMEOUT + PERIOD + late + 0.05)
        self.assertLess(abs(last - lost), 2 * PERIOD + late, "it was not the wall")
        standing = drive.place(stopped + 1)
        self.assertAlmostEqual(drive.place(back), standing, delta=0.01)

        # Back in sight it goes on, for good.
        again = [t for t, _ in drive.commands if t > back]
        self.assertTrue(again, "no command came any more")
        self.assertLess(again[0] - back, 3, "s: the neighbour may have to be asked for again")
        self.assertEqual([state for t, state in drive.states if t > again[0] - PERIOD], ["driving"])
        self.assertGreater(drive.place(40) - standing, 0.9 * SPEED * (40 - again[0] - 1))

        # The record gives the same without programs.
        record = self.out
        for how in ([], ["--controllers", "in-process"]):
            repeated = self.run_baraka(SCENARIO, "--set", CYCLONE, "--repeat", record, *how)
            self.assertEqual(repeated["fingerprint"], finished["fingerprint"])
            self.assertLess(float(repeated["wall_s"]), 20)

    def test_the_shipped_operator_drives_it_from_nothing_but_what_is_installed(self):
        for pace in ([], REAL_TIME):
            with self.subTest(pace):
                self.run_baraka(SCENARIO, "--until", 8, *pace)
                self.assertEqual([state for _, state in self.drive().states], ["waiting", "driving"])
                told = dict(self.query("SELECT r.name, MAX(value) FROM recorded r JOIN agents a USING (agent) WHERE a.name = 'operator'"
                                       " GROUP BY 1"))
                self.assertGreater(told["odometry"], 0)
                self.assertLessEqual(len(self.drive().commands), told["commands"])

    def test_without_the_wall_it_never_stops(self):
        self.run_baraka(SCENARIO, "--set", CYCLONE, "--set", "world.walls=[]", "--until", 25, env=PROGRAMS)
        self.assertEqual([state for _, state in self.drive().states], ["waiting", "driving"])

    def test_the_controller_sees_the_air_and_nothing_else_and_its_death_ends_the_run(self):
        run = self.start(SCENARIO, "--set", CYCLONE, *REAL_TIME, env=PROGRAMS)
        (controller,) = wait_for(lambda: descendants(run.process.pid, "ros_base"))
        self.assertNotEqual(os.readlink(f"/proc/{controller}/ns/net"),
                            os.readlink(f"/proc/{run.process.pid}/ns/net"))
        interfaces = [line.split(":")[0].strip() for line in
                      pathlib.Path(f"/proc/{controller}/net/dev").read_text().splitlines()[2:]]
        self.assertEqual(sorted(interfaces), ["lo", "wlan0"])
        # Of its own participants: 10.77.0.2 of the air. The sockets of the exchange are not in its namespace.
        wait_for(lambda: "02004D0A" in self.addresses(controller))
        self.assertNotIn("0100007F", self.addresses(controller))
        os.kill(controller, 9)
        finished = run.finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertRegex(finished.err, rf"process 'robot' \(pid {controller}\) died: .* \(agents robot\)")

    def addresses(self, pid):
        """To which the UDP sockets of its namespace are bound."""
        lines = pathlib.Path(f"/proc/{pid}/net/udp").read_text().splitlines()[1:]
        return [line.split()[1].split(":")[0] for line in lines]

    def test_only_the_run_starts_controllers_inside(self):
        for where in ("in-process", "external"):
            finished = self.run_baraka(SCENARIO, "--set", CYCLONE, "--controllers", where, env=PROGRAMS,
                                       status=2)
            self.assertRegex(finished.err, r"program: 'ros_base' is to run inside its agent's network, .*: "
                                           rf"controllers must be spawn, not {where}\n")


if __name__ == "__main__":
    unittest.main()
