#!/usr/bin/env python3
"""Programs that know nothing of it live slower with the preloaded library: their clocks, sleeps and
time-outs go by one slowed time. What is asserted holds on a busy machine, too: a program's time is
the factor times the time that passed outside, and no wait ends early."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from baraka import BIN, ROOT, some_domain

LIBRARY = BIN / "libbaraka_dilate.so"
FACTOR = 0.25

PYTHON = """
import json, os, select, subprocess, sys, threading, time
def measured(wait):
    begin = time.monotonic(), time.time()
    wait()
    return time.monotonic() - begin[0], time.time() - begin[1]
event, poll, epoll = threading.Event(), select.poll(), select.epoll()
def child():
    return float(subprocess.check_output([sys.executable, "-c", "import time; print(time.monotonic())"]))
before = time.monotonic()
inner = child()
after = time.monotonic()
print(json.dumps({"waits": {
    "sleep": measured(lambda: time.sleep(0.05)),
    "event": measured(lambda: event.wait(0.05)),
    "select": measured(lambda: select.select([], [], [], 0.05)),
    "poll": measured(lambda: poll.poll(50)),
    "epoll": measured(lambda: epoll.poll(0.05)),
    "lock": measured(lambda: threading.Lock().acquire() and event.wait(0.05)),
    "process": measured(lambda: subprocess.run(["sleep", "0.05"])),
}, "child": [before, inner, after], "variable": os.environ["BARAKA_DILATION"]}))
"""

PROCESSOR = """
import json, os, resource, time
def readings():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    ticks = os.times()
    return {"process": time.process_time(), "thread": time.thread_time(), "getrusage": usage.ru_utime + usage.ru_stime,
            "times": ticks.user + ticks.system, "/proc/self/stat": sum(map(int, open("/proc/self/stat").read().rpartition(
                ")")[2].split()[11:13])) / 100}, {"monotonic": time.monotonic(), "elapsed": ticks.elapsed}
before, clocks = readings()
while time.monotonic() < clocks["monotonic"] + 0.2: pass
after, clocks_after = readings()
print(json.dumps([{name: after[name] - before[name] for name in before},
                  {name: clocks_after[name] - clocks[name] for name in clocks}]))
"""

UPTIMES = """
import subprocess, time
boot = lambda: time.clock_gettime(time.CLOCK_BOOTTIME)
said = lambda *command: float(subprocess.check_output(command).split()[0])
for command in (["cat", "/proc/uptime"], ["awk", "{print $1}", "/proc/uptime"], ["sh", "-c", "cat < /proc/uptime"],
                ["sh", "-c", "cd /proc; read up idle < uptime; echo $up"]):
    print(boot(), said(*command), boot())
for way in (lambda: open("/proc/uptime"), lambda: open("/proc/uptime", "rb", buffering=0)):
    print(boot(), float(way().read().split()[0]), boot())
