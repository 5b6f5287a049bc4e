#!/usr/bin/env python3
"""A program of the same user that answers for somebody else's controllers drives no robot and enters no
state, in the simulator and on a real one: who has said Hello is who answers. And a LAN that can reach a
participant of 127.0.0.1 by multicast is not heard."""
import re
import subprocess
import sys
import unittest

from baraka import BIN, CASE_STUDY, Case, loopback, wait_for
from real_agents import Network, Place, Process, RealAgents

FORGER = BIN.parent / "tests/forger"
FAULTY = BIN.parent / "tests/faulty"  # a controller that does nothing, unless it is told to
UNTIL = 20  # simulated s; nobody calls for help within, so that the robot stands


class Simulator(Case):
    def run_with(self, process):
        program = self.start(CASE_STUDY, "--until", UNTIL, "--max-speed", 2, "--set", "reply_timeout=60 s")
        domain = re.match(r"domain: (\d+)", program.process.stderr.readline()).group(1)
        forger = subprocess.Popen([FORGER, domain, process], stdout=subprocess.PIPE, text=True)
        self.addCleanup(forger.stdout.close)
        self.addCleanup(forger.wait)
        self.addCleanup(forger.kill)
        finished = program.finish()
        forger.terminate()
        self.forged = max([0, *map(int, re.findall(r"forged: (\d+)", forger.stdout.read()))])
        self.assertEqual(finished.status, 0, str(finished))
        return finished

    def test_forged_replies_change_nothing_and_are_named(self):
        expected = self.run_baraka(CASE_STUDY, "--until", UNTIL)
        for process in ("robots", "motes"):
            finished = self.run_with(process)
            self.assertGreater(self.forged, 10, f"the forger was not matched\n{finished}")
            self.assertEqual(finished["fingerprint"], expected["fingerprint"], f"{process}\n{finished}")
            self.assertEqual(finished["result"], expected["result"])
            self.assertRegex(finished.err, rf"participant [0-9a-f]{{24}} answers for process '{process}'")
            self.assertRegex(finished.err, r"dropped \d+ replies that participant [0-9a-f]{24}")


class Daemon(RealAgents):
    def test_forged_replies_drive_no_wheels_and_are_named(self):
        network = Place(None, "lo", loopback())
        daemon, robotino = self.robotino(network, "r0", 1, more="controller: {program: faulty}")
        controller = Process(self, network, FAULTY, "--agents", "r0", "--name", "honest",
                             env=self.environment)
        forger = Process(self, network, FORGER, self.domain, "honest")
        wait_for(lambda: "forged: 31" in forger.out.read_text(), 60)
        self.assertEqual(robotino.state()["pose"], [0, 0, 0], f"the forger drives\n{daemon}")
        forger.send("SIGTERM")
        controller.send("SIGTERM")
        controller.finish()
        daemon.send("SIGTERM")
        self.assertEqual(daemon.finish(), 0, str(daemon))
        text = daemon.err.read_text()
        self.assertNotIn("FULFILLED", text)
        self.assertRegex(text, r"participant [0-9a-f]{24} answers for process 'honest'")
        self.assertRegex(text, r"dropped \d+ replies that participant [0-9a-f]{24}")


# Joins the group where DDS discovers others on the interface of the LAN, as any program may.
JOINER = """
import socket, struct, sys, time
one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
one.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
               socket.inet_aton("239.255.0.1") + socket.inet_aton(sys.argv[1]))
print("joined", flush=True)
time.sleep(600)
"""
SENDER = """
import socket, sys
one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
one.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(sys.argv[1]))
for datagram in sys.argv[3:]:
    one.sendto(bytes.fromhex(datagram), ("239.255.0.1", int(sys.argv[2])))
print("sent", flush=True)
"""


class Lan(RealAgents):
    SENT = 5

    def test_nothing_of_it_reaches_a_participant_of_the_loopback_interface(self):
        network = Network(self, 2)
        if not network.has_namespaces:
            self.skipTest("no right to make network namespaces")
        here, there = network.places
        joiner = Process(self, here, sys.executable, "-c", JOINER, here.address)
        joiner.await_text("joined")
        run = Process(self, here, BIN / "baraka", "run", CASE_STUDY, "--domain", self.domain, "--until", 40,
                      "--max-speed", 8, "--out", self.folder / "run")
        run.await_text("inspect domain: ", "err")
        # Well-formed: a HEARTBEAT of nobody's.
        datagrams = ["52545053020301010f1100000000000000000000" + "07011c00000004c7000004c2" +
                     f"00000000010000000000000001000000{i:02x}000000" for i in range(1, self.SENT + 1)]
        sender = Process(self, there, sys.executable, "-c", SENDER, there.address,
                         7400 + 250 * self.domain, *datagrams)
        sender.await_text("sent")
        self.assertEqual(run.finish(60), 0, str(run))
        text = run.err.read_text()
        self.assertRegex(text, rf"dropped a datagram from {there.address}:\d+: sender: it is beyond")
        self.assertRegex(text, rf"dropped in all {self.SENT} datagrams from {there.address}", str(run))


if __name__ == "__main__":
    unittest.main()
