#!/usr/bin/env python3
"""Whether ./setup installs what the build takes from the system: every header that a compiler read and every library that is linked must
be of a package that ./setup names, or that one of these depends on. Else a fresh machine lacks it, while this one has it by accident.

    setup_packages.py ROOT [BUILD]     BUILD: build/release, built
"""
import pathlib
import re
import subprocess
import sys


def run(*command):
    return subprocess.run(command, check=False, capture_output=True, text=True).stdout


def named(setup):
    """The packages that ./setup always installs."""
    [block] = re.findall(r"^packages=\(\n(.*?)^\)", setup, re.MULTILINE | re.DOTALL)
    return re.sub(r"#.*", "", block).split()


def closure(names, table):
    """With what they depend on; of alternatives the first that is installed, as apt takes it on a machine that has none."""
    needs, real = {}, {}
    for line in table.splitlines():
        package, depends, provides = line.split("\t")
        needs[package] = depends
        for provided in [package, *provides.split(",")]:
            real.setdefault(provided.split("(")[0].strip(), package)
    found, left = set(), list(names)
    while left:
        package = real.get(left.pop())
        if package is None or package in found:
            continue
        found.add(package)
        for one in needs[package].split(","):
            alternatives = [re.sub(r"[\s(:].*", "", name.strip()) for name in one.split("|")]
            left += [name for name in alternatives if name in real][:1]
    return found


def taken(build):
    """Files of the system that the build reads."""
    deps = run("ninja", "-C", str(build), "-t", "deps")
    linked = (build / "build.ninja").read_text(encoding="utf-8")
    return set(re.findall(r"^\s+(/usr/\S+)", deps, re.MULTILINE)) | set(re.findall(r"(/usr/lib/\S+\.(?:a|so)[.0-9]*)(?=\s)", linked))


def owners(files):
    """{package: one of its files}"""
    found = {}
    files = sorted(str(pathlib.Path(file).resolve()) for file in files)
    for begin in range(0, len(files), 5000):
        for line in run("dpkg", "-S", *files[begin:begin + 5000]).splitlines():
            packages, _, file = line.partition(": ")
            for package in packages.split(", "):
                found.setdefault(package.split(":")[0], file)
    return found


def missing(setup, table, owned):
    installed = closure(named(setup), table)
    return {package: file for package, file in owned.items() if package not in installed}


def main():
    root = pathlib.Path(sys.argv[1])
    build = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else root / "build/release"
    table = run("dpkg-query", "-W", "-f", "${Package}\t${Pre-Depends}, ${Depends}\t${Provides}\n")
    owned = owners(taken(build))
    lacks = missing((root / "setup").read_text(encoding="utf-8"), table, owned)
    for package, file in sorted(lacks.items()):
        print(f"setup: does not install {package}, of which the build reads {file}")
    print(f"{len(owned)} packages: {'ok' if owned and not lacks else 'wrong'}")
    return 0 if owned and not lacks else 1


if __name__ == "__main__":
    sys.exit(main())
