#!/usr/bin/env python3
"""Unmodified programs in lock-step: exact to the nanosecond, equal in equal runs, and refused if they cannot be held."""
import bisect
import contextlib
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import textwrap
import unittest

import wire
from baraka import BIN, ROOT, Case, send, wait_for

REFUSED = wire.why_not()
WAITS = BIN.parent / "tests/lockstep_waits"
ECHO_IN_C = BIN.parent / "tests/lockstep_echo"
SPINNER = BIN.parent / "tests/mutex_spinner"
BEGINS = BIN.parent / "tests/thread_begins"
STILL = BIN.parent / "tests/still"
PYTHON = "/usr/bin/python3"
SEEDS_OF_MIX = (1, 2)

ECHO = """
import socket, sys, time
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
if len(sys.argv) == 1:
    s.bind(("", 5000))
    while True:
        data, peer = s.recvfrom(2000)
        s.sendto(data, peer)
time.sleep(0.1)
s.settimeout(1)
for i in range(1000):
    begin = time.monotonic_ns()
    s.sendto(b"x" * 64, (sys.argv[1], 5000))
    s.recvfrom(2000)
    print(time.monotonic_ns() - begin, flush=True)
    time.sleep(0.01)
"""


# A thread waits to be moved to a lock that the kernel hands over with the priority of its owner, and gets it after 0.5 s:
# FUTEX_WAIT_REQUEUE_PI and FUTEX_CMP_REQUEUE_PI of futex(2), which nobody replaces.
UNKNOWN_WAIT = """
import ctypes, threading, time
futex = ctypes.CDLL(None).syscall
word, lock = ctypes.c_int(0), ctypes.c_int(0)
other = threading.Thread(target=lambda: futex(202, ctypes.byref(word), 11, 0, None, ctypes.byref(lock), 0))
other.start()
time.sleep(0.5)
futex(202, ctypes.byref(word), 12, 1, 0, ctypes.byref(lock), 0)
other.join()
print("got it", time.clock_gettime(time.CLOCK_BOOTTIME))
"""


def scenario(folder, agents, seed=1, record="{frames: all}", network="{}"):
    """A file with stations 10 m apart. @param agents  {name: [(program, [word, ...], more)]}"""
    lines = ["version: 1", "name: held", f"seed: {seed}", "routing: none", f"record: {record}",
             f"radio: {{include: {ROOT}/config/radios/ieee80211g.yaml}}", "agents:"]
    for i, (name, programs) in enumerate(agents.items()):
        lines += [f"  {name}:", f"    name: {name}", "    station: {}", f"    poses: [{{x: {10 * i} m, y: 0 m}}]",
                  f"    network: {network}", "    programs:"]
        for program, words, more in programs:
            quoted = ", ".join(repr(str(word)) if "\n" not in str(word) else '"' + str(word).replace("\\", "\\\\").replace(
                '"', '\\"').replace("\n", "\\n") + '"' for word in words)
            lines.append(f"      - {{name: {program}, command: [{quoted}]{more}}}")
    lines += ["end:", "  - {at: 60 s, result: late}"]
    file = folder / "held.yaml"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


class Held(Case):
    def run_held(self, file, *arguments, **options):
        return self.run_baraka(file, "--pace", "lockstep", "--no-inspect", *arguments, **options)

    def log(self, agent, program):
        return (self.out / f"{agent}.{program}.log").read_text(encoding="utf-8")


