"""Whether agents specialise: a statistic of the probabilities that they end with, and what it would be if agents
exchanged their histories. docs/scenarios/division_of_labour.md says why; labour.py plays the runs.

A history is a list of (time [s], task, whether it was a success), in order of time."""
import bisect
import math
import random
import statistics

# The weights of config/tasks, and the rule `fixed`. Replayed histories are compared with what was recorded.
INITIAL, LEAST, MOST, STEP, EXPONENT = 0.5, 0.1, 1.0, 0.05, 2
HOUR, BLOCK, SETTLED = 3600, 600, 1800  # s: of a run; of what is exchanged; from when on probabilities are averaged


def probabilities(weights):
    powers = [weight ** EXPONENT for weight in weights]
    return [one / sum(powers) for one in powers]


def learnt(weights, task, succeeded):
    """Weights after an outcome."""
    moved = list(weights)
    moved[task] = min(MOST, max(LEAST, round(weights[task] + (STEP if succeeded else -STEP), 9)))
    return tuple(moved)


def blocks_of(history, block=BLOCK, end=HOUR):
    """The history cut into pieces of equal time; an outcome at a cut belongs to the earlier one, one at 0 to the first."""
    pieces = [[] for _ in range(math.ceil(end / block))]
    for one in history:
        pieces[max(0, math.ceil(one[0] / block) - 1)].append(one)
    return pieces


class Replay:
    """Plays histories that are made of blocks. What a block does to weights is computed once."""

    def __init__(self, tasks, block=BLOCK, end=HOUR, settled=SETTLED):
        self.tasks, self.block, self.end, self.settled, self.known = tasks, block, end, settled, {}

    def through(self, weights, number, key, block):
        """@return weights after a block, and P of each task summed over its time after `settled`."""
        found = self.known.get((key, weights))
        if found is None:
            found = self.known[key, weights] = self.played(weights, number, block)
        return found

    def played(self, weights, number, block):
        total, since, now = [0.0] * self.tasks, number * self.block, weights
        stop = min(self.end, (number + 1) * self.block)
        for at, task, succeeded in [*block, (stop, None, None)]:
            time = max(0.0, at - max(since, self.settled))
            if time > 0:
                total = [old + time * p for old, p in zip(total, probabilities(now))]
            since = at
            if task is not None:
                now = learnt(now, task, succeeded)
        return now, total

    def history(self, blocks, keys):
        """@return mean P of each task after `settled`, and P of each at the end."""
        weights, total = (INITIAL,) * self.tasks, [0.0] * self.tasks
        for number, (block, key) in enumerate(zip(blocks, keys)):
            weights, more = self.through(weights, number, key, block)
            total = [old + one for old, one in zip(total, more)]
        return [one / (self.end - self.settled) for one in total], probabilities(weights)


def dispersion(values, classes):
    """Variance of P between the agents of a class, summed over tasks: sum of squares about the class's mean over the
    number of agents less the number of classes. @param values  P of each task, by agent. @param classes  lists of
    places in `values`."""
    squares = 0.0
    for members in classes:
        for task in zip(*(values[one] for one in members)):
            mean = math.fsum(task) / len(task)
            squares += math.fsum((one - mean) ** 2 for one in task)
    return squares / (len(values) - len(classes))


class Population:
    """The agents of one kind in one run."""

    def __init__(self, histories, tasks, classes=None, **times):
        """@param histories  by agent. @param classes  of agents that may exchange their blocks; default: all."""
        self.replay = Replay(tasks, **times)
        self.blocks = [blocks_of(one, self.replay.block, self.replay.end) for one in histories]
        self.classes = classes or [list(range(len(histories)))]

    def measured(self, owners):
        """@param owners  by number of the block: whose block each agent is given. @return the dispersion, and the final
        P of each agent."""
        means, ends = [], []
        for agent in range(len(self.blocks)):
            keys = [(owner[agent], number) for number, owner in enumerate(owners)]
            mean, end = self.replay.history([self.blocks[owner][number] for owner, number in keys], keys)
            means.append(mean)
            ends.append(end)
        return dispersion(means, self.classes), ends

    def observed(self):
        everyone = list(range(len(self.blocks)))
        return self.measured([everyone] * len(self.blocks[0]))

    def exchanged(self, chance):
        """In each block of time, the agents of a class get one another's histories of that block, at random."""
        owners = []
        for _ in self.blocks[0]:
            owner = [0] * len(self.blocks)
            for members in self.classes:
                for place, one in zip(members, chance.sample(members, len(members))):
                    owner[place] = one
            owners.append(owner)
        return self.measured(owners)


def p_of(observed, null):
    """One-sided: how often chance gives as much, the observation counted among it."""
    return (1 + sum(one >= observed for one in null)) / (1 + len(null))


