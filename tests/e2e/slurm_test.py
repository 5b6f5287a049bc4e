#!/usr/bin/env python3
"""Campaigns on a cluster: the runs of a campaign under Slurm are those of this computer, whatever
node, daemon or campaign is killed on the way; and what can be wrong with a cluster is said."""
import contextlib
import os
import re
import shutil
import signal
import sqlite3
import sys
import time
import unittest

import slurm_cluster
from baraka import ROOT, Case, Program, wait_for
from slurm_cluster import Cluster, descendants, stat_of

MISSING = slurm_cluster.missing()
TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
MANY = ROOT / "config/scenarios/many_robots.yaml"
FAULTY = ROOT / "tests/e2e/faulty.yaml"
LONG = 600  # s, in which a lost node is found out, and its runs start again


class Campaigns(Case):
    def campaign(self, scenario=TWO_MOTES, replications=6, more="", slurm="poll: 200 ms"):
        """Writes a campaign file."""
        file = self.folder / "campaign.yaml"
        file.write_text(f"version: 1\nname: c\nscenario: {scenario}\nreplications: {replications}\n"
                        f"keep: all\n{more}\nslurm: {{{slurm}}}\n")
        return file

    def start_cluster(self, **settings):
        cluster = Cluster(self.folder / "cluster", **settings)
        self.addCleanup(cluster.close)
        return cluster

    def start_on(self, cluster, file, *arguments, out="slurm"):
        self.out = self.folder / out
        engine = [] if cluster is None else ["--engine", "slurm"]
        program = Program("baraka", "campaign", file, "--out", self.out, *engine, *arguments,
                          env=cluster.environment if cluster else None)
        self.addCleanup(program.clean_up)
        return program

    def run_on(self, cluster, file, *arguments, status=0, out="slurm", timeout=120):
        finished = self.start_on(cluster, file, *arguments, out=out).finish(timeout)
        self.assertEqual(finished.status, status, f"{finished}\n{cluster.log() if cluster else ''}")
        return finished

    def rows(self, sql, out=None):
        """Of the campaign's database; none while it is not there."""
        file = (out or self.out) / "campaign.sqlite"
        if not file.exists():
            return []
        with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as database:
            try:
                return database.execute(sql).fetchall()
            except sqlite3.OperationalError:
                return []

    def done(self):
        return [run for run, in self.rows("SELECT run FROM runs WHERE state = 'done'")]

    def fingerprints(self, out):
        return dict(self.rows("SELECT run, fingerprint FROM runs WHERE state = 'done'", self.folder / out))

    def submissions(self):
        return [value.split() for value, in self.rows(
            "SELECT value FROM campaign WHERE key GLOB 'slurm.[0-9]*' ORDER BY key")]

    def logs(self):
        return {log.name: log.read_text() for log in sorted((self.out / "runs").glob("*.log"))}

    def assert_each_ran_to_its_end_once(self, count):
        """Of the ends that each log tells, all but one are of runs that found a result there."""
        ends = {name: len(re.findall(r"^result: (?!interrupted)", log, re.M)) - log.count("the result is there already")
                for name, log in self.logs().items()}
        self.assertEqual(ends, {name: 1 for name in self.logs()})
        self.assertEqual(len(self.logs()), count)

    def assert_equal_to_local(self, file, count):
        self.run_on(None, file, out="local")
        self.assertEqual(self.fingerprints("slurm"), self.fingerprints("local"))
        self.assertEqual(len(set(self.fingerprints("local").values())), count)


