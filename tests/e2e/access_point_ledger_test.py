"""What is lost on its way through an access point, and where: the record against what the programs themselves counted
and what tshark finds on the air. Six runs: a queue that overflows, losses on the links, a wall; of UDP and of DDS."""
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from baraka import Case, Program
from private_network import has_networks
from wire import PYTHON

SKIPPED = 77
TSHARK = shutil.which("tshark")
TESTS = pathlib.Path(os.environ["BARAKA_BIN"]).resolve().parent / "tests"
CYCLONE = "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='wlan0'/></Interfaces></General></Domain></CycloneDDS>"
SENDER = """
import socket, sys, time
count, rate, port = int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
begin, sent = time.monotonic(), 0
while sent < count:
    while time.monotonic() < begin + sent / rate: time.sleep(0.001)
    s.sendto(b"x" * 1000, ("10.77.0.3", port))
    sent += 1
print("sent:", sent)
"""
RECEIVER = """
import socket, sys, time
sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
for i, s in enumerate(sockets):
    s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
    s.bind(("0.0.0.0", 5001 + i)); s.setblocking(False)
got, end = 0, time.monotonic() + float(sys.argv[1])
while time.monotonic() < end:
    for s in sockets:
        try:
            while s.recv(2000): got += 1
        except BlockingIOError: pass
    time.sleep(0.002)
print("received:", got)
"""
# Programs talk for 6 s. With a path the receiver goes from y = -16 m to 16 m, past a wall that hides the access point from
# it within 4 m to both sides.
SCENARIO = """
version: 1
name: through_an_access_point
radio: {{include: radios/ieee80211b.yaml, bss: {{access_point: ap}}{radio}}}
routing: none
{world}agents:
  first:
    name: first
    station: {{}}
    poses: [{{x: -10 m, y: 5 m}}]
    network: {{address: 10.77.0.1/16}}
    programs: [{neighbours}, {first}]
  second:
    name: second
    station: {{}}
    poses: [{{x: -10 m, y: -5 m}}]
    network: {{address: 10.77.0.2/16}}
    programs: [{neighbours}, {second}]
  receiver:
    name: receiver
    station: {{{path}}}
    poses: [{{x: 10 m, y: {y} m, yaw: 90 deg}}]
    network: {{address: 10.77.0.3/16}}
    programs: [{neighbours}, {receiver}]
  ap: {{name: ap, station: {{}}, poses: [{{x: 0 m, y: 0 m}}], controller: {{program: traffic_sink}}}}
end: [{{at: {end} s, result: done}}]
record: {{air: air.pcapng, frames: all, samples: all}}
"""
# So that no frame of ARP is counted. Addresses of agents are 1, 2, 3, ...
NEIGHBOURS = "for i in 1 2 3; do ip neigh replace 10.77.0.$i lladdr 02:00:00:00:00:0$i dev wlan0 nud permanent; done"
LOSS = ", loss: {probability: 0.3}, short_retry_limit: 3"
# What a frame of several that overlap ends as: at a third station "collision", or "preamble missed" where that one holds
# another of them; at a station that sends one of them "receiver transmitting".
OVERLAP = "collision", "preamble missed", "receiver transmitting"
WALL = "world: {walls: [{name: wall, size: [30 cm, 4 m, 2 m], position: [5 m, 0 m], radio_loss: {per_crossing: 60 dB}}]}\n"


def program(name, *command, start):
    words = ", ".join("'" + str(word).replace("'", "''") + "'" for word in command)
    return f"{{name: {name}, command: [{words}], start: {start} s, environment: {{CYCLONEDDS_URI: \"{CYCLONE}\"}}}}"


