"""How far broadcasts carry."""
import collections

import peer
from chart import GREY, Chart, Panel, axis
from document import Row, percent, within
from runs import OWN, ROOT, rate

NAME = "ranges"
TITLE = "Ranges"
FILE = "range_ns3.csv"
TEXT = """Share of broadcasts that arrive, over distance, log-distance with exponent 3 (`tests/validation/range.yaml`,
2000 broadcasts, all receivers in one run), and the distance at which it is one half, by linear interpolation. Tolerance:
0.7 %. With ns-3's preamble detector -82 dBm and 4 dB limit the range of the slow rates; without it a frame can be as weak as
the interference floor. Further modes: `range_more_ns3.csv`."""
COLUMNS = ["mode", "bytes", "detector", "range, m", "ns-3, m", "off", "largest difference of the shares"]
FRAMES = 2000


def cases(short):
    groups = collections.defaultdict(list)
    for row in [*peer.rows(FILE), *peer.rows("range_more_ns3.csv")]:
        groups[row["mode"], row["payload"], row["preamble_det"]].append(row)
    return [group for group in groups.items() if not short or group[0] in (("b11", "100", "0"), ("g54", "100", "0"))]


def settings(mode, detector, distances, payload):
    family = "g" if mode[0] == "g" else "b"
    free = {} if detector == "1" else {"radio.sensitivity": "-101 dBm", "radio.min_sinr": "-50 dB"}
    at_risk = {"radio.bits_at_risk": "payload_time"} if family == "g" else {}
    return {"radio.include": ROOT / f"config/radios/ieee80211{family}.yaml", "radio.broadcast_rate": rate(mode),
            "agents.posts.poses": [{"x": f"{d} m", "y": "0 m"} for d in distances],
            "agents.sender.controller.parameters.size": int(payload) - 7, **free, **at_risk}


def shares(runs, mode, detector, distances, payload):
    recorded = runs.play(OWN / "range.yaml", settings(mode, detector, distances, payload)).recorded()
    sent = recorded["sender"]["sent"]
    return [recorded[f"p{i}"]["received"] / sent for i in range(len(distances))]


def half(distances, values):
    """Where a falling curve first crosses one half."""
    before = (0, 1)
    for here in zip(distances, values):
        if here[1] < 0.5 <= before[1]:
            return before[0] + (here[0] - before[0]) * (before[1] - 0.5) / (before[1] - here[1])
        before = here
    return float("nan")


def measure(runs, case):
    (mode, payload, detector), rows = case
    distances = [float(row["dist_m"]) for row in rows]
    theirs = [float(row["pdr"]) for row in rows]
    ours = shares(runs, mode, detector, distances, payload)
    found, expected = half(distances, ours), half(distances, theirs)
    largest = max(abs(a - b) for a, b in zip(ours, theirs))
    return Row([mode, payload, "on" if detector == "1" else "off", f"{found:.2f}", f"{expected:.2f}", percent(found, expected),
                f"{largest:.3f}"],
               within(found, expected, 0.007, what=f"{mode}, {payload} bytes, detector {detector}"),
               (mode if payload == "100" else f"{mode}, {payload} B", detector, distances, ours, theirs))


def draw(rows):
    panel = Panel(x=axis("distance, m", log=True), y=axis("share received"))
    without = [row.data for row in rows if row.data[1] != "1"]  # the detector
    for curve, (mode, _, distances, ours, theirs) in enumerate(without):
        panel.line(distances, ours, curve=curve, label=mode)
        panel.marks(distances[::2], theirs[::2], "cross", curve=curve, scale=0.7)
    panel.line([], [], curve=GREY, label="ours; no detector")
    panel.marks([], [], "cross", curve=GREY, label="ns-3")
    return Chart(panel, title=TITLE)
