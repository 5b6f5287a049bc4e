"""A cluster of Debian's slurm-wlm on this machine: munged, slurmctld and two slurmds, in a folder of its
own, without systemd and without accounting, as root or as an ordinary user.

The daemons are children of a keeper process, which adopts whatever they leave behind. It reads a pipe
that this process holds open: when this process ends, even by kill -9, all of them end, and all jobs."""
import contextlib
import ctypes
import getpass
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time

DAEMONS = ("munged", "slurmctld", "slurmd")
COMMANDS = ("sbatch", "squeue", "scancel", "scontrol", "sinfo")
NODES = ("n1", "n2")
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36

SLURM_CONF = """\
ClusterName=baraka
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
# A task of a lost node waits this long before it starts again; by default 120 s.
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,bf_interval=1
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
KillWait=2
InactiveLimit=0
MessageTimeout=3
{settings}
{nodes}
PartitionName=short Nodes=ALL Default=YES MaxTime=10 State=UP
PartitionName=long Nodes=ALL MaxTime=INFINITE State=UP
"""


def missing():
    """What of Slurm is not installed, for a message; empty: nothing."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return [name for name in (*DAEMONS, *COMMANDS) if not shutil.which(name, path=path)]


def daemon(name):
    return shutil.which(name, path="/usr/sbin:/sbin:" + os.environ.get("PATH", ""))


def free_ports(count):
    """Ports of 127.0.0.1 that nobody has."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


def stat_of(pid):
    """(name, state, parent) of a process; None: it is gone."""
    try:
        text = pathlib.Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return None
    name, _, rest = text.partition("(")[2].rpartition(")")
    fields = rest.split()
    return name, fields[0], int(fields[1])


def processes():
    """(name, state, parent) by pid."""
    all_ = {int(p.name): stat_of(p.name) for p in pathlib.Path("/proc").glob("[0-9]*")}
    return {pid: stat for pid, stat in all_.items() if stat}


def descendants(root):
    """Pids of all processes below one, that one not included."""
    table, found, front = processes(), [], [root]
    while front:
        front = [pid for pid, (_, _, parent) in table.items() if parent in front]
        found += front
    return found


