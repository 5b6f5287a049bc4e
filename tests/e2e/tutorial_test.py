#!/usr/bin/env python3
"""Every command of docs/tutorial.md works, and prints what the page says.

A block ```yaml whose first line is `# NAME` is a file to write, ```sh are commands, ```text are lines of which each must be part of what
the commands before it printed.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from air_programs_test import refused_here
from baraka import BIN, ROOT, some_domain

SKIPPED = 77
SECONDS = 300  # for the commands of one block, on a busy computer


def parts():
    """(title, blocks as (language, text)) of the page."""
    text = (ROOT / "docs/tutorial.md").read_text(encoding="utf-8")
    for part in re.split(r"^## ", text, flags=re.M)[1:]:
        title, _, body = part.partition("\n")
        yield title, re.findall(r"^```(\w*)\n(.*?)^```$", body, re.M | re.S)


class Tutorial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="baraka-tutorial-")
        self.addCleanup(folder.cleanup)
        self.folder, self.said = pathlib.Path(folder.name), ""
        (self.folder / "work").mkdir()
        install = subprocess.run(["cmake", "--install", BIN.parent, "--prefix", self.folder / "usr"], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(install.returncode, 0, install.stderr)
        path = f"{self.folder}/usr/bin:{os.environ['PATH']}"
        self.environment = {"PATH": path, "HOME": str(self.folder), "CMAKE_PREFIX_PATH": str(self.folder / "usr"), "LC_ALL": "C.UTF-8",
                            "BARAKA_DOMAIN": str(some_domain(self))}

    def shell(self, commands):
        """Runs them as a user types them: what one block exports the next one has."""
        kept = self.folder / "environment"
        script = f"set -e; cd work; [ ! -e {kept} ] || . {kept}\n{commands}\nexport -p >{kept}\n"
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=SECONDS, check=False)
        self.assertEqual(done.returncode, 0, f"{commands}\n{done.stdout}")
        return done.stdout

    def block(self, language, text):
        if language == "sh" and ".html" in text and not (BIN / "report_page.html").exists():
            return  # the page says what builds it
        if language == "sh":
            self.said += self.shell(text)
        elif language == "yaml":
            name = re.match(r"# (\S+)\n", text)[1]
            (self.folder / "work" / name).write_text(text, encoding="utf-8")
        else:
            self.assertEqual(language, "text")
            for line in text.splitlines():
                self.assertIn(line, self.said)
            self.said = ""

    def test_every_command_works_and_prints_what_the_page_says(self):
        counts = {"sh": 0, "yaml": 0, "text": 0}
        for title, blocks in parts():
            if title.startswith("5.") and (refused_here() or not shutil.which("ping")):
                continue
            with self.subTest(title):
                for language, text in blocks:
                    self.block(language, text)
                    counts[language] += 1
        self.assertGreaterEqual(min(counts.values()), 4, counts)


if __name__ == "__main__":
    if not shutil.which("cmake"):
        print("skipped: needs cmake")
        sys.exit(SKIPPED)
    unittest.main()
