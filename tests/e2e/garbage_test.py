#!/usr/bin/env python3
"""Garbage at every UDP port of a run changes nothing: not what happens in it, not whether it ends.

BARAKA_GARBAGE datagrams are sent, by default 100,000; `ctest -L slow` sends a million. They are random,
have a stranger's header, or are real ones of this very run, cut anywhere or with changed bytes. Fast DDS
2.9 can be crashed with the last (CVE-2024-28231 and others): gateway/guard drops them before it sees them.
"""
import os
import pathlib
import re
import socket
import unittest

import garbage
from baraka import CASE_STUDY, Case, children, wait_for

COUNT = int(os.environ.get("BARAKA_GARBAGE", "100000"))
UNTIL = 60  # simulated s


class Garbage(Case):
    def begin(self, speed):
        """A case study under way, so slow that it lasts, and the UDP ports of its processes."""
        program = self.start(CASE_STUDY, "--until", UNTIL, "--max-speed", speed,
                             "--set", "reply_timeout=60 s")
        domain = int(re.match(r"domain: (\d+)", program.process.stderr.readline()).group(1))
        pids = wait_for(lambda: self.three_processes(program.process.pid))
        # Two of each participant, and one to send from.
        ports = wait_for(lambda: self.ports_of(pids))
        return program, domain, ports

    def three_processes(self, server):
        pids = [server, *children(server, "help_mote"), *children(server, "help_robot")]
        return pids if len(pids) == 3 else None

    def ports_of(self, pids):
        ports = [garbage.udp_ports(pid) for pid in pids]
        return sorted({port for some in ports for port in some}) if all(len(some) >= 2 for some in ports) else None

    def real_datagrams(self, ports):
        try:
            return garbage.captured(2, set(ports))
        except PermissionError:
            return []  # then all is invented

    def expected(self):
        return self.run_baraka(CASE_STUDY, "--until", UNTIL)["fingerprint"]

    def test_a_run_under_garbage_is_the_same_run(self):
        expected = self.expected()
        sent, seed = 0, 0
        while sent < COUNT:  # a run that ends early is not enough: another one
            seed += 1
            program, domain, ports = self.begin(speed=6)
            corpus = self.real_datagrams(ports)
            if os.geteuid() == 0:
                self.assertGreater(len(corpus), 10, "no datagrams of this run were seen")
            targets = [("127.0.0.1", port) for port in ports]
            targets.append(("239.255.0.1", 7400 + 250 * domain))  # where DDS discovers others by default
            sent += garbage.send(garbage.datagrams(seed, corpus), targets, COUNT - sent,
                                 go_on=lambda: program.process.poll() is None)
            finished = program.finish(timeout=300)
            self.assertEqual(finished.status, 0, f"seed {seed}: {finished}")
            self.assertEqual(finished["fingerprint"], expected, f"seed {seed}: {finished}")
            for log in self.out.glob("*.log"):
                self.assertNotRegex(log.read_text(errors="replace"), "killed by|assert", log)
            self.assertRegex(finished.err, r"dropped in all \d+ datagrams from 127.0.0.1", str(finished))
        self.assertEqual(sent, COUNT)

    def test_all_ports_where_it_hears_are_those_of_the_loopback_interface(self):
        """And of the group where DDS discovers others, which the run joins on that interface. From those of any
        address it only sends: what comes there is dropped."""
        program, _, ports = self.begin(speed=20)
        found = self.sockets(ports)
        addresses = {address for address, *_ in found}
        self.assertIn("0100007F", addresses)  # 127.0.0.1, as Linux writes it
        self.assertLessEqual(addresses, {"0100007F", "0100FFEF", "00000000"})  # 239.255.0.1
        senders = [port for address, port, *_ in found if address == "00000000"]
        self.assertEqual(len(senders), 3, "of the run and its two processes of controllers")
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
            for port in senders:
                one.sendto(b"RTPS" + bytes(60), ("127.0.0.1", port))
        for address, port, held, drops in self.sockets(senders):
            self.assertEqual(held, 0, f"{address}:{port}")
            self.assertGreaterEqual(drops, 1, f"{address}:{port}")
        self.assertEqual(program.finish().status, 0)

    @staticmethod
    def sockets(ports):
        """(address, port, octets held, datagrams dropped) of each at these ports: proc(5)."""
        found = []
        for line in pathlib.Path("/proc/net/udp").read_text().splitlines()[1:]:
            columns = line.split()
            address, port = columns[1].split(":")
            if int(port, 16) in ports:
                found.append((address, int(port, 16), int(columns[4].split(":")[1], 16), int(columns[12])))
        return found

    def test_equal_seeds_give_equal_garbage(self):
        corpus = [b"RTPS" + bytes(range(100)), b"RTPS" + bytes(60)]
        streams = [garbage.datagrams(seed, corpus, (*garbage.KINDS, "forged")) for seed in (5, 5, 6)]
        first, second, other = ([next(stream) for _ in range(500)] for stream in streams)
        self.assertEqual(first, second)
        self.assertNotEqual(first, other)


if __name__ == "__main__":
    unittest.main()
