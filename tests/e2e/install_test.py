#!/usr/bin/env python3
"""The installed package, and controllers made with it by `baraka new-controller`."""
import contextlib
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from baraka import BIN, ROOT, Case, Finished, some_domain

TWO_MOTES = "share/baraka/scenarios/two_motes.yaml"


def clean_environment(**more):
    """That of a user who has never heard of the build tree."""
    kept = {key: os.environ[key] for key in ("PATH", "HOME", "TMPDIR") if key in os.environ}
    return {**kept, **{key: str(value) for key, value in more.items()}}


def finish(*command, env=None, cwd=None, timeout=300):
    done = subprocess.run([str(part) for part in command], env=clean_environment(**(env or {})), cwd=cwd,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=timeout)
    return Finished(done.returncode, done.stdout, done.stderr)


class Package(Case):
    """Installed once for all tests of this process, none of which writes there."""

    prefix = None

    @classmethod
    def setUpClass(cls):
        if Package.prefix is None:
            Package.prefix = pathlib.Path(tempfile.mkdtemp(prefix="baraka-prefix-"))
            unittest.addModuleCleanup(shutil.rmtree, Package.prefix)
            Package.installed = finish("cmake", "--install", BIN.parent, "--prefix", Package.prefix)

    def setUp(self):
        super().setUp()
        self.assertEqual(self.installed.status, 0, str(self.installed))

    def succeed(self, *command, **options):
        finished = finish(*command, **options)
        self.assertEqual(finished.status, 0, str(finished))
        return finished

    def baraka(self, *arguments, **options):
        return finish(self.prefix / "bin/baraka", *arguments, cwd=self.folder, **options)

    def files(self):
        return [path for path in self.prefix.rglob("*") if path.is_file()]


class Installed(Package):
    def test_runs_what_it_brings_along_without_the_tree(self):
        at_home = self.run_baraka(ROOT / "config/scenarios/two_motes.yaml")["fingerprint"]
        for controllers in ("spawn", "in-process"):
            away = self.baraka("run", self.prefix / TWO_MOTES, "--controllers", controllers)
            self.assertEqual(away.status, 0, str(away))
            self.assertEqual(away["fingerprint"], at_home)

    def test_brings_every_robot_radio_and_scenario_without_mistakes(self):
        scenarios = sorted((self.prefix / "share/baraka/scenarios").glob("*.yaml"))
        self.assertGreaterEqual(len(scenarios), 3)
        for scenario in scenarios:
            checked = self.baraka("check", scenario)
            self.assertEqual((checked.status, checked.err), (0, ""), scenario)
        self.assertFalse(list(self.prefix.rglob("invalid")))

    def test_has_the_same_folders_as_the_build_tree(self):
        installed = {path.name for path in (self.prefix / "share/baraka").iterdir() if path.is_dir()}
        built = {path.name for path in (BIN.parent / "share/baraka").iterdir()}
        self.assertEqual(installed, built)
        self.assertIn("tasks", built)

    def test_headers_are_those_a_controller_may_include(self):
        folders = {path.parent.relative_to(self.prefix).as_posix()
                   for path in self.files() if path.suffix == ".h"}
        self.assertEqual(folders, {"include/baraka/hal/api", "include/baraka/hal/types"})

    def test_brings_its_licence(self):
        self.assertEqual((self.prefix / "share/doc/baraka/LICENSE").read_text(),
                         (ROOT / "LICENSE").read_text())

    def test_no_file_knows_where_it_was_built(self):
        if "CMAKE_BUILD_TYPE:STRING=Release" not in (BIN.parent / "CMakeCache.txt").read_text():
            self.skipTest("debug information names the sources")
        files = self.files()
        self.assertGreater(len(files), 30)
        for path in files:
            content = path.read_bytes()
            for folder in (ROOT, BIN.parent, self.prefix):
                # A folder /baraka must not be found in ${_IMPORT_PREFIX}/lib/baraka/.
                name = os.fsencode(folder) + b"/"
                named = name in content and re.search(rb"(?<![\w}.-])" + re.escape(name), content)
                self.assertFalse(named, f"{path} names {folder}")

    def test_runs_from_wherever_it_is_moved_to(self):
        moved = self.folder / "moved"
        shutil.copytree(self.prefix, moved)
        self.succeed(moved / "bin/baraka", "run", moved / TWO_MOTES, cwd=self.folder)

    def test_an_older_and_a_newer_minor_version_are_not_taken_for_this_one(self):
        (self.folder / "CMakeLists.txt").write_text("""
            cmake_minimum_required(VERSION 3.25)
            project(x LANGUAGES CXX)
            foreach(version 0.0 0.2 1.0 0.1)
              find_package(baraka ${version} QUIET)
              message(STATUS "${version}: found ${baraka_FOUND}, to consider ${baraka_CONSIDERED_VERSIONS}")
            endforeach()
        """)
        said = self.succeed("cmake", "-G", "Ninja", "-B", self.folder / "build", "-S", self.folder,
                            f"-DCMAKE_PREFIX_PATH={self.prefix}").out
        found = re.findall(r"^-- (\S+): found ([01]), to consider 0\.1\.0$", said, re.M)
        self.assertEqual(found, [("0.0", "0"), ("0.2", "0"), ("1.0", "0"), ("0.1", "1")], said)


