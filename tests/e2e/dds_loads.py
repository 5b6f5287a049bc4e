"""The loads of dds_load/ under way on hosts of a private network, and what they wrote down."""
import csv
import os
import pathlib

from private_network import INTERFACE

TESTS = pathlib.Path(os.environ["BARAKA_BIN"]).resolve().parent / "tests"
PROFILES = pathlib.Path(__file__).resolve().parents[2] / "config/dds"
VENDORS = "cyclone", "fastdds"
CONFIGURATION = {"cyclone": "CYCLONEDDS_URI", "fastdds": "FASTRTPS_DEFAULT_PROFILES_FILE"}
# Cyclone takes the interface that it likes best; on a host of ours there is no other than lo.
ON_THE_NETWORK = (f'<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="{INTERFACE}" multicast="true"/>'
                  "</Interfaces></General></Domain></CycloneDDS>")


def environment(profile=None):
    """Of a load with a file of config/dds, by its name without .xml."""
    if profile is None:
        return {"CYCLONEDDS_URI": ON_THE_NETWORK}
    file = PROFILES / f"{profile}.xml"
    vendor = profile.split("_")[0]
    text = f"{ON_THE_NETWORK},file://{file}" if vendor == "cyclone" else str(file)
    return {"CYCLONEDDS_URI": ON_THE_NETWORK, CONFIGURATION[vendor]: text}


class Load:
    """One of them, from its start on."""

    def __init__(self, network, host, vendor, journal, *arguments, profile=None):
        self.journal = journal
        self.stem = journal.with_suffix("")
        with open(f"{self.stem}.out", "w") as out, open(f"{self.stem}.err", "w") as err:
            self.process = network.start(host, TESTS / f"{vendor}_load", "--csv", journal, *arguments,
                                         env=environment(profile), stdout=out, stderr=err)

    def __str__(self):
        return "".join(pathlib.Path(f"{self.stem}{end}").read_text() for end in (".out", ".err"))

    def finish(self, timeout=60):
        """@return its exit status."""
        return self.process.wait(timeout)

    def says(self, key):
        return any(line.startswith(key + ": ") for line in str(self).splitlines())

    def __getitem__(self, key):
        """A number that it printed."""
        for line in str(self).splitlines():
            if line.startswith(key + ": "):
                return float(line.split(": ")[1])
        raise AssertionError(f"no '{key}:' in\n{self}")

    def events(self, kind):
        with open(self.journal, newline="") as file:
            return [row for row in csv.DictReader(file) if row["event"] == kind]
