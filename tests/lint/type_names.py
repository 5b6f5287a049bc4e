#!/usr/bin/env python3
"""Fails when a type's name is defined in three folders or more: nobody can tell then which is meant.

Types inside others do not count: they are read with the name of the outer one.
Usage: type_names.py ROOT
"""
import collections
import pathlib
import re
import sys

from house import sources

MOST = 2
DEFINITION = re.compile(r"(?:template <[^;{]*>\s*)?(?:struct|class|enum class|union) ([A-Z]\w*)(?: final)?\s*(?::[^:]|{)")


def main():
    root = pathlib.Path(sys.argv[1])
    places = collections.defaultdict(set)
    for path in sources(root, without=("tests",)):
        for line in path.read_text(encoding="utf-8").splitlines():
            if found := DEFINITION.match(line):
                places[found[1]].add(path.parent.relative_to(root).as_posix())
    wrong = {name: folders for name, folders in places.items() if len(folders) > MOST}
    for name, folders in sorted(wrong.items()):
        print(f"{name} is a type in {len(folders)} folders: {', '.join(sorted(folders))}")
    print(f"{len(places)} names of types" + ("" if wrong else ": ok"))
    return 1 if wrong or (not places and any(root.glob("hal/*/*.h"))) else 0


if __name__ == "__main__":
    sys.exit(main())
