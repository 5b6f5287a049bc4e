#!/usr/bin/env python3
"""As many controller processes as agents: a hundred and two hundred, and limits that are too low."""
import os
import resource
import subprocess
import unittest

from baraka import BIN, ROOT, Case, Finished

SCENARIO = """version: 1
name: many
seed: 1
radio: {{profile: ideal}}
agents:
  motes:
    name: m{{}}
    mote: {{include: {mote}}}
    grid: {{columns: 20, rows: {rows}, spacing: [100 m, 100 m]}}
    controller:
      program: help_mote
      processes: {agents}
      overrides:
        - {{agents: m1, parameters: {{help_at: 200 ms}}}}
end:
  - {{at: 500 ms, result: done}}
"""


class Many(Case):
    def scenario(self, agents):
        path = self.folder / f"many{agents}.yaml"
        path.write_text(SCENARIO.format(agents=agents, rows=agents // 20,
                                        mote=ROOT / "config/robots/mote.yaml"))
        return path

    def run_many(self, agents):
        """@return a run with a process for each agent, once its fingerprint is that of one process."""
        expected = self.run_baraka(self.scenario(agents), "--controllers", "in-process")
        finished = self.run_baraka(self.scenario(agents), timeout=600)
        self.assertEqual(finished["result"], "done")
        self.assertEqual(finished["fingerprint"], expected["fingerprint"])
        self.assertGreater(int(finished["exchanges"]), agents)
        self.assertEqual(len(list(self.out.glob("motes-*.log"))), agents)
        return finished

    def test_a_hundred_agents_in_a_hundred_processes(self):
        self.run_many(100)

    def test_two_hundred_agents_in_two_hundred_processes(self):
        self.run_many(200)

    def limited(self, what, limit, agents):
        """A run whose processes may only have so much of something."""
        def lower():
            resource.setrlimit(what, (limit, limit))
        done = subprocess.run(
            [BIN / "baraka", "run", self.scenario(agents), "--out", self.folder / "out"],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, preexec_fn=lower)
        self.assertEqual(done.returncode, 1, str(Finished(done.returncode, done.stdout, done.stderr)))
        return done.stderr

    def test_too_few_open_files_are_named_before_anything_is_started(self):
        said = self.limited(resource.RLIMIT_NOFILE, 96, 100)
        self.assertRegex(said, r"error: 100 controller processes need \d+ open files, the limit is 96: "
                               r"raise it with 'ulimit -Hn \d+'")
        self.assertEqual(list((self.folder / "out.not-started").glob("motes-*.log")), [])

    def test_too_few_processes_are_named_with_the_limit(self):
        if os.geteuid() == 0:
            self.skipTest("root may start as many processes as it likes")
        said = self.limited(resource.RLIMIT_NPROC, 1, 100)
        self.assertRegex(said, r"error: .*'ulimit -u'")


if __name__ == "__main__":
    unittest.main()
