#!/usr/bin/env python3
"""Programs that nobody here wrote, unmodified, in agents' networks: as root and as an ordinary user.
What the interfaces send goes over a wire; the simulated radio is not in it."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import textwrap
import time
import unittest

import wire
from baraka import BIN, wait_for
from wire import PYTHON, Wire

STILL = BIN.parent / "tests/still"
REFUSED = wire.why_not()
REFUSED_TO_USER = REFUSED or wire.why_not(wire.as_user([]))


def needs(program):
    return unittest.skipUnless(shutil.which(program, path=wire.PATH), f"needs {program}")


def times(said):
    return [float(text) for text in re.findall(r"time=([\d.]+) ms", said)]


@unittest.skipIf(REFUSED, REFUSED)
class AsRoot(unittest.TestCase):
    user = False

    def wire(self, *arguments, **options):
        return Wire(self, *arguments, user=self.user, **options)

    @needs("ping")
    def test_ping_by_address_by_name_and_ipv6(self):
        run = self.wire()
        for target in (["10.77.0.2"], ["r2"], ["-4", "r1"], ["-6", "r1"], ["fe80::ff:fe00:3%wlan0"]):
            with self.subTest(target):
                said = run.run(0, "ping", "-c", 3, "-i", 0.2, *target)
                self.assertEqual(len(times(said)), 3, said)
        self.assertEqual(run.ask("dropped", 0), "0")

    def test_each_agent_is_a_host_of_its_own(self):
        run = self.wire()
        self.assertEqual(run.run(0, "hostname"), "r0\n")
        self.assertEqual(run.run(2, "hostname"), "r2\n")
        run.run(0, "sh", "-c", "echo mine > /dev/shm/mark")
        self.assertEqual(run.run(0, "cat", "/dev/shm/mark"), "mine\n")
        self.assertNotIn("mark", run.run(1, "ls", "/dev/shm"))
        self.assertFalse(pathlib.Path("/dev/shm/mark").exists())
        self.assertEqual(run.run(0, "sh", "-c", "ls /sys/class/net | sort"), "lo\nwlan0\n")
        self.assertEqual(run.run(1, "cat", "/sys/class/net/wlan0/address"), "02:00:00:00:00:02\n")
        self.assertNotIn(str(run.process.pid), run.run(1, "ls", "/proc").split())

    def test_what_a_program_was_started_with_and_how_it_ended(self):
        run = self.wire()
        self.assertEqual(run.start(0, "sh", "-c", "exit 3").status(), 3)
        self.assertEqual(run.start(0, "sh", "-c", "kill -9 $$").status(), -9)
        with self.assertRaisesRegex(AssertionError, "no program 'none-of-that' in PATH"):
            run.start(0, "none-of-that")
        started = run.start(1, PYTHON, "-c", "x = 1\nwhile True: x = x * 7 % 1000003")
        wait_for(lambda: float(run.ask("cpu")) > 0.2)
        self.assertNotIn(started.number, run.ended)
        self.assertEqual(int(run.ask("loaded", 1)), 1)

    def test_python_sockets_tcp_udp_and_groups(self):
        run = self.wire()
        server = run.start(1, PYTHON, "-c", textwrap.dedent("""\
            import socket
            tcp = socket.create_server(("", 7000))
            udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            udp.bind(("", 7001))
            group = socket.inet_aton("239.255.0.1") + socket.inet_aton("0.0.0.0")
            udp.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
            print("listening", flush=True)
            peer = tcp.accept()[0]
            data = b""
            while part := peer.recv(65536): data += part
            print("tcp", len(data), flush=True)
            for i in range(2): print("udp", udp.recvfrom(2000)[1][0], flush=True)
            """))
        server.says("listening")
        run.run(0, PYTHON, "-c", "import socket; s = socket.create_connection(('r1', 7000)); "
                                 "s.sendall(b'x' * 1_000_000)")
        server.says("tcp 1000000")
        for agent in (0, 2):
            run.run(agent, PYTHON, "-c", "import socket; socket.socket(socket.AF_INET, socket.SOCK_DGRAM)"
                                         ".sendto(b'to all', ('239.255.0.1', 7001))")
        said = server.output()
        self.assertIn("udp 10.77.0.1\n", said)
        self.assertIn("udp 10.77.0.3\n", said)

    @needs("iperf3")
    def test_iperf3(self):
        run = self.wire(rate=20e6)
        for options in ([], ["-u", "-b", "5M"]):
            with self.subTest(options):
                server = run.start(1, "iperf3", "-s", "-1", "--forceflush")
                server.says("Server listening")
                said = json.loads(run.run(0, "iperf3", "-c", "r1", "-t", 2, "-J", *options))
                received = said["end"]["sum_received" if not options else "sum"]
                self.assertGreater(received["bits_per_second"], 3e6)
                self.assertLess(received["bits_per_second"], 20e6)
                if options:
                    self.assertEqual(received["lost_packets"], 0)
                server.output()

    @needs("ddsperf")
    def test_cyclone_dds_finds_its_peers_by_multicast(self):
        run = self.wire()
        subscribers = [run.start(i, "ddsperf", "-D", 30, "sub") for i in (1, 2)]
        run.start(0, "ddsperf", "-D", 30, "pub", "100Hz", "size", 1000)
        for one in subscribers:
            wait_for(lambda: re.search(r"total [1-9]\d* ", one.text()), 30)

    @needs("fast-discovery-server")
    def test_the_discovery_server_of_fast_dds(self):
        run = self.wire()
        server = run.start(0, "fast-discovery-server", "-i", "0", "-l", "10.77.0.1", "-p", "11811")
        server.says("10.77.0.1")  # some time after it said that it runs
        ports = run.run(0, PYTHON, "-c", "print(open('/proc/net/udp').read())")
        self.assertIn(f"{11811:04X} ", ports)


@unittest.skipIf(REFUSED_TO_USER, REFUSED_TO_USER)
class AsUser(AsRoot):
    user = True

    def test_it_is_one(self):
        run = self.wire()
        self.assertEqual(run.run(0, "id", "-u"), "0\n")
        run.run(0, "touch", run.folder / "file")
        owner = (run.folder / "file").stat().st_uid
        self.assertEqual(owner, wire.USER if os.geteuid() == 0 else os.geteuid())
        self.assertNotEqual(owner, 0)

    def test_goes_inside_its_own_run(self):
        run = self.wire(factor=0.5)
        as_user = ["setpriv", "--reuid", str(wire.USER), "--regid", str(wire.USER), "--clear-groups"]
        said = subprocess.run([*(as_user if os.geteuid() == 0 else []), BIN / "baraka", "exec", "r1", "--run",
                               run.folder, "--", "ping", "-c", "1", "r2"],
                              capture_output=True, text=True, timeout=60, check=False, cwd="/")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("1 received", said.stdout)


@unittest.skipIf(REFUSED_TO_USER, REFUSED_TO_USER)
class Dilated(unittest.TestCase):
    factor = 0.1

    def setUp(self):
        self.run_ = Wire(self, user=True, factor=self.factor, rate=1e6)

    @needs("ping")
    def test_ping_sees_the_air_in_its_own_time(self):
        """A frame of 98 B takes 784 us at 1 Mb/s, there and back."""
        begin = time.monotonic()
        said = self.run_.run(0, "ping", "-c", 5, "-i", 0.2, "r1")
        outside = time.monotonic() - begin
        self.assertGreaterEqual(outside, 4 * 0.2 / self.factor)
        found = times(said)
        self.assertEqual(len(found), 5, said)
        for one in found:
            self.assertGreaterEqual(one, 2 * 0.784)
        self.assertLess(min(found), 2 * 0.784 / self.factor, "the wall's time")
        self.assertGreater(int(self.run_.ask("loaded", 0)), 0)

    def test_all_agents_have_one_clock(self):
        clock = "import time; print(time.monotonic(), time.time())"
        before = time.monotonic()
        readings = [[float(word) for word in self.run_.run(i % 3, PYTHON, "-c", clock).split()] for i in range(4)]
        passed = (time.monotonic() - before) * self.factor
        for (monotonic, realtime), (later, realtime_later) in zip(readings, readings[1:]):
            self.assertLess(monotonic, later)
            self.assertLess(realtime, realtime_later)
        self.assertLess(readings[-1][0] - readings[0][0], passed)

    def test_timers_of_the_kernel_are_stretched(self):
        proc = "/proc/sys/net"
        said = self.run_.run(0, "cat", f"{proc}/ipv4/neigh/wlan0/retrans_time_ms", f"{proc}/ipv4/ipfrag_time",
                             f"{proc}/ipv6/neigh/wlan0/base_reachable_time_ms")
        self.assertEqual(said.split(), ["10000", "300", "300000"])

    def test_what_cannot_be_slowed_is_refused(self):
        with self.assertRaisesRegex(AssertionError, "still is statically linked, so its time cannot be slowed"):
            self.run_.start(0, STILL)
        script = self.run_.folder / "script"
        script.write_text(f"#! {STILL} -x\n")
        script.chmod(0o755)
        with self.assertRaisesRegex(AssertionError, "script is run by .*still, which is statically linked"):
            self.run_.start(0, script)
        spawned = f"import os; os.posix_spawn({str(STILL)!r}, ['x'], os.environ)"
        found = f"import os; os.posix_spawnp('still', ['x'], {{**os.environ, 'PATH': {str(STILL.parent)!r}}})"
        for status, *command in ((126, "sh", "-c", STILL), (126, "sh", "-c", script), (126, "timeout", 9, STILL),
                                 (126, "env", f"PATH={STILL.parent}", "still"), (1, PYTHON, "-c", spawned),
                                 (1, "env", f"PATH={STILL.parent}", PYTHON, "-c", found)):
            with self.subTest(command):
                child = self.run_.start(0, *command)
                self.assertEqual(child.status(), status, child.text())
                self.assertIn("statically linked, or run by what is, so its time cannot be slowed", child.text())

    def test_no_rights_come_with_a_file_for_the_library_would_not_be_loaded(self):
        """ld.so(8): secure-execution mode. At a factor of 1 they may."""
        asked = "grep", "NoNewPrivs", "/proc/self/status"
        self.assertEqual(self.run_.run(0, *asked).split(), ["NoNewPrivs:", "1"])
        self.assertEqual(Wire(self, user=True).run(0, *asked).split(), ["NoNewPrivs:", "0"])

    @needs("ps")
    def test_processes_are_as_old_as_the_clock_says(self):
        # /proc counts uptime and start times in ticks of 10 ms, each rounded down: an age of 2.000 s may read as 1.99 s.
        said = self.run_.run(0, "sh", "-c", "sleep 9 & sleep 2.5; ps -o etimes= -p $!; date +%s; ps -o lstart= -p $!")
        old, now, started = said.splitlines()
        self.assertIn(int(old), (2, 3))
        begun = time.mktime(time.strptime(started.strip(), "%a %b %d %H:%M:%S %Y"))
        self.assertLessEqual(abs(int(now) - 2 - begun), 2)


@unittest.skipIf(REFUSED, REFUSED)
class BackPressure(unittest.TestCase):
    RECEIVER = textwrap.dedent("""\
        import socket
        s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 200_000)
        s.bind(("", 9999))
        print("listening", flush=True)
        s.settimeout(60)
        s.recv(2000)
        count = 0
        while s.recv(2000) != b"end": count += 1
        # What came, and found no room as this program had no processor for a while, came too.
        names, values = [line.split() for line in open("/proc/net/snmp") if line.startswith("Udp:")]
        print("got", count + int(values[names.index("RcvbufErrors")]))
        """)
    SENDER = textwrap.dedent("""\
        import select, socket, time
        s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        s.connect(("r1", 9999))
        s.send(b"find the neighbour")
        time.sleep(0.5)
        for i in range(5000): assert s.send(b"x" * 1000) == 1000
        s.setblocking(False)
        full = 0
        for i in range(1000):
            try: s.send(b"x" * 1000)
            except BlockingIOError:
                full += 1
                begin = time.monotonic()
                assert select.select([], [s], [], 10)[1] == [s]
                s.send(b"x" * 1000)
        print("full", full)
        s.setblocking(True)
        s.send(b"end")
        """)

    def test_a_sender_waits_for_the_air_and_loses_nothing(self):
        run = Wire(self, agents=2, rate=5e6)
        receiver = run.start(1, PYTHON, "-c", self.RECEIVER)
        receiver.says("listening")
        begin = time.monotonic()
        said = run.run(0, PYTHON, "-c", self.SENDER, timeout=120)
        took = time.monotonic() - begin
        # How often depends on when the sender has a processor; without back pressure it is never.
        self.assertGreater(int(re.search(r"full (\d+)", said)[1]), 0)
        self.assertEqual(receiver.output(), "listening\ngot 6000\n")
        # 6000 frames of 1042 B, but for the 64 that the queue holds, cannot have taken less.
        self.assertGreater(took, (6000 - 64) * 1042 * 8 / 5e6)
        self.assertEqual(run.ask("dropped", 0), "0")

    def test_large_datagrams_go_out_between_small_ones(self):
        """60 kB are 41 frames, more than the queue of 20 ever has; the small ones take each place that gets free."""
        run = Wire(self, agents=2, rate=5e6, options=["--queue", 20])
        sender = ("import socket\ns = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\nprint('begins', flush=True)\n"
                  "for _ in range({count}): s.sendto(b'x' * {size}, ('r1', 9))")
        small = [run.start(0, PYTHON, "-c", sender.format(count=10**9, size=200)) for _ in range(4)]
        for one in small:
            one.says("begins")
        self.assertEqual(run.run(0, PYTHON, "-c", sender.format(count=3, size=60_000)), "begins\n")

    def test_no_program_takes_the_page_from_under_the_run(self):
        run = Wire(self, agents=2, rate=5e6)
        page = "/dev/shm/.baraka-room"
        for attack in (f": > {page}", f"truncate -s 0 {page}", f"truncate -s 1M {page}",
                       f"dd if=/dev/zero of={page} bs=1 count=1 seek=1M"):
            with self.subTest(attack):
                self.assertNotEqual(run.start(0, "sh", "-c", attack).status(), 0)
                self.assertEqual(len(times(run.run(0, "ping", "-c", 1, "r1"))), 1)
        # Its name is the agent's own: without it, only nothing is held back there.
        run.run(0, "rm", page)
        self.assertEqual(len(times(run.run(0, "ping", "-c", 1, "r1"))), 1)
        self.assertEqual(len(times(run.run(1, "ping", "-c", 1, "r0"))), 1)
        self.assertEqual(int(run.ask("loaded", 1)), 1)

    def test_a_killed_sender_does_not_block_the_others(self):
        run = Wire(self, agents=2, rate=5e6)
        flood = "import socket\ns = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\nwhile True: s.sendto(b'x' * 1000, ('r1', 9))"
        for _ in range(5):
            run.start(0, "timeout", "-s", "KILL", 0.3, PYTHON, "-c", flood).status()
        said = run.run(0, "ping", "-c", 3, "-i", 0.2, "r1")
        self.assertEqual(len(times(said)), 3, said)


@unittest.skipIf(REFUSED, REFUSED)
class Exec(unittest.TestCase):
    def exec(self, *arguments, **options):
        return subprocess.run([BIN / "baraka", "exec", *map(str, arguments)], capture_output=True, text=True,
                              timeout=60, check=False, **options)

    def test_runs_a_command_inside_with_the_clock_and_hands_its_status_on(self):
        run = Wire(self, factor=0.5)
        done = self.exec("r1", "--run", run.folder, "--", "sh", "-c", "hostname; cat; exit 7", input="typed")
        self.assertEqual((done.returncode, done.stdout), (7, "r1\ntyped"), done.stderr)
        clock = self.exec("r1", "--run", run.folder, "--", PYTHON, "-c", "import time; print(time.monotonic())")
        self.assertLess(float(clock.stdout), time.monotonic())
        killed = self.exec("r1", "--run", run.folder, "--", "sh", "-c", "kill -9 $$")
        self.assertEqual(killed.returncode, 137)
        refused = self.exec("r1", "--run", run.folder, "--", STILL)
        self.assertEqual(refused.returncode, 125)
        self.assertIn("statically linked", refused.stderr)

    def test_has_the_users_terminal_and_shell(self):
        run = Wire(self)
        said = subprocess.run(["script", "-qec", f"{BIN}/baraka exec r2 --run {run.folder}", "/dev/null"],
                              input="hostname; tty; exit 5\n", capture_output=True, text=True, timeout=60,
                              check=False, env={**os.environ, "SHELL": "/bin/sh"})
        self.assertRegex(said.stdout, r"r2\r?\n/dev/pts/\d+")
        self.assertEqual(said.returncode, 5)

    def test_ends_with_the_run(self):
        run = Wire(self)
        inside = subprocess.Popen([BIN / "baraka", "exec", "r0", "--run", run.folder, "--", "sleep", "1000"])
        self.addCleanup(inside.kill)
        wait_for(lambda: "sleep" in run.run(0, "ps", "-eo", "comm"))
        run.close()
        self.assertIn(inside.wait(timeout=10), (128 + signal.SIGTERM, 128 + signal.SIGKILL))

    def test_names_the_agents_and_the_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            nobody = self.exec("r0", "--run", folder)
        self.assertEqual(nobody.returncode, 125)
        self.assertIn("no run with programs on the air is under way there", nobody.stderr)
        first, second = Wire(self), Wire(self)
        wrong = self.exec("r9", "--run", first.folder, "--", "true")
        self.assertIn("no agent 'r9' with a network: there are r0, r1, r2", wrong.stderr)
        which = self.exec("r0", "--", "true")
        self.assertEqual(which.returncode, 2)
        self.assertIn(f"--run {first.folder}", which.stderr)
        self.assertIn(f"--run {second.folder}", which.stderr)

    def refusal(self, run):
        done = self.exec("r0", "--run", run.folder, "--", "true")
        self.assertEqual(done.returncode, 125, done.stderr)
        return done.stderr

    def test_trusts_no_file_that_others_may_have_written(self):
        run = Wire(self)
        state = run.folder / "namespaces.txt"
        state.chmod(0o666)
        self.assertIn("may be written by others", self.refusal(run))
        state.chmod(0o644)
        state.rename(run.folder / "moved")
        state.symlink_to("moved")
        self.assertIn("namespaces.txt: Too many levels of symbolic links", self.refusal(run))
        state.unlink()
        os.mkfifo(state)
        self.assertIn("is no file", self.refusal(run))
        state.unlink()
        state.write_text((run.folder / "moved").read_text().replace("dilation ", "dilation x"))
        self.assertRegex(self.refusal(run), "'x.*' is no dilation")

    @unittest.skipUnless(os.geteuid() == 0, "needs root, and a user")
    def test_root_goes_into_another_users_run_as_that_user_and_loads_nothing_of_theirs_before(self):
        run = Wire(self, user=True, factor=0.5)
        done = self.exec("r1", "--run", run.folder, "--", "sh", "-c",
                         f"hostname; id -u; touch {run.folder}/mine; cat /proc/self/status")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout.startswith("r1\n0\n"), done.stdout)
        self.assertRegex(done.stdout, r"Groups:\s*(65534 ?)*\n")
        self.assertEqual((run.folder / "mine").stat().st_uid, wire.USER)
        self.assertNotIn(str(run.folder), self.exec("r0", "--", "none-of-that").stderr, "not root's own")

    @unittest.skipUnless(os.geteuid() == 0, "needs root, and a user")
    def test_a_users_file_does_not_lead_root_into_roots_processes(self):
        run = Wire(self)
        state = run.folder / "namespaces.txt"
        os.chown(state, wire.USER, wire.USER)
        self.assertRegex(self.refusal(run), "belongs to user 65534, but the process that it names to user 0")

    def test_a_run_is_found_under_its_new_name(self):
        run = Wire(self)
        moved = run.folder.with_name(run.folder.name + ".moved")
        run.folder.rename(moved)
        self.addCleanup(shutil.rmtree, moved, ignore_errors=True)
        self.assertEqual(self.exec("r0", "--run", moved, "--", "hostname").stdout, "r0\n")
        run.close()
        self.assertEqual(list(moved.iterdir()), [], "what tells of the run goes with it")


@unittest.skipIf(REFUSED, REFUSED)
@unittest.skipUnless(os.geteuid() == 0, "needs root, to take something away")
class Refusals(unittest.TestCase):
    def why(self, prepare, command=()):
        finished = subprocess.run(
            ["unshare", "--mount", *command, "sh", "-c", prepare + ' && exec "$@"', "sh", wire.WIRE,
             "r0=10.77.0.1/16", "--programs", BIN],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(finished.returncode, 1, finished.stderr)
        self.assertEqual(len(finished.stderr.splitlines()), 1, finished.stderr)
        return finished.stderr

    def test_say_what_is_missing_and_how_to_allow_it(self):
        self.assertRegex(self.why("mount -t tmpfs none /dev/net"), "no /dev/net/tun.*modprobe tun")
        user = f"setpriv --reuid {wire.USER} --regid {wire.USER} --clear-groups"
        closed = f"{wire.DEVICES} && chmod 600 /dev/net/tun"
        why = subprocess.run(["unshare", "--mount", "sh", "-c", f'{closed} && exec {user} "$@"', "sh", wire.WIRE,
                              "r0=10.77.0.1/16", "--programs", BIN], stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, timeout=60, check=False).stderr
        self.assertRegex(why, "no access to /dev/net/tun.*chmod 0666 /dev/net/tun")
        self.assertRegex(self.why("echo 0 > /proc/sys/user/max_user_namespaces", ["--map-root-user", "--user"]),
                         "none are allowed here.*user.max_user_namespaces")


if __name__ == "__main__":
    unittest.main()