"""

FILES = """
cd "$1"
sleep 0.3
date +%s.%N; echo first > a; date +%s.%N; stat -c %.9Y a; stat -c %.9Z a
sleep 0.1
echo later > b
test b -nt a && echo newer
touch -d @1900000000.123456789 a; stat -c %.9Y a
cp -p a c; stat -c %.9Y c; test c -nt a || test a -nt c || echo same
find . -newer b -name a
touch -d 2020-01-02T03:04:05Z a; stat -c %Y a
touch -d "100 seconds" ahead
"""


def slowed(factor=FACTOR, **variables):
    return {**os.environ, "LD_PRELOAD": str(LIBRARY), "BARAKA_DILATION": str(factor), **variables}


def run(command, environment=None):
    """The finished process, and the seconds that it took out here."""
    begin = time.monotonic()
    process = subprocess.run([str(part) for part in command], env=environment or slowed(), text=True,
                             capture_output=True, timeout=300, check=False)
    return process, time.monotonic() - begin


class Dilation(unittest.TestCase):
    def test_python_waits_by_the_slowed_time(self):
        process, outside = run([sys.executable, "-c", PYTHON])
        self.assertEqual(process.returncode, 0, process.stderr)
        said = json.loads(process.stdout)
        inside = 0
        for name, (monotonic, realtime) in said["waits"].items():
            with self.subTest(name):
                self.assertGreaterEqual(monotonic, 0.05)
                self.assertGreater(realtime, 0.049)
                inside += monotonic
        self.assertGreaterEqual(outside, inside / FACTOR, "no wait ended early")
        before, child, after = said["child"]
        self.assertTrue(before <= child <= after, f"a child has the same clock: {said['child']}")
        self.assertRegex(said["variable"], r"^0\.25( \d+){4}$")

    def test_processor_time_is_no_more_than_the_time_that_passed(self):
        """It was four times as much: whoever keeps to a share of the processor then kept to a quarter of it."""
        process, outside = run([sys.executable, "-c", PROCESSOR])
        self.assertEqual(process.returncode, 0, process.stderr)
        processor, clocks = json.loads(process.stdout)
        self.assertGreaterEqual(outside, 0.2 / FACTOR)
        for name, time_ in clocks.items():
            self.assertGreaterEqual(time_, 0.19, name)
            self.assertLessEqual(time_, outside * FACTOR + 0.02, name)
        for name, time_ in processor.items():
            self.assertGreater(time_, 0, name)
            self.assertLessEqual(time_, clocks["monotonic"] + 0.03, name)

    def test_the_limit_of_processor_time_is_of_the_programs_own(self):
        factor = 0.5
        process, outside = run(["bash", "-c", "ulimit -t 1; ulimit -t; while :; do :; done"], slowed(factor))
        self.assertEqual(process.returncode, -9, process.stderr)
        self.assertEqual(process.stdout, "1\n")
        self.assertGreaterEqual(outside, 1 / factor)

    def test_files_of_proc_tell_the_slowed_time(self):
        process, _ = run([sys.executable, "-c", UPTIMES])
        self.assertEqual(process.returncode, 0, process.stderr)
        for line in process.stdout.splitlines():
            before, told, after = map(float, line.split())
            self.assertTrue(before - 0.02 <= told <= after + 0.02, line)
        self.assertEqual(len(process.stdout.splitlines()), 6)

    @unittest.skipUnless(shutil.which("top"), "needs top")
    def test_top_sees_processors_work_between_two_looks(self):
        process, _ = run(["top", "-b", "-n", "3", "-d", "0.3"], slowed(LC_ALL="C"))
        shares = [float(share) for share in re.findall(r"([\d.]+) id", process.stdout)]
        self.assertGreaterEqual(len(shares), 3, process.stdout + process.stderr)
        sums = [sum(map(float, re.findall(r"([\d.]+) (?:us|sy|ni|id|wa|hi|si|st)", line)))
                for line in process.stdout.splitlines() if line.startswith("%Cpu")]
        for total in sums:
            self.assertAlmostEqual(total, 100, delta=1)

    def test_files_are_of_the_slowed_time(self):
        with tempfile.TemporaryDirectory() as folder:
            before_outside = time.time()
            process, _ = run(["sh", "-c", FILES, "sh", folder])
            self.assertEqual(process.returncode, 0, process.stderr)
            before, after, modified, changed, *rest = process.stdout.splitlines()
            for told in (modified, changed):  # by the kernel's last tick
                self.assertLessEqual(float(before) - 0.02, float(told))
                self.assertLessEqual(float(told), float(after) + 0.001)
            self.assertEqual(rest, ["newer", "1900000000.123456789", "1900000000.123456789", "same", "./a",
                                    "1577934245"])
            self.assertGreaterEqual(os.stat(pathlib.Path(folder) / "b").st_mtime, before_outside)
            self.assertEqual(os.stat(pathlib.Path(folder) / "a").st_mtime, 1577934245)
            ahead = os.stat(pathlib.Path(folder) / "ahead").st_mtime - time.time()
            self.assertAlmostEqual(ahead, 100 / FACTOR, delta=30)

    def test_a_thread_that_was_promised_a_second_gets_one(self):
        """time-outs of the C library's tools, which wait by alarm and timer."""
        process, outside = run(["timeout", "0.2", "sleep", "60"])
        self.assertEqual(process.returncode, 124)
        self.assertGreaterEqual(outside, 0.2 / FACTOR)

    def test_a_wrong_factor_ends_the_program_before_it_begins(self):
        for factor in ("2", "", "0", "fast", "0.5 1 2 3"):
            with self.subTest(factor):
                process, _ = run(["true"], slowed(factor))
                self.assertEqual(process.returncode, 127)
                self.assertIn(f"BARAKA_DILATION='{factor}' must be a factor 0.01 .. 1", process.stderr)

    def test_at_one_nothing_changes(self):
        process, _ = run([sys.executable, "-c", "import time; print(time.time(), time.monotonic())"],
                         slowed(1))
        realtime, monotonic = map(float, process.stdout.split())
        self.assertLess(abs(realtime - time.time()), 60)
        self.assertLessEqual(monotonic, time.monotonic())

    @unittest.skipUnless(shutil.which("ping") and os.geteuid() == 0,
                         "needs ping, which for others than root is a program of privilege")
    def test_ping_does_not_mix_the_kernels_time_with_its_own(self):
        process, outside = run(["ping", "-c", "5", "-i", "0.1", "127.0.0.1"], slowed(0.1))
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        times = [float(text) for text in re.findall(r"time=([\d.]+) ms", process.stdout)]
        self.assertEqual(len(times), 5, process.stdout)
        self.assertGreaterEqual(outside, (4 * 0.1 - 0.001) / 0.1)  # it waits in whole milliseconds of its own
        for one in times:  # mixed up, they would be those ten times, or the time since the origin
            self.assertLessEqual(one, outside / 5 * 0.1 * 1000)

    def test_cyclone_dds(self):
        with tempfile.TemporaryDirectory() as folder:
            settings = pathlib.Path(folder) / "cyclone.xml"
            settings.write_text(
                "<CycloneDDS><Domain><General><Interfaces><NetworkInterface address='127.0.0.1'/>"
                "</Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
                "<ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='127.0.0.1'/></Peers>"
                "</Discovery></Domain></CycloneDDS>", encoding="utf-8")
            environment = slowed(CYCLONEDDS_URI=f"file://{settings}")
            domain = str(some_domain(self))
            pong = subprocess.Popen(["ddsperf", "-i", domain, "-D", "60", "pong"], env=environment,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process, outside = run(["ddsperf", "-i", domain, "-D", "2", "ping", "100Hz"],
                                       environment)
            finally:
                pong.kill()
                pong.wait()
        counts = [int(text) for text in re.findall(r"cnt (\d+)$", process.stdout, re.MULTILINE)]
        self.assertTrue(counts, process.stdout + process.stderr)
        self.assertLessEqual(max(counts), 110, "100 in a second of its own")
        self.assertGreaterEqual(outside, 2 / FACTOR)

    def test_fast_dds(self):
        """A whole run, its controllers over DDS."""
        with tempfile.TemporaryDirectory() as folder:
            process, _ = run([BIN / "baraka", "run", ROOT / "config/scenarios/two_motes.yaml", "--until", "1", "--domain",
                              some_domain(self), "--out", pathlib.Path(folder) / "run"])
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)


if __name__ == "__main__":
    unittest.main()
