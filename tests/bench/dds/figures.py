"""Numbers from samples, and tables of them."""
import math
import random

RESAMPLES = 2000


def quantile(values, share):
    """Of sorted values, by linear interpolation between order statistics (Hyndman and Fan's type 7)."""
    at = share * (len(values) - 1)
    low = math.floor(at)
    high = min(low + 1, len(values) - 1)
    return values[low] + (at - low) * (values[high] - values[low])


def interval(values, statistic, seed=1, resamples=RESAMPLES):
    """95 % percentile bootstrap of statistic(sorted values). Efron, Tibshirani, An Introduction to the Bootstrap,
    1993, chapter 13."""
    stream = random.Random(seed)
    found = sorted(statistic(sorted(stream.choices(values, k=len(values)))) for _ in range(resamples))
    return quantile(found, 0.025), quantile(found, 0.975)


def blocks_interval(blocks, statistic, seed=1, resamples=RESAMPLES):
    """The same where the values of a block depend on each other, as the samples of one writer do: whole blocks are
    drawn."""
    stream = random.Random(seed)
    found = []
    for _ in range(resamples):
        drawn = [value for block in stream.choices(blocks, k=len(blocks)) for value in block]
        if drawn:
            found.append(statistic(sorted(drawn)))
    found.sort()
    return quantile(found, 0.025), quantile(found, 0.975)


def median(values):
    return quantile(values, 0.5)


def growth_exponent(pairs):
    """Slope of log y over log x by least squares, and its standard error (None for two points)."""
    points = [(math.log(x), math.log(y)) for x, y in pairs]
    count = len(points)
    mean_x, mean_y = (sum(one[i] for one in points) / count for i in (0, 1))
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread
    if count < 3:
        return slope, None
    rest = sum((y - mean_y - slope * (x - mean_x)) ** 2 for x, y in points)
    return slope, math.sqrt(rest / (count - 2) / spread)


def not_dominated(rows, keys):
    """Of dictionaries, those that no other beats in one of `keys` without being worse in another. keys: {name: +1 if
    more is better, -1 if less}. A row that lacks a value of them is dominated."""
    def values(row):
        return [sign * row[key] for key, sign in keys.items()]

    whole = [row for row in rows if all(row.get(key) is not None for key in keys)]
    return [row for row in whole
            if not any(all(a >= b for a, b in zip(values(other), values(row))) and values(other) != values(row)
                       for other in whole)]


def number(value, digits=3):
    """As people read it."""
    if value is None:
        return "-"
    if isinstance(value, (bool, str)):
        return str(value)
    if isinstance(value, int) or value == 0:
        return str(value)
    places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{places}f}"


def with_interval(value, ends, digits=3):
    return f"{number(value, digits)} ({number(ends[0], digits)} … {number(ends[1], digits)})"


def table(columns, rows):
    """Markdown. Numbers are to the right."""
    cells = [[number(one) for one in row] for row in rows]
    widths = [max(len(line[i]) for line in [columns, *cells]) for i in range(len(columns))]
    right = [all(not isinstance(row[i], str) for row in rows) for i in range(len(columns))]

    def line(words):
        return "| " + " | ".join(word.rjust(width) if is_right else word.ljust(width)
                                 for word, width, is_right in zip(words, widths, right)) + " |"
    rule = "|" + "|".join("-" * (width + 1) + (":" if is_right else "-") for width, is_right in zip(widths, right)) + "|"
    return "\n".join([line(columns), rule, *map(line, cells)])
