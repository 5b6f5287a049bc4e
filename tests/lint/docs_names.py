#!/usr/bin/env python3
"""Fails when README.md or a page of docs names what is not there: a file, a command of baraka, an option, a class, a
function or a constant.

What is looked at: code spans and indented or fenced code. A file is a span that begins with the name of a top folder, or that is a bare
name with a suffix of SUFFIXES (it must be somewhere in the tree). `a.h`, `.cpp` names a.cpp, too. An option must be in
the help of the command that stands before it, or of some command of baraka, or be a word of one of our scripts or programs.
A function named right after a file (`a/b.cpp`, `f()`) must be in it. Words in capitals (DIR), with … or in <> are places for names.
Usage: docs_names.py ROOT [PROGRAM], PROGRAM being baraka; without it commands and options are not looked at.
"""
import pathlib
import re
import subprocess
import sys

NO_TOPS = ("build", "node_modules")  # made; of hidden folders only .ci is looked into
# What a run writes below the folder where it was started, beside the sources of that name.
OUTPUT = re.compile(r"results/(?!.*\.(cpp|h|js)$)")
TOPIC = re.compile(r"baraka/\w+")  # of DDS, if some source names it
SUFFIXES = ("cpp", "h", "py", "yaml", "idl", "cc", "c", "sh", "mjs", "md")
MORE = ("", "txt", "cmake", "html", "js", "css")  # of sources
# Pages that baraka writes itself and tests compare.
GENERATED = ("docs/keys.md", "docs/observables.md", "docs/results.md")
# Other people's programs, whose options are theirs.
OTHERS = ("cmake", "ctest", "git", "ros2", "sbatch", "sudo", "apt", "apt-get", "docker", "chrt", "npm", "pip", "gdb", "ddsperf",
          "ping", "iperf3", "srun", "salloc")
# A file of the port that anthocnet_base_field.md quotes; one of rosbag2; what readers of the tutorial write, or new-controller for them.
NOT_OURS = {"docs/benchmarks/scenarios/paper-base.md", "metadata.yaml", "scenario.yaml", "my_burger.yaml", "office.yaml", "study.yaml", "pair.yaml",
            "node.yaml", "fitted.yaml", "drive_around.cpp", "arrival.py", "my_robot.py", "speeds.yaml"}
# Of others: an option of NFS, a function of Fast DDS; and a name that a reader makes up.
FOREIGN = {"local_lock", "check_remote_participant_liveliness", "my_talker"}
OUR_OPTION = re.compile(r"""["'(\s|](--[a-z][\w-]*)|AddValue\("(\w+)\"""")
WORD = re.compile(r"\b(?:[A-Za-z]\w*::)*[A-Za-z]\w*(?:\(\))?")


def text_of(path):
    return path.read_text(encoding="utf-8", errors="replace")


