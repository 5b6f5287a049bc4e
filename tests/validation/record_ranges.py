#!/usr/bin/env python3
"""Records ns-3's figures of further ranges: record_ranges.py PROGRAM >tests/analytic/radio/range_more_ns3.csv, where
PROGRAM is tests/peer/ns3/range."""
import subprocess
import sys

# Mode, bytes, roughly where half of the broadcasts arrive, m.
MODES = (("b2", 100, 138), ("b5.5", 100, 105), ("b5.5", 1000, 96), ("g9", 100, 84), ("g12", 100, 83), ("g18", 500, 64),
         ("g24", 100, 50), ("g36", 100, 39.5), ("g36", 1000, 37.5), ("g48", 100, 29))

print("# ns-3.37 (Debian libns3-dev 3.37-2), tests/peer/ns3/range --data=mode --size=payload --detector=0 --distance=dist_m: "
      "4000 broadcasts, share that is delivered, over log-distance 46.6777 dB at 1 m.")
print("mode,payload,preamble_det,dist_m,pdr")
for mode, size, about in MODES:
    control = "g24" if mode[0] == "g" else "b1"
    for i in range(41):
        distance = round(about * 1.0075 ** (i - 20), 4)
        done = subprocess.run([sys.argv[1], f"--data={mode}", f"--control={control}", f"--size={size}", "--detector=0",
                               f"--distance={distance}"], capture_output=True, text=True, check=True)
        print(mode, size, 0, distance, done.stdout.strip().split(",")[-1], sep=",", flush=True)
