"""A peer that knows only ROS 2's messages, on Cyclone DDS with its default discovery on loopback."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from baraka import BIN, wait_for

PEER = BIN.parent / "tests/ros_peer"
needs_peer = unittest.skipUnless(
    PEER.exists(), "no ros_peer: Cyclone DDS was not there (cyclonedds-dev) when this was built")
LOOPBACK = ('<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="true"/>'
            "</Interfaces></General></Domain></CycloneDDS>")


class Peer:
    """`ros_peer` under way; ready when this is made. What it prints goes to a file."""

    def __init__(self, case, *arguments):
        folder = pathlib.Path(tempfile.mkdtemp(dir=case.folder))
        self.out, self.err = folder / "out", folder / "err"
        with self.out.open("w") as out, self.err.open("w") as err:
            self.process = subprocess.Popen(
                [PEER, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                env={**os.environ, "CYCLONEDDS_URI": LOOPBACK})
        case.addCleanup(self.end)
        wait_for(lambda: "ready" in self.err.read_text() or self.process.poll() is not None)
        case.assertIsNone(self.process.poll(), self.err.read_text())

    def lines(self):
        """What it has printed, as JSON; the last line may not be complete yet."""
        text = self.out.read_text()
        return [json.loads(line) for line in text[:text.rfind("\n") + 1].splitlines()]

    def samples(self, topic):
        return [line for line in self.lines() if line["topic"] == topic]

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
