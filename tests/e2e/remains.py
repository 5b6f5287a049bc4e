"""What is left of a run on this machine: its processes, known by a mark in their environment, and its
namespaces, known by their inodes. Others may be running meanwhile."""
import os
import pathlib
import subprocess
import time
import uuid

VARIABLE = "BARAKA_TEST_MARK"


def processes_by(condition):
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if condition(folder):
                found.append(int(folder.name))
        except OSError:
            continue  # it has ended meanwhile
    return found


def namespace_links(process):
    """Every namespace that it is in or holds open, as net:[4026532178]."""
    links = set()
    for folder in ("ns", "fd"):
        try:
            names = list((process / folder).iterdir())
        except OSError:
            continue
        for name in names:
            try:
                target = os.readlink(name)
            except OSError:
                continue
            if ":[" in target and target.split(":")[0] in ("net", "mnt", "uts", "ipc", "pid", "user"):
                links.add(target)
    return links


OUTSIDE = namespace_links(pathlib.Path("/proc/self"))


def started(pid):
    """When, in clock ticks: with its number, that is one process for ever. 0: it is gone, or a zombie."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0
    return 0 if fields[0] == "Z" else int(fields[19])


class Mark:
    """In the environment of one run's first process, and so in that of all that it starts. Inodes of
    namespaces are used again, so those count that a process holds which was seen to hold them before."""

    def __init__(self):
        self.text = uuid.uuid4().hex
        self.variables = {VARIABLE: self.text}
        self.holders = {}  # of each namespace: (pid, started)

    def processes(self):
        wanted = f"{VARIABLE}={self.text}".encode()
        return processes_by(lambda folder: wanted in (folder / "environ").read_bytes())

    def look(self):
        """Keeps in mind which namespaces there are. Who has lost the mark is in one of them."""
        inside = set()
        for pid in self.processes():
            inside.add(pid)
            for link in namespace_links(pathlib.Path(f"/proc/{pid}")) - OUTSIDE:
                self.holders.setdefault(link, set())
        def is_inside(folder):
            return os.readlink(folder / "ns/pid") in self.holders
        for pid in inside | set(processes_by(is_inside)):
            for link in namespace_links(pathlib.Path(f"/proc/{pid}")) - OUTSIDE:
                self.holders.setdefault(link, set()).add((pid, started(pid)))

    def remains(self):
        """Processes, namespaces and files that are still there, in words."""
        marked = set(self.processes())
        left = [f"process {pid}: {pathlib.Path(f'/proc/{pid}/comm').read_text().strip()}"
                for pid in marked if started(pid)]
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            pid = int(folder.name)
            for link in namespace_links(folder) & self.holders.keys():
                if pid in marked or (pid, started(pid)) in self.holders[link]:
                    left.append(f"namespace {link}, of process {pid}")
        listed = subprocess.run(["lsns", "--noheadings", "--raw", "--output", "NS,PID"], capture_output=True,
                                text=True, check=False).stdout.splitlines()
        for inode, pid in map(str.split, listed):
            for link, holders in self.holders.items():
                if f"[{inode}]" in link and (int(pid), started(pid)) in holders:
                    left.append(f"namespace {link}, listed by lsns")
        for mount in pathlib.Path("/proc/self/mountinfo").read_text().splitlines():
            left += [f"mount of {link}" for link in self.holders if link in mount]
        left += [f"file {file}" for file in pathlib.Path("/dev/shm").iterdir() if self.text in file.name]
        return left

    def remains_after(self, seconds):
        """What is left so long after; empty as soon as there is nothing."""
        end = time.monotonic() + seconds
        while True:
            try:
                left = self.remains()
            except OSError:  # what was there a moment ago is not
                continue
            if not left or time.monotonic() > end:
                return left
            time.sleep(0.1)

