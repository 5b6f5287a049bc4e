#!/usr/bin/env python3
"""Records ns-3's AODV on the base field of AntHocNet: record_field.py PROGRAM [--seconds S] [--seeds 1-10] [--parallel N]
[NAME...], where PROGRAM is tests/peer/ns3/field and NAME one of VARIANTS. Adds rows to FILE, and makes no row twice. A run
of 120 s takes 25 s of one core, one of 900 s some four minutes. `record_field.py --table` prints the table of
docs/scenarios/anthocnet_base_field.md from FILE: means with 95 % intervals (Student-t)."""
import argparse
import concurrent.futures
import csv
import math
import pathlib
import statistics
import subprocess

FILE = pathlib.Path(__file__).parent / "anthocnet_base_field_ns3.csv"
COLUMNS = ["variant", "seconds", "seed", "sent", "delivered", "delay_mean", "delay_median", "delay_p99", "hellos", "rreq",
           "rreq_relayed", "rrep", "rerr", "data", "given_up", "given_up_data", "given_up_beyond", "lost_given_up",
           "lost_too_old", "lost_arp", "lost_ttl", "lost_no_route", "lost_unseen"]
PERMANENT = "--addresses=permanent"
VARIANTS = {
    "stock": [],
    "permanent": [PERMANENT],
    "filled": ["--addresses=filled"],
    "arp forgets after 1 s": ["--arp_dead=1"],
    "permanent, hello loss 6": [PERMANENT, "--hello_loss=6"],
    "permanent, destination only": [PERMANENT, "--destination_only=1"],
    "permanent, hello loss 6, destination only": [PERMANENT, "--hello_loss=6", "--destination_only=1"],
    "permanent, two-ray": [PERMANENT, "--loss=two_ray"],
}


def seeds_of(text):
    low, _, high = text.partition("-")
    return range(int(low), int(high or low) + 1)


def rows():
    if not FILE.exists():
        return []
    with FILE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


# Quantiles 0.975 of Student's t, by degrees of freedom.
STUDENT = (12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622)


def with_interval(values):
    if len(values) == 1:
        return f"{values[0]:.1f}"
    half = STUDENT[len(values) - 2] * statistics.stdev(values) / math.sqrt(len(values))
    return f"{statistics.mean(values):.1f} ± {half:.1f}"


def print_table():
    shares = ("delivered", "lost_given_up", "lost_arp", "lost_no_route")
    print("| ns-3's AODV | s | runs | delivered, % | given up by the MAC, % | dropped by ARP, % | no route, % | delay, mean, ms | "
          "of the frames of data given up, to stations beyond 300 m, % | messages of AODV per packet delivered |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    found = rows()
    order = list(VARIANTS)
    for variant, seconds in sorted({(row["variant"], row["seconds"]) for row in found},
                                   key=lambda one: (order.index(one[0]), int(one[1]))):
        some = [{key: value if key == "variant" else float(value) for key, value in row.items()} for row in found
                if (row["variant"], row["seconds"]) == (variant, seconds)]
        cells = [with_interval([100 * row[key] / row["sent"] for row in some]) for key in shares]
        cells += [with_interval([row["delay_mean"] for row in some]),
                  with_interval([100 * row["given_up_beyond"] / row["given_up_data"] for row in some]),
                  with_interval([sum(row[key] for key in ("hellos", "rreq", "rreq_relayed", "rrep", "rerr"))
                                 / row["delivered"] for row in some])]
        print(f"| {variant} | {seconds} | {len(some)} | {' | '.join(cells)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path, nargs="?")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--seconds", type=int, default=120)
    parser.add_argument("--seeds", type=seeds_of, default=range(1, 11))
    parser.add_argument("--parallel", type=int, default=1)
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_intermixed_args()
    if options.table:
        return print_table()
    there = {(row["variant"], row["seconds"], row["seed"]) for row in rows()}
    wanted = [(name, seed) for seed in options.seeds for name in options.names or VARIANTS
              if (name, str(options.seconds), str(seed)) not in there]

    def play(case):
        name, seed = case
        # In the benchmark flows begin in the first half of the short form; of the long one, in 180 s as Broch et al. have it.
        window = min(options.seconds / 2, 180)
        done = subprocess.run(["nice", "-n", "10", options.program, f"--seed={seed}", f"--stop={options.seconds}",
                               f"--window={window}", *VARIANTS[name]], capture_output=True, text=True, check=True)
        with FILE.open("a", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerow([name, options.seconds, *done.stdout.strip().split(",")])

    with concurrent.futures.ThreadPoolExecutor(options.parallel) as pool:
        list(pool.map(play, wanted))
    return None


if __name__ == "__main__":
    main()
