"""The figure of division_of_labour, and what its page says of the runs: Fig. 15 of the paper, and whether agents
specialise (specialisation.py).

tests/validation/validate.py --only division_of_labour plays the runs, draws the figure and writes the measured part of
docs/scenarios/division_of_labour.md."""
import collections
import math
import re
import statistics

import specialisation
from chart import BLACK, Chart, Panel, axis
from runs import ROOT, SCENARIOS
from specialisation import HOUR, Population, Verdict

PAGE = ROOT / "docs/scenarios/division_of_labour.md"
FIRST, LAST = "<!-- Measured: written by tests/validation/labour.py -->", "<!-- End of what is measured -->"
SEEDS = range(101, 121)
MOTE_TASKS, ROBOT_TASKS = ("temperature", "audio", "video", "help"), ("answer", "patrol", "idle")
EVERY = 60            # s between the points of a mean
SHUFFLES = 1999
NEAR = 0.05           # of a last value
LITTLE = 0.2          # of a probability
T_95 = {9: 2.2622, 19: 2.0930}  # Student's t, by degrees of freedom
CONTROL_SEEDS = SEEDS[:10]
NO_LEARNING = {"agents.motes.controller.parameters.weights.step": 0, "agents.robots.controller.parameters.weights.step": 0}
COLUMNS, CELL, SINK, REACH = 5, 125, 12, 250.2  # of the grid: m, the sink's number, m
KINDS = {"motes": ("m", MOTE_TASKS), "robots": ("r", ROBOT_TASKS)}
NOT_CALLED, UNDER_WAY, ANSWERED, GIVEN_UP = "not called yet", "under way", "answered", "given up"


