#!/usr/bin/env python3
"""Records ns-3's figures of AODV: record_aodv.py PROGRAM >tests/analytic/radio/aodv_ns3.csv, where PROGRAM is
tests/peer/ns3/aodv."""
import subprocess
import sys

from aodv_fields import STOP, Field

# Field, flows, how stations know MAC addresses, AODV's AllowedHelloLoss, DestinationOnly, hellos.
CASES = [*(("grid", count, "permanent", loss, only, 1) for loss, only in ((2, 0), (6, 1)) for count in (2, 4, 6, 8)),
         *(("moving", 4, addresses, loss, only, 1) for addresses, loss, only in
           (("permanent", 2, 0), ("permanent", 6, 0), ("permanent", 6, 1), ("filled", 2, 0), ("arp", 2, 0))),
         *(("leaving", 1, addresses, 2, 0, 0) for addresses in ("permanent", "filled"))]


def main():
    print("# ns-3.37 (Debian libns3-dev 3.37-2), tests/peer/ns3/aodv with the stations and flows of tests/validation/"
          "aodv_fields.py: AODV with its defaults but MyRouteTimeout 6 s and what the columns say (hello_loss: AllowedHelloLoss; "
          "destination_only: DestinationOnly; hello: EnableHello), 1 Mb/s, log-distance 46.6777 dB at 1 m, exponent 3, 16.0206 "
          "dBm, CcaEdThreshold -82 dBm; packets of 64 bytes at 4 Hz from 5..10 s to 100 s; addresses: how stations know MAC "
          "addresses (aodv_stations.h); run number: seed; delays in ms.")
    print("field,addresses,hello_loss,destination_only,hello,flows,seed,sent,delivered,per_sent,median_ms,p95_ms,hellos,rreq,"
          "rreq_relayed,rrep,rerr,data,given_up")
    for name, count, addresses, loss, only, hello in CASES:
        for seed in range(1, 2 if name == "leaving" else 11):
            done = subprocess.run(
                [sys.argv[1], f"--seed={seed}", "--data=b1", "--energy=-82", f"--stop={STOP}", f"--addresses={addresses}",
                 f"--hello_loss={loss}", f"--destination_only={only}", f"--hello={hello}"],
                input=Field(name, count).for_peer(seed), capture_output=True, text=True, check=True)
            print(name, addresses, loss, only, hello, count, *done.stdout.strip().split(","), sep=",", flush=True)


if __name__ == "__main__":
    main()
