#!/usr/bin/env python3
"""Controllers in Python: equal to those in C++, and what goes wrong is said with file and line."""
import os
import shutil
import sys
import textwrap
import unittest

from baraka import BIN, ROOT, Case, Program

HERE = ROOT / "tests/e2e/python"
MANY_ROBOTS = ROOT / "config/scenarios/many_robots.yaml"
IN_PROCESS = ("--controllers", "in-process")
PATHS = {"BARAKA_CONTROLLER_PATH": f"{HERE}:{BIN.parent / 'tests'}"}
SCENARIO = """version: 1
name: own
seed: 1
radio: {{profile: ideal}}
agents:
  robots:
    name: r{{}}
    robot: {{include: {robot}}}
    poses: [{{x: 0 m, y: 0 m}}]
    controller: {{program: {program}{more}}}
end:
  - {{at: 1 s, result: done}}
"""


@unittest.skipUnless((BIN / "libbaraka_python.so").exists(), "needs a build with Python's headers and pybind11")
class Python(Case):
    def play(self, *arguments, status=0, **keywords):
        return self.run_baraka(*arguments, env=keywords.pop("env", PATHS), status=status, **keywords)

    def own(self, source, more="", name="own.py"):
        """A scenario whose controller is this text."""
        (self.folder / name).write_text(textwrap.dedent(source))
        file = self.folder / "own.yaml"
        file.write_text(SCENARIO.format(robot=ROOT / "config/robots/robertino.yaml", program=name, more=more))
        return file

    def own_paths(self):
        return {"BARAKA_CONTROLLER_PATH": str(self.folder)}

    def lines(self, words):
        return [line for line in (self.out / "run.log").read_text().splitlines() if words in line]


class Equal(Python):
    def test_help_robot_in_python_gives_the_fingerprint_of_the_one_in_c_plus_plus(self):
        for mode, until in (("in-process", 150), ("spawn", 30)):
            prints = [self.play(MANY_ROBOTS, "--controllers", mode, "--until", f"{until} s", "--set",
                                f"agents.robots.controller.program={program}", "--set",
                                "agents.motes.controller.overrides.0.parameters.help_at=1 s")["fingerprint"]
                      for program in ("help_robot", "help_robot.py")]
            self.assertEqual(*prints, mode)
            self.assertGreater(self.query("SELECT COUNT(DISTINCT state) FROM states WHERE state LIKE '%_%'")[0][0], 5)

    def test_every_call_gives_what_it_gives_in_c_plus_plus(self):
        logs = []
        for program, mode in (("every_call", "in-process"), ("every_call.py", "in-process"), ("every_call.py", "spawn")):
            self.play(HERE / "every_call.yaml", "--controllers", mode, *(
                word for group in ("robots", "motes") for word in ("--set", f"agents.{group}.controller.program={program}")))
            logs.append(self.lines("/controller:"))
        self.assertGreater(len(logs[0]), 2500)
        self.assertEqual(logs[0], logs[1])
        self.assertEqual(logs[0], logs[2])
        words = {line.split()[4] for line in logs[0]}
        for word in ("start parameters names channel body solid wheel step battery energy capacity reading place sent route drawn "
                     "neighbour drive infrared odometry scan imu bumped pose math receive timer notice stop error").split():
            self.assertIn(word, words)

    def test_several_agents_of_one_process_and_other_seeds(self):
        first, again, other = (self.play(HERE / "wrong_uses.yaml", *IN_PROCESS, "--seed", seed)["fingerprint"]
                               for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)


