#!/usr/bin/env python3
"""Records ns-3's figures of AODV: record_aodv.py PROGRAM >tests/analytic/radio/aodv_ns3.csv, where PROGRAM is
tests/peer/ns3/aodv."""
import subprocess
import sys

import aodv

print("# ns-3.37 (Debian libns3-dev 3.37-2), tests/peer/ns3/aodv with the flows of tests/validation/aodv.py: AODV with "
      "its defaults but MyRouteTimeout 6 s, 5 x 5 stations 40 m apart, 1 Mb/s, log-distance 46.6777 dB at 1 m, exponent "
      "3, 16.0206 dBm, CcaEdThreshold -82 dBm; packets of 64 bytes at 4 Hz from 5..10 s to 100 s, no ARP; run number: "
      "seed; delays in ms.")
print("flows,seed,sent,delivered,per_sent,median_ms,p95_ms,hellos,rreq,rreq_relayed,rrep,rerr,data,given_up")
for flows in aodv.FLOWS:
    for seed in aodv.SEEDS:
        lines = "".join(f"{source} {destination} {start}\n" for source, destination, start in aodv.flows(flows, seed))
        done = subprocess.run([sys.argv[1], f"--seed={seed}", "--data=b1", "--energy=-82", f"--stop={aodv.STOP}"],
                              input=lines, capture_output=True, text=True, check=True)
        print(flows, *done.stdout.strip().split(","), sep=",", flush=True)
