#!/usr/bin/env python3
"""Draws the map of an office floor: office.png and office.yaml beside this file, with the keys and levels of Nav2's map_saver.

    python3 draw_office.py [FOLDER]

24 m x 16 m at 5 cm a cell: a corridor of 2.4 m from west to east with rooms on both sides, doors of 1.2 m, windows' piers in
the outer walls, pillars in the open office, desks, and the ground outside, which no robot has seen.
"""
import pathlib
import struct
import sys
import zlib

RESOLUTION = 0.05  # m
WIDTH, HEIGHT = 520, 360  # cells
FREE, UNKNOWN, OCCUPIED = 254, 205, 0
LEFT, LOW = -13.0, -9.0  # m, of the lower left corner


class Floor:
    def __init__(self):
        self.rows = [bytearray([UNKNOWN]) * WIDTH for _ in range(HEIGHT)]  # the lowest first

    def fill(self, x0, y0, x1, y1, level):
        """A rectangle, in metres."""
        for y in range(round((y0 - LOW) / RESOLUTION), round((y1 - LOW) / RESOLUTION)):
            for x in range(round((x0 - LEFT) / RESOLUTION), round((x1 - LEFT) / RESOLUTION)):
                self.rows[y][x] = level

    def wall_x(self, x0, x1, y, doors=(), thickness=0.1):
        """A wall along x with its middle at y; each door is 1.2 m wide from its x on."""
        self.fill(x0, y - thickness / 2, x1, y + thickness / 2, OCCUPIED)
        for door in doors:
            self.fill(door, y - thickness / 2, door + 1.2, y + thickness / 2, FREE)

    def wall_y(self, x, y0, y1, doors=(), thickness=0.1):
        self.fill(x - thickness / 2, y0, x + thickness / 2, y1, OCCUPIED)
        for door in doors:
            self.fill(x - thickness / 2, door, x + thickness / 2, door + 1.2, FREE)


def office():
    floor = Floor()
    floor.fill(-12, -8, 12, 8, FREE)
    for y in (-7.85, 7.85):  # the outer walls
        floor.wall_x(-12, 12, y, thickness=0.3)
    for x in (-11.85, 11.85):
        floor.wall_y(x, -8, 8, thickness=0.3)
    floor.wall_x(-12, 12, 1.2, doors=(-10.5, -6.5, -2.5, 1.5, 6.5), thickness=0.2)  # the corridor
    floor.wall_x(-12, 4, -1.2, doors=(-9.5, -4.5, 0.5), thickness=0.2)
    for x in (-8, -4, 0, 4):  # rooms in the north
        floor.wall_y(x, 1.2, 8)
    for x in (-7, -2):  # rooms in the south; the rest is one open office with the corridor
        floor.wall_y(x, -8, -1.2)
    floor.wall_y(4, -8, -1.2, doors=(-5,), thickness=0.2)
    for x in (6.8, 9.2):  # pillars
        for y in (-5.6, -3.2):
            floor.fill(x - 0.2, y - 0.2, x + 0.2, y + 0.2, OCCUPIED)
    for x in (-10.8, -6.8, -2.8, 1.2):  # desks in the north, against the outer wall
        floor.fill(x, 6.6, x + 1.6, 7.4, OCCUPIED)
    floor.fill(6.0, 4.0, 9.0, 5.2, OCCUPIED)  # the table of the meeting room
    for x in (-11.0, -6.0, -0.5):  # shelves in the south
        floor.fill(x, -7.7, x + 2.4, -7.3, OCCUPIED)
    for x, y in ((-9.3, 5.9), (-5.2, 5.8), (2.1, 5.9), (6.4, 3.4), (8.4, 5.8), (-4.4, -4.3)):  # legs of chairs
        floor.fill(x, y, x + 0.05, y + 0.05, OCCUPIED)
    return floor


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png(rows):
    """8 bits of grey, every row as it is (filter 0)."""
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)) + chunk(b"IEND", b""))


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    (folder / "office.png").write_bytes(png(reversed(office().rows)))
    (folder / "office.yaml").write_text(
        f"image: office.png\nmode: trinary\nresolution: {RESOLUTION}\norigin: [{LEFT}, {LOW}, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.25\n", encoding="utf-8")


if __name__ == "__main__":
    main()
