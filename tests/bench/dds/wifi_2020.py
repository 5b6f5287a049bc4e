#!/usr/bin/env python3
"""60 kB reliable through an access point at 80 and 100 Hz, as OSRF's TSC-RMW report measured it (2020, raw logs in
wifi_2020.csv), over 802.11n in each width and number of streams, because the report tells neither.

    cmake --build build/release --target baraka baraka-holder cyclone_load fastdds_load
    tests/bench/dds/wifi_2020.py [--runs N] [--parallel N] [--store FILE] [--short]

Two stations, 5 m from the access point that relays between them, so that each byte is twice on the air; one writer, one
reader, keep last 10. Radio file as shipped but for width, streams, MCS and rate control. Profiles: '2020', receive
buffers as Linux gave them where its limit was its default (212,992 B, which it doubles for those who ask: Cyclone);
'4 MiB', buffers that are asked for; 'one frame', fragments that DDS cuts so that IP does not. Received: in the seconds
from the first call of write on, of what the rate says; the report's writer kept to its rate, ours waits where the
station's queue is full. A run is dead if nothing arrives in the last sixth of these seconds. From the reader's kernel:
IP fragments that came, those that failed to be put together, and datagrams that found the receive buffer full. The
kernel gives up a datagram that lacks a fragment after 30 s of the computer's time, also in lock-step; the store counts
those, too.
"""
import collections
import csv
import itertools
import pathlib
import tempfile

import figures
import journals
import own
from store import Store

MEASURED = pathlib.Path(__file__).with_name("wifi_2020.csv")
SIZE, RATES = 60_000, (80, 100)  # B, Hz
VENDORS = "cyclone", "fastdds"
ASKED = {"2020": {"cyclone": 212_992, "fastdds": None}, "4 MiB": {"cyclone": 4_194_304, "fastdds": 4_194_304}}  # B
ONE_FRAME = "one frame"
OF_ONE_FRAME = {"cyclone": "cyclone_one_frame", "fastdds": "fastdds_fragments_1400"}
PROFILES = {
    "cyclone": """<CycloneDDS xmlns="https://cdds.io/config"><Domain id="any"><Internal>
<SocketReceiveBufferSize min="{0} B" max="{0} B"/></Internal></Domain></CycloneDDS>""",
    "fastdds": """<dds><profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
<participant profile_name="participant" is_default_profile="true"><rtps>
<listenSocketBufferSize>{0}</listenSocketBufferSize></rtps></participant></profiles></dds>"""}
COUNTERS = ("Ip", "ReasmReqds"), ("Ip", "ReasmOKs"), ("Ip", "ReasmFails"), ("Ip", "ReasmTimeout"), ("Udp", "RcvbufErrors")
KEYS = "width", "streams", "mcs", "control", "profile"
RADIO = "width, MHz", "streams", "MCS", "rate control", "profile"
DETAILS = [*RADIO, "vendor", "rate, Hz", "written, Hz", "p50, ms", "p99, ms", "air", "fragments", "not put together",
           "buffer full", "given up"]
BROKEN = 0.9  # of what the rate says: less than this is received in the median


class AccessPoint(own.Station):
    """A station without a network of its own: it only relays."""

    def section(self):
        return {key: value for key, value in super().section().items() if key not in ("network", "programs")}


class Load(own.Program):
    """That sees the files to which its environment refers: an agent's /tmp is its own."""

    def section(self):
        files = [text.removeprefix("file://") for text in self.environment.values()]
        return {**super().section(), "shown": [file for file in files if file.startswith(tempfile.gettempdir())]}


def load(case, options, writes, folder):
    vendor = case["vendor"]
    command = [options.build / f"tests/{vendor}_load", "--reliable", "--keep-last", 10, "--until-matched", 1, "--settle",
               1, "--for", options.discovery + options.seconds + options.linger, "--writer", 0 if writes else 1, "--csv",
               f"{{results}}/{0 if writes else 1}.csv"]
    if writes:
        command += ["--publish", "t", "--size", SIZE, "--rate", case["rate"], "--count",
                    round(options.seconds * case["rate"]), "--linger", options.linger]
    else:
        command += ["--subscribe", "t"]
    return Load("writer" if writes else "reader", command, environment(vendor, case["profile"], folder),
                       on_exit="end" if writes else "ignore", start=1)


