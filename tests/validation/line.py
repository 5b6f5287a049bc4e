"""Two senders on one side of their receiver."""
import collections
import math

import peer
from chart import Chart, Panel, around, axis
from document import Row, within
from runs import OWN

NAME = "line"
TITLE = "Two stations on a line"
FILE = "line_ns3.csv"
TEXT = """Saturated senders at d and 2 d on one side of the receiver (`tests/validation/line.yaml`; 802.11b, 11 Mb/s, 1500 bytes,
Friis): the share of data frames that begin within a slot of a frame of the other sender, three seeds of 8 s, the same
at every distance. Overlaps come in pairs, so the interval of a share is 2 standard deviations of a binomial distribution
with half as many trials; ours must be within twice that of ns-3's mean over all distances."""
COLUMNS = ["d, m", "frames", "ours", "interval", "ns-3", "interval"]
SLOT = 20_000  # ns


def cases(short):
    """Rows of ns-3 by distance."""
    groups = collections.defaultdict(list)
    for row in peer.rows(FILE):
        groups[float(row["distance_m"])].append(row)
    return [(d, rows) for d, rows in groups.items() if not short or d in (10, 25)]


def overlaps(run):
    """Data frames, and how many of them overlapped one of the other's at the start."""
    frames, overlapping, last, last_sender = 0, 0, None, None
    for at, sender in run.query("SELECT at_ns, transmitter FROM frames WHERE class = 'unicast' ORDER BY at_ns, frame"):
        frames += 1
        if last is not None and at - last < SLOT and sender != last_sender:
            overlapping += 2
        last, last_sender = at, sender
    return frames, overlapping


def interval(share, frames):
    return 2 * math.sqrt(2 * share * (1 - share) / frames)


def mean_of_peer():
    found = [(float(row["started"]), float(row["overlap"])) for row in peer.rows(FILE)]
    return sum(n * share for n, share in found) / sum(n for n, _ in found)


def measure(runs, case):
    distance, rows = case
    counts = [overlaps(runs.play(OWN / "line.yaml", {
        "agents.senders.line.spacing": f"{distance:g} m",
        "agents.senders.line.origin": [f"{distance:g} m", "0 m"]}, seed, 8)) for seed in (1, 2, 3)]
    frames = sum(one[0] for one in counts)
    share = sum(one[1] for one in counts) / frames
    their_frames = sum(float(row["started"]) for row in rows)
    theirs = sum(float(row["started"]) * float(row["overlap"]) for row in rows) / their_frames
    ours_off, theirs_off = interval(share, frames), interval(theirs, their_frames)
    return Row([f"{distance:g}", f"{frames:.0f}", f"{share:.4f}", f"± {ours_off:.4f}", f"{theirs:.4f}",
                f"± {theirs_off:.4f}"],
               within(share, mean_of_peer(), absolute=2 * ours_off, what=f"{distance:g} m"),
               (distance, share, ours_off, theirs, theirs_off))


def draw(rows):
    distances, ours, our_halves, theirs, their_halves = zip(*(row.data for row in rows))
    panel = Panel(x=axis("d, m"), y=axis("share of overlapping starts", limits=(0, 0.1)))
    panel.marks(distances, ours, "circle", around(ours, our_halves), curve=0, label="ours")
    panel.marks([one + 1 for one in distances], theirs, "cross", around(theirs, their_halves), curve=1, label="ns-3")
    panel.horizontal(mean_of_peer(), curve=1, opacity=0.5)
    return Chart(panel, title=TITLE)