@unittest.skipIf(REFUSED, REFUSED)
class Waits(Held):
    def test_each_kind_of_wait_takes_exactly_as_long_as_it_says(self):
        self.run_held(scenario(self.folder, {"a": [("waits", [WAITS], ", on_exit: end")]}))
        log = self.log("a", "waits")
        self.assertNotIn("wrong", log)
        lines = [re.fullmatch(r"(.+): (\d+) (\d+)", line) for line in log.splitlines()]
        sources = [ROOT / f"tests/e2e/lockstep/{name}.c" for name in ("waits", "timers", "objects", "files")]
        kinds = [kind for file in sources
                 for kind in re.findall(r'^    {"([^"]+)", \w+, ', file.read_text(encoding="utf-8"), re.M)]
        self.assertEqual([line[1] for line in lines[:-1]], kinds)
        self.assertGreaterEqual(len(kinds), 100)
        for line in lines:
            with self.subTest(line[1]):
                took, expected = int(line[2]), int(line[3])
                if expected:
                    self.assertEqual(took, expected)
                else:  # spins: in steps
                    self.assertGreaterEqual(took, 1_234_567)
                    self.assertLess(took, 2_000_000)

    def test_the_clock_is_the_runs(self):
        self.run_held(scenario(self.folder, {"a": [("date", ["sh", "-c", "date -u +%s; sleep 3600; date -u +%s"],
                                                    ", on_exit: end")]}), "--set", "end.0.at=2 h")
        begin, end = map(int, self.log("a", "date").split())
        self.assertEqual((begin, end), (1767225600, 1767229200))

    def test_a_number_of_a_socket_that_was_closed_says_nothing_of_the_next_file(self):
        code = ("import os, socket, struct, threading, time\n"
                "def numbers():\n    some = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]\n"
                "    for one in some: one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack('ll', 0, 1000))\n"
                "    return [one.fileno() for one in some]\n"
                "for make in (os.pipe, lambda: [one.detach() for one in socket.socketpair()]):\n"
                "    before = numbers()\n    out, into = make()\n    assert [out, into] == before, before\n"
                "    threading.Thread(target=lambda: (time.sleep(0.5), os.write(into, b'x'))).start()\n    print(os.read(out, 1))")
        self.run_held(scenario(self.folder, {"a": [("reads", [PYTHON, "-c", code], ", on_exit: end")]}))
        self.assertEqual(self.log("a", "reads"), "b'x'\n" * 2)

    @unittest.skipIf(len(os.sched_getaffinity(0)) == 1, "needs two processors")
    def test_programs_have_one_processor(self):
        self.run_held(scenario(self.folder, {"a": [("count", ["nproc"], ", on_exit: end")]}))
        self.assertEqual(self.log("a", "count").strip(), "1")

    def test_what_waits_until_everything_is_taken_does(self):
        """More than a pipe or a socket holds; in parts for who does not wait."""
        code = ("import os, socket, threading, time\nout, into = os.pipe()\na, b = socket.socketpair()\n"
                "def take(one):\n    time.sleep(0.5)\n    left = 1000000\n    while left: left -= len(os.read(one, left))\n"
                "for read, write in ((out, lambda data: os.write(into, data)), (b.fileno(), a.send),\n"
                "                    (out, lambda data: os.writev(into, [data[:300000], data[300000:]])),\n"
                "                    (b.fileno(), lambda data: a.sendmsg([data[:300000], data[300000:]]))):\n"
                "    thread = threading.Thread(target=take, args=[read])\n    thread.start()\n    begin = time.monotonic_ns()\n"
                "    print(write(bytes(1000000)), time.monotonic_ns() - begin)\n    thread.join()\n"
                "a.setblocking(False)\nprint(0 < a.send(bytes(1000000)) < 1000000)")
        self.run_held(scenario(self.folder, {"a": [("writes", [PYTHON, "-c", code], ", on_exit: end")]}))
        self.assertEqual(self.log("a", "writes"), "1000000 500000000\n" * 4 + "True\n")


    def test_so_is_how_long_the_computer_has_been_on(self):
        code = ("import time\ntime.sleep(5.25)\nboot = time.clock_gettime_ns(time.CLOCK_BOOTTIME)\n"
                "print(boot, *open('/proc/uptime').read().split(), open('/proc/uptime', 'rb').read().decode().split()[0])")
        self.run_held(scenario(self.folder, {"a": [
            ("python", [PYTHON, "-c", code], ", on_exit: end"), ("cat", ["cat", "/proc/uptime"], ""),
            ("uptime", ["uptime", "-p"], "")]}))
        boot, up, idle, again = self.log("a", "python").split()
        hundredths = int(boot) // 10_000_000
        self.assertEqual((up, idle, again), (f"{hundredths // 100}.{hundredths % 100:02}", "0.00", up))
        self.assertGreaterEqual(float(up), 1005.25)
        self.assertRegex(self.log("a", "cat"), r"^1000\.0[01] 0\.00\n$")
        self.assertEqual(self.log("a", "uptime"), "up 16 minutes\n")


