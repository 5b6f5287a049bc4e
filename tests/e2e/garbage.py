#!/usr/bin/env python3
"""Sends garbage to UDP ports of this machine: datagrams a program must survive without a change.

    garbage.py --ports 7660,7661 --count 1000000 [--seed 1] [--kinds random,headed,truncated,mutated]
               [--corpus FILE] [--capture SECONDS] [--multicast 239.255.0.1:7650] [--save FILE]

Kinds, all from the seed:
    random      bytes without a meaning, 0 to 1500 of them
    headed      an RTPS header of a stranger, then submessages of known kinds with random contents
    truncated   a real datagram, cut anywhere
    mutated     a real datagram with some bytes changed, from strangers: no GUID of a real participant
                is left in it
    forged      the same with the GUIDs left as they are. Only on request: who can write as a participant
                can change a run, garbage or not; what keeps him out is DDS security

Real datagrams come from --corpus, a file with one of them per line in hexadecimal, or, as root, from the
traffic on the loopback interface (--capture). For ports that do not speak RTPS give a corpus of theirs.
"""
import argparse
import collections
import os
import pathlib
import random
import socket
import struct
import time

KINDS = ("random", "headed", "truncated", "mutated")
# OMG DDSI-RTPS 2.3, 9.4.5.1.1 and, 0x80, one of the vendor.
SUBMESSAGES = (0x01, 0x06, 0x07, 0x08, 0x09, 0x0c, 0x0d, 0x0e, 0x0f, 0x12, 0x13, 0x15, 0x16, 0x30, 0x80)
PREFIX = slice(8, 20)  # of the sender's GUID, in an RTPS datagram


def captured(seconds, ports=None, limit=400):
    """Real RTPS datagrams on the loopback interface, to any of the ports; as many of each shape as of
    any other. Needs the right to open raw sockets: PermissionError without it."""
    shapes = collections.defaultdict(list)
    end = time.monotonic() + seconds
    with socket.socket(socket.AF_PACKET, socket.SOCK_DGRAM, socket.htons(0x0800)) as wire:
        wire.bind(("lo", 0))
        wire.settimeout(0.1)
        while time.monotonic() < end:
            try:
                packet = wire.recv(65536)
            except TimeoutError:
                continue
            header = (packet[0] & 15) * 4
            if packet[9] != socket.IPPROTO_UDP:
                continue
            port, = struct.unpack_from(">H", packet, header + 2)
            datagram = packet[header + 8:]
            if datagram[:4] != b"RTPS" or ports and port not in ports:
                continue
            shape = shapes[tuple(submessages(datagram))]
            if len(shape) < 8 and datagram not in shape:
                shape.append(datagram)
    return [datagram for shape in shapes.values() for datagram in shape][:limit]


def submessages(datagram):
    """Kind of each submessage, with its flags (OMG DDSI-RTPS 2.3, 8.3.3.2)."""
    at = 20
    while at + 4 <= len(datagram):
        kind, flags = datagram[at], datagram[at + 1]
        length, = struct.unpack_from("<H" if flags & 1 else ">H", datagram, at + 2)
        yield kind, flags
        if length == 0:
            return
        at += 4 + length


def read_corpus(path):
    return [bytes.fromhex(line) for line in pathlib.Path(path).read_text().split()]


def random_datagram(dice, corpus):
    return dice.randbytes(min(int(dice.expovariate(1 / 200)), 1500))


def headed(dice, corpus):
    parts = [b"RTPS", bytes((2, dice.choice((1, 2, 3, 4, 255)))), b"\x01\x0f", dice.randbytes(12)]
    for _ in range(dice.randint(1, 4)):
        content = dice.randbytes(dice.choice((0, 4, 8, 16, 20, 24, 28, 60, 300)))
        length = dice.choice((len(content), len(content), 0, 65535, dice.randrange(65536)))
        flags = dice.randrange(256)
        parts.append(struct.pack("<BBH" if flags & 1 else ">BBH", dice.choice(SUBMESSAGES), flags, length))
        parts.append(content)
    return b"".join(parts)


