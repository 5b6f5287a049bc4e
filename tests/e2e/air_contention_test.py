#!/usr/bin/env python3
"""Ten programs that send as fast as they can share the air as saturated stations do: against ns-3's row of saturation.

BARAKA_CONTENTION: simulated seconds (default 20; 520 give each station 25,000 frames). With few, bounds are wider, by as much
as counts scatter: who has sent draws from a smaller window than who has collided, so frames come in bursts, and a share
of 1000 frames has a standard deviation of some 8 %, over traffic_source as well."""
import json
import math
import os
import sys
import unittest

from air_programs_test import SKIPPED, SLOW_RADIO, Air, program, refused_here, station

STATIONS = 10
SECONDS = int(os.environ.get("BARAKA_CONTENTION", "20"))
WARM_UP = 2
SCATTER = 0.085  # of a share of 1000 frames
# Row b11,b1,1.0,20.0,0,1500,10 of saturation_ns3.csv: ns-3.37, 802.11b, 1500 B of MSDU, ACK at 1 Mb/s; see tests/slow/radio.
ROW_MBPS, ROW_FAILURES = 6.001, 0.2699

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


class Contention(Air):
    def test_each_gets_its_share_and_frames_fail_as_often_as_with_saturated_stations(self):
        places = [(5 * math.cos(2 * math.pi * i / STATIONS), 5 * math.sin(2 * math.pi * i / STATIONS))
                  for i in range(STATIONS)]
        stations = [station("sink", 0, program("receiver", "python3", "-c", RECEIVE, start="0 s"))]
        for i, (x, y) in enumerate(places):
            stations.append(station(f"s{i}", round(x, 6), program("sender", "python3", "-c", SEND, start="1 s"))
                            .replace("y: 0 m", f"y: {round(y, 6)} m"))
        finished = self.run_baraka(self.scenario(*stations, end=f"{SECONDS + WARM_UP} s", more="record: {frames: all}\n",
                                                 radio=SLOW_RADIO.replace("queue_limit: 20", "queue_limit: 50")),
                                   timeout=SECONDS + 120)
        self.assertEqual(finished["frames_dropped"], "0", str(finished))
        sent = dict(self.query("SELECT transmitter, COUNT(*) FROM frames WHERE bits > 12000 AND at_ns >= "
                               f"{WARM_UP * 10**9} GROUP BY 1"))
        came = dict(self.query("SELECT transmitter, COUNT(*) FROM frames JOIN frame_ends USING (frame) WHERE bits > 12000 "
                               f"AND verdict = 'delivered' AND frame_ends.agent = 1 AND frames.at_ns >= {WARM_UP * 10**9} "
                               "GROUP BY 1"))
        self.assertEqual(len(came), STATIONS, str(finished))
        all_came, all_sent = sum(came.values()), sum(sent.values())
        mean = all_came / STATIONS
        figures = {"Mb/s": all_came * 1500 * 8 / SECONDS / 1e6, "failures": 1 - all_came / all_sent,
                   "shares": sorted(round(count / mean, 4) for count in came.values()), "frames": mean}
        print(json.dumps(figures), flush=True)
        wide = max(0.02, 3.5 * SCATTER * math.sqrt(1000 / mean))
        self.assertLess(abs(figures["Mb/s"] / ROW_MBPS - 1), 0.02, figures)
        self.assertLess(abs(figures["failures"] / ROW_FAILURES - 1), 0.03, figures)
        for count in came.values():
            self.assertLess(abs(count / mean - 1), wide, figures)


def load_tests(loader, _tests, _pattern):
    """Not those of the imported module."""
    return loader.loadTestsFromTestCase(Contention)


if __name__ == "__main__":
    if reason := refused_here():
        print("skipped:", reason)
        sys.exit(SKIPPED)
    unittest.main()