def pages(root):
    found = [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    return [page for page in found if page.exists() and page.relative_to(root).as_posix() not in GENERATED]


def code_of(page):
    """(line, code, what follows in the line) of each span and each line of a block."""
    fenced = False
    for number, line in enumerate(text_of(page).splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif fenced:
            yield number, line.strip(), ""
        else:
            for span in re.finditer(r"`([^`]+)`", line):
                yield number, span[1], line[span.end():]


class Tree:
    """What there is."""

    def __init__(self, root):
        self.root = root
        self.tops = [".ci", *(path.name for path in root.iterdir() if path.is_dir() and path.name[0] != "." and path.name not in NO_TOPS)]
        self.files = [path for top in self.tops if (root / top).exists() for path in (root / top).rglob("*") if path.is_file()]
        self.files += [path for path in root.iterdir() if path.is_file()]
        self.names = {path.name for path in self.files}
        # Not this folder: its tests name what there is not.
        sources = [path for path in self.files if "lint" not in path.parts and path.suffix != ".md"]
        self.sources = {path: text_of(path) for path in sources if path.suffix.lstrip(".") in (*SUFFIXES, *MORE)}
        self.words = {word for text in self.sources.values() for word in re.findall(r"\w+", text)}

    def has_word(self, word):
        return word in self.words or word.endswith("s") and word[:-1] in self.words  # AgentHosts

    def options(self):
        """Of scripts and of programs other than baraka: words of their sources that look like options."""
        return {f"--{(one or other).removeprefix('--')}" for text in self.sources.values()
                for one, other in OUR_OPTION.findall(text)}

    def has(self, path):
        """A file, a folder, or a program by its source."""
        if "*" in path:
            return any(self.root.glob(path))
        return any((self.root / f"{path}{end}").exists() for end in ("", ".cc", ".cpp"))


def braces(text):
    """Of a{b,c}: ab and ac."""
    found = re.search(r"\{([^{}]*)\}", text)
    if not found:
        return [text]
    return [whole for part in found[1].split(",") for whole in braces(text[:found.start()] + part + text[found.end():])]


def is_place(text):
    return any(mark in text for mark in "<>…$") or bool(re.search(r"\b[A-Z]{2,}\b", text))


def missing_files(tree, code, after):
    for word in code.split():
        yield from missing_file(tree, re.sub(r"(:\d+)*[:,;.)]*$", "", word.lstrip("(")), after)


def missing_file(tree, word, after):
    if is_place(word) or word.startswith("--") or word in NOT_OURS or OUTPUT.match(word):
        return
    if TOPIC.fullmatch(word) and any(f'{word}"' in text for text in tree.sources.values()):
        return
    if re.match(rf"({'|'.join(map(re.escape, tree.tops))})/", word) and re.fullmatch(r"[\w./*{},+-]+", word):
        wanted = braces(word)
        beside = re.match(r"^, `(\.[a-z]+)`", after)
        if beside:
            wanted.append(str(pathlib.PurePosixPath(word).with_suffix(beside[1])))
        yield from (f"no file {path}" for path in wanted if not tree.has(path.rstrip("/")))
    elif re.fullmatch(rf"[\w-]+\.({'|'.join(SUFFIXES)})", word) and word not in tree.names:
        yield f"no file is called {word}"


def missing_function(tree, code, after):
    """`file`, `f()`: the function is in the file."""
    named = re.match(r"^, `(\w+)\(\)`", after)
    path = tree.root / code
    if named and re.fullmatch(r"[\w./-]+\.(cpp|h)", code) and path.is_file():
        if not re.search(rf"\b{named[1]}\(", text_of(path)):
            yield f"{code} has no {named[1]}()"


def is_name_of_code(word):
    bare = word.removesuffix("()").split("::")[-1]
    return word.endswith("()") or "::" in word or re.fullmatch(r"[A-Z]+[a-z]\w*[A-Z]\w*|k[A-Z]\w*|[a-z]+_\w+", bare)


def missing_names(tree, code):
    if is_place(code) or re.search(r"[./-]\w", code.replace("std::", "")) or code.startswith("std::"):
        return
    for word in WORD.findall(code):
        parts = word.removesuffix("()").split("::")
        if is_name_of_code(word) and parts[0] != "std" and any(not tree.has_word(part) for part in parts) and parts[-1] not in FOREIGN:
            yield f"nothing is called {word}"


class Help:
    """Commands of baraka and their options, from what it prints."""

    def __init__(self, program):
        self.program = program
        self.options, self.commands = {}, set()
        self._read(())
        self.all = set().union(*self.options.values())

    def _read(self, command):
        text = subprocess.run([self.program, *command, "--help"], capture_output=True, text=True, check=True).stdout
        self.options[command] = set(re.findall(r"--[a-z][\w-]*", text))
        self.commands.add(command)
        _, _, below = text.partition("Subcommands:")
        for name in re.findall(r"^  ([a-z][\w-]*) ", below, re.MULTILINE):
            self._read((*command, name))


def wrong_commands(help_of, of_scripts, code):
    words = code.replace("[", " ").replace("]", " ").split()
    options = [re.sub(r"[=,;:|).]+.*$", "", word) for word in words if re.match(r"--[a-z]", word)]
    if not words or words[0] in OTHERS:
        return
    known, whose = help_of.all | of_scripts, "no command or program"
    if words[0] == "baraka" and len(words) > 1 and re.fullmatch(r"[a-z][a-z-]+", words[1]):
        command = next((one for one in (tuple(words[1:3]), tuple(words[1:2])) if one in help_of.commands), None)
        if command is None:
            yield f"no command 'baraka {words[1]}'"
            return
        known, whose = help_of.options[command], f"'baraka {' '.join(command)}' does not have"
        options = options if "--" not in words else options[:sum(one.startswith("--") for one in words[:words.index("--")])]
    yield from (f"{whose}: option {option}" for option in options if option not in known)


def main():
    root = pathlib.Path(sys.argv[1])
    tree = Tree(root)
    help_of = Help(sys.argv[2]) if len(sys.argv) > 2 else None
    of_scripts = tree.options()
    count, wrong = 0, []
    for page in pages(root):
        name = page.relative_to(root).as_posix()
        for line, code, after in code_of(page):
            count += 1
            found = [*missing_files(tree, code, after), *missing_function(tree, code, after), *missing_names(tree, code)]
            if help_of:
                found += wrong_commands(help_of, of_scripts, code)
            wrong += [f"{name}:{line}: {one}" for one in found]
    print("\n".join([*wrong, f"{count} pieces of code in pages" + ("" if wrong else ": ok")]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
