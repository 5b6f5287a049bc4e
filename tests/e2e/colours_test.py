#!/usr/bin/env python3
"""Which lines have colours: those on a terminal, unless NO_COLOR or TERM=dumb says no."""
import os
import pty
import subprocess
import unittest

from baraka import BIN, ROOT, Case

TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
ESCAPE = "\033["
BOLD, RED, END = "\033[1m", "\033[1m\033[31m", "\033[0m"
# Its second action is refused with a warning of run.log, and its expectation is not met.
WARNED = ["--set", "events=[{at: 1 s, do: [{remove: m0}, {switch_off: m0}]}]", "--set", "expect=[{result: other}]"]


def on_terminals(arguments, terminals, **variables):
    """What a program wrote to standard output and to standard error. @param terminals  which of "out" and "err" are
    terminals of their own; the others are pipes. @param variables  None: unset."""
    environment = {**os.environ, "TERM": "xterm", "NO_COLOR": None, **variables}
    ends = {name: pty.openpty() if name in terminals else os.pipe() for name in ("out", "err")}
    process = subprocess.Popen([BIN / "baraka", *map(str, arguments)], stdin=subprocess.DEVNULL,
                               stdout=ends["out"][1], stderr=ends["err"][1],
                               env={name: value for name, value in environment.items() if value is not None})
    for _, writer in ends.values():
        os.close(writer)
    # One after the other: all that is written here fits into the buffer of a terminal.
    said = {name: read_all(reader).decode().replace("\r\n", "\n") for name, (reader, _) in ends.items()}
    process.wait()
    return said["out"], said["err"]


def read_all(descriptor):
    text = b""
    while True:
        try:
            part = os.read(descriptor, 65536)
        except OSError:  # EIO: a terminal that nobody has open any more
            part = b""
        if not part:
            os.close(descriptor)
            return text
        text += part


class Colours(Case):
    def check(self, terminals=("out", "err"), **variables):
        return on_terminals(["check", TWO_MOTES, "--set", "seed=-1"], terminals, **variables)[1]

    def run_with_a_warning(self, terminals, **variables):
        return on_terminals(["run", TWO_MOTES, "--controllers", "in-process", "--out", self.folder / "out", "--overwrite",
                             *WARNED], terminals, **variables)

    def test_a_mistake_on_a_terminal_has_colours(self):
        self.assertIn(f"{BOLD}--set seed:{END} ", self.check())
        _, err = on_terminals(["run", TWO_MOTES, "--seed", "a"], ["err"])
        self.assertIn(f"{BOLD}--seed:{END} 'a' is not a whole number", err)
        _, err = on_terminals(["ruin"], ["err"])
        self.assertIn(f"{RED}error:{END} 'ruin' is no command", err)

    def test_an_empty_NO_COLOR_counts_as_none(self):
        self.assertEqual(self.check(NO_COLOR=""), self.check())

    def test_no_colours_where_they_are_refused_or_nobody_sees_them(self):
        plain = self.check(terminals=[])
        self.assertIn("--set seed: ", plain)
        for terminals, variables in ((["out", "err"], {"NO_COLOR": "1"}), (["out", "err"], {"TERM": "dumb"}),
                                     (["out"], {}), ([], {"TERM": None})):
            with self.subTest(terminals=terminals, variables=variables):
                self.assertEqual(self.check(terminals, **variables), plain)

    def test_each_stream_is_judged_for_itself(self):
        for terminals in ([], ["out"], ["err"], ["out", "err"]):
            with self.subTest(terminals=terminals):
                out, err = self.run_with_a_warning(terminals)
                self.assertEqual(f"{BOLD}result:{END} done\n" in out, "out" in terminals, out)
                self.assertEqual("result: done\n" in out, "out" not in terminals, out)
                self.assertEqual(ESCAPE in out, "out" in terminals, out)
                self.assertEqual(f"{RED}not met:{END} " in err, "err" in terminals, err)
                self.assertEqual(ESCAPE in err, "err" in terminals, err)

    def test_a_warning_of_the_log_is_yellow_on_a_terminal_and_plain_in_the_file(self):
        line = r"\[ *1\.000000000\] warning m0: the scenario: .*no effect, it is not present.*"
        _, err = self.run_with_a_warning(["err"])
        self.assertRegex(err, "\033\\[33m(\033\\[1m)?" + line + "\033")
        _, err = self.run_with_a_warning(["err"], NO_COLOR="1")
        self.assertRegex(err, f"(?m)^{line}$")
        self.assertNotIn(ESCAPE, err)
        self.assertNotIn(ESCAPE, (self.folder / "out/run.log").read_text())


if __name__ == "__main__":
    unittest.main()
