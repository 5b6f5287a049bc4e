"""The figure of division_of_labour: Fig. 15 of the paper, and the numbers that its page quotes.

tests/validation/validate.py --only division_of_labour prints them and draws the figure."""
import collections
import statistics

from document import pyplot
from runs import SCENARIOS

SEEDS = range(1, 11)
MOTE_TASKS, ROBOT_TASKS = ("temperature", "audio", "video", "help"), ("answer", "patrol", "idle")
HOUR = 3600  # s
EVERY = 60   # s between the points of a mean


def probabilities(run):
    """{agent: {task: [(time [s], P)]}}."""
    found = collections.defaultdict(lambda: collections.defaultdict(list))
    for agent, at, name, value in run.query(
            "SELECT a.name, r.at_ns / 1e9, r.name, r.value FROM recorded r JOIN agents a USING (agent) "
            "WHERE r.name LIKE 'p\\_%' ESCAPE '\\' ORDER BY r.rowid"):
        found[agent][name[2:]].append((at, value))
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


def tell(played):
    """Prints what the page says of the runs."""
    print(f"worst |sum - 1|: {max(worst_sum(one) for one in played):.1e}")
    print("| task | P at the end: mean | sd over agents | least | most |\n|---|---|---|---|---|")
    for letter, tasks in (("m", MOTE_TASKS), ("r", ROBOT_TASKS)):
        for task in tasks:
            ends = [steps[task][-1][1] for one in played for name, steps in one.items() if name.startswith(letter)]
            print(f"| {task} | {statistics.mean(ends):.3f} | {statistics.stdev(ends):.3f} | {min(ends):.3f} | "
                  f"{max(ends):.3f} |")
    # Specialised: the share of an agent's probability that its first task has.
    for letter, name in (("m", "motes"), ("r", "robots")):
        firsts = [max(steps[-1][1] for steps in tasks.values()) for one in played for agent, tasks in one.items()
                  if agent.startswith(letter)]
        print(f"{name}: P of the likeliest task at the end {statistics.mean(firsts):.3f}, "
              f"{min(firsts):.3f} to {max(firsts):.3f}")


def tell_outcomes(runs):
    totals = collections.Counter()
    for run in runs:
        for values in run.recorded().values():
            for name, value in values.items():
                if name.startswith(("succeeded_", "failed_")):
                    totals[name] += int(value)
    for task in MOTE_TASKS + ROBOT_TASKS:
        print(f"{task}: {totals['succeeded_' + task]} successes, {totals['failed_' + task]} failures")


def division_of_labour(runs):
    hours = [runs.play(SCENARIOS / "division_of_labour.yaml", {}, seed) for seed in SEEDS]
    played = [probabilities(run) for run in hours]
    tell(played)
    tell_outcomes(hours)
    plt = pyplot()
    figure, axes = plt.subplots(2, 4, figsize=(11, 5), sharex=True, sharey=True)
    axes[1][3].set_visible(False)
    times = range(0, HOUR + 1, EVERY)
    for row, (letter, tasks) in enumerate((("m", MOTE_TASKS), ("r", ROBOT_TASKS))):
        for axis, task in zip(axes[row], tasks):
            for number, (agent, steps) in enumerate(sorted(played[0].items())):
                if not agent.startswith(letter):
                    continue
                at, p = zip(*steps[task], (HOUR, steps[task][-1][1]))
                axis.step(at, p, where="post", linewidth=0.6, alpha=0.6, color=f"C{number % 10}")
            everybody = [steps[task] for one in played for agent, steps in one.items() if agent.startswith(letter)]
            axis.plot(times, [statistics.mean(value_at(one, time) for one in everybody) for time in times], "k",
                      linewidth=1.5)
            axis.set(title=f"{'motes' if letter == 'm' else 'robots'}: {task}", ylim=(0, 1), xlim=(0, HOUR))
    for axis in (*axes[0], *axes[1]):
        axis.set_xlabel("time, s")
    for row in axes:
        row[0].set_ylabel("probability")
    return figure
