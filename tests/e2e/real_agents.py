"""Agent daemons with emulated devices, each in a network namespace of its own, joined by a bridge; or,
without the right to make namespaces, on addresses of the loopback interface."""
import hashlib
import json
import os
import random
import signal
import subprocess
import sys
import time

from baraka import BIN, ROOT, Case, some_domain, wait_for
from ros import LOOPBACK

EMULATORS = ROOT / "tests/e2e/emulators"
ROBOTS = ROOT / "config/robots"
TESTS = BIN.parent / "tests"
MOTION_CAPTURE = TESTS / "motion_capture"
RADIO_PORT = 7300


class Network:
    """Places for `count` hosts that hear each other."""

    may_make_namespaces = None  # not asked yet

    def __init__(self, case, count):
        self.name = f"bk{os.getpid()}x{random.randrange(1000)}"
        self.count = count
        if Network.may_make_namespaces is None:
            Network.may_make_namespaces = self._may_make_namespaces()
        self.has_namespaces = Network.may_make_namespaces
        if self.has_namespaces:
            self.places = [Place(self._space(i), "eth0", f"10.77.0.{i + 1}") for i in range(count)]
            self._make_namespaces(case)
        else:
            net = random.randrange(1, 255)
            self.places = [Place(None, "lo", f"127.77.{net}.{i + 1}") for i in range(count)]

    def _space(self, i):
        return f"{self.name}-{i}"

    def _bridge(self):
        """Where the other ends of the interfaces are; that of a lone host is beside its own."""
        return f"{self.name}-bridge" if self.count > 1 else self._space(0)

    def _may_make_namespaces(self):
        if os.environ.get("BARAKA_NO_NAMESPACES"):
            return False
        probe = f"{self.name}-probe"
        if ip("netns", "add", probe, check=False) != 0:
            return False
        return ip("netns", "del", probe, check=False) == 0

    def _make_namespaces(self, case):
        for space in sorted({self._bridge(), *map(self._space, range(self.count))}):
            case.addCleanup(ip, "netns", "del", space, check=False)
            ip("netns", "add", space)
        if self.count > 1:
            inside(self._bridge(), "link add br0 type bridge", "link set br0 up")
        for i in range(self.count):
            self.plug_in(i, f"10.77.0.{i + 1}")

    def plug_in(self, i, address):
        """A new eth0 at place i, on the bridge."""
        space = self._space(i)
        inside(self._bridge(), f"link add port{i} type veth peer name eth0 netns {space}",
               f"link set port{i} {'master br0 ' if self.count > 1 else ''}up")
        inside(space, "link set lo up", f"addr add {address}/24 brd + dev eth0", "link set eth0 up")


def ip(*arguments, check=True):
    try:
        status = subprocess.run(["ip", *arguments], capture_output=not check).returncode
    except FileNotFoundError:
        status = 127
    if check and status != 0:
        raise AssertionError(f"ip {' '.join(arguments)}: status {status}")
    return status


def inside(space, *lines):
    """Commands of `ip` in a namespace, by one process."""
    run = subprocess.run(["ip", "-n", space, "-batch", "-"], input="\n".join(lines), text=True)
    if run.returncode != 0:
        raise AssertionError(f"ip -n {space}: {lines}: status {run.returncode}")


class Place:
    """Where one agent, its devices and its controller run."""

    def __init__(self, space, interface, address):
        self.space, self.interface, self.address = space, interface, address

    def add_address(self, address):
        inside(self.space, f"addr add {address}/24 brd + dev {self.interface}")

    def command(self, *arguments):
        prefix = ["ip", "netns", "exec", self.space] if self.space else []
        return [*prefix, *map(str, arguments)]


class Process:
    """A program under way at a place; what it prints goes to files."""

    def __init__(self, case, place, name, *arguments, env=None):
        case.processes += 1
        stem = case.folder / f"{case.processes}-{os.path.basename(str(name))}"
        self.out, self.err = stem.with_suffix(".out"), stem.with_suffix(".err")
        with self.out.open("w") as out, self.err.open("w") as err:
            # `ip netns exec` becomes the program: its pid is the program's.
            self.process = subprocess.Popen(place.command(name, *arguments),
                                            stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                            env={**os.environ, **(env or {})})
        case.addCleanup(self.end)

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()

    def send(self, what):
        """@return when, on time.monotonic()."""
        at = time.monotonic()
        self.process.send_signal(getattr(signal, what))
        return at

    def await_text(self, text, where="out", timeout=30):
        file = getattr(self, where)
        try:
            wait_for(lambda: text in file.read_text() or self.process.poll() is not None, timeout)
        except AssertionError:
            pass
        if text not in file.read_text():
            raise AssertionError(f"no '{text}' from {self.process.args}:\n{self}")

    def finish(self, timeout=20):
        """@return its exit status."""
        try:
            return self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{self.process.args} does not end\n{self}") from None

    def __getitem__(self, key):
        for line in self.out.read_text().splitlines():
            if line.startswith(key + ": "):
                return float(line.split(": ", 1)[1])
        raise AssertionError(f"no '{key}:' in\n{self}")

    def __str__(self):
        return f"--- stdout\n{self.out.read_text()}\n--- stderr\n{self.err.read_text()}"