class Includes(Package):
    def check(self, include, **env):
        scenario = self.folder / "scenario.yaml"
        scenario.write_text((self.prefix / TWO_MOTES).read_text().replace("../robots/mote.yaml", include))
        return self.baraka("check", scenario, env=env)

    def test_robots_are_found_by_what_they_are_called_where_they_are_installed(self):
        self.assertEqual(self.check("robots/mote.yaml").status, 0)

    def test_one_beside_the_scenario_comes_first(self):
        (self.folder / "robots").mkdir()
        (self.folder / "robots/mote.yaml").write_text("version: 1\nmodel: broken\nsise: 1 m\n")
        self.assertRegex(self.check("robots/mote.yaml").err, str(self.folder / "robots/mote.yaml:3:1: "))

    def test_one_of_the_users_folders_comes_before_the_installed_one(self):
        mine = self.folder / "mine/robots"
        mine.mkdir(parents=True)
        (mine / "mote.yaml").write_text("version: 1\nmodel: broken\nsise: 1 m\n")
        finished = self.check("robots/mote.yaml", BARAKA_CONFIG_PATH=f"/nowhere:{mine.parent}")
        self.assertRegex(finished.err, str(mine / "mote.yaml:3:1: "))

    def test_one_that_is_nowhere_is_named(self):
        finished = self.check("robots/mole.yaml")
        self.assertEqual(finished.status, 2)
        self.assertRegex(finished.err, r"scenario.yaml:\d+:\d+: .*include: there is no file '.*robots/mole.yaml', "
                         rf"nor in the shared folders \(.*{re.escape(str(self.prefix))}/share/baraka\)")


