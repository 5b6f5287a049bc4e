#!/usr/bin/env python3
"""The Debian packages that `./setup packages` builds. What a root with nothing else makes of them is
shown by new_user.sh and new_user_python.sh. Without dpkg-dev and file it is skipped (status 77)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from baraka import BIN, ROOT, Case, Finished

SITE = BIN.parent / "site"
SITE_WAS_BUILT = (SITE / "index.html").exists()
SDF_WAS_BUILT = (BIN / "baraka-sdf").exists()
PYTHON_WAS_BUILT = (BIN / "libbaraka_python.so").exists()
MODULES = "/usr/lib/python3/dist-packages/baraka"
PACKAGES = ("baraka", "libbaraka-dev", "baraka-agentd", *(["baraka-doc"] if SITE_WAS_BUILT else []),
            *(["baraka-sdf"] if SDF_WAS_BUILT else []), *(["python3-baraka"] if PYTHON_WAS_BUILT else []))


def output(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True,
                          **options).stdout


class Packages(Case):
    """Built and unpacked once."""

    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="baraka-packages-"))
        cls.addClassCleanup(shutil.rmtree, folder)
        output("cpack", "--config", BIN.parent / "CPackConfig.cmake", "-D",
               f"CPACK_OUTPUT_FILE_PREFIX={folder}", cwd=folder)
        cls.debs = {deb.name.split("_")[0]: deb for deb in folder.glob("*.deb")}
        cls.root = folder / "root"
        cls.files = {}
        for name, deb in cls.debs.items():
            output("dpkg-deb", "-x", deb, cls.root)
            cls.files[name] = {line.split(maxsplit=5)[5][1:]
                               for line in output("dpkg-deb", "-c", deb).splitlines()}

    def field(self, package, name):
        return output("dpkg-deb", "-f", self.debs[package], name).strip()

    def baraka(self, *arguments, **more):
        environment = {key: os.environ[key] for key in ("PATH", "HOME") if key in os.environ} | more
        done = subprocess.run([self.root / "usr/bin/baraka", *map(str, arguments)], env=environment,
                              cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=300)
        return Finished(done.returncode, done.stdout, done.stderr)

    def test_are_all_there_with_nothing_twice(self):
        self.assertEqual(sorted(self.debs), sorted(PACKAGES))
        files = [path for of_one in self.files.values() for path in of_one if not path.endswith("/")]
        self.assertEqual(len(files), len(set(files)))

    def test_hold_what_a_user_needs_each_in_its_place(self):
        for package, pattern in (
                ("baraka", "bin/baraka"), ("baraka", "bin/help_robot"),
                ("baraka", "bin/baraka-topics-cyclonedds"), ("baraka", "bin/baraka-topics-fastdds"), ("baraka", "lib/baraka/help_robot.so"),
                ("baraka", "lib/baraka/baraka-holder"), ("baraka", "lib/baraka/libbaraka_dilate.so"),
                ("baraka", "share/baraka/scenarios/case_study.yaml"), ("baraka", "share/baraka/robots/mote.yaml"),
                ("baraka", "share/baraka/radios/ieee80211b.yaml"), ("baraka", "share/baraka/hardware/robotino.yaml"),
                ("baraka", "share/baraka/idl/inspect.idl"), ("baraka", "share/baraka/idl/exchange.idl"),
                ("baraka", "share/baraka/templates/any/CMakeLists.txt.in"), ("baraka", "share/doc/baraka/README.md"),
                ("libbaraka-dev", "lib/baraka/libgateway_exchange.a"), ("libbaraka-dev", "include/baraka/hal/api/robot.h"),
                ("libbaraka-dev", "lib/cmake/baraka/barakaConfig.cmake"),
                ("baraka", "share/man/man1/baraka-run.1.gz"), ("baraka", "share/bash-completion/completions/baraka"),
                ("baraka-agentd", "share/man/man1/baraka-agentd.1.gz"),
                ("baraka-agentd", "share/bash-completion/completions/baraka-agentd"),
                ("baraka-agentd", "bin/baraka-agentd"),
                ("baraka-agentd", "lib/systemd/system/baraka-agentd@.service"),
                ("baraka-agentd", "lib/sysusers.d/baraka.conf")):
            self.assertIn(f"/usr/{pattern}", self.files[package])
        for page in (ROOT / "docs").glob("*.md"):
            self.assertIn(f"/usr/share/doc/baraka/docs/{page.name}", self.files["baraka"])
        for package in PACKAGES:
            self.assertIn(f"/usr/share/doc/{package}/copyright", self.files[package])
        page_was_built = (BIN / "report_page.html").exists()
        self.assertEqual("/usr/share/baraka/report_page.html" in self.files["baraka"], page_was_built)

    @unittest.skipUnless(SITE_WAS_BUILT, "./setup docs builds the site")
    def test_the_site_is_a_package_for_every_architecture(self):
        self.assertEqual(self.field("baraka-doc", "Architecture"), "all")
        self.assertEqual(self.field("baraka-doc", "Depends"), "")
        built = {str(path.relative_to(SITE)) for path in SITE.rglob("*") if path.is_file()}
        html = "/usr/share/doc/baraka-doc/html/"
        packed = {path.removeprefix(html) for path in self.files["baraka-doc"] if path.startswith(html) and not path.endswith("/")}
        self.assertEqual(packed, built)

    def test_depend_on_the_libraries_their_programs_were_linked_with(self):
        for package, library in (("baraka", "libode"), ("baraka", "libfastrtps"), ("baraka", "libddsc"),
                                 ("baraka-agentd", "libfastrtps"), ("baraka-agentd", "libcpp-httplib")):
            self.assertRegex(self.field(package, "Depends"), rf"\b{library}\S* \(>= [0-9]")
        self.assertNotIn("libode", self.field("baraka-agentd", "Depends"))
        version = self.field("baraka", "Version")
        for package in ("libbaraka-dev", "baraka-agentd"):
            self.assertEqual(self.field(package, "Version"), version)
            self.assertIn(f"baraka (= {version})", self.field(package, "Depends"))

    @unittest.skipUnless(SDF_WAS_BUILT, "needs libsdformat-dev, libassimp-dev and libtinyxml2-dev")
    def test_what_reads_urdf_and_sdf_is_a_package_of_its_own(self):
        self.assertIn("/usr/bin/baraka-sdf", self.files["baraka-sdf"])
        for library in ("libsdformat12", "libassimp5", "libtinyxml2"):
            self.assertRegex(self.field("baraka-sdf", "Depends"), rf"\b{library}")
            self.assertNotIn(library, self.field("baraka", "Depends"))

    @unittest.skipUnless(PYTHON_WAS_BUILT, "needs python3-dev, python3-numpy and pybind11-dev")
    def test_python_is_a_package_of_its_own_for_the_interpreter_it_was_built_with(self):
        sources = {path.name for path in (ROOT / "python/baraka").glob("*.py")}
        self.assertLessEqual({"__init__.py", "controller.py", "analysis.py", "environment.py"}, sources)
        expected = {f"{MODULES}/{name}" for name in sources | {"_hal.so", "_process.so", "_simulator.so"}}
        self.assertEqual({path for path in self.files["python3-baraka"] if path.startswith(f"{MODULES}/") and not path.endswith("/")},
                         expected)
        self.assertIn("/usr/lib/baraka/libbaraka_python.so", self.files["python3-baraka"])
        depends = self.field("python3-baraka", "Depends").split(", ")
        for one in (f"baraka (= {self.field('baraka', 'Version')})", "python3 (>= 3.11)", "python3 (<< 3.12)", "python3-numpy"):
            self.assertIn(one, depends)
        self.assertTrue(any(one.startswith("libpython3.11 (>=") for one in depends), depends)
        self.assertEqual(self.field("python3-baraka", "Recommends"), "python3-pandas, python3-matplotlib")
        self.assertNotIn("python", self.field("baraka", "Depends"))
        control = output("dpkg-deb", "--ctrl-tarfile", self.debs["python3-baraka"], encoding="latin-1")
        for script in ("postinst", "prerm"):  # byte code comes and goes with the package
            self.assertIn(f"./{script}", control)

    @unittest.skipUnless(PYTHON_WAS_BUILT, "needs python3-dev, python3-numpy and pybind11-dev")
    def test_a_controller_in_python_runs_from_the_packages(self):
        self.addCleanup(shutil.rmtree, self.folder / "my_robot", ignore_errors=True)
        made = self.baraka("new-controller", "my_robot", "--python")
        self.assertEqual(made.status, 0, str(made))
        fingerprints = set()
        for how in ("in-process", "spawn"):
            ran = self.baraka("run", "my_robot/scenario.yaml", "--controllers", how, "--out", self.folder / how,
                              BARAKA_CONTROLLER_PATH=str(self.folder / "my_robot"))
            self.assertEqual((ran.status, ran["result"]), (0, "arrived"), str(ran))
            fingerprints.add(ran["fingerprint"])
        self.assertEqual(len(fingerprints), 1)
        imported = output("/usr/bin/python3", "-c", "import baraka; print(baraka.__file__)", cwd=self.folder,
                          env={"PYTHONPATH": str(self.root) + os.path.dirname(MODULES)})
        self.assertEqual(imported.strip(), f"{self.root}{MODULES}/__init__.py")

    def test_programs_and_libraries_find_what_they_are_linked_with(self):
        for path in self.root.rglob("*"):
            if path.is_file() and not path.is_symlink() and path.read_bytes()[:4] == b"\x7fELF":
                self.assertNotIn("not found", output("ldd", path), path)

    def test_headers_that_the_development_package_needs_come_with_it(self):
        needed = set()
        for line in (ROOT / "cmake/barakaConfig.cmake.in").read_text().splitlines():
            needed |= set(re.findall(r"find_dependency\(([\w-]+)\)", line))
        package_of = {"tl-expected": "libexpected-dev", "fmt": "libfmt-dev", "yaml-cpp": "libyaml-cpp-dev",
                      "fastcdr": "libfastcdr-dev", "fastrtps": "libfastrtps-dev", "PkgConfig": "pkg-config",
                      "Threads": "g++"}
        depends = re.split(r", | \| ", self.field("libbaraka-dev", "Depends"))
        for dependency in needed:
            self.assertIn(package_of[dependency], depends)

    def test_case_study_runs_by_its_name_from_any_folder(self):
        for file in ("case_study.yaml", "robertino.yaml", "ieee80211b.yaml", "tmc200.yaml"):
            checked = self.baraka("check", file)
            self.assertEqual(checked.status, 0, str(checked))
        ran = self.baraka("run", "case_study.yaml", "--controllers", "in-process")
        self.assertEqual(ran.status, 0, str(ran))
        self.assertEqual(ran["result"], "arrived")
        at_home = self.run_baraka(ROOT / "config/scenarios/case_study.yaml", "--controllers", "in-process")
        self.assertEqual(ran["fingerprint"], at_home["fingerprint"])

    def test_scenario_that_is_nowhere_is_told_with_where_it_was_looked_for(self):
        for command in ("check", "run"):
            finished = self.baraka(command, "case_studdy.yaml")
            self.assertEqual(finished.status, 2, str(finished))
            self.assertRegex(finished.err, "^case_studdy.yaml: there is no such file here, nor in "
                             + re.escape(str(self.root / "usr/share/baraka")) + " or its .*scenarios")

    def test_name_no_folder_of_the_machine_that_built_them(self):
        if "CMAKE_BUILD_TYPE:STRING=Release" not in (BIN.parent / "CMakeCache.txt").read_text():
            self.skipTest("debug information names the sources")
        for path in self.root.rglob("*"):
            if path.is_file():
                for folder in (ROOT, BIN.parent):
                    named = re.search(rb"(?<![\w}.-])" + re.escape(os.fsencode(folder)) + rb"/",
                                      path.read_bytes())
                    self.assertIsNone(named, f"{path} names {folder}")

    def test_programs_are_stripped_and_everything_may_be_read(self):
        for program in ("baraka", "baraka-agentd", "help_mote"):
            self.assertIn(", stripped", output("file", self.root / "usr/bin" / program))
        for path in self.root.rglob("*"):
            self.assertTrue(path.stat().st_mode & 0o004, path)


if __name__ == "__main__":
    if not all(map(shutil.which, ("dpkg-shlibdeps", "file", "cpack"))):
        print("skipped: ./setup packages installs dpkg-dev and file, which build packages")
        sys.exit(77)
    unittest.main()
