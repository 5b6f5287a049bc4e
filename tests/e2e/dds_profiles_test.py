#!/usr/bin/env python3
"""Every file of config/dds does what it is for: seen on the wire between programs that have it."""
import signal
import sys
import unittest

from baraka import Case, wait_for
from dds_loads import PROFILES, TESTS, Load
from private_network import INTERFACE, PrivateNetwork, is_possible
import rtps_capture

SKIPPED = 77
LARGE = 100_000  # bytes of a sample that is cut
FRAME = 1500     # bytes of IP that travel in one frame


class DdsProfiles(Case):
    def begin(self, hosts):
        """A network with an ear at host 0."""
        self.network = PrivateNetwork(hosts)
        self.enterContext(self.network)
        self.file = self.folder / f"frames{self.runs}"
        self.ear = self.network.start(0, sys.executable, rtps_capture.__file__, INTERFACE, self.file, stdout=-1)
        self.assertEqual(self.ear.stdout.readline(), "ready\n")

    def heard(self):
        self.ear.kill()
        self.ear.wait()
        return rtps_capture.datagrams(self.file)

    def load(self, host, vendor, *arguments, profile=None, seconds=1.2):
        self.runs += 1
        return Load(self.network, host, vendor, self.folder / f"{self.runs}.csv", "--writer", host, "--for", seconds,
                    *arguments, profile=profile)

    def exchange(self, vendor, *written, profile=None, readers=1, quality=()):
        """What is heard of a writer and its readers, all with a profile; all is received."""
        self.begin(1 + readers)
        loads = [self.load(1 + i, vendor, "--subscribe", "t", "--until-matched", 1, *quality, profile=profile)
                 for i in range(readers)]
        loads.append(self.load(0, vendor, "--publish", "t", "--until-matched", readers, *quality, *written,
                               profile=profile))
        for load in loads:
            self.assertEqual(load.finish(), 0, str(load))
        for load in loads[:-1]:
            self.assertEqual(load["received"], loads[-1]["written"], str(load))
        return self.heard()

    @staticmethod
    def of_user(datagrams, kind):
        return [one for datagram in datagrams for one in datagram.submessages if one.kind == kind and one.is_of_user]

    def test_best_effort_sends_no_heartbeats_and_gets_no_acknowledgements(self):
        for profile, is_reliable in (("fastdds_reliable", True), ("fastdds_best_effort", False)):
            with self.subTest(profile):
                datagrams = self.exchange("fastdds", "--rate", 20, "--count", 10, profile=profile)
                self.assertEqual(len(self.of_user(datagrams, "DATA")), 10)
                for kind in "HEARTBEAT", "ACKNACK":
                    self.assertEqual(bool(self.of_user(datagrams, kind)), is_reliable, kind)

    def heartbeats(self, vendor, profile):
        """While a reader that is stopped does not acknowledge."""
        self.begin(2)
        quality = ("--reliable",) if vendor == "cyclone" else ()
        reader = self.load(1, vendor, "--subscribe", "t", *quality, "--until-matched", 1, profile=profile, seconds=60)
        writer = self.load(0, vendor, "--publish", "t", *quality, "--until-matched", 1, "--rate", 2, profile=profile,
                           seconds=2.5)
        wait_for(lambda: reader.says("matched_ns") and writer.says("matched_ns"))
        reader.process.send_signal(signal.SIGSTOP)
        self.assertEqual(writer.finish(), 0, str(writer))
        return len(self.of_user(self.heard(), "HEARTBEAT"))

    def test_heartbeats_come_as_often_as_the_profile_says(self):
        # A sample every 0.5 s has one with it.
        self.assertGreater(self.heartbeats("fastdds", "fastdds_fast_heartbeat"),
                           2 * self.heartbeats("fastdds", "fastdds_reliable"))
        self.assertGreater(self.heartbeats("cyclone", None), 1.5 * self.heartbeats("cyclone", "cyclone_slow_heartbeat"))

    def test_large_samples_are_cut_where_the_profile_says(self):
        for profile, fits in (("fastdds_fragments_1400", True), ("fastdds_fragments_64k", False), (None, False),
                              ("cyclone_one_frame", True), ("cyclone_fragments_64k", False)):
            with self.subTest(profile):
                vendor = profile.split("_")[0] if profile else "cyclone"
                quality = ("--reliable",) if vendor == "cyclone" else ()
                datagrams = self.exchange(vendor, "--size", LARGE, "--count", 3, "--rate", 5, profile=profile,
                                          quality=quality)
                self.assertLessEqual(max(one.length for one in datagrams), FRAME)
                self.assertEqual(not any(one.is_fragment for one in datagrams), fits)
                fragments = len(self.of_user(datagrams, "DATA_FRAG"))
                if fits:
                    self.assertGreater(fragments, 3 * LARGE / FRAME)
                else:
                    self.assertLess(fragments, 3 * LARGE / FRAME)

    def test_clients_of_a_discovery_server_do_without_multicast(self):
        self.begin(3)
        server = self.load(0, "fastdds", "--subscribe", "unused", profile="fastdds_discovery_server", seconds=4)
        clients = [self.load(i, "fastdds", flag, "t", "--until-matched", 1, "--reliable", "--keep-all", *more,
                             profile="fastdds_discovery_client", seconds=3)
                   for i, flag, more in ((1, "--subscribe", ()), (2, "--publish", ("--count", 5)))]
        for load in clients:
            self.assertEqual(load.finish(), 0, str(load))
        self.assertEqual(clients[0]["received"], 5)
        self.assertEqual(server.finish(), 0, str(server))
        datagrams = self.heard()
        clients = {self.network.address(1), self.network.address(2)}
        self.assertEqual({one.source for one in datagrams} - {self.network.address(0)}, clients)
        self.assertFalse([one for one in datagrams if one.is_multicast and one.source in clients])

    def test_without_their_server_clients_do_not_find_each_other(self):
        self.begin(2)
        loads = [self.load(i, "fastdds", flag, "t", "--until-matched", 1, profile="fastdds_discovery_client")
                 for i, flag in enumerate(("--subscribe", "--publish"))]
        self.assertEqual([load.finish() for load in loads], [3, 3])

    def announcements(self, profile):
        """By multicast, of a lone participant, in 3 s."""
        self.begin(1)
        self.assertEqual(self.load(0, "cyclone", "--publish", "t", profile=profile, seconds=3).finish(), 0)
        return sum(one.writer == rtps_capture.SPDP_WRITER for datagram in self.heard() if datagram.is_multicast
                   for one in datagram.submessages)

    def test_participants_tell_of_themselves_as_often_as_the_profile_says(self):
        self.assertGreaterEqual(self.announcements("cyclone_spdp_500ms"), 2 + self.announcements(None))

    def test_multicast_can_be_left_to_discovery(self):
        for profile, has_multicast in ((None, True), ("cyclone_multicast_for_discovery", False)):
            with self.subTest(profile):
                datagrams = self.exchange("cyclone", "--count", 5, profile=profile, readers=2, quality=("--reliable",))
                by_multicast = [one for one in datagrams if one.is_multicast]
                self.assertTrue(any(one.writer == rtps_capture.SPDP_WRITER for datagram in by_multicast
                                    for one in datagram.submessages))
                # Each sample for all, or for each; and one that says that the writer is gone, to readers that are not.
                self.assertIn(len(self.of_user(by_multicast, "DATA")), (5, 6) if has_multicast else (0,))
                self.assertIn(len(self.of_user(datagrams, "DATA")), (5, 6) if has_multicast else (10, 11, 12))

    def test_every_profile_is_tested_and_says_how_it_is_used(self):
        with open(__file__, encoding="utf-8") as own:
            text = own.read()
        for file in PROFILES.glob("*.xml"):
            self.assertIn(f'"{file.stem}"', text)
            self.assertIn(f"/path/to/{file.name} PROGRAM", file.read_text())


if __name__ == "__main__":
    if not is_possible() or not (TESTS / "cyclone_load").exists():
        print("skipped: needs user namespaces and Cyclone DDS", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
