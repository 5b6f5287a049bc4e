#!/usr/bin/env python3
"""Fails when a controller's object files need more than the HAL: then it would not be the same
binary on the robot.

Usage: controller_symbols.py OBJECT...
"""
import re
import subprocess
import sys

FORBIDDEN = re.compile(r"\bsim::|\bdWorld|\bdBody|\beprosima\b|\bhal::(?:dds|exchange|runtime)::")


def main():
    objects = sys.argv[1:]
    if not objects:
        print("no object files given")
        return 1
    wrong = []
    for path in objects:
        undefined = subprocess.run(["nm", "-uC", path], capture_output=True, text=True, check=True)
        wrong += [f"{path}: {line.strip()}" for line in undefined.stdout.splitlines()
                  if FORBIDDEN.search(line)]
    print("\n".join(wrong) or f"controller symbols: ok ({len(objects)} object files)")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