class NewController(Package):
    def new(self, name, *options):
        made = self.baraka("new-controller", name, *options)
        self.assertEqual(made.status, 0, str(made))
        return self.folder / name

    def build(self, project):
        self.succeed("cmake", "-G", "Ninja", "-B", "build", f"-DCMAKE_PREFIX_PATH={self.prefix}", cwd=project)
        self.succeed("cmake", "--build", "build", cwd=project)

    def ctest(self, project):
        return finish("ctest", "--test-dir", "build", "--output-on-failure", cwd=project)

    def test_of_a_robot_builds_and_passes_its_own_test_which_can_fail(self):
        project = self.new("wall_finder")
        self.build(project)
        sections = self.succeed("readelf", "--section-headers", project / "build/wall_finder").out
        self.assertIn(".debug_info", sections, "a debugger finds its way in it")
        tested = self.ctest(project)
        self.assertEqual(tested.status, 0, str(tested))
        self.assertIn("100% tests passed, 0 tests failed out of 1", tested.out)

        scenario = project / "scenario.yaml"
        good = scenario.read_text()
        scenario.write_text(good.replace("{result: arrived}", "{result: lost}"))
        self.assertRegex(self.ctest(project).out, r"not met: .*scenario.yaml")
        scenario.write_text(good.replace("speed: 0.4 m/s", "speed: 4 m/s"))
        self.assertRegex(self.ctest(project).out, r"speed: 4 m/s is above the limit")

        scenario.write_text(good)
        source = project / "wall_finder.cpp"
        source.write_text("#include <chrono>\n" + source.read_text().replace(
            "speed_(parameters[\"speed\"])",
            "speed_(0.3 + 1e-12 * static_cast<double>("
            "std::chrono::steady_clock::now().time_since_epoch().count() % 1000000007))"))
        self.build(project)
        self.assertRegex(self.ctest(project).out, r"over DDS [0-9a-f]{16}: does it use a clock")

    def test_of_a_mote_builds_and_runs_against_simulator_and_daemon(self):
        project = self.new("echo", "--mote", "--to", self.folder)
        self.build(project)
        tested = self.ctest(project)
        self.assertEqual(tested.status, 0, str(tested))

        environment = {"BARAKA_CONTROLLER_PATH": project / "build"}
        server = [self.prefix / "bin/baraka", "run", project / "scenario.yaml", "--controllers",
                  "external", "--out", self.folder / "results"]
        with self.serving(*server, env=environment) as (process, domain):
            self.drives(project, "m*", domain)
            out, _ = process.communicate(timeout=60)
        self.assertIn("result: answered", out)
        self.answers_over_two_hops(self.folder / "results")
        self.answers_a_daemon(project)

    def answers_over_two_hops(self, results):
        """As the scenario's first lines say: each mote is in reach of the next one only."""
        self.assertEqual(self.query("SELECT x.name, y.name FROM links JOIN agents x ON x.agent = links.a "
                                    "JOIN agents y ON y.agent = links.b ORDER BY 1", results),
                         [("m0", "m1"), ("m1", "m2")])
        self.assertIn(("m2", "m0", 2), self.query(
            "SELECT x.name, y.name, d.transmissions FROM deliveries d JOIN agents x ON x.agent = d.sender "
            "JOIN agents y ON y.agent = d.receiver", results))

    def answers_a_daemon(self, project):
        """Two daemons on the loopback interface, each with the project's controller: one calls, the
        other answers, over UDP."""
        net = random.randrange(1, 255)
        with contextlib.ExitStack() as stack:
            daemons = [stack.enter_context(self.serving(
                self.prefix / "bin/baraka-agentd", self.agent_file(project, i, f"127.79.{net}.{i + 1}"),
                env={"BARAKA_CONTROLLER_PATH": project / "build"})) for i in range(2)]
            caller, listener = (stack.enter_context(self.under_way(
                project / "build" / project.name, "--agents", f"m{i}", "--domain", daemons[i][1]))
                for i in (0, 1))
            lines = []
            while not lines or "state ANSWERED" not in lines[-1]:
                lines.append(daemons[0][0].stderr.readline())
                self.assertTrue(lines[-1], f"no answer: {lines}")
            for process, _ in daemons:
                process.send_signal(signal.SIGTERM)
            for process in (caller, listener, *(daemon for daemon, _ in daemons)):
                process.communicate(timeout=20)
                self.assertEqual(process.returncode, 0, process.args)

    def agent_file(self, project, i, address):
        file = self.folder / f"m{i}.yaml"
        file.write_text(f"""version: 1
agent: {{name: m{i}, address: {i + 1}, kind: mote}}
radio: {{interface: lo, address: {address}, port: 7301}}
localisation: {{driver: static, pose: {{x: {i} m, y: 0 m}}}}
controller:
  program: {project.name}
  parameters: {{{"call_at: 3 s" if i == 0 else ""}}}
""")
        return file

    @contextlib.contextmanager
    def under_way(self, *command, env=None):
        process = subprocess.Popen([*map(str, command)], env=clean_environment(**(env or {})), text=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        try:
            yield process
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
            with contextlib.suppress(subprocess.TimeoutExpired, ValueError):
                process.communicate(timeout=20)
            process.kill()
            process.wait()

    @contextlib.contextmanager
    def serving(self, *command, env=None):
        """A server of agents under way that can be found: the simulator says so on standard error, the
        daemon on standard output. @return the process and its domain; it is ended afterwards."""
        domain = str(some_domain(self))
        with self.under_way(*command, "--domain", domain, env=env) as process:
            is_daemon = pathlib.Path(command[0]).name == "baraka-agentd"
            line = (process.stdout if is_daemon else process.stderr).readline()
            self.assertRegex(line, rf"domain:? {domain}\b")
            yield process, domain

    def drives(self, project, agents, domain):
        """The project's controller drives the agents of that domain until they are stopped."""
        return self.succeed(project / "build" / project.name, "--agents", agents, "--domain", domain,
                            timeout=60)

    def test_leaves_no_placeholder_in_what_it_writes(self):
        for kind in ("--robot", "--mote"):
            project = self.new("a_b2_c" + kind.strip("-"), kind)
            for path in project.iterdir():
                self.assertNotRegex(path.name + path.read_text(), r"@\w+@|\.in$", path)
            self.assertIn(f"class AB2C{kind.strip('-')} ", (project / f"{project.name}.cpp").read_text())
            self.assertTrue(os.access(project / "test.sh", os.X_OK))

    def test_from_a_model_is_what_is_shipped_and_passes_its_own_test(self):
        same = self.new("two_turtlebots", "--from", "two_turtlebots")
        shipped = ROOT / "controllers/two_turtlebots/two_turtlebots.cpp"
        self.assertEqual((same / "two_turtlebots.cpp").read_text(), shipped.read_text())
        scenario = (ROOT / "config/scenarios/two_turtlebots.yaml").read_text()
        self.assertEqual((same / "scenario.yaml").read_text(), scenario.replace("../robots/", "robots/"))

        project = self.new("my_pair", "--from", "two_turtlebots")
        self.assertIn("class MyPair ", (project / "my_pair.cpp").read_text())
        self.build(project)
        tested = self.ctest(project)
        self.assertEqual(tested.status, 0, str(tested))

    def test_a_project_of_an_earlier_template_builds_and_passes_its_own_test(self):
        """earlier_project is what `new-controller wall_finder` wrote at b0aa378d^, before the folders were moved: users keep
        such projects, so it is never brought up to date."""
        project = self.folder / "wall_finder"
        shutil.copytree(ROOT / "tests/e2e/earlier_project", project)
        self.build(project)
        tested = self.ctest(project)
        self.assertEqual(tested.status, 0, str(tested))

    def test_from_what_is_no_model_is_refused_and_so_is_a_model_for_a_mote(self):
        for options in (("--from", "two_turtles"), ("--from", "two_turtlebots", "--mote")):
            self.assertEqual(self.baraka("new-controller", "x", *options).status, 2)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_without_prefix_the_program_that_was_just_built_writes_one_too(self):
        self.succeed(BIN / "baraka", "new-controller", "fresh", cwd=self.folder)
        self.assertTrue((self.folder / "fresh/fresh.cpp").exists())

    def test_names_that_cannot_be_are_refused_and_nothing_is_written(self):
        for name in ("2nd", "a-b", "Robot", "a/b", "..", "", "a b", "ä", "test", "install", "baraka",
                     "x" * 65):
            made = self.baraka("new-controller", name)
            self.assertEqual(made.status, 2, f"{name}: {made}")
            self.assertRegex(made.err, re.escape(f"the name '{name}' ") if name else "NAME: is given nothing")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_folder_that_is_there_is_left_alone(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/thesis.tex").write_text("precious")
        made = self.baraka("new-controller", "mine")
        self.assertEqual(made.status, 2, str(made))
        self.assertRegex(made.err, "mine is there already")
        self.assertEqual(os.listdir(self.folder / "mine"), ["thesis.tex"])

    def test_both_kinds_at_once_is_a_usage_error(self):
        self.assertEqual(self.baraka("new-controller", "x", "--robot", "--mote").status, 2)


if __name__ == "__main__":
    unittest.main()
