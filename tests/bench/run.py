#!/usr/bin/env python3
"""Measures our programs and those of others in turn, A B A B ..., and prints medians and ratios.

    cmake --build build/release --target programs benches
    tests/bench/run.py [--build DIR] [--peer DIR] [--lockstep DIR] [--repeat N] [BENCH...]

BENCH is one of event_queue, exchange, walker, case_study, driving; default: all. A peer that is not there is
skipped with a message. --peer: a folder with ns3/eventcore.cc, which needs libns3-dev, and
ode/speed.cpp, which needs libode-dev. --lockstep: a folder with lockstep.cpp, the exchange in bare
Fast DDS, and its CMakeLists.txt. They are built into DIR/peers; the programs themselves may lie
beside the sources. Default of both: what is in ../shared beside the checkout, or BARAKA_PEER and
BARAKA_LOCKSTEP of the environment.
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
# The peer's default broad phase is the hash space; the other one is ours, and the faster.
SPACES = ((0, "peer, hash space"), (1, "peer, sweep and prune"))
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


def built(program, source, *commands):
    """The program, built anew if its source is newer; None, with a message, if it cannot be."""
    if not source.exists():
        print(f"  skipped: no {source}")
        return None
    if program.exists() and program.stat().st_mtime > source.stat().st_mtime:
        return program
    program.parent.mkdir(parents=True, exist_ok=True)
    for command in commands:
        try:
            done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
            error = "" if done.returncode == 0 else done.stdout + done.stderr
        except FileNotFoundError as missing:
            error = str(missing)
        if error:
            lines = [line for line in error.splitlines() if "rror" in line] or error.splitlines()
            print(f"  skipped: {source} cannot be built: {lines[0] if lines else 'no message'}")
            return None
    return program


def eventcore(options):
    """ns-3's event queue."""
    beside = options.peer / "ns3/eventcore"
    if beside.exists():
        return beside
    program, source = options.build / "peers/eventcore", options.peer / "ns3/eventcore.cc"
    libraries = [f"-lns3-{name}" for name in ("core", "network", "wifi", "mobility", "propagation")]
    return built(program, source, ["g++", "-O2", "-std=c++17", "-o", program, source,
                                   "-Wl,--as-needed", *libraries])


def lockstep(options):
    """The exchange in bare Fast DDS."""
    for given in (options.lockstep, options.lockstep / "lockstep"):
        if given.is_file():
            return given
    folder = options.build / "peers/lockstep"
    return built(folder / "lockstep", options.lockstep / "lockstep.cpp",
                 ["cmake", "-S", options.lockstep, "-B", folder, "-G", "Ninja"],
                 ["cmake", "--build", folder])


def ode_speed(options):
    """Robots and motes in bare ODE."""
    beside = options.peer / "ode/speed"
    if beside.exists():
        return beside
    program, source = options.build / "peers/speed", options.peer / "ode/speed.cpp"
    return built(program, source, ["g++", "-O2", "-std=c++17", "-o", program, source, "-lode"])


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
    peer = eventcore(options)
    if peer:
        for scheduler in SCHEDULERS:
            programs[f"ns-3 {scheduler}"] = lambda name=scheduler: float(
                output(peer, f"--sched=ns3::{name}Scheduler", "--events=3000000").split(",")[6])
    found = medians(options.repeat, programs)
    best = max((rate for name, rate in found.items() if name.startswith("ns-3")), default=None)
    for name, rate in found.items():
        show(name, rate, "events/s", f"{rate / best:.2f} x the best of ns-3" if best else "")


def lockstep_exchange(program, processes, agents):
    """As ours: a listener on each side, and a topic for each process instead of one that all read.
    Both send 168 bytes of readings to each agent, and get one action back."""
    route = "batch" if agents > 1 else "topic"
    printed = output(program, f"procs={processes}", f"agents={processes * agents}",
                     f"route={route}", "disc=peers", "wait=listener", "ticks=5000",
                     "domain=101")  # one that our programs do not take
    return float(re.search(r"p50 +([\d.]+)", printed).group(1))


def exchange(options):
    """Microseconds of wall time, median of one run, and median of these."""
    ours = options.build / "tests/exchange_bench"
    peer = lockstep(options)
    for processes, agents in ((1, 1), (1, 37), (6, 1)):
        programs = {"ours": lambda p=processes, a=agents: float(
            re.search(r"median ([\d.]+) us", output(ours, 5000, p, a)).group(1))}
        if peer:
            programs["lockstep"] = lambda p=processes, a=agents: lockstep_exchange(peer, p, a)
        found = medians(options.repeat, programs)
        note = (f"{found['ours'] / found['lockstep']:.2f} x lockstep, {found['lockstep']:.4g} us"
                if peer else "")
        show(f"{processes} processes, {agents} agents each", found["ours"], "us", note)


def walker(options):
    """Nanoseconds that a datagram is looked at before Fast DDS gets it, and the share of an exchange."""
    bench, exchanges = options.build / "tests/walker_bench", options.build / "tests/exchange_bench"
    found = medians(options.repeat, {
        "a datagram": lambda: value(output(bench), "ns"),
        "datagrams": lambda: float(re.search(r"([\d.]+) datagrams", output(exchanges, 5000, 1, 1)).group(1)),
        "exchange": lambda: float(re.search(r"median ([\d.]+) us", output(exchanges, 5000, 1, 1)).group(1))})
    share = 0.1 * found["a datagram"] * found["datagrams"] / found["exchange"]
    show("validation and filter", found["a datagram"], "ns",
         f"x {found['datagrams']:.2f} datagrams: {share:.2f} % of {found['exchange']:.1f} us")


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
    peer = ode_speed(options)
    for model, wheels in enumerate(("jointed", "contact")):
        with tempfile.TemporaryDirectory(prefix="baraka-bench-") as folder:
            commands = {"ours": lambda seconds, w=wheels, f=folder: (
                baraka, "run", DRIVING, "--controllers", "in-process", "--out", f"{f}/run",
                "--until", seconds, "--set", f"agents.robots.wheels={w}")}
            for space, name in SPACES if peer else ():
                commands[name] = lambda seconds, m=model, s=space: (
                    peer, "n=12", "m=25", f"model={m}", f"space={s}", "prof=0", f"T={seconds}")
            found = medians(options.repeat, {
                name: lambda c=command: user_ms_per_second(100, 500, c)
                for name, command in commands.items()})
        for name, figure in found.items():
            note = "" if name == "ours" else f"ours: {found['ours'] / figure:.2f} x"
            show(f"{wheels}: {name}", figure, "ms/s", note)


BENCHES = {"event_queue": event_queue, "exchange": exchange, "walker": walker, "case_study": case_study,
           "driving": driving}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benches", nargs="*", metavar="BENCH")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--peer", type=pathlib.Path,
                        default=os.environ.get("BARAKA_PEER", SHARED / "peer"))
    parser.add_argument("--lockstep", type=pathlib.Path,
                        default=os.environ.get("BARAKA_LOCKSTEP", SHARED / "spikes/dds"))
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