class LostNodes(Campaigns):
    """One campaign of 20 runs local and under Slurm; on the way one slurmd is
    killed, then one together with its slurmstepds, whose runs go on."""

    def test_20_runs_are_those_of_this_computer_when_nodes_are_lost(self):
        file = self.campaign(MANY, 20, more="until: 1800 s")
        cluster = self.start_cluster()
        program = self.start_on(cluster, file)
        wait_for(lambda: self.done(), timeout=60)

        # One slurmd alone: its runs go on under their slurmstepds, and Slurm starts them again.
        wait_for(lambda: self.writers(cluster, "n2"))
        cluster.kill("n2")
        wait_for(lambda: cluster.state_of("n2").startswith("DOWN"), timeout=90)
        cluster.start("n2")
        wait_for(lambda: cluster.state_of("n2") in ("IDLE", "MIXED", "ALLOCATED"), timeout=60)

        # One with its slurmstepds: its runs are nobody's any more, and one of them takes its time.
        frozen = max(wait_for(lambda: self.writers(cluster, "n1"), timeout=60))  # the youngest
        victims = cluster.stepds("n1")
        cluster.kill("n1")
        for pid in victims:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        os.kill(frozen, signal.SIGSTOP)  # not before: what is stopped when it is orphaned gets a SIGHUP
        said = f"another run is writing there (pid {frozen})"
        wait_for(lambda: any(said in log for log in self.logs().values()), timeout=LONG)
        os.kill(frozen, signal.SIGCONT)

        finished = program.finish(LONG)
        self.assertEqual(finished.status, 0, f"{finished}\n{cluster.log()}")
        self.assertEqual((finished["finished"], finished["failed"]), ("20", "0"))
        self.assert_each_ran_to_its_end_once(20)
        told = [name for name, log in self.logs().items() if "the result is there already" in log]
        self.assertGreaterEqual(len(told), 1, "some run must have met its first process")
        self.assertEqual(len(self.submissions()), 1, "it was submitted once")
        self.assert_equal_to_local(file, 20)

    def writers(self, cluster, node):
        """Pids of runs below the slurmstepds of a node that hold their folders."""
        holders = {lock.read_text() for lock in (self.out / "runs").glob(".*.lock")}
        return [pid for stepd in cluster.stepds(node) for pid in descendants(stepd)
                if (stat_of(pid) or ("",))[0] == "baraka" and str(pid) in holders]


class Killed(Campaigns):
    def test_a_killed_campaign_finds_its_jobs_and_submits_none_twice(self):
        file = self.campaign(MANY, 8, more="until: 400 s")
        cluster = self.start_cluster()
        for signal_name, done in (("SIGKILL", 0), ("SIGKILL", 2), ("SIGINT", 4)):
            program = self.start_on(cluster, file)
            wait_for(lambda: len(self.done()) >= done and [3] == [len(words) for words in self.submissions()],
                     timeout=60)
            os.kill(program.process.pid, getattr(signal, signal_name))
            finished = program.finish()
        self.assertEqual(finished.status, 130, str(finished))
        self.assertRegex(finished.err, r"\d runs stay with Slurm \(job \d+\)")
        finished = self.run_on(cluster, file)
        self.assertEqual(finished["finished"], "8")
        self.assertEqual(len(self.submissions()), 1, self.submissions())
        name, first, job = self.submissions()[0]
        self.assertRegex(name, "^baraka-[0-9a-f]{8}-1$")
        self.assertEqual((first, job), ("1", "1"))
        self.assert_each_ran_to_its_end_once(8)
        self.assert_equal_to_local(file, 8)

    def test_killed_before_sbatch_answers_it_finds_the_job_by_its_name(self):
        """sbatch has submitted, and nobody has noted the number of the job."""
        slow = self.folder / "bin"
        slow.mkdir()
        (slow / "sbatch").write_text(f'#!/bin/sh\n{shutil.which("sbatch")} "$@"\n'
                                     f'[ "$1" = --version ] || {{ touch {self.folder}/sent; sleep 600; }}\n')
        (slow / "sbatch").chmod(0o755)
        file = self.campaign(replications=4, slurm="poll: 200 ms, arguments: [--hold]")
        cluster = self.start_cluster()
        environment = {**cluster.environment}
        cluster.environment["PATH"] = f"{slow}:{environment['PATH']}"
        program = self.start_on(cluster, file)
        wait_for((self.folder / "sent").exists)
        os.kill(program.process.pid, signal.SIGKILL)
        program.finish()
        self.assertEqual([len(words) for words in self.submissions()], [2], "its number is not noted")
        cluster.environment.update(environment)
        cluster.command("scontrol", "release", "1")
        self.assertEqual(self.run_on(cluster, file)["finished"], "4")
        self.assertEqual(len(self.submissions()), 1)

    def test_cancel_takes_the_jobs_out_and_the_campaign_can_go_on(self):
        file = self.campaign(MANY, 4, more="until: 2000 s")
        cluster = self.start_cluster()
        program = self.start_on(cluster, file)
        wait_for(lambda: "RUNNING" in cluster.tasks().values())
        program.process.send_signal(signal.SIGINT)
        self.assertEqual(program.finish().status, 130)
        self.assertEqual(len(cluster.tasks()), 4)
        local = Program("baraka", "campaign", file, "--out", self.out, env=cluster.environment).finish()
        self.assertEqual(local.status, 2, str(local))
        self.assertIn("4 runs of this campaign are with Slurm", local.err)
        local = self.run_on(None, file, status=2)
        self.assertIn("whether it still has some cannot be found out", local.err)
        cancelled = self.run_on(cluster, file, "--cancel")
        self.assertEqual(cancelled["cancelled"], "4")
        self.assertEqual(cluster.tasks(), {})
        self.assertEqual(self.run_on(cluster, self.campaign(MANY, 4, more="until: 2000 s"))["finished"], "4")
        self.assertEqual(len(self.submissions()), 2)

    def test_slurmctld_may_come_back_later(self):
        file = self.campaign(MANY, 6, more="until: 400 s")
        cluster = self.start_cluster()
        program = self.start_on(cluster, file)
        wait_for(lambda: "RUNNING" in cluster.tasks().values())
        cluster.kill("slurmctld")
        time.sleep(3)
        cluster.start("slurmctld")
        finished = program.finish()
        self.assertEqual(finished.status, 0, f"{finished}\n{cluster.log()}")
        self.assertEqual(finished["finished"], "6")
        self.assertIn("asking again", finished.err)
        self.assert_each_ran_to_its_end_once(6)


