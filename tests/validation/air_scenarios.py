"""Figures of the pages of docs/scenarios whose programs have sockets, in lock-step: of the radio and the programs alone. Needs Cyclone's ddsperf (Debian: cyclonedds-tools) and the right to make user namespaces."""
import collections
import sys

from chart import Chart, Panel, axis, series
from runs import ROOT, SCENARIOS

sys.path.append(str(ROOT / "tests/e2e"))
import ddsperf  # noqa: E402

PURPOSES = {"user": "samples, heartbeats, acknowledgements of programs", "SPDP": "SPDP: participants",
            "SEDP": "SEDP: their endpoints", "liveliness": "liveliness", "802.11": "802.11's acknowledgements",
            "network": "ARP, ICMPv6, IGMP"}


def play(runs, name, settings):
    return runs.play(SCENARIOS / f"{name}.yaml", settings)


def said(run, program):
    return (run.file.parent / f"{program}.log").read_text()


def draw_round_trips(panel, seconds, curve, name, shift=0.0):
    """Median and the range from least to 90 % of each second, ms."""
    panel.marks([one.at - 0.5 + shift for one in seconds], [1e3 * one.median for one in seconds],
                intervals=[(1e3 * one.least, 1e3 * one.p90) for one in seconds], scale=0.7, curve=curve, label=name)


def air_by_purpose(run):
    """{purpose: {second: share of the second}}."""
    found = collections.defaultdict(dict)
    for second, purpose, airtime in run.query("SELECT second, purpose, sum(airtime_ns) FROM air_seconds GROUP BY 1, 2"):
        found[purpose][second] = airtime * 1e-9
    return found


def draw_air(panel, run):
    found = air_by_purpose(run)
    seconds = range(1 + max(second for shares in found.values() for second in shares))
    shares = {name: [found.get(purpose, {}).get(second, 0) for second in seconds] for purpose, name in PURPOSES.items()}
    panel.bars([second + 0.5 for second in seconds],
               *(series(name, heights, curve) for curve, (name, heights) in enumerate(shares.items()) if any(heights)),
               width=0.9, stacked=True)


def round_trips(label, x="time since the program's start, s"):
    return Panel(x=axis(x), y=axis(label, log=True))


def dds_two_stations(runs):
    panel = round_trips("round trip of 64 bytes, ms")
    for curve, (shift, rate) in enumerate(((-0.1, "54 Mb/s"), (0.1, "6 Mb/s"))):
        run = play(runs, "dds_two_stations", {"radio.data_rate": rate})
        draw_round_trips(panel, ddsperf.round_trips(said(run, "pinger.ping")), curve, rate, shift)
    return Chart(panel, title="Round trips between two stations")


def dds_discovery_storm(runs):
    panel = Panel(x=axis("time, s"), y=axis("share of the air time"))
    draw_air(panel, play(runs, "dds_discovery_storm", {}))
    return Chart(panel, title="What the air is used for", size=(640, 380))


def dds_camera_over_wifi(runs):
    panel = round_trips("round trip, ms", "time, s")
    run = play(runs, "dds_camera_over_wifi", {})
    draw_round_trips(panel, ddsperf.round_trips(said(run, "operator.command")), 0, "commands, 1 kB, 20 Hz")
    panel.vertical(5, dash="dotted", label="the camera begins: 512 kB, 3 Hz")
    return Chart(panel, title="Round trips of commands beside a camera")


def dds_through_access_point(runs):
    panel = round_trips("round trip of 64 bytes, ms")
    near = {"agents.robot.poses": [{"x": "-15 m", "y": "0 m"}], "agents.operator.poses": [{"x": "15 m", "y": "0 m"}]}
    for curve, (shift, name, settings) in enumerate(((-0.1, "through the access point", {}),
                                                     (0.1, "directly, 30 m", {**near, "radio.bss.access_point": []}))):
        run = play(runs, "dds_through_access_point", settings)
        draw_round_trips(panel, ddsperf.round_trips(said(run, "operator.ping")), curve, name, shift)
    return Chart(panel, title="Round trips through an access point")


PAGES = {"dds_two_stations": dds_two_stations, "dds_discovery_storm": dds_discovery_storm,
         "dds_camera_over_wifi": dds_camera_over_wifi, "dds_through_access_point": dds_through_access_point}