def holm(ps):
    """Adjusted p values (Holm 1979), in the order given."""
    adjusted, least = [0.0] * len(ps), 0.0
    for rank, place in enumerate(sorted(range(len(ps)), key=lambda i: ps[i])):
        least = max(least, min(1.0, (len(ps) - rank) * ps[place]))
        adjusted[place] = least
    return adjusted


def convex_hull(points, sign):
    """Greatest convex minorant (sign 1) or least concave majorant (-1) of points in order of x."""
    hull = []
    for x, y in points:
        while len(hull) > 1 and sign * ((hull[-1][1] - hull[-2][1]) * (x - hull[-2][0])
                                        - (y - hull[-2][1]) * (hull[-1][0] - hull[-2][0])) >= 0:
            hull.pop()
        hull.append((x, y))
    return hull


def height(hull, x):
    """Of a hull at x."""
    place = bisect.bisect_right(hull, (x, math.inf)) - 1
    if place + 1 >= len(hull):
        return hull[-1][1]
    (x0, y0), (x1, y1) = hull[place], hull[place + 1]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def dip(values):
    """Greatest distance between the empirical distribution function and the unimodal one that is nearest to it
    (J. A. Hartigan, P. M. Hartigan, "The Dip Test of Unimodality", Annals of Statistics 13, 1985)."""
    values = sorted(values)
    places = sorted(set(values))
    below = [bisect.bisect_left(values, x) / len(values) for x in places]
    upto = [bisect.bisect_right(values, x) / len(values) for x in places]
    low, high, found = 0, len(places) - 1, 1 / len(values)
    while low < high:
        some = range(low, high + 1)
        minorant = convex_hull([(places[i], below[i]) for i in some], 1)
        majorant = convex_hull([(places[i], upto[i]) for i in some], -1)
        gaps = [height(majorant, places[i]) - height(minorant, places[i]) for i in some]
        widest = max(gaps)
        if widest <= found:
            break
        at_minorant, at_majorant = ({x for x, _ in hull} for hull in (minorant, majorant))
        place = low + gaps.index(widest)
        lows = [i for i in some if places[i] in at_minorant]
        highs = [i for i in some if places[i] in at_majorant]
        if places[place] in at_minorant:
            new_low, new_high = place, min(i for i in highs if i >= place)
        else:
            new_low, new_high = max(i for i in lows if i <= place), place
        # A unimodal distribution may have an atom at its mode: there, F is met from the side of the tail.
        found = max([found, *(upto[i] - height(minorant, places[i]) for i in range(low, new_low)),
                     below[new_low] - height(minorant, places[new_low]),
                     height(majorant, places[new_high]) - upto[new_high],
                     *(height(majorant, places[i]) - below[i] for i in range(new_high + 1, high + 1))])
        if (new_low, new_high) == (low, high):
            break
        low, high = new_low, new_high
    return found / 2


def ranks(values):
    """From 1; equal values share the mean of theirs."""
    order = sorted(values)
    return [(bisect.bisect_left(order, one) + bisect.bisect_right(order, one) + 1) / 2 for one in values]


def rank_correlation(first, second):
    """Spearman's."""
    return statistics.correlation(ranks(first), ranks(second))


def share_between(values, classes):
    """Share of the variance of values that lies between the classes (eta squared)."""
    mean = statistics.fmean(values)
    between = sum(len(one) * (statistics.fmean(values[i] for i in one) - mean) ** 2 for one in classes)
    return between / sum((one - mean) ** 2 for one in values)


class Verdict:
    """Of one hypothesis, over all runs."""

    def __init__(self, populations, shuffles, seed):
        chance = random.Random(seed)
        self.observed = [one.observed() for one in populations]
        self.null = [[one.exchanged(chance) for one in populations] for _ in range(shuffles)]

    def dispersions(self):
        return [one for one, _ in self.observed]

    def chances(self):
        """Mean dispersion of each run, its blocks exchanged."""
        return [statistics.fmean(shuffle[run][0] for shuffle in self.null) for run in range(len(self.observed))]

    def p(self):
        """Of the mean dispersion of all runs."""
        return p_of(statistics.fmean(self.dispersions()),
                    [statistics.fmean(one for one, _ in shuffle) for shuffle in self.null])

    def ratios(self):
        """Of each run: logarithm of its dispersion over that by chance."""
        return [math.log(seen / chance) for seen, chance in zip(self.dispersions(), self.chances())]

    def final(self, task):
        """Final P of a task of all agents of all runs, as observed and by chance."""
        def pooled(runs):
            return [p[task] for _, ends in runs for p in ends]
        return pooled(self.observed), [pooled(one) for one in self.null]
