"""Programs over our radio: a scenario from stations and what runs in them, a run of it, and what it recorded."""
import argparse
import contextlib
import dataclasses
import json
import math
import pathlib
import re
import shutil
import sqlite3
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROFILES = ROOT / "config/dds"
CONFIGURATION = {"cyclone": "CYCLONEDDS_URI", "fastdds": "FASTRTPS_DEFAULT_PROFILES_FILE"}
WITHOUT_RESULT = "time_over"
LOCKSTEP = "lock-step"


@dataclasses.dataclass
class Program:
    name: str
    command: list
    environment: dict = dataclasses.field(default_factory=dict)
    on_exit: str = "ignore"
    start: float = 0  # s

    def section(self):
        return {"name": self.name, "command": [str(part) for part in self.command], "on_exit": self.on_exit,
                "environment": self.environment, "start": f"{self.start} s"}


@dataclasses.dataclass
class Station:
    """Of one host, at a place in metres. kind: keys of an agent that say what it is."""
    name: str
    x: float
    y: float
    programs: list
    kind: dict = dataclasses.field(default_factory=lambda: {"station": {}})

    def section(self):
        return {"name": self.name, **self.kind, "poses": [{"x": f"{self.x} m", "y": f"{self.y} m"}],
                "network": {}, "programs": [program.section() for program in self.programs]}


def circle(count, radius=5):
    """Places in metres, as tests/peer/ns3/tap.cc has them."""
    return [(round(radius * math.cos(2 * math.pi * i / count), 6), round(radius * math.sin(2 * math.pi * i / count), 6))
            for i in range(count)]


def environment(vendor, profile=None):
    """Of a load with a file of config/dds, by its name without .xml."""
    if profile is None:
        return {}
    file = PROFILES / f"{profile}.xml"
    return {CONFIGURATION[vendor]: f"file://{file}" if vendor == "cyclone" else str(file)}


def radio(standard="ieee80211g", **more):
    return {"include": str(ROOT / f"config/radios/{standard}.yaml"),
            "propagation": [{"model": "log_distance", "exponent": 3}], **more}


def scenario(stations, seconds, of_radio, **more):
    """As a file of ours: YAML of which JSON is a part."""
    return {"version": 1, "name": "measured", "seed": 1, "controller_latency": "0 s", "radio": of_radio,
            "routing": "none", "agents": {station.name: station.section() for station in stations},
            "end": [{"at": f"{seconds} s", "result": WITHOUT_RESULT}], **more}


class Results:
    """Of one run, until the end of the `with` that began it."""

    def __init__(self, folder, done, wall):
        self.folder, self.status, self.out, self.err = folder, done.returncode, done.stdout, done.stderr
        self.wall = wall  # s that the run took

    def __str__(self):
        return f"status {self.status}\n{self.out}\n{self.err}"

    def line(self, key, otherwise=None):
        """Of the summary."""
        found = re.search(rf"^{re.escape(key)}: (.*)$", self.out, re.MULTILINE)
        if found is None and otherwise is None:
            raise SystemExit(f"no '{key}:' in\n{self}")
        return found.group(1) if found else otherwise

    def cost(self):
        """Seconds that it simulated, and seconds that it took."""
        return {"simulated": float(self.line("simulated_s")), "wall": self.wall}

    def check_programs(self):
        """A run goes on without a program that fails, and would be measured as if it had sent nothing."""
        for agent, program, status in self.query("select a.name, p.name, p.status from programs p join agents a using (agent) "
                                                 "where p.status <> 0"):
            log = self.folder / f"{agent}.{program}.log"
            raise SystemExit(f"program {program} of {agent} ended with status {status}"
                             f"{':' if log.exists() else ''}\n{log.read_text() if log.exists() else ''}")

    def query(self, sql):
        with contextlib.closing(sqlite3.connect(f"file:{self.folder / 'run.sqlite'}?mode=ro", uri=True)) as database:
            return database.execute(sql).fetchall()


def parser(text):
    """Of a bench's command line, with what all of them take."""
    made = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("--build", type=lambda text: pathlib.Path(text).resolve(), default=ROOT / "build/release")
    made.add_argument("--store", type=pathlib.Path, help="file of what is measured already")
    made.add_argument("--kept", type=pathlib.Path, help="folder for runs that fail")
    return made


def add_factor(made):
    """To a parser(): for benches of which all runs have one pace."""
    made.add_argument("--factor", type=float, help="of real time; default: in lock-step")


def pace(factor):
    """Option of `baraka run`. factor: of real time; None or LOCKSTEP: in lock-step."""
    return "lockstep" if factor in (None, LOCKSTEP) else f"realtime:{factor}"


def costs(rows):
    """A line of text: what runs with cost() took, one after the other."""
    simulated, wall = (sum(row[key] for row in rows) for key in ("simulated", "wall"))
    return f"{len(rows)} runs, {simulated:.0f} s simulated in {wall:.0f} s: {simulated / wall:.1f} times real time"


@contextlib.contextmanager
def played(build, written, factor=None, seed=1, kept=None, timeout=None):
    """Results of a run of a scenario(...), at the pace(factor). kept: a folder for the scenario and log of a run that
    fails."""
    with tempfile.TemporaryDirectory(prefix="baraka-measured-") as name:
        file, out = pathlib.Path(name) / "measured.yaml", pathlib.Path(name) / "run"
        file.write_text(json.dumps(written, indent=1))
        command = [build / "bin/baraka", "run", file, "--out", out, "--seed", seed, "--no-inspect", "--pace",
                   pace(factor)]
        begin = time.monotonic()
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=timeout, check=False)
        results = Results(out, done, time.monotonic() - begin)
        if done.returncode != 0 and kept is not None:
            shutil.copytree(name, kept, dirs_exist_ok=True)
        if (out / "run.sqlite").exists():
            results.check_programs()
        yield results
