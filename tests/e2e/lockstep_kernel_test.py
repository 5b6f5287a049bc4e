#!/usr/bin/env python3
"""What lock-step needs of the kernel is tried before a run: what is missing is named, all of it in one line. Things are taken away
by what takes them away elsewhere: seccomp filters of containers, mounts, limits."""
import os
import subprocess
import sys
import unittest

import wire
from baraka import BIN
from lockstep_test import REFUSED, Held, scenario

# Filters calls as a container's profile does, then becomes a program: {number: [first argument, or any, error]}.
FILTER = """
import ctypes, os, struct, sys
refused = eval(sys.argv[1])
load = lambda offset: struct.pack("<HBBI", 0x20, 0, 0, offset)
unless_equal = lambda value, skip: struct.pack("<HBBI", 0x15, 0, skip, value)
give = lambda what: struct.pack("<HBBI", 0x06, 0, 0, what)
code = b""
for number, (first, error) in refused.items():
    answer = give(0x50000 | error)
    if first is not None: answer = load(16) + unless_equal(first, 1) + answer
    code += load(0) + unless_equal(number, len(answer) // 8) + answer
code += give(0x7fff0000)
class Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("code", ctypes.c_char_p)]
libc = ctypes.CDLL(None, use_errno=True)
if libc.prctl(38, 1, 0, 0, 0) or libc.prctl(22, 2, ctypes.byref(Program(len(code) // 8, code)), 0, 0): sys.exit("no filter")
os.execvp(sys.argv[2], sys.argv[2:])
"""
PRCTL, PIDFD_GETFD, PIDFD_OPEN = 157, 438, 434
DISPATCH = {PRCTL: (59, 22)}  # PR_SET_SYSCALL_USER_DISPATCH: EINVAL, as of a kernel before 5.11


@unittest.skipIf(REFUSED, REFUSED)
class Needs(Held):
    def run_after(self, *prefix, pace="lockstep", status=1, errors=None):
        self.runs += 1
        self.out = self.folder / f"run{self.runs}"
        file = scenario(self.folder, {"a": [("ping", ["ping", "-c", 2, "-i", 0.1, "b"], ", on_exit: end")], "b": []})
        self.folder.chmod(0o777)
        finished = subprocess.run([*map(str, prefix), BIN / "baraka", "run", file, "--pace", pace, "--no-inspect", "--out", self.out],
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(finished.returncode, status, finished.stderr)
        lines = [line for line in finished.stderr.splitlines() if not line.startswith(("not started; ", "hint: ", "domain: "))]
        self.assertEqual(len(lines), status if errors is None else errors, finished.stderr)
        return finished, *lines

    def filtered(self, refused, **options):
        return self.run_after(sys.executable, "-c", FILTER, refused, **options)

    def refusal(self, refused):
        return self.filtered(refused)[1]

    def test_no_syscall_user_dispatch(self):
        self.assertEqual(self.refusal(DISPATCH), "error: lock-step needs of the kernel what is missing here: Syscall User Dispatch "
                         "(Linux 5.11 or later): Invalid argument; run in real time (--pace realtime)")

    def test_all_that_is_missing_is_named_in_one_line(self):
        self.assertEqual(self.refusal({**DISPATCH, PIDFD_GETFD: (None, 1)}),
                         "error: lock-step needs of the kernel what is missing here: Syscall User Dispatch (Linux 5.11 or later): "
                         "Invalid argument; pidfd_getfd(2) (Linux 5.6 or later): Operation not permitted; run in real time "
                         "(--pace realtime)")
        self.assertIn("pidfd_getfd(2) (Linux 5.6 or later): Function not implemented", self.refusal({PIDFD_OPEN: (None, 38)}))

    def test_real_time_does_without(self):
        finished, = self.filtered({**DISPATCH, PIDFD_GETFD: (None, 1)}, pace="realtime", status=0)
        self.assertIn("result: ping", finished.stdout)

    @unittest.skipUnless(os.geteuid() == 0, "needs root, to take something away")
    def test_what_is_taken_away_by_mounts_and_limits(self):
        def why(prepare, *command, **options):
            return self.run_after("unshare", "--mount", *command, "sh", "-c", prepare + ' && exec "$@"', "sh", **options)[1]
        self.assertRegex(why("mount -t tmpfs none /dev/net"), "^error: no /dev/net/tun, ")
        self.assertRegex(why("echo 0 > /proc/sys/user/max_user_namespaces", "--map-root-user", "--user"),
                         "^error: agents with a network need user namespaces, of which none are allowed here")
        self.assertRegex(why("mount -t tmpfs none /proc", status=2, errors=1),
                         ":[0-9]+:[0-9]+: command: /usr/bin/ping cannot be checked without /proc")

    @unittest.skipUnless(os.geteuid() == 0, "needs root, to hide processes")
    def test_processes_of_others_may_be_hidden(self):
        for user in (False, True):
            hidden = "mount -t proc -o hidepid=invisible none /proc"
            prefix = wire.as_user([], prepare=hidden) if user else [
                "unshare", "--mount", "sh", "-c", hidden + ' && exec "$@"', "sh"]
            with self.subTest(user=user):
                finished, = self.run_after(*prefix, status=0)
                self.assertIn("result: ping", finished.stdout)


if __name__ == "__main__":
    unittest.main()
