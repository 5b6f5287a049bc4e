#!/usr/bin/env python3
"""Ten programs that send as fast as they can share the air as saturated stations do: as controllers that have always
something to send, over runs of the same length, which are compared with ns-3 in tests/slow/radio.

A run of 20 s has some 13,800 frames, and their share that fails scatters by 1.2 % from seed to seed, as collisions come
in bursts. So the figure of the programs must lie where one more such run would, but for one in 10,000: within 4.7
standard deviations (Student's t, 23 degrees of freedom) times sqrt(1 + 1/24) of the mean of 24 runs.

BARAKA_CONTENTION: simulated seconds (default 20; 520 give each station 25,000 frames). With few, bounds of a station's share
are wider: who has sent draws from a smaller window than who has collided, so frames come in bursts, and a share of 1000
frames has a standard deviation of some 8 %, over traffic_source as well."""
import json
import math
import os
import statistics
import sys
import unittest

from air_programs_test import SKIPPED, SLOW_RADIO, Air, program, refused_here, station
from baraka import ROOT
from wire import PYTHON

STATIONS = 10
SECONDS = int(os.environ.get("BARAKA_CONTENTION", "20"))
WARM_UP = 2
SCATTER = 0.085  # of a share of 1000 frames
SEEDS = 24
QUANTILE = 4.69  # of Student's t with 23 degrees of freedom, two-sided, 1 in 10,000

LENGTH = 1472  # of a datagram; 28 of IP and UDP make an MSDU of 1500
SEND = f"""
import socket
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
out.connect(('sink', 9))
while True:
    try:
        out.send(bytes({LENGTH}))
    except OSError:
        pass
"""
RECEIVE = """
import socket
port = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
port.bind(('', 9))
while True:
    port.recv(2048)
"""


def counted(case):
    """Data frames behind the warm-up: sent and delivered to the sink, agent 1, by station."""
    data = f"bits > 12000 AND frames.at_ns >= {WARM_UP * 10**9}"
    sent = dict(case.query(f"SELECT transmitter, COUNT(*) FROM frames WHERE {data} GROUP BY 1"))
    came = dict(case.query(f"SELECT transmitter, COUNT(*) FROM frames JOIN frame_ends USING (frame) WHERE {data} "
                           "AND verdict = 'delivered' AND frame_ends.agent = 1 GROUP BY 1"))
    return sent, came


def figures_of(sent, came):
    all_sent, all_came = sum(sent.values()), sum(came.values())
    return {"Mb/s": all_came * 1500 * 8 / SECONDS / 1e6, "failures": 1 - all_came / all_sent}


class Contention(Air):
    def saturated(self, seed):
        """The same stations with traffic_source in place of programs."""
        self.run_baraka(ROOT / "config/scenarios/saturation.yaml", "--controllers", "in-process", "--set", f"seed={seed}",
                        "--set", "record={frames: all, messages: none, routes: none, readings: none}",
                        "--set", f"end=[{{at: {SECONDS + WARM_UP} s, result: done}}]", timeout=SECONDS + 120)
        return figures_of(*counted(self))

    def programs(self):
        places = [(5 * math.cos(2 * math.pi * i / STATIONS), 5 * math.sin(2 * math.pi * i / STATIONS))
                  for i in range(STATIONS)]
        stations = [station("sink", 0, program("receiver", PYTHON, "-c", RECEIVE, start="0 s"))]
        for i, (x, y) in enumerate(places):
            stations.append(station(f"s{i}", round(x, 6), program("sender", PYTHON, "-c", SEND, start="1 s"))
                            .replace("y: 0 m", f"y: {round(y, 6)} m"))
        finished = self.run_baraka(self.scenario(*stations, end=f"{SECONDS + WARM_UP} s", more="record: {frames: all}\n",
                                                 radio=SLOW_RADIO.replace("queue_limit: 20", "queue_limit: 50")),
                                   timeout=SECONDS + 120)
        self.assertEqual(finished["frames_dropped"], "0", str(finished))
        sent, came = counted(self)
        self.assertEqual(len(came), STATIONS, str(finished))
        return sent, came

    def test_each_gets_its_share_and_frames_fail_as_often_as_with_saturated_stations(self):
        sent, came = self.programs()
        figures = figures_of(sent, came)
        saturated = [self.saturated(seed) for seed in range(1, SEEDS + 1)]
        mean = sum(came.values()) / STATIONS
        shares = sorted(round(count / mean, 4) for count in came.values())
        expected = {name: [statistics.mean(run[name] for run in saturated), statistics.stdev(run[name] for run in saturated)]
                    for name in figures}
        print(json.dumps({**figures, "expected": expected, "shares": shares, "frames": mean}), flush=True)
        for name, (centre, deviation) in expected.items():
            self.assertLess(abs(figures[name] - centre), QUANTILE * deviation * math.sqrt(1 + 1 / SEEDS), name)
        wide = max(0.02, 3.5 * SCATTER * math.sqrt(1000 / mean))
        for share in shares:
            self.assertLess(abs(share - 1), wide, figures)


def load_tests(loader, _tests, _pattern):
    """Not those of the imported module."""
    return loader.loadTestsFromTestCase(Contention)


if __name__ == "__main__":
    if reason := refused_here():
        print("skipped:", reason)
        sys.exit(SKIPPED)
    unittest.main()
