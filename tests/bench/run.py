#!/usr/bin/env python3
"""Measures our programs and those of others in turn, A B A B ..., and prints medians and ratios.

    cmake --build build/release --target programs benches
    tests/bench/run.py [--build DIR] [--peer DIR] [--lockstep PROGRAM] [--repeat N] [BENCH...]

BENCH is one of event_queue, exchange, case_study, driving; default: all. A peer that is not there is
skipped with a message. --peer: a folder with ns3/eventcore.cc and ode/speed.cpp, which are built if
they can be (libns3-dev, libode-dev), or the programs beside them. --lockstep: the exchange in bare Fast DDS. Default of both: what is in
../shared beside the checkout, or BARAKA_PEER and BARAKA_LOCKSTEP of the environment.
"""
import argparse
import os
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared"
DRIVING = ROOT / "tests/bench/driving.yaml"
CASE_STUDY = ROOT / "config/scenarios/case_study.yaml"
SCHEDULERS = ("Map", "Heap", "Calendar", "PriorityQueue")
SIX_PROCESSES = ["--set", "agents.motes.controller.processes=5"]


def output(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def value(text, key):
    return float(re.search(rf"^{key}: (\S+)$", text, re.MULTILINE).group(1))


def medians(repeat, programs):
    """The median of each of several measurements by name, taken in turn."""
    figures = {name: [] for name in programs}
    for _ in range(repeat):
        for name, measure in programs.items():
            figures[name].append(measure())
    return {name: statistics.median(values) for name, values in figures.items()}


def show(name, figure, unit, note=""):
    print(f"  {name:44} {figure:12.4g} {unit:10} {note}", flush=True)


def peer_program(source, package, *libraries):
    """The program; None, with a message, if it is not there and cannot be built."""
    program = source.with_suffix("")
    if program.exists():
        return program
    if not source.exists():
        print(f"  skipped: no {source}")
        return None
    program = pathlib.Path(tempfile.mkdtemp(prefix="baraka-peer-")) / source.stem
    built = subprocess.run(["g++", "-O2", "-std=c++17", "-o", program, source, "-Wl,--as-needed",
                            *libraries], capture_output=True, text=True)
    if built.returncode != 0:
        print(f"  skipped: {source} cannot be built; is {package} there?")
        return None
    return program


def eventcore(peer):
    modules = ("core", "network", "wifi", "mobility", "propagation")
    return peer_program(peer / "ns3/eventcore.cc", "libns3-dev",
                        *(f"-lns3-{name}" for name in modules))


def user_seconds(*command):
    """That a program takes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    output(*command)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def user_ms_per_second(short, long, command):
    """User milliseconds per simulated second: the difference of two runs, so without the start.

    command(seconds): the command line of a run of that length."""
    start = user_seconds(*command(short))
    return 1e3 * (user_seconds(*command(long)) - start) / (long - short)


def event_queue(options):
    """Events per user second of the hold model."""
    ours = options.build / "tests/event_queue_bench"
    programs = {kind: lambda kind=kind: value(output(ours, 3_000_000, 100_000, kind), "rate")
                for kind in ("plain", "cancelled")}
    peer = eventcore(options.peer)
    if peer:
        for scheduler in SCHEDULERS:
            programs[f"ns-3 {scheduler}"] = lambda name=scheduler: float(
                output(peer, f"--sched=ns3::{name}Scheduler", "--events=3000000").split(",")[6])
    found = medians(options.repeat, programs)
    best = max((rate for name, rate in found.items() if name.startswith("ns-3")), default=None)
    for name, rate in found.items():
        show(name, rate, "events/s", f"{rate / best:.2f} x the best of ns-3" if best else "")


def exchange(options):
    """Microseconds of wall time, median of one run, and median of these."""
    ours = options.build / "tests/exchange_bench"
    has_peer = options.lockstep.exists()
    if not has_peer:
        print(f"  skipped: no {options.lockstep}")
    for processes, agents in ((1, 1), (1, 37), (6, 1)):
        programs = {"ours": lambda p=processes, a=agents: float(
            re.search(r"median (\d+) us", output(ours, 5000, p, a)).group(1))}
        if has_peer:
            programs["lockstep"] = lambda p=processes, a=agents: float(re.search(
                r"p50 +([\d.]+)", output(options.lockstep, f"procs={p}", f"agents={p * a}",
                                         "route=batch", "disc=peers", "ticks=5000")).group(1))
        found = medians(options.repeat, programs)
        ratio = f"{found['ours'] / found['lockstep']:.2f} x lockstep" if has_peer else ""
        show(f"{processes} processes, {agents} agents each", found["ours"], "us", ratio)


def case_study(options):
    """Times real time, start-up excluded."""
    baraka = options.build / "bin/baraka"
    ways = {"in process": ["--controllers", "in-process"], "two controller processes": [],
            "six controller processes": SIX_PROCESSES}
    with tempfile.TemporaryDirectory(prefix="baraka-bench-") as folder:
        programs = {name: lambda arguments=arguments: value(
            output(baraka, "run", CASE_STUDY, "--out", f"{folder}/run", *arguments),
            "real_time_factor") for name, arguments in ways.items()}
        for name, factor in medians(options.repeat, programs).items():
            show(name, factor, "x real time")


def driving(options):
    """User milliseconds per simulated second: 12 robots and 25 motes; bare ODE as the peer."""
    baraka = options.build / "bin/baraka"
    peer = peer_program(options.peer / "ode/speed.cpp", "libode-dev", "-lode")
    for model, wheels in enumerate(("jointed", "contact")):
        with tempfile.TemporaryDirectory(prefix="baraka-bench-") as folder:
            commands = {"ours": lambda seconds, w=wheels, f=folder: (
                baraka, "run", DRIVING, "--controllers", "in-process", "--out", f"{f}/run",
                "--until", seconds, "--set", f"agents.robots.wheels={w}")}
            # Its default broad phase is the hash space; the other one is ours, and the faster.
            for space, name in ((0, "peer, hash space"), (1, "peer, sweep and prune")) if peer else ():
                commands[name] = lambda seconds, m=model, s=space: (
                    peer, "n=12", "m=25", f"model={m}", f"space={s}", "prof=0", f"T={seconds}")
            found = medians(options.repeat, {
                name: lambda c=command: user_ms_per_second(100, 500, c)
                for name, command in commands.items()})
        for name, figure in found.items():
            note = "" if name == "ours" else f"ours: {found['ours'] / figure:.2f} x"
            show(f"{wheels}: {name}", figure, "ms/s", note)


BENCHES = {"event_queue": event_queue, "exchange": exchange, "case_study": case_study,
           "driving": driving}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benches", nargs="*", metavar="BENCH")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--peer", type=pathlib.Path,
                        default=os.environ.get("BARAKA_PEER", SHARED / "peer"))
    parser.add_argument("--lockstep", type=pathlib.Path,
                        default=os.environ.get("BARAKA_LOCKSTEP", SHARED / "spikes/dds/lockstep"))
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    unknown = set(options.benches) - set(BENCHES)
    if unknown:
        parser.error(f"no such bench: {', '.join(sorted(unknown))}")
    for name in options.benches or BENCHES:
        print(f"{name}: {BENCHES[name].__doc__}")
        BENCHES[name](options)


if __name__ == "__main__":
    main()
