#!/usr/bin/env python3
"""The lint rules find what they are for: each is run on a small tree with one mistake in it."""
import contextlib
import io
import pathlib
import re
import runpy
import sys
import tempfile
import unittest
import unittest.mock

import setup_packages

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parent.parent
FOLDERS = ["hal/types", "sim/core", "gateway/process", "controllers", "tests", "idl"]


def lint(rule, files, program=None):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name in FOLDERS:
            (root / name).mkdir(parents=True)
        for name, text in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        more = [str(root / program)] if program else []
        if program:
            (root / program).chmod(0o755)
        # As a program of its own, but for the time that it takes to start one.
        said, status = io.StringIO(), 0
        with unittest.mock.patch.object(sys, "argv", [rule, str(root), *more]), contextlib.redirect_stdout(said):
            try:
                runpy.run_path(str(HERE / rule), run_name="__main__")
            except SystemExit as end:
                status = end.code
        return status, said.getvalue()


class IncludeRules(unittest.TestCase):
    def check(self, name, line, message):
        status, out = lint("include_rules.py", {name: f"#pragma once\n{line}\n"})
        self.assertEqual(status, 1 if message else 0, out)
        self.assertIn(message or "ok", out)

    def test_a_controller_may_not_see_the_simulator(self):
        self.check("controllers/x/x.cpp", '#include "sim/core/event_queue.h"',
                   "controllers/x/x.cpp:2: controllers may not include sim/core/event_queue.h")

    def test_the_gateway_may_not_see_its_programs(self):
        self.check("gateway/server/server.cpp", '#include "baraka/run/x.h"', "gateway/server may not include")

    def test_the_daemon_may_not_see_the_simulator(self):
        self.check("agentd/x.cpp", '#include "gateway/server/server.h"', "")
        for other in ("sim/core/clock.h", "baraka/run/x.h"):
            self.check("agentd/x.cpp", f'#include "{other}"',
                       f"agentd may not include {other}")

    def test_the_exchange_may_not_see_the_messages_of_ros(self):
        self.check("results/report/x.cpp", '#include "idl/ros/values.h"', "")
        self.check("gateway/exchange/x.cpp", '#include "idl/ros/values.h"', "gateway/exchange may not include")

    def test_third_party_headers_have_a_home(self):
        self.check("sim/agents/x.cpp", "#include <ode/ode.h>", "belongs in sim/physics only")

    def test_a_folder_without_a_rule_is_named(self):
        self.check("sim/magic/x.cpp", "", "the folder has no row")
        self.check("magic/x.cpp", "", "the folder has no row")

    def test_one_controller_speaks_dds(self):
        self.check("controllers/ros_base/x.cpp", "#include <fastdds/x.hpp>", "")
        self.check("controllers/x/x.cpp", "#include <fastdds/x.hpp>", "belongs in gateway/guard, gateway/domain, gateway/exchange, gateway/inspection, controllers/ros, controllers/ros_base, controllers/ros_operator, programs/topics/fastdds only")

    def test_folders_that_need_each_other_are_named(self):
        sys.path.insert(0, str(HERE))
        import include_rules  # pylint: disable=import-outside-toplevel
        self.assertEqual(list(include_rules.circles({"a": ["b"], "b": ["c"], "c": []})), [])
        self.assertIn("a -> b -> a", list(include_rules.circles({"a": ["b"], "b": ["a"]}))[0])
        self.assertIn("a -> b -> c -> a", list(include_rules.circles({"a": ["b"], "b": ["c"], "c": ["a"]}))[0])

    def test_allowed_includes_pass(self):
        self.check("sim/agents/x.cpp", '#include "sim/radio/mac/mac_sap.h"', "")


class House(unittest.TestCase):
    def test_clang_tidy_looks_at_the_headers_of_every_top_folder(self):
        sys.path.insert(0, str(HERE))
        import house  # pylint: disable=import-outside-toplevel
        named = re.search(r"HeaderFilterRegex: '/\(([\w|]+)\)/'", (ROOT / ".clang-tidy").read_text(encoding="utf-8"))[1]
        self.assertEqual(sorted(named.split("|")), sorted(set(house.top_folders(ROOT)) - {"tests"}))


class DeterminismRules(unittest.TestCase):
    def check(self, line, message):
        status, out = lint("determinism_rules.py", {"sim/core/x.cpp": line + "\n"})
        self.assertEqual(status, 1 if message else 0, out)
        self.assertIn(message or "ok", out)

    def test_each_forbidden_thing_is_found(self):
        for line, message in {
            "double y = std::sin(x);": "hal::math",
            "std::random_device d;": "RandomStream",
            "std::normal_distribution<> n;": "standard libraries",
            "int i = rand();": "RandomStream",
            "std::unordered_map<int, int> m;": "no fixed order",
            "auto t = std::chrono::steady_clock::now();": "wall clock",
            "std::set<Node*> nodes;": "orders by address",
        }.items():
            with self.subTest(line):
                self.check(line, message)

    def test_comments_and_exact_functions_pass(self):
        self.check("double y = std::sqrt(x);  // not std::sin(x)", "")


