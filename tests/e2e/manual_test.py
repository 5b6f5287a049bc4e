#!/usr/bin/env python3
"""Manual pages and completion for bash: whatever --help lists is in both."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from baraka import BIN, Program

ENVIRONMENT = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8", "MANWIDTH": "1000"}


def parts_of(help_text):
    """Options, words of choices and commands that a help lists, each from the lines of its own section."""
    options, choices, commands, section = {}, {}, [], ""
    for line in help_text.splitlines():
        if re.match(r"\S.*:$", line):
            section = line
        entry = re.match(r"  (\S+)(?: (\S.*?))?(?:  |$)", line)
        if not entry:
            continue
        if section == "Options:" and entry[1].startswith("-"):
            names = entry[1].split(",")
            options[names[-1]] = names
        if section == "Subcommands:":
            commands.append(entry[1])
        if section in ("Options:", "Positionals:") and re.match(r"[A-Z]+:[\w-]+(\|[\w-]+)*$", entry[2] or ""):
            choices[entry[1]] = entry[2].split(":")[1].split("|")
    return options, choices, commands


def commands_of(program, *path):
    """Every command with what its help lists: ((program, command …), options, choices, commands)."""
    parts = parts_of(Program(program, *path, "--help").finish().out)
    yield ((program, *path), *parts)
    for command in parts[2]:
        yield from commands_of(program, *path, command)


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="baraka-manual-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for program in ("baraka", "baraka-agentd"):
            written = Program(program, "--write-manual", cls.folder).finish()
            assert (written.status, written.out, written.err) == (0, "", ""), str(written)
        cls.commands = [*commands_of("baraka"), *commands_of("baraka-agentd")]

    def page(self, path):
        return self.folder / "man1" / f"{'-'.join(path)}.1"

    def test_there_is_a_page_for_each_command_and_no_other(self):
        self.assertEqual(sorted(page.name for page in (self.folder / "man1").iterdir()),
                         sorted(self.page(path).name for path, *_ in self.commands))
        self.assertGreaterEqual(len(self.commands), 12)

    def test_pages_list_what_help_lists(self):
        for path, options, choices, commands in self.commands:
            text = subprocess.run(["man", "--no-hyphenation", "-l", self.page(path)], env=ENVIRONMENT, check=True,
                                  capture_output=True, text=True).stdout
            self.assertTrue(options)
            for names in options.values():
                self.assertRegex(text, rf"(?m)^ +{re.escape(', '.join(names))}( |$)", path)
            for command in commands:
                self.assertRegex(text, rf"(?m)^ +{re.escape(command)}( |$)", path)
            for words in choices.values():
                self.assertTrue("|".join(words) in text or ", ".join(words) in text, (path, words))

    def test_pages_are_right_to_groff(self):
        for path, *_ in self.commands:
            done = subprocess.run(["man", "--warnings", "-l", self.page(path)], env=ENVIRONMENT, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), path)

    def test_groff_is_heard_when_a_page_is_wrong(self):
        wrong = self.folder / "wrong.1"
        wrong.write_text(self.page(("baraka",)).read_text() + ".NOSUCHMACRO\n")
        done = subprocess.run(["man", "--warnings", "-l", wrong], env=ENVIRONMENT, capture_output=True, text=True)
        self.assertIn("NOSUCHMACRO", done.stderr)

    def offered(self, *words):
        """What bash offers for the last word."""
        script = """source "$0/completions/$1"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
$(complete -p "$1" | sed 's/.*-F \\([^ ]*\\) .*/\\1/') "$1" "${@: -1}" "${@: -2:1}"; printf '%s\\n' "${COMPREPLY[@]}\""""
        done = subprocess.run(["bash", "-uc", script, self.folder, *words], cwd=self.folder, env=ENVIRONMENT, check=True,
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_offers_what_help_lists(self):
        for path, options, choices, commands in self.commands:
            with self.subTest(path=path):
                self.assertEqual(sorted(self.offered(*path, "-")), sorted(sum(options.values(), [])))
                self.assertLessEqual(set(commands), set(self.offered(*path, "")))
                for name, words in choices.items():
                    before = [name] if name.startswith("-") else []
                    self.assertLessEqual(set(words), set(self.offered(*path, *before, "")))
                    self.assertIn(words[0], self.offered(*path, *before, words[0][:2]))

    def test_bash_offers_scenarios_and_files(self):
        self.assertEqual(self.offered("baraka", "run", "two_tu"), ["two_turtlebots"])
        (self.folder / "mine.yaml").touch()
        self.assertEqual(self.offered("baraka", "run", "mi"), ["mine.yaml"])
        self.assertEqual(self.offered("baraka", "run", "--seed", "1", "--out", "mi"), ["mine.yaml"])
        self.assertEqual(self.offered("baraka-agentd", "mi"), ["mine.yaml"])
        self.assertEqual(self.offered("baraka", "ru"), ["run"])


if __name__ == "__main__":
    unittest.main()
