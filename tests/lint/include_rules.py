#!/usr/bin/env python3
"""Fails when a file includes something its folder may not: the tables of docs/architecture.md.

Usage: include_rules.py ROOT
"""
import pathlib
import re
import sys

from house import sources

PAGE = "docs/architecture.md"


def rows(page, head):
    """(first column, last column) of the table with that head, as lists of what stands in code spans."""
    at = page.find(head)
    if at < 0:
        sys.exit(f"{PAGE}: has no table '{head}'")
    for line in page[at:].splitlines()[2:]:
        if not line.startswith("|"):
            return
        cells = [re.findall("`([^`]+)`", cell) for cell in line.strip("|").split("|")]
        yield cells[0][0], cells[-1]


RULES = (pathlib.Path(__file__).parents[2] / PAGE).read_text(encoding="utf-8")
MAY_INCLUDE = dict(rows(RULES, "| folder | job | may include |"))  # folder -> project folders, besides itself
ONLY_IN = dict(rows(RULES, "| header | library | included only in |"))  # third-party header -> the only folders that name it
GENERATED = re.compile(r"^\w+(PubSubTypes)?\.h$")  # of idl/: "exchange.h", "exchangePubSubTypes.h"


def inside(path, folders):
    return any(path == f or path.startswith(f + "/") for f in folders)


def folder_of(name):
    matching = [f for f in MAY_INCLUDE if inside(name, [f])]
    return max(matching, key=len, default=None)


def below(name):
    """The folders of the table that a name in it stands for."""
    return [f for f in MAY_INCLUDE if f == name or (name not in MAY_INCLUDE and f.startswith(name + "/"))]


def circles(may_include):
    """A way back to where it began, for each of the folders that have one."""
    for start in may_include:
        ways, seen = [[start]], set()
        while ways:
            way = ways.pop()
            for to in may_include.get(way[-1], ()):
                if to == start:
                    yield f"{PAGE}: {' -> '.join(way + [start])}: folders that need each other"
                    ways = []
                    break
                if to not in seen:
                    seen.add(to)
                    ways.append(way + [to])


def check_table():
    """No two folders need each other, and no two top folders do."""
    folders = {f: [t for name in allowed for t in below(name) if t != f] for f, allowed in MAY_INCLUDE.items()}
    yield from circles(folders)
    tops = {}
    for f, allowed in folders.items():
        top = f.split("/")[0]
        tops.setdefault(top, set()).update(t.split("/")[0] for t in allowed if t.split("/")[0] != top)
    yield from circles(tops)


def check_line(name, folder, target, idl_stems):
    project = [f.split("/")[0] for f in MAY_INCLUDE]
    if target.split("/")[0] in project:
        # A folder of the table is itself alone, without what lies in folders of the table of its own;
        # "hal" and "sim", which are not in it, are all below them.
        home = folder_of(target)
        allowed = [f for f in [folder] + MAY_INCLUDE[folder] if f not in MAY_INCLUDE or home == f]
        if folder != "tests" and not inside(target, allowed):
            yield f"{folder} may not include {target}"
    elif GENERATED.match(target) and re.sub(r"(PubSubTypes)?\.h$", "", target) in idl_stems:
        if not inside("idl", MAY_INCLUDE[folder]):
            yield f"{folder} may not include {target}"
    if folder != "tests":
        for prefix, homes in ONLY_IN.items():
            if target.startswith(prefix) and not inside(name, homes):
                yield f"<{target}> belongs in {', '.join(homes)} only"


def check(root):
    idl_stems = {p.stem for p in (root / "idl").glob("*.idl")}
    for file in sources(root):
        name = file.relative_to(root).as_posix()
        folder = folder_of(name)
        if folder is None:
            yield f"{name}:1: the folder has no row in {PAGE}"
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
            if match:
                for error in check_line(name, folder, match.group(1), idl_stems):
                    yield f"{name}:{number}: {error}"


if __name__ == "__main__":
    found = list(check_table()) + list(check(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "include rules: ok")
    sys.exit(1 if found else 0)