class Wrong(Python):
    def test_sixty_wrong_uses_raise_and_the_run_goes_on(self):
        for mode in ("in-process", "spawn"):
            self.play(HERE / "wrong_uses.yaml", "--controllers", mode)
            self.assertEqual(self.lines("WRONG"), [])
            self.assertEqual(len(self.lines("info r0/controller: right")), 80 + 3, mode)
            self.assertEqual(len(self.lines("right after the end")), 3)
            (ended,) = self.lines("right after the end: CallError")
            self.assertIn("the controller of this agent has ended", ended)
            (typed,) = self.lines("right 0: ")
            self.assertIn("TypeError: payload: must be bytes, not str", typed)
            (ranged,) = self.lines("right 8: ")
            self.assertIn("InvalidArgument: destination: 65536 is outside 0..65535", ranged)

    def test_an_exception_names_file_line_and_agent(self):
        for method in ("step", "start", "__init__"):
            source = f"""\
                import baraka

                class Own(baraka.Controller):
                    def {method}(self, *arguments):
                        self.divide()

                    def divide(self):
                        1 / 0
                """
            for mode in ("in-process", "spawn"):
                run = self.play(self.own(source), "--controllers", mode, status=1, env=self.own_paths())
                self.assertIn(f"{self.folder}/own.py:8: in divide(): ZeroDivisionError: division by zero", run.err, method)
                self.assertIn("r0", run.err)

    def test_a_process_that_was_killed_is_called_by_the_name_in_the_scenario(self):
        source = """\
            import os
            import baraka
            class Own(baraka.Controller):
                def step(self):
                    os.kill(os.getpid(), 9)
            """
        run = self.play(self.own(source), status=1, env=self.own_paths())
        self.assertRegex(run.err, r"own\.py \(pid [0-9]+\) killed by signal 9")
        self.assertNotIn("python3", run.err)

    def test_leaving_python_in_a_callback_ends_the_run(self):
        source = """\
            import sys
            import baraka
            class Own(baraka.Controller):
                def step(self):
                    sys.exit(3)
            """
        run = self.play(self.own(source), *IN_PROCESS, status=1, env=self.own_paths())
        self.assertIn("own.py:5: in step(): SystemExit: 3", run.err)

    def test_files_that_are_no_controller_are_said_before_the_run(self):
        head = "import baraka\nclass Own(baraka.Controller):\n    "
        for source, words in (
                ("x = (", "own.py:1: SyntaxError: '(' was never closed"),
                ("import nothing_there", "own.py:1: in <module>(): ModuleNotFoundError: No module named 'nothing_there'"),
                ("import baraka", "must have one class below baraka.Controller, or name one by `controller = …`; it has none"),
                (head + "pass\nclass Two(baraka.Controller): pass", "it has Own, Two"),
                ("raise SystemExit(2)", "own.py:1: in <module>(): SystemExit: 2"),
                (head + "channels = 'infrared'", "channels: must be a list of texts, not str"),
                (head + "channels = [5]", "channels[0]: must be a text (str), not int"),
                (head + "channels = ['nothing']", "channel 'nothing'"),
                (head + "runs_on = ['bird']", "runs_on: 'bird' is neither 'robot' nor 'mote'"),
                (head + "runs_on = []", "runs_on: names no kind of agent"),
                (head + "runs_on = ['mote']", "does not drive agents like r0"),
                (head + "parameters = {'speed': 5}", "parameters: speed: must be a baraka.Parameter"),
                (head + "parameters = []", "parameters: must be a dict"),
                (head + "parameters = {'a': baraka.Parameter(5, 'm', 'x')}", "parameters: a: low: must be a number, not str"),
                (head + "parameters = {'a': baraka.Parameter('x', names='bird')}", "names: 'bird' is none of agent"),
                (head + "records = {'x': 'm'}", "records: x: must be a list of texts, not str"),
                (head + "records = {'x': ('m', )}", "records: x: must be a unit and a meaning"),
                (head + "names = 1", "names: must be True or False, not int")):
            run = self.play(self.own(source), *IN_PROCESS, status=2, env=self.own_paths())
            self.assertIn(words, run.err)
            self.assertIn("own.yaml:10:", run.err)  # where the scenario names it

    def test_check_knows_parameters_states_and_contradictions(self):
        source = """\
            import baraka
            class Own(baraka.Controller):
                parameters = {"speed": baraka.Parameter(0.5, "m/s", 0, 2, "How fast."),
                              "least": baraka.Parameter(0.1, "m/s", 0, 2, "How slow.")}
                states = ["DRIVING"]
                def judge(parameters):
                    if parameters["least"] > parameters["speed"]:
                        return [baraka.Mistake("least", f"{parameters['least']} m/s is above `speed`")]
                def start(self):
                    self.agent.state("DRIVING")
            """
        for more, words in ((", parameters: {speed: 3 m/s}", "own.yaml:10:"),
                            (", parameters: {speed: 3 m/s}", "speed: 3 m/s is above the limit of 2 m/s"),
                            (", parameters: {sped: 1 m/s}", "did you mean 'speed'"),
                            (", parameters: {speed: 1 s}", "own.yaml:10:"),
                            (", parameters: {least: 1 m/s}", "least: 1.0 m/s is above `speed`")):
            run = self.play(self.own(source, more), *IN_PROCESS, status=2, env=self.own_paths())
            self.assertIn(words, run.err)
        scenario = self.own(source, ", parameters: {speed: 1 m/s}")
        self.play(scenario, *IN_PROCESS, env=self.own_paths())
        file = scenario.read_text().replace("{at: 1 s,", "{agent: r0, state: FLYING,")
        scenario.write_text(file)
        run = self.play(scenario, *IN_PROCESS, status=2, env=self.own_paths())
        self.assertIn("FLYING", run.err)

    def test_a_file_that_is_not_there_is_named_with_a_similar_one(self):
        scenario = self.own("import baraka\nclass Own(baraka.Controller): pass")
        scenario.write_text(scenario.read_text().replace("own.py", "owm.py"))
        run = self.play(scenario, *IN_PROCESS, status=2, env=self.own_paths())
        self.assertIn("did you mean 'own.py'", run.err)

    def test_list_asks_controllers_and_runs_no_other_file(self):
        self.own("""\
            import baraka
            class Own(baraka.Controller):
                parameters = {"speed": baraka.Parameter(0.5, "m/s", 0, 2, "How fast.")}
            """)
        (self.folder / "other.py").write_text(f"open('{self.folder}/ran', 'w')")
        program = Program("baraka", "list", "controllers", env=self.own_paths())
        self.addCleanup(program.clean_up)
        self.assertRegex(program.finish().out, r"own.py +for robots; parameters: speed")
        self.assertFalse((self.folder / "ran").exists())

    def test_new_controllers_do_what_their_scenario_expects_in_process_as_over_dds(self):
        for kind in ("robot", "mote"):
            made = Program("baraka", "new-controller", f"my_{kind}", "--python", f"--{kind}", "--to", self.folder)
            self.addCleanup(made.clean_up)
            self.assertEqual(made.finish().status, 0)
            folder = self.folder / f"my_{kind}"
            self.assertEqual(sorted(file.name for file in folder.iterdir()),
                             ["README.md", f"my_{kind}.py", "scenario.yaml", "test.sh"])
            test = Program(folder / "test.sh", BIN / "baraka", folder / "scenario.yaml",
                           env={"BARAKA_CONTROLLER_PATH": str(folder)})
            self.addCleanup(test.clean_up)
            done = test.finish()
            self.assertEqual(done.status, 0, str(done))

    def test_the_interpreter_is_debians_or_the_one_named_whatever_path_finds_first(self):
        """A version manager's python3 in front of it has other modules; a virtual environment has some more."""
        file = self.own("""\
            import baraka
            import sys
            class Own(baraka.Controller):
                def start(self):
                    self.agent.log("info", f"prefix {sys.prefix}, base {sys.base_prefix}")
                    self.agent.log("info", f"own module {'mine' if self.mine() else 'none'}")
                def mine(self):
                    try:
                        import only_in_the_environment
                        return True
                    except ModuleNotFoundError:
                        return False
            """)
        version = f"python{sys.version_info.major}.{sys.version_info.minor}"
        other = self.folder / "other"
        for folder in (other / "bin", other / "lib" / version / "lib-dynload"):
            folder.mkdir(parents=True)
        (other / "bin/python3").write_text("#!/bin/sh\nexit 1\n")
        (other / "bin/python3").chmod(0o755)
        (other / "lib" / version / "os.py").touch()
        environment = self.folder / "environment"
        packages = environment / "lib" / version / "site-packages"
        packages.mkdir(parents=True)
        (packages / "only_in_the_environment.py").touch()
        (environment / "bin").mkdir()
        (environment / "bin/python3").symlink_to("/usr/bin/python3")
        (environment / "pyvenv.cfg").write_text("home = /usr/bin\ninclude-system-site-packages = true\n")
        path = f"{other}/bin:{os.environ['PATH']}"
        for named, prefix, module in (({}, "/usr", "none"),
                                      ({"BARAKA_PYTHON": str(environment / "bin/python3")}, str(environment), "mine")):
            for mode in ("in-process", "spawn"):
                self.play(file, "--controllers", mode, env={**self.own_paths(), **named, "PATH": path})
                self.assertTrue(self.lines(f"prefix {prefix}, base /usr"), f"{mode} {named}")
                self.assertTrue(self.lines(f"own module {module}"), f"{mode} {named}")

    def test_without_the_package_it_is_named_before_the_run(self):
        file = self.own("import baraka\nclass Own(baraka.Controller): pass\n")
        (self.folder / "alone").mkdir()
        program = shutil.copy(BIN / "baraka", self.folder / "alone/baraka")
        for command in ("check", "run"):
            done = Program(program, command, file, env={**self.own_paths(), "BARAKA_CONFIG_PATH": str(ROOT / "config")})
            self.addCleanup(done.clean_up)
            done = done.finish()
            self.assertEqual(done.status, 2, str(done))
            self.assertIn("own.yaml:10:27: program: controllers in Python need libbaraka_python.so, of the package python3-baraka, "
                          "which is not there", done.err)

    def test_an_interpreter_that_is_not_there_is_named_before_the_run(self):
        file = self.own("import baraka\nclass Own(baraka.Controller): pass\n")
        paths = {**self.own_paths(), "BARAKA_PYTHON": "/nowhere/python3"}
        for mode in ("in-process", "spawn"):
            done = self.play(file, "--controllers", mode, env=paths, status=2)
            self.assertIn("own.yaml:10:27: program: BARAKA_PYTHON: '/nowhere/python3' is not the path of a program", done.err)

    def test_a_file_is_named_once_and_without_detours(self):
        self.own("x = (")
        (self.folder / "sub").mkdir()
        done = self.play(self.folder / "own.yaml", env={"BARAKA_CONTROLLER_PATH": f"{self.folder}/sub/.."}, status=2)
        self.assertIn(f"own.yaml:10:27: program: {self.folder}/own.py:1: SyntaxError: '(' was never closed", done.err)

    def test_run_by_hand(self):
        """As on a robot: python3 own.py, with the options of every controller."""
        self.own("""\
            import baraka
            class Own(baraka.Controller):
                parameters = {"speed": baraka.Parameter(0.5, "m/s", 0, 2, "How fast.")}
            if __name__ == "__main__":
                baraka.main(Own)
            """)
        (self.folder / "python3").symlink_to("/usr/bin/python3")
        env = {"PYTHONPATH": str(BIN / "python")}
        for arguments, status, words in ((["--help"], 0, "How fast."), ([], 2, "--agents"),
                                         (["--agents", "r0", "--wait", "1", "--domain", "66"], 1, "no server in DDS domain 66")):
            program = Program(self.folder / "python3", self.folder / "own.py", *arguments, env=env)
            self.addCleanup(program.clean_up)
            done = program.finish()
            self.assertEqual(done.status, status, str(done))
            self.assertIn(words, done.out + done.err)


del Python  # the base of the two

if __name__ == "__main__":
    os.environ.pop("PYTHONPATH", None)
    unittest.main()
