"""Namespaces joined by a wire in place of a simulated radio: tests/e2e/wire/wire.cpp."""
import os
import pathlib
import queue
import shutil
import signal
import subprocess
import tempfile
import threading
import time

from baraka import BIN, wait_for

WIRE = BIN.parent / "tests/wire"
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
PYTHON = shutil.which("python3", path="/usr/bin:/bin") or "python3"
USER = 65534

# The user gets a /dev/net/tun and a /dev/null that everybody may open, in a mount namespace of its own: what
# Debian gives to all, and a container may not.
DEVICES = ("mount -t tmpfs none /dev/net && mknod /dev/net/tun c 10 200 && mknod /dev/net/null c 1 3 && "
           "chmod 666 /dev/net/tun /dev/net/null && mount --bind /dev/net/null /dev/null")
AS_USER = (f"{DEVICES} && "
           f'exec setpriv --reuid {USER} --regid {USER} --clear-groups "$@"')


def as_user(command, prepare="true"):
    """The command as an ordinary user; as it is, if nobody else could start it otherwise.
    `prepare`: done before by root, in the mounts of this command alone."""
    if os.geteuid() != 0:
        return command
    return ["unshare", "--mount", "sh", "-c", AS_USER.replace(" && exec", f" && {prepare} && exec"), "sh", *command]


def is_refusal(said):
    """Whether what could not be made is refused by this machine: then there is nothing to test here, as in many containers.
    With BARAKA_NETWORKS=required nothing may be, as in .ci/run; any other failure is one of the test's subject."""
    is_allowed = os.environ.get("BARAKA_NETWORKS") != "required"
    return is_allowed and ("user namespaces" in said or "/dev/net/tun" in said)


def why_not(command=()):
    """Why no namespaces can be made here, or nothing."""
    finished = subprocess.run([*command, WIRE, "r0=10.77.0.1/16", "--programs", BIN], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=60, check=False)
    said = finished.stderr.strip()
    if finished.returncode != 0 and not is_refusal(said):
        raise AssertionError(f"status {finished.returncode}: {said}")
    return said if finished.returncode != 0 else ""


class Wire:
    """A run of agents r0, r1, ... under way."""

    def __init__(self, case, agents=3, user=False, rate=None, factor=1, options=(), prepare="true"):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="baraka-wire-"))
        case.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.folder.chmod(0o777)
        command = [str(WIRE), *(f"r{i}=10.77.0.{i + 1}/16" for i in range(agents)), "--programs", str(BIN),
                   "--state", str(self.folder), "--factor", str(factor), *map(str, options)]
        if rate:
            command += ["--rate", str(rate)]
        self.process = subprocess.Popen(as_user(command, prepare) if user else command, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, "PATH": PATH})
        case.addCleanup(self.close)
        self.answers, self.ended = queue.Queue(), {}
        threading.Thread(target=self.read, daemon=True).start()
        self.logs = 0
        answer = self.answers.get(timeout=60)
        if answer != "ready":
            raise AssertionError(f"{answer} {self.process.stderr.read()}")

    def read(self):
        for line in self.process.stdout:
            words = line.split()
            if words[0] == "ended":
                self.ended[int(words[2])] = int(words[3])
            else:
                self.answers.put(line.rstrip("\n"))
        self.answers.put("gone")

    def ask(self, *words):
        self.process.stdin.write("\t".join(map(str, words)).replace("\n", "\x1e") + "\n")
        self.process.stdin.flush()
        return self.answers.get(timeout=60)

    def start(self, agent, *command):
        self.logs += 1
        log = self.folder / f"{self.logs}.log"
        answer = self.ask("start", agent, log, *command)
        if not answer.startswith("started"):
            raise AssertionError(answer)
        return Started(self, int(answer.split()[1]), log)

    def run(self, agent, *command, timeout=60):
        """What a program said, which ended well."""
        return self.start(agent, *command).output(timeout)

    def close(self):
        if self.process.stdin and not self.process.stdin.closed:
            try:
                self.process.stdin.close()
            except BrokenPipeError:
                pass
        try:
            self.process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGKILL)
            self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()


class Started:
    def __init__(self, wire, number, log):
        self.wire, self.number, self.log = wire, number, log

    def text(self):
        return self.log.read_text(errors="replace")

    def says(self, what, timeout=30):
        return wait_for(lambda: what in self.text() and self.text(), timeout)

    def status(self, timeout=60):
        wait_for(lambda: self.number in self.wire.ended, timeout)
        return os.waitstatus_to_exitcode(self.wire.ended[self.number])

    def output(self, timeout=60):
        status = self.status(timeout)
        if status != 0:
            raise AssertionError(f"status {status}: {self.text()}")
        return self.text()


def namespaces():
    """Every namespace that some process is in, by kind and inode."""
    found = set()
    for link in pathlib.Path("/proc").glob("[0-9]*/ns/*"):
        try:
            found.add(os.readlink(link))
        except OSError:
            continue
    return found


def interfaces():
    return set(os.listdir("/sys/class/net"))


def gone_within(seconds, before, what):
    """What of what() is not in `before` after so long; empty as soon as there is nothing."""
    end = time.monotonic() + seconds
    while time.monotonic() < end and what() - before:
        time.sleep(0.05)
    return what() - before
