"""Hosts of a network that nobody else sees: network namespaces, with a /dev/shm each, on one bridge; no right is
needed but that to make user namespaces.

    with PrivateNetwork(2) as network:
        network.start(0, "ping", "-c", "1", network.address(1)).wait()
"""
import contextlib
import ctypes
import os
import pathlib
import signal
import subprocess

INTERFACE = "wlan0"
# The namespaces end with their holder, and the holder with the program that started it.
HOLD = """
set -e
ip link set lo up
echo hold $$
exec sleep infinity
"""
PLACE = """
set -e
mount -t tmpfs none /dev/shm
ip link set lo up
echo place $$
exec sleep infinity
"""
PR_SET_PDEATHSIG = 1
IP_MAY_PING = "/proc/sys/net/ipv4/ping_group_range"


def _die_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def is_possible():
    """Whether this user may make namespaces."""
    done = subprocess.run(["unshare", "-Urnm", "true"], capture_output=True, check=False)
    return done.returncode == 0


def has_networks():
    """Whether a run may make networks."""
    return is_possible() and os.access("/dev/net/tun", os.R_OK | os.W_OK)


class PrivateNetwork:
    """`count` hosts, from 0 on. Without `bridge` they have no interface but lo."""

    def __init__(self, count, bridge=True):
        self.count, self.bridge = count, bridge
        self.stack = contextlib.ExitStack()

    def __enter__(self):
        self.holder = self._hold(["unshare", "-Urnm", "sh", "-c", HOLD])
        self.places = [self._hold([*self._enter(self.holder), "unshare", "-nm", "sh", "-c", PLACE])
                       for _ in range(self.count)]
        if self.bridge:
            self._plug_in()
        return self

    def __exit__(self, *_):
        self.stack.close()

    def _hold(self, command):
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, preexec_fn=_die_with_parent)
        self.stack.callback(self._end, process)
        words = process.stdout.readline().split()
        if len(words) != 2:
            raise OSError(f"no namespace: {' '.join(command)}")
        return int(words[1])

    @staticmethod
    def _end(process):
        process.kill()
        process.wait()
        process.stdout.close()

    @staticmethod
    def _enter(pid):
        return ["nsenter", "--preserve-credentials", "-U", "-n", "-m", "-t", str(pid), "--"]

    def _ip(self, pid, *arguments):
        subprocess.run([*self._enter(pid), "ip", *map(str, arguments)], check=True)

    def _plug_in(self):
        self._ip(self.holder, "link", "add", "br0", "type", "bridge", "mcast_snooping", "0")
        self._ip(self.holder, "link", "set", "br0", "up")
        for i, pid in enumerate(self.places):
            self._ip(self.holder, "link", "add", f"port{i}", "type", "veth", "peer", "name", INTERFACE, "netns", pid)
            self._ip(self.holder, "link", "set", f"port{i}", "master", "br0", "up")
            self._ip(pid, "link", "set", INTERFACE, "address", f"02:00:00:00:{i >> 8:02x}:{i & 255:02x}")
            self.set_up(i)

    def set_up(self, i):
        """The address, and a way for multicast."""
        self._ip(self.places[i], "addr", "add", f"{self.address(i)}/16", "brd", "+", "dev", INTERFACE)
        self._ip(self.places[i], "link", "set", INTERFACE, "up")
        self._ip(self.places[i], "route", "add", "224.0.0.0/4", "dev", INTERFACE)

    def address(self, i):
        return f"10.77.{(i + 1) >> 8}.{(i + 1) & 255}"

    def namespace(self, i):
        """File of the network namespace; the user namespace that owns it is the holder's."""
        return pathlib.Path(f"/proc/{self.places[i]}/ns/net")

    def command(self, i, *arguments):
        """A command line that runs another one at host i."""
        return [*self._enter(self.places[i]), *map(str, arguments)]

    def outside(self, *arguments):
        """The same where the bridge is, in the user namespace that owns all others."""
        return [*self._enter(self.holder), *map(str, arguments)]

    def start(self, i, *arguments, env=None, **more):
        """A program under way at host i; it is killed with the network."""
        process = subprocess.Popen(self.command(i, *arguments), text=True, env={**os.environ, **(env or {})}, **more)
        self.stack.callback(self._kill, process)
        return process

    @staticmethod
    def _kill(process):
        if process.poll() is None:
            process.kill()
        process.communicate()
