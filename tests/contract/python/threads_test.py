#!/usr/bin/env python3
"""Environments, agents and the interpreter's lock in several threads and processes."""
import pathlib
import subprocess
import sys
import textwrap
import threading
import time
import unittest

import world

TWO = world.PROGRAMS / "wrong_uses.yaml"  # two robots of one process; r0 starts again after two seconds


def in_threads(*calls):
    """Runs the calls side by side; what they return, or the exception of each."""
    results = [None] * len(calls)

    def run(i, call):
        try:
            results[i] = call()
        except Exception as error:
            results[i] = error

    threads = [threading.Thread(target=run, args=one, daemon=True) for one in enumerate(calls)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(100)
        assert not thread.is_alive(), "a thread does not end"
    return results


class Threads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import baraka
        cls.baraka = baraka

    def environment(self, program="waits.py", **keywords):
        return self.baraka.Environment(TWO, "r1", lambda *_: 0, set=[f"agents.robots.controller.program={program}"], **keywords)

    def held(self, in_step):
        """An environment whose other robot's controller calls this in step()."""
        environment = self.environment()
        environment.reset(seed=1)
        sys.modules["waits"].Waits.in_step = in_step
        self.addCleanup(setattr, sys.modules["waits"].Waits, "in_step", lambda _: None)
        return environment

    def play(self, program, seed):
        environment = self.environment(program)
        environment.reset(seed=seed)
        while True:
            *_, truncated, info = environment.step([0.2, 0, 0.1])
            if truncated:
                return info["fingerprint"]

    def test_episodes_in_several_threads_are_those_of_one(self):
        for program in ("steady.py", "wanderer"):
            alone = [self.play(program, seed) for seed in range(4)]
            self.assertEqual(len(set(alone)), 4)
            self.assertEqual(in_threads(*(lambda seed=seed: self.play(program, seed) for seed in range(4))), alone)

    def test_controllers_of_a_file_that_several_threads_load_are_of_one_class(self):
        seen = set()
        in_threads(*(lambda: self.environment("all_calls.py") for _ in range(4)))
        sys.modules["all_calls"].AllCalls.in_step = lambda controller: seen.add(type(controller))
        self.assertEqual(len({self.play("all_calls.py", seed) for seed in range(3)}), 3)
        self.assertEqual(seen, {sys.modules["all_calls"].AllCalls})

    def test_another_thread_counts_while_a_step_waits(self):
        """The step ends when the other has counted on, which it cannot as long as the step keeps the interpreter's lock."""
        count, counted, go_on = 0, threading.Event(), threading.Event()
        environment = self.held(lambda _: counted.wait(60))

        def counting():
            nonlocal count
            go_on.wait(60)
            while count < 100_000:
                count += 1
            counted.set()

        def step():
            go_on.set()
            environment.step([0, 0, 0])
            return count

        self.assertEqual(in_threads(counting, step)[1], 100_000)

    def test_calls_that_take_long_let_others_run_whatever_the_controllers_are(self):
        """The lock changes hands only where a call gives it back, for nothing asks for it within ten minutes."""
        ticks, over = 0, False

        def tick():
            nonlocal ticks
            while not over:
                ticks += 1
                time.sleep(0)

        def calls():
            nonlocal over
            seen = []
            try:
                for call in (lambda: self.environment("wanderer"), lambda: one.reset(seed=1), *[lambda: one.step([0, 0, 0])] * 30):
                    before = ticks
                    made = call()
                    seen.append(ticks - before)
                    one = made if isinstance(made, self.baraka.Environment) else one
            finally:
                over = True
            return seen

        interval = sys.getswitchinterval()
        self.addCleanup(sys.setswitchinterval, interval)
        sys.setswitchinterval(600)
        made, reset, *steps = in_threads(calls, tick)[0]
        self.assertGreater(made, 0)
        self.assertGreater(reset, 0)
        self.assertGreater(sum(steps), 0)

    def test_an_environment_is_closed_from_another_thread_while_its_step_waits(self):
        is_in_step, go_on = threading.Event(), threading.Event()

        def wait(_):
            is_in_step.set()
            go_on.wait(60)

        environment = self.held(wait)

        def close():
            is_in_step.wait(60)
            threading.Timer(0.2, go_on.set).start()
            environment.close()
            return go_on.is_set()  # it waited until the run had ended

        stepped, closed = in_threads(lambda: environment.step([0, 0, 0]), close)
        self.assertIsInstance(stepped, RuntimeError)
        self.assertIn("the episode has been closed", str(stepped))
        self.assertTrue(closed)
        with self.assertRaisesRegex(RuntimeError, "reset"):
            environment.step([0, 0, 0])
        environment.close()
        environment.reset(seed=2)
        environment.step([0, 0, 0])

    def test_two_threads_that_drive_one_environment_are_told(self):
        is_in_step, go_on = threading.Event(), threading.Event()

        def wait(_):
            is_in_step.set()
            go_on.wait(60)

        environment = self.held(wait)

        def second():
            is_in_step.wait(60)
            try:
                environment.step([0, 0, 0])
            finally:
                go_on.set()

        first, refused = in_threads(lambda: environment.step([0, 0, 0]), second)
        self.assertEqual(len(first), 5)
        self.assertIsInstance(refused, RuntimeError)
        self.assertIn("another thread drives the episode", str(refused))
        environment.step([0, 0, 0])

    def test_closing_many_at_any_time_from_two_threads_each(self):
        for i in range(20):
            environment = self.environment("steady.py" if i % 2 else "wanderer")
            environment.reset(seed=i)

            def drive(environment=environment):
                while True:
                    environment.step([0.1, 0, 0])

            def close(environment=environment, i=i):
                time.sleep(0.001 * i)
                environment.close()

            driven, *closed = in_threads(drive, close, close)
            self.assertIsInstance(driven, RuntimeError)
            self.assertEqual(closed, [None, None])

    def test_an_agent_whose_controller_ends_while_another_thread_reads_the_argument_of_a_call(self):
        kept, ended, is_read = [], threading.Event(), threading.Event()

        class Slow:
            def __index__(self):
                is_read.set()
                ended.wait(60)
                return 1

            def __float__(self):
                return float(self.__index__())

        environment = self.held(lambda controller: kept.append(controller.agent))
        environment.step([0, 0, 0])
        agent = kept[0]
        for call in (lambda: agent.relative_position(Slow()), lambda: agent.name_of(Slow()), lambda: agent.send(Slow(), "t", b""),
                     lambda: agent.set_body_velocity(Slow()), lambda: agent.set_wheel_speeds([Slow(), 1, 1]),
                     lambda: agent.set_timer(1, Slow()), lambda: agent.record("x", Slow()),
                     lambda: agent.network().routes("t", Slow()), lambda: agent.network().invalidate("t", Slow())):
            ended.clear()
            is_read.clear()
            kept.clear()
            environment.reset(seed=1)
            environment.step([0, 0, 0])
            agent = kept[0]

            def end():
                is_read.wait(60)
                environment.close()
                ended.set()

            called, _ = in_threads(call, end)
            self.assertIsInstance(called, self.baraka.CallError, str(called))
            self.assertIn("has ended", str(called))

    def test_lists_that_change_while_they_are_read(self):
        values, raised = [], []

        class Clears:
            def __float__(self):
                values.clear()
                return 1.0

        class Route(self.baraka.Route):
            @property
            def topic(self):
                values.clear()
                return "t"

        def use(controller):
            agent, baraka = controller.agent, self.baraka
            for call in (lambda: agent.set_wheel_speeds(values), lambda: baraka.draw_route(values, baraka.PathMetric(), 2, agent.random())):
                make = Clears if not raised else lambda: Route("t", 2, 2, 1, 0.1, 10.0, 0.1)
                values[:] = [make() for _ in range(3)]
                raised.append(call())

        environment = self.held(use)
        environment.step([0, 0, 0])
        self.assertIsNone(raised[0])
        self.assertIn(raised[1], (0, 1, 2))

    def child(self, source, *, status=0):
        """Another Python, that imports this suite's package."""
        head = f"import os, sys, threading\nsys.path.insert(0, {str(world.HERE)!r})\nimport world, baraka\n" \
               f"def make(program='steady.py'):\n" \
               f"    one = baraka.Environment({str(TWO)!r}, 'r1', lambda *_: 0, set=['agents.robots.controller.program=' + program])\n" \
               f"    one.reset(seed=1)\n    one.step([0, 0, 0])\n    return one\n"
        done = subprocess.run([sys.executable, "-c", head + textwrap.dedent(source)], capture_output=True, text=True, timeout=100,
                              check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_python_ends_while_episodes_are_under_way(self):
        for source in ("kept = make()", "baraka.kept = make()", "kept = make('wanderer')", "kept = [make(), make(), make('wanderer')]",
                       "kept = make()\nraise SystemExit(0)"):
            done = self.child(source)
            self.assertNotIn("FATAL", done.stderr)

    def test_a_forked_process_neither_waits_for_the_episode_nor_drives_it(self):
        self.child("""\
            kept = make()
            child = os.fork()
            if child == 0:
                try:
                    kept.step([0, 0, 0])
                except RuntimeError as error:
                    assert "forked" in str(error), error
                else:
                    os._exit(3)
                kept.reset(seed=1)
                kept.step([0, 0, 0])
                kept.close()
                os._exit(0)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
            kept.step([0, 0, 0])
            """)

    @unittest.skipUnless(world.SANITIZED, "a build with the address sanitizer")
    def test_the_sanitizers_watch_the_modules(self):
        """So that the suites can fail: the modules were compiled with them, and what they see ends the process."""
        import ctypes
        for name in ("_hal", "_process", "_simulator"):
            (file, ) = (world.BIN / "python/baraka").glob(f"{name}*.so")
            self.assertIn(b"__asan_report_load8", file.read_bytes())
        self.assertIn("libasan", pathlib.Path("/proc/self/maps").read_text())
        self.assertIn(b"__asan_report_load8", (world.BIN / "libbaraka_python.so").read_bytes())
        self.assertTrue(ctypes.CDLL(None)["__asan_init"])
        done = self.child("""\
            import ctypes
            libc = ctypes.CDLL(None)
            libc.malloc.restype = ctypes.c_void_p
            ctypes.memset(libc.malloc(8), 0, 9)
            """, status=1)
        self.assertIn("heap-buffer-overflow", done.stderr)


if __name__ == "__main__":
    world.main()
