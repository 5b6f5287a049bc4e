#!/usr/bin/env python3
"""Runs with programs in lock-step that are interfered with: events of the scenario, stopped programs, debuggers, breakpoints of the
view, commands of others. What waits meanwhile changes nothing."""
import contextlib
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from baraka import BIN, ROOT, Program, send, wait_for
from lockstep_test import ECHO_IN_C, PYTHON, REFUSED, Held, scenario
from view_live_test import Page

GDB = shutil.which("gdb")
QUIET = "handle SIGSYS SIG63 nostop noprint pass"
CLOCK = ("clock", ["sh", "-c", "while sleep 0.1; do date +%s; done"], "")
PINGS = ("ping", ["ping", "-q", "-i", "0.1", "a"], "")


@unittest.skipIf(REFUSED, REFUSED)
class Events(Held):
    SCENARIO = """
version: 1
name: events
seed: 1
radio: {{profile: ieee80211b}}
agents:
  motes:
    name: m{{}}
    mote: {{include: {root}/config/robots/mote.yaml}}
    poses: [{{x: 0 m, y: 0 m}}, {{x: 20 m, y: 0 m}}, {{x: 40 m, y: 0 m}}]
    controller: {controller}
    network: {{}}
    programs:
      - {{name: loop, command: [sh, -c, "while :; do timeout -s KILL 1 ping -D -i 0.1 m0; date +%s.%N; done"]}}
events:
  - {{at: 2 s, do: [{{kill: m1}}, {{restart: m2}}]}}
  - {{at: 4 s, do: [{{restart: m1}}]}}
  - {{at: 5 s, do: [{{switch_off: m2}}, {{jam: {{position: [10 m, 5 m], power: 100 mW, duration: 1 s}}}}]}}
  - {{at: 7 s, do: [{{switch_on: m2}}, {{move: m1, to: [0 m, 30 m], yaw: 90 deg}}]}}
end:
  - {{at: 11 s, result: done}}
"""
    CONTROLLER = ("{program: gap_mote, parameters: {sink: m0, report_every: 200 ms, sign_every: 500 ms, patience: 2 s, "
                  "call_every: 1 s}}")

    def test_events_happen_to_agents_with_programs_as_to_others(self):
        file = self.folder / "events.yaml"
        file.write_text(self.SCENARIO.format(root=ROOT, controller=self.CONTROLLER), encoding="utf-8")
        first = self.run_held(file, "--controllers", "in-process")
        self.assertEqual(first["result"], "done")
        done = self.query("SELECT at_ns, action, name FROM events LEFT JOIN agents USING (agent) ORDER BY 1, 2, 3")
        self.assertEqual([(at // 10 ** 9, action, name) for at, action, name in done if action != "jam"],
                         [(2, "kill", "m1"), (2, "restart", "m2"), (4, "restart", "m1"), (5, "switch_off", "m2"), (7, "move", "m1"),
                          (7, "switch_on", "m2")])
        off = [line for line in self.log("m2", "loop").splitlines() if "bytes from" in line]
        at = [float(line[1:line.index("]")]) - 1767225600 for line in off]
        self.assertEqual([one for one in at if 5.1 < one < 7], [], "its radio is off")
        self.assertTrue(any(one > 7 for one in at), "it is on again")
        logs = [self.log(agent, "loop") for agent in ("m0", "m1", "m2")]
        for arguments in (["--controllers", "in-process"], []):
            again = self.run_held(file, *arguments)
            self.assertEqual((again["fingerprint"], again["frames_digest"]), (first["fingerprint"], first["frames_digest"]))
            self.assertEqual([self.log(agent, "loop") for agent in ("m0", "m1", "m2")], logs)


# A thread waits without a time limit, as those of DDS do; who is told to end wakes it and joins it.
ENDS_ORDERLY = """
import signal, threading
told, woken = threading.Event(), threading.Event()
def wait():
    told.wait()
    print('woken', flush=True)
thread = threading.Thread(target=wait)
thread.start()
signal.signal(signal.SIGTERM, lambda *_: told.set())
signal.pause()
thread.join()
print('ended', flush=True)
"""


# Takes half a second, and sends more than the interface takes at once; nobody answers.
ENDS_SLOWLY = """
import signal, socket, time
signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
signal.sigwait({signal.SIGTERM})
print(time.clock_gettime_ns(time.CLOCK_MONOTONIC), flush=True)
time.sleep(0.5)
print(time.clock_gettime_ns(time.CLOCK_MONOTONIC), flush=True)
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
s.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
print(sum(s.sendto(bytes(1000), ('10.77.255.255', 5000)) for _ in range(3000)), flush=True)
print(time.clock_gettime_ns(time.CLOCK_MONOTONIC), flush=True)
"""
# Sends as fast as the interface takes it, to whom is there and to nobody's address, until it is told to end.
ENDS_SENDING = """
import signal, socket, sys
signal.signal(signal.SIGTERM, lambda *_: sys.exit(print('told')))
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
while True:
    try: s.sendto(bytes(1000), (sys.argv[1], 5000))
    except OSError: pass
"""
ENDS_NEVER = """
import signal, time
signal.signal(signal.SIGTERM, signal.SIG_IGN)
for second in range(100):
    print(second, flush=True)
    time.sleep(1)
"""


@unittest.skipIf(REFUSED, REFUSED)
class Ended(Held):
    def test_threads_that_wake_each_other_after_the_end_do(self):
        agents = {"a": [("orderly", ["/usr/bin/python3", "-c", ENDS_ORDERLY], "")]}
        self.run_held(scenario(self.folder, agents), "--set", "end.0.at=2 s")
        self.assertEqual(self.log("a", "orderly").split(), ["woken", "ended"])

    def test_so_they_do_when_the_run_has_failed(self):
        agents = {"a": [("orderly", ["/usr/bin/python3", "-c", ENDS_ORDERLY], ""), ("fail", ["sh", "-c", "sleep 1; exit 3"], ", on_exit: end")]}
        self.run_held(scenario(self.folder, agents), status=1)
        self.assertEqual(self.log("a", "orderly").split(), ["woken", "ended"])

    def test_so_they_do_when_the_run_is_interrupted(self):
        agents = {"a": [("orderly", [PYTHON, "-c", ENDS_ORDERLY], ""), ("busy", ["sh", "-c", "while sleep 0.001; do :; done"], "")]}
        run = self.start(scenario(self.folder, agents), "--pace", "lockstep", "--no-inspect", "--set", "end.0.at=10 h")
        wait_for(lambda: (self.out / "a.busy.log").exists())
        time.sleep(1)
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.finish().status, 130)
        self.assertEqual(self.log("a", "orderly").split(), ["woken", "ended"])

    def test_programs_end_in_virtual_time_which_is_not_the_runs(self):
        agents = {"a": [("slow", [PYTHON, "-c", ENDS_SLOWLY], ""), ("never", [PYTHON, "-c", ENDS_NEVER], "")],
                  "b": [("slow", [PYTHON, "-c", ENDS_SLOWLY], "")]}
        finished = self.run_held(scenario(self.folder, agents), "--set", "end.0.at=2 s")
        self.assertEqual(float(finished["simulated_s"]), 2)
        for agent in agents:
            self.assertEqual(self.log(agent, "slow").split(), ["1002000000000", "1002500000000", "3000000", "1002790000000"],
                             "100 frames are taken at once, and 29 times 100 later")
        self.assertEqual(self.log("a", "never").split(), [str(second) for second in range(12)], "killed after 10 s")
        self.assertEqual(self.query("SELECT count(*) FROM programs WHERE ended_ns IS NOT NULL"), [(0,)])

    def test_programs_that_send_all_the_time_end_before_they_are_killed(self):
        agents = {agent: [("flood", [PYTHON, "-c", ENDS_SENDING, to], "")] for agent, to in (("a", "b"), ("b", "10.77.0.9"))}
        finished = self.run_held(scenario(self.folder, agents), "--set", "end.0.at=100 ms")
        self.assertEqual([self.log(agent, "flood") for agent in agents], ["told\n"] * 2)
        self.assertNotIn("too much wall time", finished.err)

    def test_a_program_with_fast_dds_ends_before_it_is_killed(self):
        load = BIN.parent / "tests/fastdds_load"
        agents = {"a": [("load", [load, "--publish", "t", "--for", "60"], "")]}
        self.run_held(scenario(self.folder, agents), "--set", "end.0.at=2 s")
        self.assertIn("written: ", self.log("a", "load"))


@unittest.skipIf(REFUSED, REFUSED)
class Stopped(Held):
    def test_a_program_that_is_stopped_by_a_signal_does_not_stop_the_others(self):
        code = ("(while sleep 0.1; do echo tick; done) & sleep 1.05; kill -STOP $!; echo stopped; sleep 5; kill -CONT $!; echo on; "
                "sleep 0.25; kill -KILL $!; (sleep 1; kill -CONT $$; echo other) & kill -STOP $$; date +%s; echo end")
        agents = {"a": [("shell", ["bash", "-c", code], ", on_exit: end")]}
        self.run_held(scenario(self.folder, agents))
        said = self.log("a", "shell").split()
        self.assertEqual(said[:12], ["tick"] * 10 + ["stopped", "on"])
        ticks = said[12:said.index("other")]
        self.assertEqual(ticks, ["tick"] * len(ticks))
        self.assertIn(len(ticks), (2, 3))
        self.assertIn("1767225607", said)
        self.assertEqual(said[-1], "end")


class Watched(Held):
    """A run that would go on for long, or not."""

    def begin(self, agents, *arguments, end="100 h"):
        self.file = scenario(self.folder, agents)
        run = self.start(self.file, "--pace", "lockstep", "--no-inspect", "--set", f"end.0.at={end}", *arguments)
        self.addCleanup(run.clean_up)
        return run

    def length(self, agent="a", program="clock"):
        log = self.out / f"{agent}.{program}.log"
        return log.stat().st_size if log.exists() else 0

    def grows(self, **what):
        before = self.length(**what)
        wait_for(lambda: self.length(**what) > before)

    def process(self, words):
        """Of a program of this run, as this computer numbers it."""
        def found():
            for folder in pathlib.Path("/proc").glob("[0-9]*"):
                with contextlib.suppress(OSError):
                    if (folder / "cmdline").read_bytes().split(b"\0")[:-1] == [str(word).encode() for word in words]:
                        return int(folder.name)
            return None
        return wait_for(found)


@unittest.skipIf(REFUSED, REFUSED)
@unittest.skipUnless(GDB, "needs gdb")
class Debugged(Watched):
    """gdb stands outside: inside it would itself be a program that is held."""

    def gdb(self, pid, *commands):
        words = [GDB, "-nx", "-batch", "-ex", QUIET, "-p", pid]
        for command in commands:
            words += ["-ex", command]
        process = subprocess.Popen([*map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True)
        self.addCleanup(process.kill)
        return process

    def echo(self, mark, times=300):
        return {"a": [("ask", [ECHO_IN_C, "10.77.0.2", times], ", on_exit: end"), CLOCK], "b": [
            ("answer", [ECHO_IN_C, mark], ""), CLOCK]}

    def test_it_stops_the_world_and_changes_nothing(self):
        mark = self.folder.name  # makes its command line unlike others
        go = self.folder / "go"
        expected = self.begin(self.echo(mark), end="60 s").finish()
        self.assertEqual(expected["result"], "ask")
        # Paused until gdb is there, for such a run takes less than a second.
        run = self.begin(self.echo(mark), "--view", "--no-open", "--paused", "--max-speed", "1e9", end="60 s")
        page = Page(next(line.split()[1] for line in run.process.stderr if line.startswith("view: ")))
        page.post("break", on="time", at=1_000_000_000)
        page.post("resume")
        page.until(lambda now: now["paused"] and now["now"] > 0)
        gdb = self.gdb(self.process([ECHO_IN_C, mark]), "shell touch " + str(self.folder / "there"),
                       f"shell while [ ! -e {go} ]; do sleep 0.1; done", "detach")
        wait_for((self.folder / "there").exists)
        page.post("resume")
        log = self.out / "run.log"
        wait_for(lambda: "b: lockstep_echo is stopped by gdb (process " in log.read_text(encoding="utf-8"))
        self.assertIn("virtual time stands until it goes on", log.read_text(encoding="utf-8"))
        before = [self.length(agent) for agent in "ab"], page.now()["now"]
        time.sleep(1)
        self.assertEqual(([self.length(agent) for agent in "ab"], page.now()["now"]), before)
        go.touch()
        self.assertEqual(gdb.wait(60), 0)
        finished = run.finish()
        self.assertEqual(finished["result"], "ask")
        self.assertEqual((finished["fingerprint"], finished["frames_digest"]), (expected["fingerprint"], expected["frames_digest"]))
        self.assertNotIn("without waiting", log.read_text(encoding="utf-8"))

    def test_breakpoints_in_programs(self):
        mark = self.folder.name
        run = self.begin(self.echo(mark, times=10 ** 6))
        self.grows()
        gdb = self.gdb(self.process([ECHO_IN_C, mark]), "break sendto", *["continue"] * 5, "backtrace", "delete", "detach")
        said = gdb.communicate(timeout=60)[0]
        self.assertGreaterEqual(said.count("Breakpoint 1."), 5, said)
        self.grows()
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish()["result"], "interrupted")


@unittest.skipIf(REFUSED, REFUSED)
class Paused(Watched):
    AGENTS = {"a": [CLOCK], "b": [PINGS, CLOCK]}

    def test_breakpoints_of_the_view_and_commands_of_others(self):
        expected = self.begin(self.AGENTS, end="9 s").finish()
        run = self.begin(self.AGENTS, "--view", "--no-open", "--paused", "--max-speed", "1e9", end="9 s")
        page = Page(next(line.split()[1] for line in run.process.stderr if line.startswith("view: ")))
        self.assertTrue(page.now()["paused"])
        page.post("break", on="time", at=3_000_000_000)
        page.post("resume")
        now = page.until(lambda now: now["paused"])
        self.assertTrue(3_000_000_000 - 1 <= now["now"] < 3_200_000_000, now)  # up to the next instant
        before = [self.length(agent) for agent in "ab"]
        page.post("step", count=5, of="frame")
        now = page.until(lambda now: now["paused"] and now["now"] > 3_000_000_000)
        self.assertLess(now["now"], 4_000_000_000)
        page.post("resume")
        wait_for(lambda: page.now()["ended"])
        self.assertGreater([self.length(agent) for agent in "ab"], before)
        finished = run.finish()
        self.assertEqual((finished["fingerprint"], finished["frames_digest"]), (expected["fingerprint"], expected["frames_digest"]))

    def test_a_command_waits_while_the_run_is_paused(self):
        run = self.begin(self.AGENTS, "--view", "--no-open", "--paused", "--max-speed", "1e9")
        page = Page(next(line.split()[1] for line in run.process.stderr if line.startswith("view: ")))
        command = Program("baraka", "exec", "--run", self.out, "a", "--", "sh", "-c", "sleep 1; echo done")
        self.addCleanup(command.clean_up)
        page.post("step", count=1, of="frame")
        page.until(lambda now: now["paused"] and now["now"] > 0)
        self.assertIsNone(command.process.poll())
        page.post("resume")
        self.assertEqual(command.finish().out, "done\n")
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish()["result"], "interrupted")

    def test_a_command_that_is_killed_leaves_the_run_as_it_is(self):
        run = self.begin(self.AGENTS)
        self.grows()
        for name in ("SIGTERM", "SIGKILL"):
            begun = self.folder / name
            command = subprocess.Popen([BIN / "baraka", "exec", "--run", self.out, "b", "--", "sh", "-c",
                                        f"while sleep 0.1; do echo >> {begun}; done"], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder)
            self.addCleanup(command.kill)
            wait_for(begun.exists)
            send(command.pid, name)
            command.wait(60)
            self.grows()
            self.grows(agent="b")
        send(run.process.pid, "SIGINT")
        self.assertEqual(run.finish()["result"], "interrupted")


if __name__ == "__main__":
    unittest.main()
