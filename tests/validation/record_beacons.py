#!/usr/bin/env python3
"""Records ns-3's figures of beacons: record_beacons.py PROGRAM >tests/analytic/radio/beacons_ns3.csv, where
PROGRAM is tests/peer/ns3/beacons."""
import subprocess
import sys

import beacons

print("# ns-3.37 (Debian libns3-dev 3.37-2), tests/peer/ns3/beacons with the fields of tests/validation/beacons.py: "
      "300 stations, 64 bytes at 10 Hz, 1 Mb/s, log-distance 46.6777 dB at 1 m, exponent 3, 16.0206 dBm; "
      "CcaEdThreshold; beacons received per sent.")
print("neighbours,seed,energy_dbm,sent,received,per_sent")
for neighbours in (12, 24, 48, 96):
    for energy in (-62, -82):
        for seed in (1, 2, 3):
            places = "".join(f"{x} {y} {phase}\n" for x, y, phase in beacons.field(neighbours, seed))
            done = subprocess.run([sys.argv[1], f"--seconds={beacons.SECONDS}", f"--seed={seed}",
                                   f"--energy={energy}"], input=places, capture_output=True, text=True, check=True)
            sent, received, share = done.stdout.strip().split(",")[3:]
            print(neighbours, seed, energy, sent, received, share, sep=",", flush=True)
