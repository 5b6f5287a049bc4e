#!/usr/bin/env python3
"""What the values that were calibrated, inferred or chosen do to the paper's figures: docs/sensitivity.md.

    tests/bench/sensitivity.py BIN FOLDER > docs/sensitivity.md

Runs config/campaigns/sensitivity.yaml and phases.yaml into FOLDER/sens and FOLDER/phases, or what is left of them;
BIN: the folder of `baraka`. A quarter of an hour of a processor, 1 GB. Not part of ./test.
"""
import collections
import contextlib
import math
import pathlib
import re
import sqlite3
import statistics
import subprocess
import sys

import pairs

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAMPAIGNS = ROOT / "config/campaigns"
SURE = 0.999  # level at which a difference is marked
SHIPPED = "jitter_max=100 ms"  # the first point
QUARTILES = ("Q1", "median", "Q3")
# Figure: the paper's value.
PAPER = {"discovery min": 0.96, "discovery Q1": 2.11, "discovery median": 10.27, "discovery Q3": 60.72, "discovery max": 10020,
         "delay min": 0.70, "delay Q1": 0.70, "delay median": 2.52, "delay Q3": 8.70, "delay max": 5660,
         "most packets": 427.2, "least packets": 184.8, "their ratio": 2.31}
OURS = ("run time s", "path m")  # which the paper does not tell
TABLES = {"Route discovery, ms": [one for one in PAPER if one.startswith("discovery")],
          "End-to-end delay, ms": [one for one in PAPER if one.startswith("delay")],
          "Packets per run, and the run": ["most packets", "least packets", "their ratio", *OURS]}


def ask(file, sql):
    with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as database:
        return database.execute(sql).fetchall()


def campaign(binary, name, out, *more):
    """Runs what is left of a campaign. @return its database."""
    done = subprocess.run([binary / "baraka", "campaign", CAMPAIGNS / f"{name}.yaml", "--out", out, "--jobs", "1", *more],
                          capture_output=True, text=True)
    if done.returncode not in (0, 3):
        raise SystemExit(done.stdout + done.stderr)
    return out / "campaign.sqlite"


def name_of(label):
    """Of a point, for a table: mappings are told by what they mean."""
    mote = re.search(r"agents: (m\d+), parameters: \{help_at", label)
    if label == SHIPPED:
        return f"as shipped: {label}"
    return f"{mote.group(1)} calls" if mote else label.replace("poses=[{x: 20 m, y: 0 m}]", "robot starts at (20, 0) m")


def measured(file):
    """{figure: value} of one run, and its packets by mote."""
    found = {}
    for name, sql in (("discovery", "SELECT took_ns / 1e6 FROM discoveries WHERE found"),
                      ("delay", "SELECT d.delay_ns / 1e6 FROM deliveries d JOIN messages m USING (sender, id) WHERE "
                                "m.destination < 65534")):
        times = [one for one, in ask(file, sql)]
        for part, share in (("min", 0), ("Q1", 0.25), ("median", 0.5), ("Q3", 0.75), ("max", 1)):
            found[f"{name} {part}"] = pairs.quantile(times, share)
        found[f"{name} long"], found[f"{name} all"] = sum(one > 1000 for one in times), len(times)
    found["run time s"] = ask(file, "SELECT value FROM run WHERE key = 'simulated_s'")[0][0]
    packets = dict(ask(file, "SELECT agent, sum(count) FROM packets JOIN agents USING (agent) WHERE name LIKE 'm%' GROUP BY "
                             "agent"))
    return found, packets


class Point:
    """All runs of one setting, in the order of their seeds."""

    def __init__(self, name, files, paths):
        self.name = name
        runs = [measured(file) for file in files]
        sums = collections.Counter()
        for _, packets in runs:
            sums.update(packets)
        # The motes that received most and least in all runs together, as in the paper's Fig. 12.
        most, least = max(sums, key=sums.get), min(sums, key=sums.get)
        self.values = collections.defaultdict(list)
        for (found, packets), path in zip(runs, paths):
            more = {"most packets": packets[most], "least packets": packets[least],
                    "their ratio": packets[most] / packets[least], "path m": path}
            for figure, value in {**found, **more}.items():
                self.values[figure].append(value)

    def value(self, figure):
        """Geometric mean over the runs; of a maximum, the longest of all."""
        if figure.endswith("max"):
            return max(self.values[figure])
        return statistics.geometric_mean(self.values[figure])

    def long(self, what):
        return sum(self.values[f"{what} long"]), sum(self.values[f"{what} all"])

    def differs(self, shipped, figure):
        """Whether the interval of its ratios to the shipped values, seed by seed, leaves out 1."""
        _, low, high = pairs.geometric_interval(self.ratios(shipped, figure), SURE)
        return low > 1 + 1e-9 or high < 1 - 1e-9

    def ratios(self, shipped, figure):
        return [a / b for a, b in zip(self.values[figure], shipped.values[figure])]

    def is_as(self, shipped):
        """Whether every figure of every run is the same, as far as it can be told."""
        return all(abs(one - 1) < 1e-3 for figure in (*PAPER, *OURS) for one in self.ratios(shipped, figure))

    def misfit(self):
        """Mean |ln(ours / paper)| of the six quartiles, as the report's replica score, here of means of runs."""
        return statistics.fmean(abs(math.log(self.value(one) / PAPER[one])) for one in PAPER
                                if one.split()[-1] in QUARTILES)