def truncated(dice, corpus):
    real = dice.choice(corpus)
    return real[:dice.randrange(len(real))]


def forged(dice, corpus):
    changed = bytearray(dice.choice(corpus))
    for _ in range(dice.randint(1, 8)):
        at = dice.randrange(4, len(changed)) if len(changed) > 4 else 0
        changed[at] = dice.choice((0, 1, 0x7f, 0x80, 0xff, dice.randrange(256), changed[at] ^ 1 << dice.randrange(8)))
    if dice.random() < 0.2:
        del changed[dice.randrange(len(changed)):]
    return bytes(changed)


class Mutated:
    """Changes what was real, and who it is from: one of few strangers, so that they get to know each."""

    def __init__(self, dice, corpus):
        self.real = {bytes(datagram[PREFIX]) for datagram in corpus if datagram[:4] == b"RTPS"}
        self.strangers = [b"\x01\x0f" + dice.randbytes(10) for _ in range(16)]

    def __call__(self, dice, corpus):
        changed = forged(dice, corpus)
        for prefix in self.real:
            changed = changed.replace(prefix, dice.choice(self.strangers))
        # A change within a GUID prefix leaves it a neighbour of a real one, which is nobody either.
        return changed


def datagrams(seed, corpus, kinds=KINDS):
    """Without end; equal arguments give equal datagrams."""
    dice = random.Random(seed)
    makers = {"random": random_datagram, "headed": headed, "truncated": truncated, "forged": forged}
    if "mutated" in kinds:
        makers["mutated"] = Mutated(dice, corpus)
    if not corpus:
        kinds = [kind for kind in kinds if kind in ("random", "headed")]
    while True:
        yield makers[dice.choice(kinds)](dice, corpus)


def send(stream, targets, count, keep=None, go_on=lambda: True):
    """Sends `count` datagrams to the targets in turn. @param keep  a deque that gets what was sent last.
    @return how many were sent before go_on() said no."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
        for sent in range(count):
            if sent % 1000 == 0 and not go_on():
                return sent
            datagram, target = next(stream), targets[sent % len(targets)]
            if keep is not None:
                keep.append((target, datagram))
            try:
                out.sendto(datagram, target)
            except ConnectionRefusedError:
                pass  # nobody there, says the answer to an earlier one
    return count


def udp_ports(pid):
    """UDP ports that a process has open; none once it has ended."""
    sockets = set()
    for descriptor in pathlib.Path(f"/proc/{pid}/fd").glob("*"):
        try:
            target = os.readlink(descriptor)
        except OSError:
            continue  # closed meanwhile
        if target.startswith("socket:["):
            sockets.add(target[8:-1])
    ports = set()
    for line in pathlib.Path("/proc/net/udp").read_text().splitlines()[1:]:
        fields = line.split()
        if fields[9] in sockets:
            ports.add(int(fields[1].split(":")[1], 16))
    return sorted(ports)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--ports", required=True)
    arguments.add_argument("--address", default="127.0.0.1")
    arguments.add_argument("--multicast")
    arguments.add_argument("--count", type=int, default=1_000_000)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--kinds", default=",".join(KINDS))
    arguments.add_argument("--corpus")
    arguments.add_argument("--capture", type=float)
    arguments.add_argument("--save")
    given = arguments.parse_args()
    targets = [(given.address, int(port)) for port in given.ports.split(",")]
    if given.multicast:
        group, port = given.multicast.split(":")
        targets.append((group, int(port)))
    corpus = read_corpus(given.corpus) if given.corpus else []
    if given.capture:
        corpus += captured(given.capture)
    if given.save:
        pathlib.Path(given.save).write_text("".join(datagram.hex() + "\n" for datagram in corpus))
    begin = time.monotonic()
    sent = send(datagrams(given.seed, corpus, given.kinds.split(",")), targets, given.count)
    print(f"corpus: {len(corpus)}\nsent: {sent}\nseconds: {time.monotonic() - begin:.1f}")


if __name__ == "__main__":
    main()