class Clusters(Campaigns):
    def test_without_slurm_it_says_so_before_anything_is_written(self):
        file = self.campaign()
        empty = self.folder / "bin"
        empty.mkdir()
        for environment, message in (({"PATH": str(empty)}, "Slurm's sbatch is in no folder of PATH"),
                                     ({"SLURM_CONF": str(self.folder / "none.conf")}, "no cluster answers")):
            self.out = self.folder / "slurm"
            refused = Program("baraka", "campaign", file, "--engine", "slurm", "--out", self.out,
                              env=environment).finish()
            self.assertEqual(refused.status, 2, str(refused))
            self.assertIn(message, refused.err)
            self.assertFalse(self.out.exists())

    def test_what_sbatch_refuses_is_told_and_can_be_put_right(self):
        cluster = self.start_cluster()
        refused = self.run_on(cluster, self.campaign(slurm="partition: gold"), status=1)
        self.assertIn("invalid partition specified: gold", refused.err)
        finished = self.run_on(cluster, self.campaign(slurm="partition: long, time: 5 min, poll: 200 ms"))
        self.assertEqual(finished["finished"], "6")
        shown = cluster.command("scontrol", "show", "job", self.submissions()[-1][2]).stdout
        self.assertIn("Partition=long", shown)
        self.assertIn("TimeLimit=00:05:00", shown)

    def test_a_full_queue_takes_them_bit_by_bit(self):
        cluster = self.start_cluster(settings="MaxJobCount=6\nMinJobAge=2")
        finished = self.run_on(cluster, self.campaign(replications=12))
        self.assertEqual(finished["finished"], "12")
        self.assertGreater(len(self.submissions()), 2)
        self.assert_each_ran_to_its_end_once(12)

    def test_an_array_has_no_more_indices_than_the_cluster_allows(self):
        cluster = self.start_cluster(settings="MaxArraySize=5")
        finished = self.run_on(cluster, self.campaign(replications=12))
        self.assertEqual(finished["finished"], "12")
        self.assertEqual([first for _, first, _ in self.submissions()], ["1", "6", "11"])

    def test_jobs_limits_how_many_run_at_a_time(self):
        cluster = self.start_cluster()
        self.run_on(cluster, self.campaign(replications=5), "--jobs", "1")
        shown = cluster.command("scontrol", "show", "job", "1").stdout
        self.assertIn("ArrayTaskThrottle=1", shown)

    def test_a_job_that_is_held_is_told_and_goes_on_when_it_is_released(self):
        cluster = self.start_cluster()
        program = self.start_on(cluster, self.campaign(slurm="poll: 200 ms, arguments: [--hold]"))
        line = program.process.stderr.readline()
        while "JobHeldUser" not in line and line:
            line = program.process.stderr.readline()
        self.assertIn("all 6 runs wait in the queue: JobHeldUser", line)
        self.assertEqual(cluster.command("scontrol", "release", "1").returncode, 0)
        finished = program.finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertEqual(finished["finished"], "6")

    def test_a_node_may_be_down_all_the_time(self):
        cluster = self.start_cluster(start=["n1"])
        self.assertEqual(self.run_on(cluster, self.campaign())["finished"], "6")
        self.assertEqual({host for host, in self.rows("SELECT DISTINCT host FROM runs")}, {"n1"})

    def test_failed_runs_are_listed_with_their_errors_and_done_again_on_request(self):
        cluster = self.start_cluster()
        file = self.campaign(FAULTY, 2, more="points:\n  - agents.robots.controller.parameters.throw_at: 1 s")
        for again in ([], ["--retry-failed"]):
            failed = self.run_on(cluster, file, *again, status=1)
            self.assertEqual(failed["failed"], "2")
            self.assertIn("the wheels have come off", failed.err)
        self.assertEqual(len(self.submissions()), 2)


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: of Debian's slurm-wlm and munge, there is no {', '.join(MISSING)}")
        sys.exit(77)
    unittest.main()
