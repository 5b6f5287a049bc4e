"""Figures of the pages of docs/scenarios whose programs have sockets: they run in real time, so that no two figures are
quite the same. Needs Cyclone's ddsperf (Debian: cyclonedds-tools) and the right to make user namespaces."""
import collections
import sys

from document import pyplot
from runs import ROOT, SCENARIOS

sys.path.append(str(ROOT / "tests/e2e"))
import ddsperf  # noqa: E402

PURPOSES = {"user": "samples, heartbeats, acknowledgements of programs", "SPDP": "SPDP: participants",
            "SEDP": "SEDP: their endpoints", "liveliness": "liveliness", "802.11": "802.11's acknowledgements",
            "network": "ARP, ICMPv6, IGMP"}


def play(runs, name, settings):
    """Slower than real time, so that the figure shows the radio and not how busy the machine was."""
    return runs.play(SCENARIOS / f"{name}.yaml", settings, more=("--pace", "realtime:0.25"))


def said(run, program):
    return (run.file.parent / f"{program}.log").read_text()


def draw_round_trips(axis, seconds, colour, name, shift=0.0):
    """Median and the range from least to 90 % of each second, ms."""
    at = [one.at - 0.5 + shift for one in seconds]
    axis.errorbar(at, [1e3 * one.median for one in seconds],
                  [[1e3 * (one.median - one.least) for one in seconds], [1e3 * (one.p90 - one.median) for one in seconds]],
                  fmt="o", color=colour, markersize=3, capsize=2, label=name)


def air_by_purpose(run):
    """{purpose: {second: share of the second}}."""
    found = collections.defaultdict(dict)
    for second, purpose, airtime in run.query("SELECT second, purpose, sum(airtime_ns) FROM air_seconds GROUP BY 1, 2"):
        found[purpose][second] = airtime * 1e-9
    return found


def draw_air(axis, run):
    found = air_by_purpose(run)
    seconds = range(1 + max(second for shares in found.values() for second in shares))
    below = [0.0] * len(seconds)
    for purpose, name in PURPOSES.items():
        heights = [found.get(purpose, {}).get(second, 0) for second in seconds]
        if any(heights):
            axis.bar([second + 0.5 for second in seconds], heights, 0.9, below, label=name)
        below = [a + b for a, b in zip(below, heights)]
    axis.set(xlabel="time, s", ylabel="share of the air time")


def dds_two_stations(runs):
    plt = pyplot()
    figure, axis = plt.subplots()
    for colour, shift, rate in (("C0", -0.1, "54 Mb/s"), ("C1", 0.1, "6 Mb/s")):
        run = play(runs, "dds_two_stations", {"radio.data_rate": rate})
        draw_round_trips(axis, ddsperf.round_trips(said(run, "pinger.ping")), colour, rate, shift)
    axis.set(xlabel="time since the program's start, s", ylabel="round trip of 64 bytes, ms", yscale="log")
    axis.legend(fontsize=7)
    return figure


def dds_discovery_storm(runs):
    plt = pyplot()
    figure, axis = plt.subplots()
    draw_air(axis, play(runs, "dds_discovery_storm", {}))
    axis.legend(fontsize=7)
    return figure


def dds_camera_over_wifi(runs):
    plt = pyplot()
    figure, axis = plt.subplots()
    run = play(runs, "dds_camera_over_wifi", {})
    draw_round_trips(axis, ddsperf.round_trips(said(run, "operator.command")), "C0", "commands, 1 kB, 20 Hz")
    axis.axvline(5, color="0.5", linestyle=":", label="the camera begins: 512 kB, 3 Hz")
    axis.set(xlabel="time, s", ylabel="round trip, ms", yscale="log")
    axis.legend(fontsize=7)
    return figure


def dds_through_access_point(runs):
    plt = pyplot()
    figure, axis = plt.subplots()
    near = {"agents.robot.poses": [{"x": "-15 m", "y": "0 m"}], "agents.operator.poses": [{"x": "15 m", "y": "0 m"}]}
    for colour, shift, name, settings in (("C0", -0.1, "through the access point", {}),
                                          ("C1", 0.1, "directly, 30 m", {**near, "radio.bss.access_point": []})):
        run = play(runs, "dds_through_access_point", settings)
        draw_round_trips(axis, ddsperf.round_trips(said(run, "operator.ping")), colour, name, shift)
    axis.set(xlabel="time since the program's start, s", ylabel="round trip of 64 bytes, ms", yscale="log")
    axis.legend(fontsize=7)
    return figure


PAGES = {"dds_two_stations": dds_two_stations, "dds_discovery_storm": dds_discovery_storm,
         "dds_camera_over_wifi": dds_camera_over_wifi, "dds_through_access_point": dds_through_access_point}

