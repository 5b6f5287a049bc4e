"""Runs of ours, from YAML alone, and what they recorded."""
import contextlib
import json
import pathlib
import sqlite3
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "config/scenarios"
OWN = ROOT / "tests/validation"
SEEDS = (1, 2, 3, 4, 5)


def flow(value):
    """A value of --set: YAML in one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, dict)):
        return json.dumps(value).replace('"', "").replace(":", ": ").replace(":  ", ": ")
    return str(value)


class Run:
    """What is in the results of a run."""

    def __init__(self, folder):
        self.file = folder / "run.sqlite"

    def query(self, sql):
        with contextlib.closing(sqlite3.connect(f"file:{self.file}?mode=ro", uri=True)) as database:
            return database.execute(sql).fetchall()

    def recorded(self):
        """{agent: {name: value}}."""
        values = {}
        for agent, name, value in self.query(
                "SELECT a.name, r.name, r.value FROM recorded r JOIN agents a USING (agent)"):
            values.setdefault(agent, {})[name] = value
        return values

    def goodput(self, sink):
        """Mb/s."""
        return self.recorded()[sink]["goodput"] / 1e6

    def failures(self):
        """Share of the first frames of exchanges that failed: RTS, or data where there are none."""
        sent = dict(self.query("SELECT class, sum(count) FROM frames_sent GROUP BY class"))
        handed_over = sum(values.get("handed_over", 0) for values in self.recorded().values())
        return 1 - handed_over / (sent.get("rts") or sent["unicast"])


class Runs:
    def __init__(self, build):
        self.program = build / "bin/baraka"
        self.probe = build / "tests/radio_probe"
        self.drawer = build / "tests/draw_chart"
        self.folder = tempfile.TemporaryDirectory(prefix="baraka-validation-")
        self.count = 0

    def play(self, scenario, settings, seed=1, until=None, more=()):
        """Runs a scenario in process with `settings`, a mapping of --set, and more arguments; a Run."""
        self.count += 1
        folder = pathlib.Path(self.folder.name) / f"run{self.count}"
        command = [self.program, "run", scenario, "--controllers", "in-process", "--no-inspect", "--seed", seed,
                   "--out", folder, "--log", "error", *more]
        if until is not None:
            command += ["--until", until]
            settings = {**settings, "end": [{"at": "1000 s", "result": "later"}]}
        for key, value in settings.items():
            command += ["--set", f"{key}={flow(value)}"]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
        return Run(folder)

    def means(self, scenario, settings, measure, seeds=SEEDS, until=None):
        """Means over seeds of the numbers that measure(Run) gives."""
        found = [measure(self.play(scenario, settings, seed, until)) for seed in seeds]
        return [statistics.mean(one) for one in zip(*found)]

    def ask(self, questions):
        """What radio_probe answers to lines of words; numbers."""
        text = "\n".join(" ".join(map(str, words)) for words in questions)
        done = subprocess.run([self.probe], input=text + "\n", capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{self.probe}: {done.stderr}")
        return [float(line) for line in done.stdout.split()]

    def draw(self, chart, path):
        """Writes a chart (chart.py) as SVG. Equal charts give equal bytes."""
        done = subprocess.run([self.drawer], input=chart.json(), capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{path}: {done.stderr}")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(done.stdout, encoding="utf-8")


def radio_like(mode, control, slot_us, ack=None, rts=False):
    """Settings of `radio` for a row of ns-3's, by its names of rates: b11, g54. Where stock ns-3 and the
    standard differ it has what ns-3 has (docs/models.md, 10)."""
    family = "g" if mode[0] == "g" else "b"
    return {"radio.include": ROOT / f"config/radios/ieee80211{family}.yaml",
            "radio.data_rate": rate(mode), "radio.control_rate": rate(control),
            "radio.basic_rates": [f"{float(one):g} Mb/s" for one in sorted({float(ack or control[1:]),
                                                                           float(control[1:])})],
            "radio.slot": f"{float(slot_us):g} us", "radio.rts_threshold": 0 if rts else 2347,
            "radio.short_retry_limit": 255 if rts else 7,
            "radio.energy_detection": "-82 dBm", "radio.cca_time": "4 us",
            **({"radio.bits_at_risk": "payload_time"} if family == "g" else {})}


def cell_seconds(size, n, is_ofdm):
    """How long a cell of saturated senders is simulated; it is measured from 1 s on."""
    if size >= 500 and not is_ofdm:
        return 11
    return 6 if n < 50 else 4


def rate(mode):
    return f"{float(mode[1:]):g} Mb/s"
