#!/usr/bin/env python3
"""A folder like that of an analog-to-digital converter of Linux's Industrial I/O subsystem, with
infrared rangers on its channels (Linux, Documentation/ABI/testing/sysfs-bus-iio): in_voltageY_raw
in counts, in_voltage_scale in millivolts per count, in_voltage_offset in counts.

The rangers are Sharp GP2D12 (data sheet: 1999; fit of its curve: counts of a 10 bit, 5 V converter
= 6787 / (d[cm] + 4) + 3). They sit on the edge of a round body whose pose stands in the state file
of another emulator, or does not change.

Prints "folder: PATH" as soon as all files are there, and then works until it is killed.
"""
import argparse
import json
import math
import pathlib
import time

import body


def gp2d12(metres):
    """V"""
    if metres > 0.8:
        return max(0.2, gp2d12(0.8) * 0.8 / metres)
    return 5 / 1023 * (6787 / (100 * max(metres, 0.1) + 4) + 3)


def pose_from(file, otherwise):
    try:
        return json.loads(pathlib.Path(file).read_text())["pose"] if file else otherwise
    except (OSError, ValueError, KeyError):
        return otherwise


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--sensors", type=int, default=6, help="at equal angles from the front")
    parser.add_argument("--radius", type=float, default=0.185, help="of the body, m")
    parser.add_argument("--scale", type=float, default=1.220703125, help="mV per count")
    parser.add_argument("--offset", type=int, default=0, help="counts")
    parser.add_argument("--world", help="JSON file with walls and cylinders")
    parser.add_argument("--pose-from", help="state file of an emulator of wheels")
    parser.add_argument("--pose", type=float, nargs=3, default=[0, 0, 0], metavar=("X", "Y", "YAW"))
    options = parser.parse_args()
    folder = pathlib.Path(options.folder)
    folder.mkdir(parents=True, exist_ok=True)
    world = body.World(options.world)
    headings = [2 * math.pi * i / options.sensors for i in range(options.sensors)]
    body.write_whole(folder / "name", "fake-adc\n")
    body.write_whole(folder / "in_voltage_scale", f"{options.scale}\n")
    if options.offset:
        body.write_whole(folder / "in_voltage_offset", f"{options.offset}\n")
    pose = options.pose
    announced = False
    while True:
        pose = pose_from(options.pose_from, pose)
        for i, metres in enumerate(world.ranges(pose, options.radius, headings)):
            counts = round(1000 * gp2d12(metres) / options.scale) - options.offset
            body.write_whole(folder / f"in_voltage{i}_raw", f"{counts}\n")
        if not announced:
            print(f"folder: {folder}", flush=True)
            announced = True
        time.sleep(0.02)


if __name__ == "__main__":
    main()