class AccessPointLedger(Case):
    maxDiff = None

    def play(self, radio, speed, programs, end):
        """@param speed  of the receiver past the wall, m/s; 0: it stands, and there is none."""
        file = self.folder / f"scenario{self.runs}.yaml"
        path = f"path: {{line: {{speed: {speed} m/s, length: 32 m}}}}" if speed else ""
        file.write_text(SCENARIO.format(
            radio=radio + (", obstacles: true" if speed else ""), world=WALL if speed else "", path=path,
            y=-16 if speed else 0, end=end, neighbours=program("neighbours", "sh", "-c", NEIGHBOURS, start=0), **programs))
        self.run_baraka(file)
        self.id = {name: agent for agent, name in self.query("SELECT agent, name FROM agents")}

    def udp(self, rate, radio="", speed=0):
        count = 6 * rate
        for name, text in ("sender.py", SENDER), ("receiver.py", RECEIVER):
            (self.folder / name).write_text(text)
        sender = PYTHON, self.folder / "sender.py", count, rate
        self.play(radio, speed, {"first": program("talk", *sender, 5001, start=2), "second": program("talk", *sender, 5002, start=2),
                                 "receiver": program("hear", PYTHON, self.folder / "receiver.py", 10, start=1)}, 12)
        sent = sum(self.printed(f"{name}.talk.log", "sent") for name in ("first", "second"))
        self.assertEqual(sent, 2 * count)
        return sent, self.printed("receiver.hear.log", "received")

    def dds(self, rate, radio="", speed=0):
        load = TESTS / "cyclone_load"
        # Of best effort: what is lost stays lost. Discovery is repaired meanwhile.
        talk = [program("talk", load, "--publish", topic, "--size", 1000, "--rate", rate, "--count", 6 * rate, "--best-effort",
                        "--until-matched", 1, "--settle", 2, "--for", 20, start=1) for topic in ("a", "b")]
        hear = ", ".join(program(f"hear_{topic}", load, "--subscribe", topic, "--best-effort", "--for", 22, start=0.8)
                         for topic in ("a", "b"))
        self.play(radio, speed, {"first": talk[0], "second": talk[1], "receiver": hear}, 35)
        written = sum(self.printed(f"{name}.talk.log", "written") for name in ("first", "second"))
        return written, sum(self.printed(f"receiver.hear_{topic}.log", "received") for topic in ("a", "b"))

    def printed(self, log, key):
        return int(re.search(rf"^{key}: (\d+)$", (self.out / log).read_text(), re.M).group(1))

    def total(self, sql):
        return self.query(sql)[0][0] or 0

    def tshark(self, condition, *fields):
        """The rows of these fields of the frames in the capture, each once: repetitions are not told apart."""
        wanted = [part for field in fields for part in ("-e", field)]
        done = subprocess.run([TSHARK, "-n", "-o", "udp.try_heuristic_first:TRUE", "-r", self.out / "air.pcapng", "-Y", condition,
                               "-T", "fields", *wanted], capture_output=True, text=True, check=True)
        return {tuple(line.split("\t")) for line in done.stdout.splitlines()}

    def check_udp(self, sent, received):
        """What the programs sent ends once each. @return how often each cause: at the senders, and at the access point."""
        ap, receiver = self.id["ap"], self.id["receiver"]
        at_senders = dict(self.query(f"SELECT verdict, SUM(count) FROM requests WHERE peer = {receiver} AND agent NOT IN"
                                     f" ({ap}, {receiver}) GROUP BY 1"))
        relays = collections.Counter(dict(self.query(
            f"SELECT verdict, SUM(count) FROM relays WHERE agent = {ap} AND destination = {receiver} GROUP BY 1")))
        self.show(f"sent {sent}, received {received}; at the senders {at_senders}; at the access point {dict(relays)}")
        self.assertEqual(sum(at_senders.values()), sent)
        arrived = ("SELECT COUNT(*) FROM (SELECT DISTINCT transmitter, sequence FROM frames f JOIN frame_ends e USING (frame) WHERE"
                   " e.agent = f.receiver AND e.verdict = 'delivered' AND class = 'unicast' AND bits > 8000 AND e.agent = {})")
        self.assertEqual(self.total(arrived.format(ap)), sum(relays.values()), "what came to the access point")
        # While it is with no access point it acknowledges what comes, and cannot use it.
        unused = self.total(f"SELECT SUM(count) FROM relays WHERE agent = {receiver} AND destination = {receiver} AND verdict = 'no route'")
        self.assertEqual(self.total(arrived.format(receiver)) - unused, received)
        ours = "udp.dstport in {5001, 5002} && wlan.fc"
        self.assertEqual(len(self.tshark(f"{ours}.tods == 1", "ip.src", "ip.id", "wlan.seq")),
                         sent - at_senders.get("queue full", 0))
        self.assertEqual(len(self.tshark(f"{ours}.fromds == 1", "ip.src", "ip.id", "wlan.seq")),
                         relays["delivered"] + relays["retry limit"])
        return relays

    def check_samples(self, written, received):
        """Each sample that was written was delivered or has one cause. @return how often each, at whom."""
        ((samples, delivered, under_way),) = self.query(
            "SELECT SUM(samples), SUM(delivered), SUM(under_way) FROM sample_sums")
        causes = {(verdict, agent): count for verdict, agent, count in self.query(
            "SELECT l.verdict, a.name, SUM(l.count) FROM sample_losses l LEFT JOIN agents a USING (agent) GROUP BY 1, 2")}
        self.show(f"written {written}, received {received}; {causes}")
        self.assertEqual((samples, delivered, under_way), (written, received, 0))
        self.assertEqual(sum(causes.values()), samples - delivered)
        self.check_hops()
        return causes

    def check_hops(self):
        """Where samples were lost: on the air tshark sees those that the access point sent, and no others; and of each
        frame that is named the radio said the same."""
        def on_the_air(end):
            rows = self.tshark(f"rtps.sm.id == 0x15 && wlan.fc.{end} == 1", "rtps.guidPrefix.src", "rtps.sm.wrEntityId",
                               "rtps.sm.seqNumber")
            return {(prefix + entity.removeprefix("0x"), int(number)) for prefix, entity, number in rows if "," not in entity}

        entered, left = on_the_air("tods"), on_the_air("fromds")
        for guid, number, verdict, at in self.query("SELECT writer, sequence_number, s.verdict, a.name FROM samples s LEFT JOIN"
                                                    " agents a ON a.agent = s.lost_at"):
            sample = guid.replace(".", ""), number
            came = verdict is None or at == "receiver"
            never_sent = not came and verdict in ("queue full", "no route", "expired")
            got_through = came or at == "ap"
            self.assertEqual(sample in entered, got_through or not never_sent, (sample, verdict, at))
            self.assertEqual(sample in left, got_through and not never_sent, (sample, verdict, at))
        self.assertEqual(self.query(
            "SELECT s.verdict, f.receiver FROM samples s JOIN frames f USING (frame) LEFT JOIN frame_ends e ON e.frame = s.frame"
            " AND e.agent = f.receiver WHERE s.verdict NOT IN (IFNULL(e.verdict, 'below sensitivity'), 'expired')"), [])

    def show(self, text):
        if "BARAKA_SHOW" in os.environ:
            print(f"{self._testMethodName}: {text}", file=sys.stderr)

    def test_udp_that_overflows_the_access_points_queue(self):
        relays = self.check_udp(*self.udp(300, ", queue_limit: 100"))
        self.assertGreater(relays["queue full"], 100)
        self.assertEqual(self.query(f"SELECT most FROM relay_queues WHERE destination = {self.id['receiver']}"), [(100,)])
        report = Program("baraka", "report", self.out).finish()
        self.assertRegex(report.out, rf"ap +receiver +{sum(relays.values())} +{relays['delivered']} +0 +{relays['queue full']} ")

    def test_udp_with_losses(self):
        self.assertGreater(self.check_udp(*self.udp(60, LOSS))["retry limit"], 0)

    def test_udp_behind_a_wall(self):
        self.assertGreater(self.check_udp(*self.udp(60, speed=3))["retry limit"], 0)

    def test_dds_that_overflows_the_access_points_queue(self):
        causes = self.check_samples(*self.dds(280, ", queue_limit: 100"))
        self.assertGreater(causes["queue full", "ap"], 100)

    def test_dds_with_losses(self):
        causes = self.check_samples(*self.dds(60, LOSS))
        # At 21 m in the open a signal is 44 dB above the noise. A frame is lost because the scenario's loss strikes it, or
        # because two backoffs end in the same slot and the frames overlap.
        self.assertEqual({verdict for verdict, _ in causes} - {"random loss", *OVERLAP}, set())
        self.assertGreater(causes["random loss", "ap"], 0)
        drawn = sum(count for (verdict, _), count in causes.items() if verdict == "random loss")
        self.assertGreater(drawn, sum(causes.values()) / 2)

    def test_dds_behind_a_wall(self):
        self.assertGreater(self.check_samples(*self.dds(60, speed=2))["obstacle", "ap"], 10)


if __name__ == "__main__":
    if TSHARK is None or not has_networks() or not (TESTS / "cyclone_load").exists():
        print("skipped: needs tshark, cyclone_load, user namespaces and /dev/net/tun", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
