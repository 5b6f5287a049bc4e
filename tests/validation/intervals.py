"""Means of seeds and the intervals of their differences."""
import math
import statistics


def quantile(freedom):
    """Of Student's t, 97.5 % (Abramowitz and Stegun, 26.7.5)."""
    z = statistics.NormalDist().inv_cdf(0.975)
    return z + (z ** 3 + z) / (4 * freedom) + (5 * z ** 5 + 16 * z ** 3 + 3 * z) / (96 * freedom ** 2)


def mean(values):
    """Mean and half of its 95 % interval."""
    if len(values) < 2:
        return values[0], math.inf
    return statistics.mean(values), quantile(len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))


def difference(ours, theirs):
    """Of the means, and half of its 95 % interval (Welch 1947)."""
    a, b = statistics.variance(ours) / len(ours), statistics.variance(theirs) / len(theirs)
    off = statistics.mean(ours) - statistics.mean(theirs)
    if a + b == 0:
        return off, 0.0
    freedom = (a + b) ** 2 / (a ** 2 / (len(ours) - 1) + b ** 2 / (len(theirs) - 1))
    return off, quantile(freedom) * math.sqrt(a + b)