class TypeNames(unittest.TestCase):
    def test_a_name_in_three_folders_is_found_and_in_two_it_is_not(self):
        files = {f"{folder}/x.h": "struct Link {\n};\n" for folder in ("hal/types", "sim/core")}
        self.assertEqual(lint("type_names.py", files)[0], 0)
        files["gateway/y.cpp"] = "class Link final : public Base {\n};\n"
        status, out = lint("type_names.py", files)
        self.assertEqual(status, 1)
        self.assertIn("Link is a type in 3 folders: gateway, hal/types, sim/core", out)

    def test_declarations_and_inner_types_pass(self):
        files = {"hal/types/x.h": "struct Link {\n};\n", "sim/core/x.h": "struct Link;\n",
                 "gateway/x.h": "class X {\n  struct Link {\n  };\n};\n"}
        self.assertEqual(lint("type_names.py", files)[0], 0)


class FunctionSizes(unittest.TestCase):
    def check(self, lines, status):
        body = "\n".join("  x += 1;" for _ in range(lines - 3))
        text = f"void f(int x) {{\n  x = 0;\n{body}\n}}\n"
        # many short ones, so that one function above 40 lines stays below 2 %
        text += "\n".join(f"void g{i}() {{}}" for i in range(100))
        code, out = lint("function_sizes.py", {"sim/core/x.cpp": text})
        self.assertEqual(code, status, out)

    def test_fifty_lines_pass_and_fifty_one_do_not(self):
        self.check(50, 0)
        self.check(51, 1)

    def test_a_tree_without_functions_is_suspicious(self):
        self.assertEqual(lint("function_sizes.py", {})[0], 1)


class DocsNames(unittest.TestCase):
    HELP = """#!/bin/sh
[ "$1" = run ] && { echo "  --pace TEXT  of the run"; exit; }
[ "$1" = topic ] && [ "$2" = echo ] && { echo "  --domain INT"; exit; }
[ "$1" = topic ] && { printf 'Subcommands:\n  echo   Samples\n'; exit; }
printf 'Options:\n  --version\n\nSubcommands:\n  run    Run a scenario\n  topic  Topics\n'
"""
    FILES = {"baraka": HELP, "sim/core/clock.h": "class Clock;\n", "sim/core/clock.cpp": "void Clock::tick() {}\n",
             "tests/bench.py": 'parser.add_argument("--seeds")\n'}

    def check(self, text, message):
        pages = "README.md", "docs/a.md"
        status, out = lint("docs_names.py", {**self.FILES, **dict.fromkeys(pages, text + "\n")}, "baraka")
        self.assertEqual(status, 1 if message else 0, out)
        for page in pages:
            self.assertIn(f"{page}:1: {message}" if message else ": ok", out)

    def test_files(self):
        for text in ("`sim/core/clock.h`, `.cpp`", "`clock.h`", "`sim/core/*.h`", "`sim/core/clock.{h,cpp}`", "`sim/core`",
                     "`sim/core/NAME.h`", "`config/<name>.yaml`"):
            with self.subTest(text):
                self.check(text, "")
        self.check("`sim/core/timer.h`", "no file sim/core/timer.h")
        self.check("`sim/core/clock.{h,py}`", "no file sim/core/clock.py")
        self.check("`timer.h`", "no file is called timer.h")
        self.check("`sim/core/clock.h`, `.yaml`", "no file sim/core/clock.yaml")

    def test_commands_and_options(self):
        for text in ("`baraka run x --pace realtime`", "`--pace`", "`tests/bench.py --seeds 1-3`", "`cmake --install build`",
                     "`baraka topic echo x --domain 1`", "`baraka run … [--pace P]`"):
            with self.subTest(text):
                self.check(text, "")
        self.check("`--real-time`", "no command or program: option --real-time")
        self.check("`baraka topic echo x --pace 1`", "'baraka topic echo' does not have: option --pace")
        self.check("`baraka fly`", "no command 'baraka fly'")

    def test_lines_of_a_block(self):
        status, out = lint("docs_names.py", {**self.FILES, "README.md": "```\nbaraka run x --pase y\n```\n"}, "baraka")
        self.assertEqual(status, 1)
        self.assertIn("README.md:2: 'baraka run' does not have: option --pase", out)

    def test_names_of_code(self):
        for text in ("`Clock`", "`Clock::tick()`", "`sim/core/clock.cpp`, `tick()`", "`std::sin`"):
            with self.subTest(text):
                self.check(text, "")
        self.check("`ClockWork`", "nothing is called ClockWork")
        self.check("`Clock::tock()`", "nothing is called Clock::tock()")
        self.check("`sim/core/clock.h`, `tick()`", "sim/core/clock.h has no tick()")


class SetupPackages(unittest.TestCase):
    """A file of a package that nothing named in ./setup brings is missing on a fresh machine."""
    SETUP = "packages=(\n  compiler maths-dev  # a comment\n)\n"
    TABLE = "\n".join("\t".join(row) for row in (
        ("compiler", ", libc-dev (>= 2), shell | other-shell", ""), ("glibc-dev", ", ", "libc-dev (= 2)"), ("other-shell", ", ", ""),
        ("maths-dev", ", maths-data:any (= 1)", ""), ("maths-data", ", ", ""), ("mock-dev", ", maths-dev", ""))) + "\n"

    def missing(self, *packages):
        return list(setup_packages.missing(self.SETUP, self.TABLE, dict.fromkeys(packages, "/usr/include/x.h")))

    def test_what_is_named_and_what_that_depends_on_is_there(self):
        self.assertEqual(self.missing("compiler", "glibc-dev", "other-shell", "maths-dev", "maths-data"), [])

    def test_what_merely_depends_on_it_is_not(self):
        self.assertEqual(self.missing("maths-dev", "mock-dev", "comment"), ["mock-dev", "comment"])


if __name__ == "__main__":
    unittest.main()
