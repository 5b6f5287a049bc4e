"""Means of runs and differences of settings with the same seeds, as docs/statistics.md has them: Student's t."""
import functools
import math
import statistics


def t_density(x, df):
    log = math.lgamma((df + 1) / 2) - math.lgamma(df / 2) - 0.5 * math.log(df * math.pi)
    return math.exp(log - (df + 1) / 2 * math.log1p(x * x / df))


def t_between(limit, df, steps=2000):
    """Probability of |t| < limit, by Simpson's rule."""
    width = limit / steps
    inner = sum((4 if i % 2 else 2) * t_density(i * width, df) for i in range(1, steps))
    return 2 * width / 3 * (t_density(0, df) + inner + t_density(limit, df))


@functools.lru_cache
def t_quantile(level, df):
    """The limit of |t| with that probability, by bisection."""
    low, high = 0.0, 1.0
    while t_between(high, df) < level:
        high *= 2
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if t_between(middle, df) < level else (low, middle)
    return high


def mean_interval(values, level=0.95):
    """Mean, and half of its interval; none with one value."""
    if len(values) < 2:
        return statistics.fmean(values), math.inf
    half = t_quantile(level, len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))
    return statistics.fmean(values), half


def geometric_interval(values, level=0.95):
    """Geometric mean of positive values, and the limits of its interval: Student's t of their logarithms."""
    mean, half = mean_interval([math.log(one) for one in values], level)
    return math.exp(mean), math.exp(mean - half), math.exp(mean + half)


def paired(first, second):
    """Mean of the differences second - first, half of its 95 % interval, and p of the paired t test, two-sided."""
    differences = [b - a for a, b in zip(first, second, strict=True)]
    mean, half = mean_interval(differences)
    deviation = statistics.stdev(differences)
    if deviation == 0:
        return mean, half, 1.0 if mean == 0 else 0.0
    t = abs(mean) / (deviation / math.sqrt(len(differences)))
    return mean, half, max(0.0, 1 - t_between(t, len(differences) - 1))


def sign_flip_p(first, second):
    """p of the exact test that each difference might as well have the other sign, two-sided: the share of all 2^n choices
    of signs whose sum is at least as far from 0. Sums are counted on a grid of 1e-6 of the sum of all."""
    differences = [abs(b - a) for a, b in zip(first, second, strict=True)]
    total = sum(differences)
    if total == 0:
        return 1.0
    whole = [round(one / total * 1e6) for one in differences]
    seen = abs(sum(w if b > a else -w for w, a, b in zip(whole, first, second)))
    counts = {0: 1}
    for one in whole:
        more = {}
        for old, count in counts.items():
            for new in (old + one, old - one):
                more[new] = more.get(new, 0) + count
        counts = more
    return sum(count for at, count in counts.items() if abs(at) >= seen) / 2 ** len(whole)


def quantile(values, share):
    """Type 7 of Hyndman and Fan, as the report has it."""
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = math.floor(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def wilson(count, of, level=0.95):
    """Interval of a share (Wilson 1927)."""
    z = statistics.NormalDist().inv_cdf((1 + level) / 2)
    share, more = count / of, z * z / of
    middle, half = share + more / 2, z * math.sqrt(share * (1 - share) / of + more / of / 4)
    return (middle - half) / (1 + more), (middle + half) / (1 + more)
