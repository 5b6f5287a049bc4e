#!/usr/bin/env python3
"""Random faults during runs, as many as BARAKA_FAULTS says (faults.py); and that the script finds what it looks for."""
import os
import signal
import subprocess
import unittest

import faults


class Faults(unittest.TestCase):
    def test_they_leave_nothing_behind_and_results_can_be_read(self):
        met, _, found = faults.soak(int(os.environ.get("BARAKA_FAULTS", "12")), seed=1, jobs=2)
        self.assertEqual(found, [])
        self.assertGreater(len(met), 5, met)

    def test_the_script_finds_what_it_looks_for(self):
        run = faults.Run(1, 0)
        run.out.mkdir()
        (run.out / "run.sqlite").write_bytes(b"SQLite format 3\0" + bytes(5000))
        script = "sleep 60 >/dev/null & echo $! >&2; : >tmp/left; kill -SEGV $$"
        run.process = subprocess.Popen(["sh", "-c", script], cwd=run.folder, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, env={**os.environ, **run.mark.variables})
        pid = int(run.process.stderr.readline())
        self.addCleanup(os.kill, pid, signal.SIGKILL)
        self.addCleanup(run.process.stderr.close)
        faults.GONE_WITHIN, before = 0, faults.GONE_WITHIN
        wrong = run.judged()
        faults.GONE_WITHIN = before
        self.assertIn("ended by signal 11", wrong)
        # Called sh until it has become sleep.
        self.assertTrue({f"left process {pid}: sleep", f"left process {pid}: sh"} & set(wrong), wrong)
        self.assertTrue(any(one.startswith("its tables: ") for one in wrong), wrong)

    def test_a_run_that_does_not_end_is_found(self):
        run = faults.Run(1, 0)
        run.process = subprocess.Popen(["sh", "-c", "echo >tmp/left; exec sleep 60"], cwd=run.folder, stdout=subprocess.PIPE)
        faults.ENDS_WITHIN, before = 0.5, faults.ENDS_WITHIN
        wrong = run.judged()
        faults.ENDS_WITHIN = before
        self.assertEqual(wrong, ["has not ended 0.5 s after its last fault"])

    def test_a_file_that_an_ended_run_leaves_is_found(self):
        run = faults.Run(1, 0)
        run.process = subprocess.Popen(["sh", "-c", ": >tmp/left"], cwd=run.folder, stdout=subprocess.PIPE)
        self.assertEqual(run.judged(), [f"left {run.folder}/tmp/left"])


if __name__ == "__main__":
    unittest.main()
