#!/usr/bin/env python3
"""Prints the commands of a page's part as a script for bash, for who tries the page as it is written.

    page_commands.py PAGE TITLE [FILE]     FILE: what the commands printed; default said.txt

A block ```yaml or ```python whose first line is `# NAME` is a file to write, ```sh are commands, ```text are lines of which each must be part of
what the commands before it printed. Other blocks are for reading. The script stops with status 1 where the page is wrong.
"""
import pathlib
import re
import shlex
import sys


def blocks(page, title):
    """(language, text) of the part, in order."""
    for part in re.split(r"^## ", pathlib.Path(page).read_text(encoding="utf-8"), flags=re.M)[1:]:
        if part.startswith(title + "\n"):
            return re.findall(r"^```(\w*)\n(.*?)^```$", part, re.M | re.S)
    raise SystemExit(f"{page}: has no part '{title}'")


def script(page, title, said):
    lines = [f"set -eE\nsaid=$(realpath -m {shlex.quote(said)})\n: >\"$said\"\nexec 3>&1",
             "trap 'echo \"failed: $BASH_COMMAND; the commands printed:\" >&3; cat \"$said\" >&3' ERR"]
    for language, text in blocks(page, title):
        if language == "sh":
            lines.append(f'{{\n{text}}} >>"$said" 2>&1')
        elif language in ("yaml", "python") and text.startswith("# "):
            lines.append(f"cat >{shlex.quote(text.split()[1])} <<'END_OF_BLOCK'\n{text}END_OF_BLOCK")
        elif language == "text":
            lines += [f'grep -qF -- {shlex.quote(line)} "$said"' for line in text.splitlines()]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__)
    sys.stdout.write(script(sys.argv[1], sys.argv[2], (sys.argv[3:] or ["said.txt"])[0]))