def digits(value):
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"


def cell(point, shipped, figure):
    value, low, high = pairs.geometric_interval(point.values[figure])
    text = f"{digits(value)} [{digits(low)}, {digits(high)}]"
    if high / low < 1 + 1e-9:
        text = digits(value)
    if figure.endswith("max"):
        text = digits(point.value(figure))
    return f"**{text}**" if point is not shipped and point.differs(shipped, figure) else text


def long_cell(point, kind):
    count, of = point.long(kind)
    low, high = (100 * one for one in pairs.wilson(count, of))
    return f"{count} of {of}: {max(low, 0):.1f} to {high:.1f} %"


def table(title, figures, points):
    shipped = points[0]
    what = title.split()[0] if title.startswith(("Route", "End")) else None
    kind = {"Route": "discovery", "End-to-end": "delay"}.get(what)
    heads = [one.removeprefix(f"{kind} ") for one in figures] + (["above 1 s"] if kind else ["misfit"])
    rows = [f"## {title}", "", "| setting | " + " | ".join(heads) + " |", "|---|" + "---|" * len(heads),
            "| the paper | " + " | ".join(str(PAPER.get(one, "-")) for one in figures) + " | - |"]
    for point in points:
        last = long_cell(point, kind) if kind else f"{point.misfit():.2f}"
        rows.append(f"| {point.name} | " + " | ".join(cell(point, shipped, one) for one in figures) + f" | {last} |")
    return "\n".join(rows)


def moves(points):
    """For each of the paper's figures: which settings move it, and where the nearest to the paper's is."""
    shipped, lines = points[0], []
    for figure, paper in PAPER.items():
        sure = [one.name for one in points[1:] if one.differs(shipped, figure)]
        nearest = min(points, key=lambda one: abs(math.log(one.value(figure) / paper)))
        lines.append(f"| {figure} | {paper} | {digits(shipped.value(figure))} | {digits(nearest.value(figure))}: {nearest.name} | "
                     f"{len(sure)} of {len(points) - 1}{': ' if sure else ''}{'; '.join(sure)} |")
    return "\n".join(["| figure | the paper | as shipped | closest | changed by (99.9 %) |", "|---|---|---|---|---|", *lines])


def points_of(file):
    paths = dict(ask(file, "SELECT run, value FROM measurements JOIN observables USING (observable) WHERE name = 'paths.mean'"))
    found = {}
    for run, label, folder, error in ask(file, "SELECT run, label, folder, error FROM runs JOIN points USING (point) ORDER BY "
                                               "point, replication"):
        if folder is None:
            raise SystemExit(f"{label}: run {run} was not kept, or failed: {error}")
        files, some = found.setdefault(label, ([], []))
        files.append(file.parent / folder / "run.sqlite")
        some.append(paths[run])
    return [Point(name_of(label), files, some) for label, (files, some) in found.items()]


PHASE_FIGURES = {"path of a robot, m": "paths.mean", "hops driven to on the way to a mote": "states.go_to_next_hop.entries",
                 "calls answered": "states.fulfilled.entries", "searches for a route": "discoveries.found",
                 "search, mean, s": "discoveries.time.mean", "search, p95, s": "discoveries.time.p95"}


def phase_values(file):
    """{figure: (aligned, uniform)}, each by seed; those of agents summed over them."""
    found = {}
    for figure, observable in PHASE_FIGURES.items():
        rows = ask(file, "SELECT label, (SELECT total(value) FROM measurements m JOIN observables o USING (observable) WHERE "
                         f"m.run = r.run AND o.name = '{observable}') FROM runs r JOIN points USING (point) ORDER BY point, "
                         "replication")
        found[figure] = tuple([value for label, value in rows if label.endswith(phase)] for phase in ("aligned", "uniform"))
    return found


