"""What Cyclone DDS's ddsperf prints."""
import dataclasses
import re

PING = re.compile(r"^\[\d+\] (?P<at>[\d.]+) +\S+ size (?P<size>\d+) mean (?P<mean>[\d.]+)us min (?P<least>[\d.]+)us "
                  r"50% (?P<median>[\d.]+)us 90% (?P<p90>[\d.]+)us "
                  r"99% (?P<p99>[\d.]+)us max (?P<most>[\d.]+)us cnt (?P<count>\d+)")
SUB = re.compile(r"^\[\d+\] (?P<at>[\d.]+) +size \d+ total (?P<total>\d+) lost (?P<lost>\d+) delta")
OTHER = re.compile(r"^\[\d+\] participant (\S+): new$")


@dataclasses.dataclass
class RoundTrips:
    """Of one second, to one other program. Times in s."""
    at: float  # since the program's start
    count: int
    least: float
    median: float
    p90: float
    p99: float
    most: float


def round_trips(text):
    """It prints half of each, as the time of one way."""
    return [RoundTrips(float(found["at"]), int(found["count"]), *(2e-6 * float(found[key])
                                                                   for key in ("least", "median", "p90", "p99", "most")))
            for found in map(PING.match, text.splitlines()) if found]


def received(text):
    """[(s since the program's start, samples received, lost)], in sum, of each second."""
    return [(float(found["at"]), int(found["total"]), int(found["lost"]))
            for found in map(SUB.match, text.splitlines()) if found]


def others(text):
    """Participants that it found, itself left out."""
    return {found.group(1) for found in map(OTHER.match, text.splitlines()) if found}