def environment(vendor, profile, folder):
    """Of a load with a profile of ours, or whose sockets ask for a receive buffer."""
    if profile == ONE_FRAME:
        return own.environment(vendor, OF_ONE_FRAME[vendor])
    asked = ASKED[profile][vendor]
    if asked is None:
        return {}
    file = pathlib.Path(folder) / f"{vendor}.xml"
    file.write_text(PROFILES[vendor].format(asked))
    return {own.CONFIGURATION[vendor]: f"file://{file}" if vendor == "cyclone" else str(file)}


def kernel():
    """A program that keeps the kernel's counters of this second in a file."""
    return own.Program("kernel", ["/bin/sh", "-c", "while sleep 1; do cat /proc/net/snmp >{results}/snmp; done"])


def counters(file):
    """{(protocol, name): value} of /proc/net/snmp."""
    found, names = {}, {}
    for line in file.read_text().splitlines():
        protocol, values = line.split(": ", 1)
        if protocol in names:
            found.update({(protocol, name): int(value) for name, value in zip(names[protocol], values.split())})
        names[protocol] = values.split()
    return found


def measure(case, options):
    radio = own.radio("ieee80211n", bss={"access_point": "ap"}, width=f"{case['width']} MHz", streams=case["streams"],
                      mcs=case["mcs"], rate_control=case["control"])
    with tempfile.TemporaryDirectory(prefix="baraka-measured-") as folder:
        stations = [AccessPoint("ap", 0, 0, []), own.Station("writer", 5, 0, [load(case, options, True, folder)]),
                    own.Station("reader", -5, 0, [load(case, options, False, folder), kernel()])]
        written = own.scenario(stations, options.discovery + options.seconds + options.linger + 2, radio)
        with own.played(options.build, written, options.factor, seed=1 + case["run"], kept=options.kept) as run:
            return {"status": run.status, **run.cost(), **result(run, options)}


def result(run, options):
    files = {i: run.folder / f"{i}.csv" for i in range(2)}
    found = journals.totals(files)
    pooled = found.pooled()
    times = [int(row["mono_ns"]) for row in journals.rows(files[0]) if row["event"] == "write"]
    seconds = collections.Counter((int(row["mono_ns"]) - times[0]) // 10**9 for row in journals.rows(files[1])
                                  if row["event"] == "receive") if times else {}
    [(air,)] = run.query("select 1e-9 * sum(airtime_ns) from air_accounts where topic = 't'")
    span = 1e-9 * (times[-1] - times[0]) if len(times) > 1 else None
    of_kernel = counters(run.folder / "snmp")
    return {"written": found.written, "received": found.received,
            "span": span,
            "per_second": [seconds.get(i, 0) for i in range(round(options.seconds))],
            "p50": 1e3 * figures.quantile(pooled, 0.5) if pooled else None,
            "p99": 1e3 * figures.quantile(pooled, 0.99) if pooled else None,
            "air": air / (span + options.linger) if span else None,
            "kernel": [of_kernel[one] for one in COUNTERS],
            "losses": dict(run.query("select verdict, sum(count) from sample_losses group by 1"))}


