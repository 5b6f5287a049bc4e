#!/usr/bin/env python3
"""The cluster that tests of Slurm run on: its jobs run, and nothing of it outlives its test."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import slurm_cluster
from slurm_cluster import Cluster, descendants, stat_of

MISSING = slurm_cluster.missing()
# Starts a cluster with jobs, says where it is, and waits to be killed.
DOOMED = """
import sys, time
from slurm_cluster import Cluster
cluster = Cluster(sys.argv[1])
print(cluster.command("sbatch", "--array=0-2", "--output=/dev/null", "--wrap", "sleep 600").stderr)
while not cluster.stepds("n1"): time.sleep(0.1)
print(cluster.keeper, flush=True)
time.sleep(600)
"""


def wait_until(condition, timeout=60):
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("waited in vain")
        time.sleep(0.1)


class ClusterOfTests(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="baraka-slurm-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, **settings):
        cluster = Cluster(self.folder / "cluster", **settings)
        self.addCleanup(cluster.close)
        return cluster

    def test_each_task_of_an_array_runs_once_on_one_of_two_nodes(self):
        cluster = self.start()
        submitted = cluster.command("sbatch", "--array=0-5", "--open-mode=append", f"--output={self.folder}/%a.log",
                                    "--wrap", "echo $SLURM_ARRAY_TASK_ID $SLURMD_NODENAME; sleep 1")
        self.assertEqual(submitted.returncode, 0, submitted.stderr)
        wait_until(lambda: not cluster.tasks())
        said = [(self.folder / f"{k}.log").read_text().split() for k in range(6)]
        self.assertEqual([number for number, _ in said], [str(k) for k in range(6)])
        self.assertEqual({node for _, node in said}, set(slurm_cluster.NODES))

    def test_closing_it_ends_daemons_and_jobs(self):
        cluster = self.start()
        cluster.command("sbatch", "--array=0-2", "--output=/dev/null", "--wrap", "sleep 600")
        wait_until(lambda: cluster.stepds("n1"))
        self.assert_that_all_end(cluster.keeper, cluster.close)

    def test_kill_9_of_the_test_ends_daemons_and_jobs(self):
        doomed = subprocess.Popen([sys.executable, "-c", DOOMED, self.folder / "cluster"], text=True,
                                  stdout=subprocess.PIPE, cwd=pathlib.Path(__file__).parent)
        self.addCleanup(doomed.stdout.close)
        keeper = self.number_from(doomed)

        def kill():
            os.kill(doomed.pid, signal.SIGKILL)
            doomed.wait()

        self.assert_that_all_end(keeper, kill)

    @staticmethod
    def number_from(doomed):
        for line in iter(doomed.stdout.readline, ""):
            if line.strip().isdigit():
                return int(line)
        raise AssertionError("it ended early")

    def assert_that_all_end(self, keeper, end):
        pids = descendants(keeper)
        names = {stat_of(pid)[0] for pid in pids}
        self.assertLessEqual({"munged", "slurmctld", "slurmd", "slurmstepd", "sleep"}, names)
        end()
        wait_until(lambda: not any(map(stat_of, [*pids, keeper])), timeout=10)


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: of Debian's slurm-wlm and munge, there is no {', '.join(MISSING)}")
        sys.exit(77)
    unittest.main()
