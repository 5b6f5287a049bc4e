#!/usr/bin/env python3
"""The measurements of DDS over the air in their short form: they run, and their tables hold what they are for."""
import subprocess
import sys
import unittest

from baraka import BIN, ROOT, Case
from dds_loads import TESTS
from private_network import is_possible

SKIPPED = 77
BENCHES = ROOT / "tests/bench/dds"


def rows(text):
    """[{column: text}] of a table in Markdown."""
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    return [dict(zip(lines[0], line)) for line in lines[2:]]


class DdsBenches(Case):
    def measure(self, name, *arguments, store="store"):
        done = subprocess.run([sys.executable, BENCHES / f"{name}.py", "--build", BIN.parent, "--store",
                               self.folder / store, "--kept", self.folder / "kept", *map(str, arguments)],
                              capture_output=True, text=True, timeout=300, check=False)
        logs = [file.read_text() for file in (self.folder / "kept").rglob("*.log")]
        self.assertEqual(done.returncode, 0, "\n".join([done.stdout, done.stderr, *logs]))
        return done.stdout

    def again(self, name, printed, *arguments):
        """The same from the store, at once."""
        self.assertEqual(self.measure(name, *arguments), printed)

    def test_latency(self):
        arguments = ("--stations", 3, "--factors", 1, 0.5, "--seconds", 2, "--rate", 100, "--peer-stations")
        printed = self.measure("air_latency", *arguments)
        found = rows(printed)
        self.assertEqual([(row["stations"], row["pace"]) for row in found],
                         [("3", "lock-step"), ("3", "1.00"), ("3", "0.500")], printed)
        for row in found:
            self.assertGreater(int(row["samples"]), 600, printed)
            self.assertGreater(float(row["p50, ms"].split()[0]), 0.1, "the air alone takes that")
        self.assertEqual([row["late in, p99, us"] == "-" for row in found], [True, False, False], printed)
        self.assertIn("from 1 to 0.5 the median moves by", printed)
        self.again("air_latency", printed, *arguments)
        alone = rows(self.measure("air_latency", *(word for word in arguments if word not in ("--factors", 1, 0.5))))
        self.assertEqual([row["pace"] for row in alone], ["lock-step"])
        self.assertNotIn("late in, p99, us", alone[0])

    def test_loss(self):
        printed = self.measure("dds_loss", "--short")
        found = {row["retries"]: row for row in rows(printed)}
        self.assertEqual(set(found), {"none", "802.11's"}, printed)
        self.assertGreater(float(found["802.11's"]["received/sent"].split()[0]), 0.95, printed)
        self.again("dds_loss", printed, "--short")

    def test_links(self):
        printed = self.measure("dds_links", "--short")
        shares = [float(row["received/sent"].split()[0]) for row in rows(printed)]
        self.assertGreater(shares[0], 0.5, printed)
        self.assertLess(shares[1], 0.8 * shares[0], printed)  # 0.36 of the frames pass both links
        self.again("dds_links", printed, "--short")
        anew = self.measure("dds_links", "--short", store="anew")
        self.assertEqual(rows(anew), rows(printed), "in lock-step equal runs are equal")

    def test_storm(self):
        printed = self.measure("discovery_storm", "--short")
        found = rows(printed)
        self.assertEqual([row["participants"] for row in found], ["2", "4"], printed)
        self.assertGreater(float(found[1]["SEDP"]), float(found[0]["SEDP"]), printed)
        self.assertEqual({row["never"] for row in found}, {"0"}, printed)
        self.assertRegex(printed, r"air time grows as N\^\d")

    def test_access_point(self):
        printed = self.measure("access_point", "--short")
        found = {(row["radio"], row["topic"]): row for row in rows(printed)}
        self.assertEqual(len(found), 4, printed)
        late = [float(found[radio, "stream"]["p50, ms"]) for radio in ("g, 54 Mb/s", "ac, 80 MHz")]
        self.assertGreater(late[0], 10 * late[1], "two times 19.2 Mb/s are more than g carries")
        self.assertEqual(found["ac, 80 MHz", "stream"]["delivered"], "1.00", printed)
        self.again("access_point", printed, "--short")

    def test_what_if(self):
        printed = self.measure("qos", "--short")
        found = rows(printed)
        self.assertEqual(len(found), 2, printed)
        self.assertIn("yes", [row["not dominated"] for row in found])


if __name__ == "__main__":
    if not is_possible() or not (TESTS / "cyclone_load").exists():
        print("skipped: needs user namespaces and Cyclone DDS", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