def is_dead(per_second):
    """Whether nothing came in the last sixth of the seconds."""
    return sum(per_second[-max(1, len(per_second) // 6):]) == 0


def measured():
    """{(vendor, rate): [(received/sent, whether it is dead)]} of the report's runs."""
    found = collections.defaultdict(list)
    with open(MEASURED, newline="") as lines:
        next(lines)
        for row in csv.DictReader(lines):
            share = int(row["received"]) / int(row["sent"])
            found[row["vendor"], int(row["rate"])].append((share, is_dead([int(one) for one in row["per_second"].split()])))
    return found


def received(row, rate):
    return sum(row["per_second"]) / (rate * len(row["per_second"]))


def middle(values):
    known = sorted(value for value in values if value is not None)
    return figures.median(known) if known else None


def compared(columns, runs, traffic):
    """A line of the first table. runs: {(vendor, rate): [(received, whether it is dead)]}."""
    cells, broken = [], []
    for one in traffic:
        shares, dead = zip(*runs[one])
        cells.append(f"{figures.with_interval(middle(shares), (min(shares), max(shares)), 2)}, {sum(dead)} of {len(dead)}")
        if middle(shares) < BROKEN:
            broken.append(f"{one[0]} {one[1]}")
    return [*columns, *cells, ", ".join(broken) or "none"]


def detailed(columns, one, rows):
    """A line of the second table, from the runs of a case."""
    kernels = {counter: middle(row["kernel"][i] for row in rows) for i, (_, counter) in enumerate(COUNTERS)}
    return [*columns, *one, middle((row["written"] - 1) / row["span"] if row["span"] else None for row in rows),
            *(middle(row[key] for row in rows) for key in ("p50", "p99", "air")),
            *(kernels[counter] for counter in ("ReasmReqds", "ReasmFails", "RcvbufErrors", "ReasmTimeout"))]


def show(rows, traffic):
    lines, details = [compared(["measured", "", "", "", ""], measured(), traffic)], []
    cells = dict.fromkeys(tuple(row[key] for key in KEYS) for row in rows)
    for cell in cells:
        columns = [str(value) for value in cell]
        of_cell = {one: [row for row in rows if tuple(row[key] for key in KEYS) == cell
                         and (row["vendor"], row["rate"]) == one] for one in traffic}
        runs = {one: [(received(row, one[1]), is_dead(row["per_second"])) for row in some]
                for one, some in of_cell.items()}
        lines.append(compared(columns, runs, traffic))
        details += [detailed(columns, one, some) for one, some in of_cell.items()]
    names = [f"{vendor}, {rate} Hz" for vendor, rate in traffic]
    print(figures.table([*RADIO, *names, "broken"], lines))
    print(figures.table(DETAILS, details))


def main():
    parser = own.parser(__doc__)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time")
    own.add_factor(parser)
    parser.add_argument("--seconds", type=float, default=30, help="of publishing")
    parser.add_argument("--linger", type=float, default=1, help="s for the last repairs")
    parser.add_argument("--discovery", type=float, default=8, help="s that may pass until they know each other")
    parser.add_argument("--widths", type=int, nargs="+", default=[20, 40], help="MHz")
    parser.add_argument("--streams", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--controls", nargs="+", default=["fixed"], help="rate control")
    parser.add_argument("--profiles", nargs="+", choices=[*ASKED, ONE_FRAME], default=["2020"])
    parser.add_argument("--mcs", type=int, nargs="+", default=[7], help="for each stream")
    parser.add_argument("--vendors", nargs="+", choices=VENDORS, default=VENDORS)
    parser.add_argument("--rates", type=int, nargs="+", default=RATES, help="Hz")
    parser.add_argument("--short", action="store_true", help="a small case, to see that it works")
    options = parser.parse_args()
    if options.short:
        options.runs, options.seconds, options.widths, options.streams, options.rates = 1, 2, [20], [2], [80]
    store = Store(options.store)
    traffic = [(vendor, rate) for vendor in options.vendors for rate in options.rates]
    cells = itertools.product(options.widths, options.streams, options.mcs, options.controls, options.profiles)
    cases = [{**dict(zip(KEYS, cell)), "vendor": vendor, "rate": rate} for cell in cells for vendor, rate in traffic]
    rows = store.get_all([{**case, "seconds": options.seconds, "run": run} for run in range(options.runs) for case in cases],
                         lambda case: measure(case, options), options.parallel)
    show(rows, traffic)
    print(own.costs(rows))


if __name__ == "__main__":
    main()