def phase_table(values):
    rows = ["| of an hour | aligned | uniform | uniform - aligned, 95 % | p, paired t | p, signs |", "|---|---|---|---|---|---|"]
    for figure, (aligned, uniform) in values.items():
        mean, half, p = pairs.paired(aligned, uniform)
        rows.append(f"| {figure} | {statistics.fmean(aligned):.4g} | {statistics.fmean(uniform):.4g} | {mean:.4g} "
                    f"[{mean - half:.4g}, {mean + half:.4g}] | {p:.2g} | {pairs.sign_flip_p(aligned, uniform):.2g} |")
    return "\n".join(rows)


HEAD = """# Effect of the chosen values on the paper's figures

<!-- Written by tests/bench/sensitivity.py -->

The paper does not state how long first ants wait, how often a robot announces that it is coming, how searches are repeated, and which radio and
grid it used. `config/scenarios/case_study.yaml` has values that were calibrated (jitter, keep-alive, grid, range, the mote that calls),
inferred from the two least times (bit rate, RTS/CTS, frames without length), or chosen. Here each is varied alone, with seeds 1 to {runs}:

```
baraka campaign sensitivity
baraka report results/sensitivity
```

A cell is the geometric mean over {runs} runs of the run's own value with its 95 % interval (Student's t of the logarithms); the paper's
quartiles are of all ten runs together. *max* is the longest of all {runs} runs; *above 1 s* has Wilson's 95 % interval. **Bold**: the ratios to
the case study as it is shipped, seed by seed (of a maximum, those of the runs' maxima), have a 99.9 % interval without 1; of {cells}
comparisons {chance:.1f} would be marked by chance. *Misfit*: mean |ln(ours / paper)| of the six quartiles. The values shipped were chosen by
these figures: their closeness shows nothing, and other values that are closer in one figure are not preferable for that.
"""
PHASES = """## Phase of control, with twelve robots

`config/campaigns/phases.yaml`: the hour of `many_robots.yaml` (25 motes, twelve robots) with `control_phase: aligned`, all control cycles
at the same instants, and `uniform`, each agent's cycles at a phase of its own; {runs} seeds, the same for both. Paired t test and the exact test of
the signs of the differences, two-sided:

{table}

{verdict}

The reason: all robots hear a call at the same time and ask for the task at their next control instant. With aligned phase that is one instant
for all twelve. Their first ants are sent together and collide, searches are repeated seconds later, and the task goes to the robot whose
request gets through, not to one nearby, so it takes more hops to drive there. With uniform phase the robots ask one after the other within
100 ms. Jitter does not separate them: it delays agents that forward an ant, not those that start a search.
"""


def verdict_of(values):
    aligned, uniform = values["path of a robot, m"]
    mean, half, p = pairs.paired(aligned, uniform)
    share = 100 * mean / statistics.fmean(aligned)
    if p <= 0.05:
        return (f"With uniform phase a robot drives {abs(share):.0f} % {'less' if mean < 0 else 'more'} (p = {p:.2g}): the phase matters.\n"
                "A comparison of controllers of several robots should state its phase.")
    return f"A difference in the robots' paths is not shown (p = {p:.2g}); its interval allows {mean - half:.3g} to {mean + half:.3g} m."


def main():
    binary, folder = (pathlib.Path(one).resolve() for one in sys.argv[1:3])
    points = points_of(campaign(binary, "sensitivity", folder / "sens", "--set", "keep=all"))
    phases = phase_values(campaign(binary, "phases", folder / "phases"))
    runs = len(points[0].values["run time s"])
    cells = (len(points) - 1) * (len(PAPER) + len(OURS))
    print(HEAD.format(runs=runs, cells=cells, chance=cells * (1 - SURE)))
    same = [one.name for one in points[1:] if one.is_as(points[0])]
    print("## Which value changes which figure\n\n" + moves(points) + "\n")
    print(f"No figure of any run changes by a thousandth or more with: {'; '.join(same) or 'none of these'}.\n")
    for title, figures in TABLES.items():
        print(table(title, figures, points) + "\n")
    print(PHASES.format(runs=len(phases["path of a robot, m"][0]), table=phase_table(phases), verdict=verdict_of(phases)), end="")


if __name__ == "__main__":
    main()
