#!/usr/bin/env python3
"""Fails when a function is longer than 50 lines, or 2 % of them or more are longer than 40.

Usage: function_sizes.py ROOT    (needs universal-ctags)
"""
import json
import pathlib
import subprocess
import sys

from house import sources

HARD_LIMIT, SOFT_LIMIT, SOFT_SHARE = 50, 40, 0.02


def functions(root):
    files = [path.as_posix() for path in sources(root)]
    tags = subprocess.run(
        ["ctags", "-L", "-", "--languages=C++", "--c++-kinds=f", "--fields=+ne",
         "--output-format=json", "-f", "-"],
        input="\n".join(files), capture_output=True, text=True, check=True).stdout
    for line in tags.splitlines():
        tag = json.loads(line)
        if "end" in tag:
            where = pathlib.Path(tag["path"]).relative_to(root)
            yield tag["end"] - tag["line"] + 1, f"{where}:{tag['line']}: {tag['name']}"


def main():
    found = list(functions(pathlib.Path(sys.argv[1])))
    long = sorted(((n, where) for n, where in found if n > SOFT_LIMIT), reverse=True)
    too_long = [f"{where}: {n} lines, the limit is {HARD_LIMIT}"
                for n, where in long if n > HARD_LIMIT]
    print("\n".join(too_long))
    share = len(long) / max(1, len(found))
    print(f"{len(found)} functions, {len(long)} longer than {SOFT_LIMIT} lines ({100 * share:.1f} %)")
    if share >= SOFT_SHARE:
        print("\n".join(f"{where}: {n} lines" for n, where in long))
    return 1 if too_long or share >= SOFT_SHARE or not found else 0


if __name__ == "__main__":
    sys.exit(main())
