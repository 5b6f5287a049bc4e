#!/usr/bin/env python3
"""The loads that measurements put on the air: they understand each other, and their journals are true."""
import subprocess
import sys
import unittest

from baraka import Case
from dds_loads import TESTS, VENDORS, Load
from private_network import PrivateNetwork, is_possible

SKIPPED, NOT_MATCHED = 77, 3


class DdsLoad(Case):
    def load(self, network, host, vendor, *arguments):
        self.runs += 1
        return Load(network, host, vendor, self.folder / f"{self.runs}.csv", *arguments)

    def test_each_vendor_understands_the_other(self):
        for writer in VENDORS:
            for reader in VENDORS:
                with self.subTest(writer=writer, reader=reader), PrivateNetwork(2) as network:
                    self.check_exchange(network, writer, reader)

    def check_exchange(self, network, writer, reader):
        """30 samples of 20 kB one way and 20 of 64 bytes the other. On a busy machine one may end before the other has had a
        processor: then again, for longer."""
        for seconds in 1.2, 5, 20:
            common = ("--reliable", "--keep-all", "--until-matched", 1, "--for", seconds)
            loads = [self.load(network, 0, writer, *common, "--publish", "t", "--subscribe", "u", "--size", 20000, "--rate",
                               100, "--count", 30, "--writer", 1),
                     self.load(network, 1, reader, *common, "--publish", "u", "--subscribe", "t", "--rate", 50, "--count",
                               20, "--writer", 2)]
            ends = [load.finish() for load in loads]
            if ends == [0, 0] and (loads[0]["received"], loads[1]["received"]) == (20, 30):
                break
            self.assertLessEqual(set(ends), {0, NOT_MATCHED}, "\n".join(map(str, loads)))
        for load, own, others, size in (loads[0], 30, 20, 64), (loads[1], 20, 30, 20000):
            self.assertEqual((load["written"], load["write_failed"], load["received"]), (own, 0, others), str(load))
            self.assertEqual(load["received_bytes"], others * size)
            self.assertGreater(load["matched_s"], 0)
        for writing, reading in loads, loads[::-1]:
            written = {row["number"]: row for row in writing.events("write")}
            received = reading.events("receive")
            self.assertEqual([row["number"] for row in received], list(written))
            for row in received:
                self.assertEqual(row["stamp_ns"], written[row["number"]]["wall_ns"])
                self.assertGreater(int(row["wall_ns"]), int(row["stamp_ns"]))
            times = [int(row["mono_ns"]) for row in written.values()]
            rate = 100 if writing is loads[0] else 50
            # The rest may follow closer than the rate says if a busy computer let the first wait.
            self.assertGreaterEqual(times[-1] - times[0], 0.5 * (len(times) - 1) * 10 ** 9 / rate)

    def test_two_of_a_kind_that_write_and_read_one_topic_do_not_count_themselves(self):
        for vendor in VENDORS:
            with self.subTest(vendor), PrivateNetwork(3) as network:
                loads = [self.load(network, i, vendor, "--reliable", "--keep-all", "--publish", "t", "--subscribe", "t",
                                   "--writer", i, "--until-matched", 2, "--count", 5, "--for", 1.2) for i in range(3)]
                for i, load in enumerate(loads):
                    self.assertEqual(load.finish(), 0, str(load))
                    self.assertEqual(load["received"], 10, str(load))
                    self.assertEqual({row["writer"] for row in load.events("receive")},
                                     {str(j) for j in range(3)} - {str(i)})

    def test_samples_are_written_in_the_phase_asked_for(self):
        for vendor in VENDORS:
            for phase in 0.02, 0.07:
                with self.subTest(vendor, phase=phase), PrivateNetwork(1) as network:
                    load = self.load(network, 0, vendor, "--publish", "t", "--rate", 10, "--phase", phase, "--count", 20,
                                     "--for", 2.5)
                    self.assertEqual(load.finish(), 0, str(load))
                    late = [(int(row["mono_ns"]) / 1e9 - phase) % 0.1 for row in load.events("write")]
                    self.assertGreaterEqual(len(late), 10)
                    self.assertLess(min(late), 0.01, "a busy computer may be late, not each time")

    def test_who_is_not_matched_in_time_says_so(self):
        for vendor in VENDORS:
            with self.subTest(vendor), PrivateNetwork(1) as network:
                load = self.load(network, 0, vendor, "--publish", "t", "--until-matched", 1, "--for", 0.3)
                self.assertEqual(load.finish(), 3, str(load))
                self.assertEqual(load["written"], 0)
                self.assertFalse(load.says("matched_s"))

    def test_wrong_command_lines_are_refused(self):
        for arguments, seen in ((("--publish", "t", "--rate", "0"), "--rate: '0'"), ((), "--publish or --subscribe"),
                                (("--publish", "t", "--size"), "--size:"), (("--publish", "t", "--count", "1.5"), "1.5"),
                                (("--publish", "t", "--often"), "--often:"),
                                (("--publish", "t", "--keep-all", "--keep-last", "3"), "--keep-all")):
            for vendor in VENDORS:
                done = subprocess.run([TESTS / f"{vendor}_load", *arguments], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(seen, done.stderr)


if __name__ == "__main__":
    if not is_possible() or not (TESTS / "cyclone_load").exists():
        print("skipped: needs user namespaces and Cyclone DDS", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