@unittest.skipIf(REFUSED, REFUSED)
class Exact(Held):
    def echo(self, program=(PYTHON, "-c", ECHO), *more, network="{}"):
        file = scenario(self.folder, {"a": [("ping", [*program, "10.77.0.2", *more], ", on_exit: end")],
                                      "b": [("pong", program, "")]}, network=network)
        finished = self.run_held(file)
        return finished, [int(line) for line in self.log("a", "ping").split()]

    def sent(self, agent, protocol):
        """When IPv4 packets of a protocol ("11": UDP, "01": ICMP) came to the agent's interface, and their hexadecimal bytes."""
        return [(at, packet) for at, packet in self.query(
            f"SELECT at_ns, bytes FROM arrivals WHERE door = 'air of {agent}' ORDER BY rowid")
            if packet[24:28] == "0800" and packet[46:48] == protocol]

    def received(self, more="f.bits > 0"):
        """When the first agent received data frames of the second."""
        return [at for at, in self.query(
            "SELECT e.at_ns FROM frame_ends e JOIN frames f USING (frame) WHERE e.agent = 1 AND f.transmitter = 2 AND "
            "f.class = 'unicast' AND f.receiver = 1 AND e.verdict = 'delivered' AND f.rate_bps = 54000000 AND "
            f"f.protocol IS NOT 'ARP' AND {more} ORDER BY e.at_ns")]

    def round_trips(self, begins, ends):
        """From when a request came to the interface until its answer was received, ns: the first that came then."""
        found = [ends[bisect.bisect_right(ends, begin)] for begin in begins]
        self.assertEqual(len(set(found)), len(begins), "each has an answer of its own")
        return list(zip(begins, found))

    def expected(self):
        return [end - begin for begin, end in self.round_trips([at for at, _ in self.sent("a", "11")], self.received())]

    @contextlib.contextmanager
    def busy(self, count):
        loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
        try:
            yield
        finally:
            for loop in loops:
                loop.kill()
                loop.wait()

    def test_round_trips_of_udp_are_those_of_the_frame_table(self):
        finished, took = self.echo()
        self.assertEqual(len(took), 1000)
        # The first waits for the address, which the table of requests shows; its packet enters afterwards.
        self.assertEqual(took[1:], self.expected()[1:])
        self.assertGreater(len(set(took)), 5, "backoffs are drawn")
        self.assertEqual(finished["frames_dropped"], "0")
        self.assertGreater(int(finished["program_turns"]), 200)

    def test_so_are_those_of_a_program_in_c(self):
        finished, took = self.echo((ECHO_IN_C,), 1000)
        self.assertEqual(len(took), 1000)
        self.assertEqual(took[1:], self.expected()[1:])
        self.assertEqual(finished["frames_dropped"], "0")

    def test_waking_up_takes_as_long_as_the_scenario_says(self):
        """The program in b reads a request, and that in a its answer, 20 us after it came in."""
        wake = 20_000
        finished, took = self.echo((ECHO_IN_C,), 100, network="{cpu: {per_wake: 20 us}}")
        self.assertEqual(len(took), 100)
        self.assertEqual(took[1:], [at + wake for at in self.expected()[1:]])
        asked = [at for at, in self.query("SELECT e.at_ns FROM frame_ends e JOIN frames f USING (frame) WHERE e.agent = 2 AND "
                                          "f.class = 'unicast' AND f.bits > 0 AND f.receiver = 2 AND e.verdict = 'delivered' AND "
                                          "f.protocol LIKE '%UDP%' ORDER BY e.at_ns")]
        answered = [at for at, _ in self.sent("b", "11")]
        self.assertEqual(answered, [at + wake for at in asked])
        again = self.echo((ECHO_IN_C,), 100, network="{cpu: {per_wake: 20 us}}")
        self.assertEqual((again[0]["frames_digest"], again[0]["fingerprint"]), (finished["frames_digest"], finished["fingerprint"]))

    def test_threads_that_are_woken_together_take_the_processor_one_after_the_other(self):
        code = ("import threading, time\nat = []\n"
                "def sleep():\n    time.sleep(until - time.monotonic())\n    at.append(time.monotonic_ns() - base)\n"
                "base = time.monotonic_ns()\nuntil = time.monotonic() + 1\n"
                "threads = [threading.Thread(target=sleep) for _ in range(3)]\n"
                "[one.start() for one in threads]; time.sleep(3); print(*at)")
        file = scenario(self.folder, {"a": [("sleep", [PYTHON, "-c", code], ", on_exit: end")]}, network="{cpu: {per_wake: 1 ms}}")
        self.run_held(file)
        first, *others = map(int, self.log("a", "sleep").split())
        self.assertGreaterEqual(first, 1_001_000_000 - 1000)
        self.assertEqual([at - first for at in others], [1_000_000, 2_000_000])

    def test_they_are_the_same_beside_busy_loops_and_when_repeated(self):
        alone = self.echo()
        first = self.out
        with self.busy(os.cpu_count()):
            loaded = self.echo()
        self.assertEqual(alone[1], loaded[1])
        self.assertEqual(alone[0]["fingerprint"], loaded[0]["fingerprint"])
        again = self.run_baraka(self.folder / "held.yaml", "--repeat", first, "--no-inspect")
        self.assertEqual(again["fingerprint"], alone[0]["fingerprint"])
        self.assertEqual(again["simulated_s"], alone[0]["simulated_s"])

    def ping(self, count):
        """ping subtracts times in whole microseconds, and prints them in milliseconds."""
        file = scenario(self.folder, {"a": [("ping", ["ping", "-i", 0.1, "-c", count, "10.77.0.2"], ", on_exit: end")], "b": []})
        self.run_held(file, "--set", "end.0.at=200 s")
        printed = re.findall(r"icmp_seq=\d+ ttl=64 time=([\d.]+) ms", self.log("a", "ping"))
        self.assertEqual(len(printed), count)
        trips = self.round_trips([at for at, _ in self.sent("a", "01")], self.received())
        expected = [1e-3 * (end // 1000 - begin // 1000) for begin, end in trips]
        self.assertEqual(printed[1:], [f"{one:.3f}" for one in expected][1:])  # the first waits for the address
        self.assertGreater(len(set(printed)), 5, "backoffs are drawn")

    def test_so_are_those_of_ping(self):
        self.ping(1000)

    def pings_of_dds(self):
        """Half of each round trip as ddsperf counts it, ns: from the time that the answer repeats, which has been a fraction of 2^-32 s
        (INFO_TS), until it was received. 64 bytes and their heartbeat are 198 bytes of Ethernet, 220 on the air."""
        def begin(packet):
            message = bytes.fromhex(packet[84:])  # behind Ethernet, IPv4 and UDP
            is_sample = message[:4] == b"RTPS" and message[20:22] == b"\x09\x01" and message[32:34] == b"\x15\x05"
            if len(packet) != 2 * 198 or not is_sample:
                return None
            seconds, fraction = struct.unpack_from("<II", message, 24)
            return (seconds - 1767225600) * 10 ** 9 + (fraction * 10 ** 9 >> 32)
        begins = [begin(packet) for _, packet in self.sent("pinger", "11")]
        trips = self.round_trips([one for one in begins if one is not None], self.received(f"f.bits = {8 * 220}"))
        return [(end - begin) // 2 for begin, end in trips]

    def ddsperf(self, seconds):
        text = (ROOT / "config/scenarios/dds_two_stations.yaml").read_text(encoding="utf-8")
        file = self.folder / "dds.yaml"
        file.write_text(text.replace("../radios", f"{ROOT}/config/radios").replace("-D, 20", f"-D, {seconds}").replace(
            "-D, 60", f"-D, {2 * seconds}"), encoding="utf-8")
        self.run_held(file, "--set", "record.frames=all", "--set", f"end.0.at={2 * seconds} s")
        halves = self.pings_of_dds()
        printed = re.findall(r"size 64 mean ([\d.]+)us min ([\d.]+)us 50% ([\d.]+)us 90% ([\d.]+)us 99% ([\d.]+)us max ([\d.]+)us "
                             r"cnt (\d+)", self.log("pinger", "ping"))
        counts = [int(line[-1]) for line in printed]
        self.assertGreaterEqual(sum(counts), 10 * seconds - 20)
        self.assertLessEqual(len(halves) - sum(counts), 1)
        for line, count in zip(printed, counts):
            some, halves = sorted(halves[:count]), halves[count:]
            self.assertEqual(list(line[1:6]), [f"{1e-3 * one:.3f}" for one in (
                some[0], *(some[count - (count * (100 - percent) + 99) // 100 if percent != 50 else count - (count + 1) // 2]
                           for percent in (50, 90, 99)), some[-1])])
            self.assertAlmostEqual(float(line[0]), 1e-3 * sum(some) / count, delta=0.00051)

    @unittest.skipUnless(shutil.which("ddsperf"), "needs ddsperf")
    def test_so_are_those_of_ddsperf(self):
        self.ddsperf(102)

    def test_so_are_those_of_others_beside_busy_loops(self):
        with self.busy(os.cpu_count()):
            self.ping(100)
            if shutil.which("ddsperf"):
                self.ddsperf(20)


@unittest.skipIf(REFUSED, REFUSED)
class Repeatable(Held):
    def mix(self, seed):
        loop = "import random, time\nfor i in range(50): time.sleep(random.random() / 50)\nprint(random.random(), hash('a'))"
        threads = ("import threading, queue, os\nq = queue.Queue()\n"
                   "ts = [threading.Thread(target=lambda i=i: q.put((i, os.urandom(2).hex()))) for i in range(8)]\n"
                   "[t.start() for t in ts]; [t.join() for t in ts]; print([q.get() for _ in ts])")
        agents = {
            "a": [("ping", ["ping", "-c", 10, "-i", 0.1, "b"], ", on_exit: end"), ("py", [PYTHON, "-c", loop], "")],
            "b": [("shell", ["sh", "-c", "for i in 1 2 3; do ping -c 1 c; sleep 0.1; done; echo $$; date; od -An -N4 -tx1 "
                             "/dev/urandom"], ""), ("threads", [PYTHON, "-c", threads], "")],
            "c": [("ping6", ["ping", "-6", "-c", 5, "-i", 0.2, "a"], "")]}
        finished = self.run_held(scenario(self.folder, agents, seed))
        logs = {(agent, program): self.log(agent, program) for agent, all_ in agents.items() for program, *_ in all_}
        return finished["fingerprint"] + finished["frames_digest"], logs

    def test_equal_runs_have_equal_bytes_and_another_seed_has_others(self):
        first = self.mix(1)
        self.assertIn("10 received", first[1]["a", "ping"])
        for _ in range(3):
            self.assertEqual(self.mix(1), first)
        other = self.mix(2)
        self.assertNotEqual(other[0], first[0])
        self.assertNotEqual(other[1]["a", "py"], first[1]["a", "py"])

    def test_errors_of_icmp_are_not_limited_by_the_wall_clock(self):
        code = ("import socket, time\ntime.sleep(0.1)\nfor family, to in ((socket.AF_INET, '10.77.0.2'), (socket.AF_INET6, 'b')):\n"
                "    s = socket.socket(family, socket.SOCK_DGRAM)\n    s.connect((to, 5000))\n    s.settimeout(1)\n"
                "    for i in range(70):\n        s.send(b'x')\n        try: s.recv(1)\n        except ConnectionRefusedError: print(i)")
        self.run_held(scenario(self.folder, {"a": [("sender", [PYTHON, "-c", code], ", on_exit: end")], "b": [
            ("sleep", ["sleep", 100], "")]}))
        self.assertEqual(self.log("a", "sender").split(), [str(i) for i in range(70)] * 2)

    def test_tcp_is_flagged(self):
        server = "import socket\ns = socket.create_server(('', 80))\nc, _ = s.accept()\nc.sendall(c.recv(100))"
        client = ("import socket, time\ntime.sleep(0.1)\ns = socket.create_connection(('10.77.0.2', 80), 5)\n"
                  "s.sendall(b'x')\nprint(s.recv(100))")
        finished = self.run_held(scenario(self.folder, {"a": [("client", [PYTHON, "-c", client], ", on_exit: end")],
                                                        "b": [("server", [PYTHON, "-c", server], "")]}))
        self.assertEqual(self.log("a", "client"), "b'x'\n")
        self.assertIn("programs used TCP in lock-step: its timers are the kernel's", finished.err)

    def test_tcp_is_as_fast_as_the_radio_lets_it_be(self):
        """Its timers are the kernel's, so the run keeps to wall time while one is pending."""
        size = 2_000_000
        server = ("import socket\ns = socket.create_server(('', 80))\nc, _ = s.accept()\nn = 0\n"
                  f"while n < {size}: n += len(c.recv(100000))\nc.sendall(b'x')\nc.recv(1)")
        client = ("import socket, time\ntime.sleep(0.1)\ns = socket.create_connection(('10.77.0.2', 80))\nt = time.time()\n"
                  f"s.sendall(bytes({size}))\ns.recv(1)\nprint(time.time() - t)")
        self.run_held(scenario(self.folder, {"a": [("client", [PYTHON, "-c", client], ", on_exit: end")],
                                             "b": [("server", [PYTHON, "-c", server], "")]}, record="{frames: none}"))
        rate = 8e-6 * size / float(self.log("a", "client"))  # Mb/s; 54 Mb/s on the air, of which DCF leaves about half
        self.assertGreater(rate, 12)
        self.assertLess(rate, 30)

    def test_tcp_asks_again_by_virtual_time(self):
        client = ("import socket, subprocess\n"
                  "subprocess.run('ip neigh replace 10.77.0.2 lladdr 02:00:00:00:00:02 dev wlan0'.split(), check=True)\n"
                  "s = socket.socket()\ns.settimeout(4)\n"
                  "try: s.connect(('10.77.0.2', 80))\nexcept TimeoutError: print('timed out')")
        file = scenario(self.folder, {"a": [("client", [PYTHON, "-c", client], ", on_exit: end")], "b": []})
        file.write_text(file.read_text(encoding="utf-8").replace("{x: 10 m", "{x: 9000 m"), encoding="utf-8")
        self.run_held(file)
        self.assertEqual(self.log("a", "client"), "timed out\n")
        sent = [at for at, packet in self.query("SELECT at_ns, bytes FROM arrivals WHERE door = 'air of a' ORDER BY at_ns")
                if packet[46:48] == "06"]
        self.assertGreaterEqual(len(sent), 2)
        self.assertLess(abs(1e-9 * (sent[1] - sent[0]) - 1), 0.3, "RFC 6298, 2.1: after a second")

    def test_an_hour_of_idle_stations_takes_seconds(self):
        programs = [("wait", ["sh", "-c", "while sleep 60; do date; done"], "")]
        finished = self.run_held(scenario(self.folder, {"a": programs, "b": programs}), "--set", "end.0.at=1 h")
        self.assertEqual(finished["simulated_s"], "3600.000000000")
        self.assertEqual(len(self.log("a", "wait").splitlines()), 59)


@unittest.skipIf(REFUSED, REFUSED)
class Programs(Held):
    def test_a_shell_handles_signals_of_its_children(self):
        code = ("trap 'echo trapped; date +%s' USR1; (sleep 1; kill -USR1 $$) & sleep 2; wait; date +%s; "
                "read -t 3 line < <(sleep 9); date +%s")
        self.run_held(scenario(self.folder, {"a": [("shell", ["bash", "-c", code], ", on_exit: end")]}))
        self.assertEqual(self.log("a", "shell").split(), ["trapped", "1767225602", "1767225602", "1767225605"])

    def test_a_new_thread_gives_no_memory_back_before_its_turn(self):
        """Else it may hold a lock of the allocator while it is not known to the run."""
        self.run_held(scenario(self.folder, {"a": [("begins", [BEGINS], ", on_exit: end")]}))
        self.assertEqual(self.log("a", "begins"), "in turn\n")

    def test_a_thread_that_spins_on_a_mutex_lets_others_go_on(self):
        file = scenario(self.folder, {"a": [("spinner", [SPINNER], ", on_exit: end")]})
        out = self.run_held(file).out
        self.assertIn("result: spinner", out)
        took = int(self.log("a", "spinner"))
        self.assertTrue(1_000_000 <= took < 1_400_000, took)  # the longest step of a spinner is 0.32 ms
        self.assertNotIn("program_spins: 0", out)

    def test_a_sender_whose_neighbour_does_not_answer_lets_time_pass(self):
        """Its packets wait for an address, so that they never fill the queue of the station."""
        code = ("import socket\ns = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\ns.connect(('10.77.0.9', 5000))\n"
                "while True:\n    try: s.send(bytes(1000))\n    except OSError: pass")
        finished = self.run_held(scenario(self.folder, {"a": [("flood", [PYTHON, "-c", code], "")]}), "--set", "end.0.at=200 ms")
        self.assertEqual(finished["result"], "late")
        self.assertEqual(finished["frames_dropped"], "0")

    def test_the_random_device_does_not_end(self):
        code = "head -c 300000 /dev/urandom | tail -c 100000 | od -An -tx1 -v"
        self.run_held(scenario(self.folder, {"a": [("random", ["sh", "-c", code], ", on_exit: end")]}))
        drawn = self.log("a", "random").split()
        self.assertEqual(len(drawn), 100000)
        for begin in range(0, 100000, 10000):  # each byte value about as often as any other
            self.assertGreater(len(set(drawn[begin:begin + 10000])), 250)
        self.assertNotEqual(drawn[:16384], drawn[16384:32768])

    def test_commands_of_others_run_in_agents_that_nothing_happens_to(self):
        busy = [("loop", ["sh", "-c", "while sleep 0.1; do :; done"], "")]
        file = scenario(self.folder, {"a": busy, "b": []})
        run = self.start(file, "--pace", "lockstep", "--set", "end.0.at=100 h")
        wait_for(lambda: (self.out / "run.log").exists())
        said = subprocess.run([BIN / "baraka", "exec", "--run", self.out, "b", "--", "sh", "-c", "date +%s; sleep 9; date +%s; "
                               "ping -c 1 a; exit 3"], capture_output=True, text=True, timeout=60, check=False)
        send(run.process.pid, "SIGINT")
        run.finish()
        begin, end = map(int, said.stdout.split()[:2])
        self.assertEqual(end - begin, 9)
        self.assertLess(begin, 1767225600 + 100 * 3600)
        self.assertIn("1 received", said.stdout)
        self.assertEqual(said.returncode, 3)


@unittest.skipIf(REFUSED, REFUSED)
class Refused(Held):
    def test_a_program_that_cannot_be_held_is_refused_before_the_run(self):
        file = scenario(self.folder, {"a": [("still", [STILL], "")]})
        finished = self.run_held(file, status=2)
        self.assertRegex(finished.err, r"held.yaml:\d+:\d+: command: .*still is statically linked, so lock-step cannot "
                                       r"hold it; run it in real time \(--pace realtime\)")

    def unknown_wait(self, network, status=0):
        agents = {"a": [("lock", [PYTHON, "-c", UNKNOWN_WAIT], ", on_exit: end")]}
        return self.run_held(scenario(self.folder, agents, network=network), status=status)

    def test_a_wait_that_nobody_knows_fails_the_run_by_name(self):
        finished = self.unknown_wait("{}", status=1)
        self.assertRegex(finished.err, r"error: a: python3 waits in system call 202 \(wchan \w+\), of which lock-step does not know")

    def test_or_is_counted_where_the_scenario_allows_it(self):
        finished = self.unknown_wait("{unknown_waits: allow}")
        self.assertIn("got it", self.log("a", "lock"))
        self.assertEqual(finished["program_unknown_waits"], "1")
        self.assertIn("1 waits of programs were in system calls that lock-step does not support", finished.err)
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'program_unknown_waits'"), [(1,)])

    def test_what_cannot_be_held_is_refused_to_the_program_and_said_once(self):
        code = """
import ctypes, os, struct
c = ctypes.CDLL(None, use_errno=True)
def call(name, *arguments):
    print(name, getattr(c, name)(*arguments), os.strerror(ctypes.get_errno()), flush=True)
for i in range(2):
    call("syscall", 425, 8, 0)  # io_uring_setup
call("syscall", 449, 0, 0, 0, None, 0)  # futex_waitv
for i in range(2):
    call("ptrace", 0, 0, 0, 0)  # PTRACE_TRACEME
queue = c.mq_open(b"/queue", os.O_RDWR | os.O_CREAT, 0o600, None)
call("mq_notify", queue, struct.pack("<qii48x", 0, 0, 2))  # SIGEV_THREAD
"""
        self.run_held(scenario(self.folder, {"a": [("ring", [PYTHON, "-c", code], ", on_exit: end")]}))
        self.assertEqual(self.log("a", "ring"), "baraka: io_uring is not available in lock-step\n" +
                         3 * "syscall -1 Function not implemented\n" +
                         "baraka: ptrace is not available in lock-step; attach debuggers from outside the agent\n" +
                         2 * "ptrace -1 Function not implemented\n" +
                         "baraka: mq_notify() with SIGEV_THREAD is not available in lock-step\n" +
                         "mq_notify -1 Function not implemented\n")

    def test_a_program_that_never_waits_is_named(self):
        file = scenario(self.folder, {"a": [("busy", [PYTHON, "-c", "while True: pass"], "")]})
        run = self.start(file, "--pace", "lockstep", "--no-inspect")
        log = self.out / "run.log"
        wait_for(lambda: log.exists() and "a: python3 has run for 4 s without waiting" in log.read_text(encoding="utf-8"))
        send(run.process.pid, "SIGINT")
        self.assertLess(float(run.finish()["simulated_s"]), 0.01, "virtual time stood")

    def test_a_thread_that_is_made_past_the_c_library_is_refused_to_the_program(self):
        """Nobody would know of it."""
        code = "import ctypes, threading\nctypes.CDLL(None).getpid()\nprint('made', ctypes.CDLL(None).syscall(56, 0x100, 1, 0, 0, 0))"
        self.run_held(scenario(self.folder, {"a": [("raw", [PYTHON, "-c", textwrap.dedent(code)], ", on_exit: end")]}))
        self.assertIn("made -1", self.log("a", "raw"))


if __name__ == "__main__":
    unittest.main()