class Cluster:
    """Started by the constructor; ends with close(), or with this process.

    settings: further lines of slurm.conf, as "MaxJobCount=10"; nodes: how many of NODES are started."""

    def __init__(self, folder, settings="", start=NODES):
        self.folder = pathlib.Path(folder).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        for name in ("state", *NODES):
            (self.folder / name).mkdir()
        self.folder.chmod(0o755)
        ports = free_ports(1 + len(NODES))
        host = socket.gethostname()
        nodes = "\n".join(f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=2 State=UNKNOWN"
                          for node, port in zip(NODES, ports[1:]))
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(SLURM_CONF.format(folder=self.folder, host=host, user=getpass.getuser(),
                                               controller_port=ports[0], nodes=nodes, settings=settings))
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf)}
        self.pids = {}
        self._start_keeper()
        self.start("munged")
        self._wait(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.start("slurmctld")
        self._wait(lambda: self.command("scontrol", "ping").returncode == 0, "slurmctld")
        for node in start:
            self.start(node)
        for node in start:
            self._wait(lambda: self.state_of(node).startswith("IDLE"), node)

    # The keeper.

    def _start_keeper(self):
        ours, theirs = socket.socketpair()
        self.keeper = os.fork()
        if self.keeper == 0:
            try:
                ours.close()
                Keeper(theirs).run()
            finally:
                os._exit(0)
        theirs.close()
        self.line = ours.makefile("rw", buffering=1)
        ours.close()

    def _ask(self, *words):
        print(*words, sep="\t", file=self.line)
        return self.line.readline().strip()

    def start(self, name):
        """Starts a daemon: "munged", "slurmctld" or the slurmd of a node, by its name."""
        commands = {
            "munged": [daemon("munged"), "--foreground", "--force", f"--key-file={self.folder}/munge.key",
                       f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                       f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munged.seed"],
            "slurmctld": [daemon("slurmctld"), "-D", "-f", self.conf]}
        command = commands.get(name, [daemon("slurmd"), "-D", "-N", name, "-f", self.conf])
        self.pids[name] = int(self._ask("start", self.folder / f"{name}.out", *command))

    def kill(self, name, sig=signal.SIGKILL):
        """Ends a daemon, and waits until it has ended."""
        pid = self.pids.pop(name)
        os.kill(pid, sig)
        self._wait(lambda: stat_of(pid) is None, f"the end of {name}")

    def close(self):
        with contextlib.suppress(OSError, ValueError):
            self.line.close()
        with contextlib.suppress(ChildProcessError):
            os.waitpid(self.keeper, 0)

    # What is asked of it.

    def command(self, *arguments, timeout=60):
        """Runs one of Slurm's commands, or any other with this cluster's configuration."""
        return subprocess.run(list(map(str, arguments)), env=self.environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=timeout, check=False)

    def state_of(self, node):
        return self.command("sinfo", "-h", "-n", node, "-p", "long", "-o", "%T").stdout.strip().upper()

    def tasks(self):
        """State of each task in the queue, by "job_index"."""
        lines = self.command("squeue", "-h", "-r", "-o", "%F_%K %T").stdout.split("\n")
        return dict(line.split() for line in lines if line)

    def stepds(self, node):
        """Pids of what starts the jobs of a node: its slurmstepds."""
        named = {pid: stat_of(pid) for pid in descendants(self.keeper)}
        return [pid for pid, stat in named.items()
                if stat and stat[0] == "slurmstepd" and self._node_of(pid) == node]

    def _node_of(self, pid):
        """Of the job below a slurmstepd."""
        for child in descendants(pid):
            with contextlib.suppress(OSError):
                environment = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
                for line in environment:
                    if line.startswith(b"SLURMD_NODENAME="):
                        return line.partition(b"=")[2].decode()
        return None

    def log(self):
        """What the daemons said, for messages."""
        return "\n".join(f"--- {file.name}\n{file.read_text(errors='replace')[-3000:]}"
                         for file in sorted(self.folder.glob("*.out")))

    def _wait(self, condition, what, timeout=60):
        end = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > end:
                log = self.log()
                self.close()
                raise AssertionError(f"waited in vain for {what}\n{log}")
            time.sleep(0.1)


class Keeper:
    """Starts what it is told to, adopts what that leaves, and ends it all when nobody tells it any more."""

    def __init__(self, line):
        self.libc = ctypes.CDLL(None, use_errno=True)
        self.socket = line
        self.line = line.makefile("rw", buffering=1)

    def run(self):
        os.setsid()  # Ctrl-C of the test is not for the daemons
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGCHLD, self._reap)
        self.libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        try:
            for request in self.line:
                _, log, *command = request.rstrip("\n").split("\t")
                print(self._start(log, command), file=self.line)
        except (OSError, ValueError):
            pass
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        while self._end_all():
            time.sleep(0.02)

    @staticmethod
    def _reap(*_):
        with contextlib.suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0] != 0:
                pass

    def _start(self, log, command):
        keeper = os.getpid()
        pid = os.fork()
        if pid != 0:
            return pid
        try:
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            self.libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
            out = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
            null = os.open(os.devnull, os.O_RDONLY)
            for source, target in ((null, 0), (out, 1), (out, 2)):
                os.dup2(source, target)
            os.closerange(3, 1024)
            if os.getppid() == keeper:
                os.execv(command[0], command)
        finally:
            os._exit(127)

    def _end_all(self):
        """Kills what is below this process, and takes leave of it. Whether there was anything."""
        alive = descendants(os.getpid())
        for pid in alive:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        self._reap()
        return bool(alive)


if __name__ == "__main__":  # a cluster to play with: slurm_cluster.py FOLDER
    cluster = Cluster(sys.argv[1])
    print(f"export SLURM_CONF={cluster.conf}\nCtrl-C ends it")
    with contextlib.suppress(KeyboardInterrupt):
        signal.pause()
    cluster.close()