class Device(Process):
    """An emulated device; its state comes from a file that it writes again and again."""

    def __init__(self, case, place, emulator, *arguments, ready):
        case.processes += 1
        self.state_file = case.folder / f"{case.processes}-state.json"
        super().__init__(case, place, sys.executable, EMULATORS / emulator, "--state",
                         self.state_file, *arguments)
        self.await_text(ready)
        self.announced = self.out.read_text().split(": ", 1)[1].strip()
        wait_for(self.state_file.exists)

    def state(self):
        return json.loads(self.state_file.read_text())

    def await_moving(self):
        wait_for(lambda: self.state()["moving"], 30)

    def await_standing(self, timeout=10):
        """@return when the wheels came to a stop, on time.monotonic()."""
        wait_for(lambda: not self.state()["moving"], timeout)
        return self.state()["stopped_at"]


class RealAgents(Case):
    """Agents as their daemons have them, by name."""

    def setUp(self):
        super().setUp()
        self.processes = 0
        self.domain = some_domain(self)
        self.environment = {"BARAKA_DOMAIN": str(self.domain), "CYCLONEDDS_URI": LOOPBACK,
                            "XDG_STATE_HOME": str(self.folder / "state")}

    @property
    def faults(self):
        """Of the Robotino: see emulators/robotino.py."""
        return self.folder / "faults.json"

    def program(self, place, name, *arguments):
        folder = BIN if (BIN / name).exists() else TESTS
        return Process(self, place, folder / name, *arguments, env=self.environment)

    def serve(self, place, name, address, text):
        daemon = self.start_serving(place, name, address, text)
        daemon.await_text("ready: ")
        return daemon

    def start_serving(self, place, name, address, text):
        """Without waiting until it is ready."""
        file = self.folder / f"{name}.yaml"
        kind = "mote" if "robot:" not in text else "robot"
        at = f"address: {place.address}, " if place.address else ""
        file.write_text(f"version: 1\nagent: {{name: {name}, address: {address}, kind: {kind}}}\n"
                        f"radio: {{interface: {place.interface}, {at}port: {RADIO_PORT}}}\n{text}")
        return self.program(place, "baraka-agentd", file)

    def mote(self, place, name, address, x, y, parameters=""):
        return self.serve(place, name, address, f"""
controller: {{program: help_mote, parameters: {{{parameters}}}}}
localisation: {{driver: static, pose: {{x: {x} m, y: {y} m}}}}
""")

    def robotino(self, place, name, address, *, pose=(0, 0, 0), more=""):
        """A Robotino in its REST interface. @return its daemon and itself."""
        device = Device(self, place, "robotino.py", "--pose", *pose, "--faults", self.faults,
                        ready="listening: ")
        host, port = device.announced.split(":")
        more = more(device) if callable(more) else more
        daemon = self.serve(place, name, address, f"""
robot: {{include: {ROBOTS}/robotino.yaml}}
wheels: {{driver: robotino_rest, host: {host}, port: {port}}}
infrared: {{driver: robotino_rest, host: {host}, port: {port}}}
{more}""")
        return daemon, device

    def tmc200(self, place, name, address, *, pose=(0, 0, 0), more=""):
        """A TMC200 on a serial line and infrared sensors under IIO. @return daemon and device."""
        device = Device(self, place, "tmc200.py", "--pose", *pose, ready="device: ")
        sensors = Process(self, place, sys.executable, EMULATORS / "iio.py",
                          self.folder / f"iio-{name}", "--pose-from", device.state_file)
        sensors.await_text("folder: ")
        more = more(device) if callable(more) else more
        daemon = self.serve(place, name, address, f"""
robot: {{include: {ROBOTS}/robertino.yaml}}
wheels:
  driver: tmc200
  device: {device.announced}
  motor: {{encoder_lines: 500, gear: 16, max_speed: 3600 rpm}}
infrared:
  driver: iio
  folder: "{self.folder}/iio-{name}"
  channels: [voltage0, voltage1, voltage2, voltage3, voltage4, voltage5]
{more}""")
        return daemon, device

    def capture_motion(self, place, name, device):
        """The true pose of an emulated robot becomes known to its daemon."""
        return Process(self, place, MOTION_CAPTURE, self.domain, f"rt/mocap/{name}/pose",
                       device.state_file, env=self.environment)


def sha256(program):
    return hashlib.sha256((BIN / program).read_bytes()).hexdigest()