def distance(mote):
    """To the sink, m."""
    return CELL * math.hypot(mote % COLUMNS - SINK % COLUMNS, mote // COLUMNS - SINK // COLUMNS)


def rings():
    """Numbers of the motes by their hops to the sink: itself, those in its reach, and the others."""
    found = [[SINK], [], []]
    for mote in range(COLUMNS ** 2):
        if mote != SINK:
            found[1 if distance(mote) < REACH else 2].append(mote)
    return found


def number_of(agent):
    return int(agent[1:])


def probabilities(run):
    """{agent: {task: [(time [s], P)]}}."""
    found = {}
    for agent, at, name, value in run.query(
            "SELECT a.name, r.at_ns / 1e9, r.name, r.value FROM recorded r JOIN agents a USING (agent) "
            "WHERE r.name LIKE 'p\\_%' ESCAPE '\\' ORDER BY r.rowid"):
        found.setdefault(agent, {}).setdefault(name[2:], []).append((at, value))
    return found


def histories(run):
    """{agent: [(time [s], task, whether it succeeded)]}. A count that is no higher than before is the one at the end."""
    found, counts = collections.defaultdict(list), collections.Counter()
    for agent, at, name, value in run.query(
            "SELECT a.name, r.at_ns / 1e9, r.name, r.value FROM recorded r JOIN agents a USING (agent) "
            "WHERE r.name LIKE 'succeeded\\_%' ESCAPE '\\' OR r.name LIKE 'failed\\_%' ESCAPE '\\' ORDER BY r.rowid"):
        if value > counts[agent, name]:
            outcome, task = name.split("_", 1)
            found[agent].append((at, task, outcome == "succeeded"))
        counts[agent, name] = value
    return found


def value_at(steps, time):
    """Of a step function that was recorded when it moved."""
    value = steps[0][1]
    for at, one in steps:
        if at > time:
            break
        value = one
    return value


def worst_sum(agents):
    """Largest |sum of P - 1| at any time at which one moved."""
    sums = [sum(values) for tasks in agents.values() for values in zip(*([p for _, p in one] for one in tasks.values()))]
    return max(abs(one - 1) for one in sums)


def calls(run):
    """How the needs for help of an hour stand at its end."""
    rows = run.query("SELECT agent, at_ns, 1, 'NEED' FROM recorded WHERE name = 'needs' UNION ALL SELECT agent, at_ns, 2, "
                     "state FROM states JOIN agents USING (agent) WHERE kind = 'mote' ORDER BY 1, 2, 3")
    ended, current = collections.Counter(), {}
    for mote, _, _, what in rows:
        if what == "NEED":
            current.setdefault(mote, NOT_CALLED)
        elif mote in current and what in ("REQUEST", "WAIT"):
            current[mote] = UNDER_WAY
        elif current.get(mote) == UNDER_WAY and what in ("FULFILLED", "GAVE_UP"):
            ended[ANSWERED if what == "FULFILLED" else GIVEN_UP] += 1
            del current[mote]
    return ended + collections.Counter(current.values())


class Hour:
    """What a run says of its agents."""

    def __init__(self, run, learns=True):
        """@param learns  whether the weights of its agents move; if so, replayed histories must give the recorded P."""
        self.learns = learns
        self.probabilities, self.histories, self.calls = probabilities(run), histories(run), calls(run)

    def agents(self, kind):
        letter, _ = KINDS[kind]
        return sorted((one for one in self.probabilities if one.startswith(letter)), key=number_of)

    def final(self, agent, task):
        return self.probabilities[agent][task][-1][1]

    def population(self, kind, classes=None):
        _, tasks = KINDS[kind]
        agents = self.agents(kind)
        numbered = [[(at, tasks.index(task), ok) for at, task, ok in self.histories[one]] for one in agents]
        population = Population(numbered, len(tasks), classes)
        for agent, ends in zip(agents, population.observed()[1] if self.learns else ()):
            for task, replayed in zip(tasks, ends):
                if abs(replayed - self.final(agent, task)) > 1e-12:
                    raise SystemExit(f"{agent}, {task}: P is {self.final(agent, task)} and {replayed} when replayed")
        return population


def interval(values):
    """Mean and half of its 95 % interval, over runs."""
    return statistics.fmean(values), T_95[len(values) - 1] * statistics.stdev(values) / math.sqrt(len(values))


def probability_table(hours):
    rows = ["| task | mean | sd | least | most |", "|---|---|---|---|---|"]
    for kind, (_, tasks) in KINDS.items():
        for task in tasks:
            ends = [hour.final(agent, task) for hour in hours for agent in hour.agents(kind)]
            rows.append(f"| {task} | {statistics.fmean(ends):.3f} | {statistics.stdev(ends):.3f} | {min(ends):.3f} | "
                        f"{max(ends):.3f} |")
    return "\n".join(rows)


def outcome_table(hours):
    counts = collections.Counter((task, ok) for hour in hours for one in hour.histories.values() for _, task, ok in one)
    rows = ["| task | successes | failures | share of successes |", "|---|---|---|---|"]
    for task in MOTE_TASKS + ROBOT_TASKS:
        done, failed = counts[task, True], counts[task, False]
        rows.append(f"| {task} | {done} | {failed} | {done / (done + failed):.3f} |")
    return "\n".join(rows)


HYPOTHESES = {
    "H1: motes, all alike": ("motes", None),
    "H2: motes at the same hops from the sink": ("motes", rings()),
    "H3: robots": ("robots", None)}


def verdicts(hours):
    return {name: Verdict([hour.population(kind, classes) for hour in hours], SHUFFLES, seed=15)
            for name, (kind, classes) in HYPOTHESES.items()}


def verdict_table(found):
    ps = [one.p() for one in found.values()]
    rows = ["| hypothesis | D, mean of the runs | D with exchanged blocks | ratio, 95 % | above 1 in | p | p, Holm | at 0.05 |",
            "|---|---|---|---|---|---|---|---|"]
    for (name, one), p, adjusted in zip(found.items(), ps, specialisation.holm(ps)):
        ratios = one.ratios()
        mean, half = interval(ratios)
        rows.append(f"| {name} | {statistics.fmean(one.dispersions()):.6f} | {statistics.fmean(one.chances()):.6f} | "
                    f"{math.exp(mean):.3f} [{math.exp(mean - half):.3f}, {math.exp(mean + half):.3f}] | "
                    f"{sum(ratio > 0 for ratio in ratios)} of {len(ratios)} runs | {p:.4f} | "
                    f"{adjusted:.4f} | {'specialise' if adjusted <= 0.05 else 'not shown'} |")
    return "\n".join(rows)


def dip_row(verdict, tasks, task):
    seen, null = verdict.final(tasks.index(task))
    dips = [specialisation.dip(one) for one in null[:999]]
    found = specialisation.dip(seen)
    return f"P({task}), {len(seen)} agents: dip {found:.4f}, exchanged {statistics.fmean(dips):.4f}, p = " \
           f"{specialisation.p_of(found, dips):.3f}"


def last_moves(hours, kind):
    """When each agent's P moved last, s."""
    return [max(steps[-1][0] for steps in hour.probabilities[one].values()) for hour in hours for one in hour.agents(kind)]


def settled_at(steps):
    """From when on P stays within NEAR of its last value, s."""
    for at, p in reversed(steps):
        if abs(p - steps[-1][1]) > NEAR:
            return next(later for later, _ in steps if later > at)
    return 0.0


def settled(hours, kind):
    return [max(settled_at(steps) for steps in hour.probabilities[one].values()) for hour in hours
            for one in hour.agents(kind)]


def sampling_frozen_at(hours):
    """When each mote's weights of the three tasks that sample moved last, s: help is done once an hour."""
    moved = []
    for hour in hours:
        for agent in hour.agents("motes"):
            weights, last = (specialisation.INITIAL,) * 3, 0.0
            for at, task, ok in hour.histories[agent]:
                if task != "help":
                    after = specialisation.learnt(weights, MOTE_TASKS.index(task), ok)
                    last, weights = (at if after != weights else last), after
            moved.append((last, weights))
    return moved


def freeze_text(hours):
    frozen = sampling_frozen_at(hours)
    times = [at / 60 for at, _ in frozen]
    bounds = sum(all(one in (specialisation.LEAST, specialisation.MOST) for one in weights) for _, weights in frozen)
    most = max(hour.final(agent, task) for hour in hours for agent in hour.agents("motes") for task in MOTE_TASKS)
    quartiles = statistics.quantiles(times, n=4, method="inclusive")
    robots = [at / 60 for at in last_moves(hours, "robots")]
    still, moving = (statistics.median(at / 60 for at in settled(hours, kind)) for kind in KINDS)
    return (f"Motes: the weights of temperature, audio and video moved last at a median of {quartiles[1]:.1f} minutes "
            f"(quartiles {quartiles[0]:.1f} and {quartiles[2]:.1f}, most {max(times):.1f}); {bounds} of {len(frozen)} motes "
            f"end with all three at a bound. Every P of a mote stays within {NEAR} of its last value from a median of "
            f"{still:.1f} minutes on. The greatest P of any mote at the end is {most:.3f}. Robots: P moved last at a median "
            f"of {statistics.median(robots):.1f} minutes, and stays within {NEAR} of its last value from {moving:.1f} minutes "
            f"on.")


def place_text(hours):
    metres, classes = [distance(one) for one in range(COLUMNS ** 2)], rings()
    video = [[hour.final(agent, "video") for agent in hour.agents("motes")] for hour in hours]
    rho = interval([specialisation.rank_correlation(metres, one) for one in video])
    share = interval([specialisation.share_between(one, classes) for one in video])
    near = [one[i] for one in video for i in classes[0] + classes[1]]
    far = [one[i] for one in video for i in classes[2]]
    lost = {seed: [f"m{i}" for i in classes[1] if one[i] < LITTLE] for seed, one in zip(SEEDS, video)}
    told = "; ".join(f"seed {seed}: {', '.join(motes)}" for seed, motes in lost.items() if motes)
    return (f"P(video) at the end and a mote's distance to the sink: Spearman's rho {rho[0]:.3f} ± {rho[1]:.3f} (mean of 20 "
            f"runs, 95 %). {100 * share[0]:.2f} ± {100 * share[1]:.2f} % of its variance lie between the three classes of "
            f"hops. In reach of the sink, itself among them, it is {min(near):.3f} to {max(near):.3f} ({len(near)} motes), "
            f"beyond {min(far):.3f} to {max(far):.3f} ({len(far)}). Below {LITTLE} in reach of the sink: "
            f"{sum(len(motes) for motes in lost.values())} motes ({told or 'none'}).")


def robot_text(hours, verdict):
    answers = [hour.final(agent, "answer") for hour in hours for agent in hour.agents("robots")]
    few = sum(one < LITTLE for one in answers)
    return (f"Robots: P(answer) is below {LITTLE} for {few} of {len(answers)}, above 0.5 for "
            f"{sum(one > 0.5 for one in answers)}. {dip_row(verdict, ROBOT_TASKS, 'answer')}; "
            f"{dip_row(verdict, ROBOT_TASKS, 'patrol')}; {dip_row(verdict, ROBOT_TASKS, 'idle')}.")


def call_text(hours):
    found = sum((hour.calls for hour in hours), collections.Counter())
    ended = found[ANSWERED] + found[GIVEN_UP]
    return (f"Of {sum(found.values())} needs for help in {len(hours)} hours {ended} had ended with the hour: "
            f"{found[ANSWERED]} were answered and {found[GIVEN_UP]} given up. {found[UNDER_WAY]} were under way, and "
            f"{found[NOT_CALLED]} had not been called out yet.")


def measured(hours, control):
    """The part of the page that the runs decide."""
    found = verdicts(hours)
    motes, _, robots = found.values()
    return "\n\n".join([
        f"Seeds {SEEDS[0]} to {SEEDS[-1]}; {SHUFFLES} exchanges of all runs.", verdict_table(found),
        f"The control, agents that learn nothing, seeds {CONTROL_SEEDS[0]} to {CONTROL_SEEDS[-1]}:",
        verdict_table(verdicts(control)),
        "P at the end of the hour, over all agents of these runs:", probability_table(hours),
        "What came of the tasks:", outcome_table(hours),
        "\n".join(f"* {one}" for one in (freeze_text(hours), place_text(hours), dip_row(motes, MOTE_TASKS, "video") + ".",
                                         robot_text(hours, robots), call_text(hours)))])


def write(text):
    page = PAGE.read_text(encoding="utf-8")
    pattern = re.compile(re.escape(FIRST) + ".*" + re.escape(LAST), re.S)
    PAGE.write_text(pattern.sub(lambda _: f"{FIRST}\n\n{text}\n\n{LAST}", page), encoding="utf-8")


def division_of_labour(runs):
    scenario = SCENARIOS / "division_of_labour.yaml"
    hours = [Hour(runs.play(scenario, {}, seed)) for seed in SEEDS]
    control = [Hour(runs.play(scenario, NO_LEARNING, seed), learns=False) for seed in CONTROL_SEEDS]
    print(f"worst |sum of P - 1|: {max(worst_sum(one.probabilities) for one in hours):.1e}")
    write(measured(hours, control))
    return figure_of(hours)


def figure_of(hours):
    panels, times = [], range(0, HOUR + 1, EVERY)
    for kind, (_, tasks) in KINDS.items():
        for task in tasks:
            panel = Panel(f"{kind}: {task}", axis("time, s", limits=(0, HOUR)), axis("probability", limits=(0, 1)))
            for agent in hours[0].agents(kind):
                steps = hours[0].probabilities[agent][task]
                at, p = zip(*steps, (HOUR, steps[-1][1]))
                panel.line(at, p, stepped=True, curve=number_of(agent), stroke=0.6, opacity=0.6)
            everybody = [hour.probabilities[agent][task] for hour in hours for agent in hour.agents(kind)]
            panel.line(times, [statistics.fmean(value_at(one, time) for one in everybody) for time in times], curve=BLACK)
            panels.append(panel)
    return Chart(*panels, title="Probabilities of the tasks", columns=4, size=(1056, 480))
