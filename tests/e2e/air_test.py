#!/usr/bin/env python3
"""Captures of the air as Wireshark reads them: nothing malformed, every FCS right, and the numbers and
times of frames those of the results."""
import collections
import shutil
import subprocess
import sys
import unittest

from baraka import BIN, ROOT, Case, Program

TSHARK = shutil.which("tshark")
SKIPPED = 77
SATURATION = ROOT / "config/scenarios/saturation.yaml"
IN_PROCESS = ("--controllers", "in-process")
TYPES = {"0x001b": "rts", "0x001c": "cts", "0x001d": "ack", "0x0020": "data", "0x0008": "beacon"}
MANAGEMENT = {"0x0000": "association request", "0x0001": "association response", "0x0002": "reassociation request",
              "0x0003": "reassociation response", "0x000a": "disassociation", "0x000b": "authentication",
              "0x000c": "deauthentication"}
TYPES |= dict.fromkeys(MANAGEMENT, "management")
FIELDS = ["frame.time_epoch", "wlan.fc.type_subtype", "wlan.fc.retry", "wlan.fcs.status", "wlan_radio.duration",
          "radiotap.mactime", "radiotap.datarate", "wlan.duration", "wlan.ra", "wlan.ta", "radiotap.dbm_antsignal",
          "radiotap.channel.freq", "llc.type", "frame.len", "wlan.fc.ds", "wlan.bssid", "wlan.sa", "wlan.da",
          "_ws.malformed", "_ws.expert.severity"]
ERROR = 0x600000  # of _ws.expert.severity
DDS_AND_IN_PROCESS = ((), IN_PROCESS)


def address(agent):
    return "ff:ff:ff:ff:ff:ff" if agent == 65535 else f"02:00:00:00:{agent >> 8:02x}:{agent & 255:02x}"


class Air(Case):
    def tshark(self, *arguments, file=None):
        file = file or self.out / "air.pcapng"
        done = subprocess.run([TSHARK, "-n", "-o", "wlan.check_checksum:TRUE", "-r", file, *arguments],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def packets(self):
        """Of the capture, as dictionaries; none is malformed, every FCS is right."""
        wanted = [part for field in FIELDS for part in ("-e", field)]
        lines = self.tshark("-T", "fields", *wanted).splitlines()
        packets = [dict(zip(FIELDS, line.split("\t"))) for line in lines]
        for packet in packets:
            self.assertEqual(packet["wlan.fcs.status"], "1")
            self.assertEqual(packet["_ws.malformed"], "")
            self.assertFalse([level for level in packet["_ws.expert.severity"].split(",") if level and int(level, 0) >= ERROR],
                             packet)
            packet["type"] = TYPES[packet["wlan.fc.type_subtype"]]
            packet["retry"] = packet["wlan.fc.retry"] in ("1", "True")
            whole, _, fraction = packet["frame.time_epoch"].partition(".")
            packet["at_ns"] = int(whole) * 10 ** 9 + int(fraction.ljust(9, "0"))
        self.assertEqual(packets, sorted(packets, key=lambda packet: packet["at_ns"]))
        return packets

    def saturate(self, *arguments, senders=20, where=IN_PROCESS, file="air.pcapng"):
        """Everything that is sent ends before the run does."""
        return self.run_baraka(SATURATION, "--until", 0.7, *where, "--set", f"agents.sources.circle.count={senders}",
                               "--set", "agents.sources.controller.parameters.stop=500 ms", "--set",
                               f"record.air={file}", *arguments)

    def counts(self, sql):
        return dict(self.query(sql))

    def sent(self, condition="TRUE"):
        return self.counts("SELECT CASE class WHEN 'unicast' THEN 'data' WHEN 'broadcast' THEN 'data' ELSE class END,"
                           f" sum(count) FROM frames_sent WHERE {condition} GROUP BY 1")

    def test_twenty_saturated_stations_are_what_the_database_says(self):
        for threshold in 0, 2347:
            with self.subTest(rts_threshold=threshold):
                self.saturate("--set", f"radio.rts_threshold={threshold}", "--set", "record.frames=all")
                packets = self.packets()
                types = collections.Counter(packet["type"] for packet in packets)
                self.assertEqual(types, self.sent())
                self.assertEqual(set(types), {"rts", "cts", "ack", "data"} if threshold == 0 else {"ack", "data"})
                self.assertGreater(types["data"], 150)
                (retries,), = self.query("SELECT sum(retry) FROM frames")
                self.assertEqual(sum(packet["retry"] for packet in packets), retries)
                if threshold == 0:
                    self.assertGreater(types["rts"], types["cts"])  # RTS collide
                else:
                    self.assertGreater(retries, 0)
                frames = self.query("SELECT at_ns, airtime_ns, class, transmitter, receiver, bits FROM frames"
                                    " ORDER BY at_ns + airtime_ns, frame")
                self.check_frames(sorted(packets, key=lambda packet: packet["at_ns"]), frames)

    def check_frames(self, packets, frames):
        """Each frame beside its packet; of those that end at one time any order will do."""
        self.assertEqual(sorted(packet["at_ns"] for packet in packets),
                         sorted(at + airtime for at, airtime, *_ in frames))
        by_end = collections.defaultdict(list)
        for frame in frames:
            by_end[frame[0] + frame[1]].append(frame)
        for packet in packets:
            same = [frame for frame in by_end[packet["at_ns"]] if address(frame[4]) == packet["wlan.ra"]
                    and packet["wlan.ta"] in ("", address(frame[3]))]
            self.assertTrue(same, packet)
            at, airtime, kind, _, _, bits = same[0]
            self.assertEqual(packet["type"], {"unicast": "data", "broadcast": "data"}.get(kind, kind))
            # What Wireshark works out from rate, preamble and length, in whole us.
            self.assertLessEqual(abs(int(packet["wlan_radio.duration"]) - airtime / 1000), 1, packet)
            # Long preamble and PLCP header: 192 us (IEEE Std 802.11-2016, 16.2.2).
            self.assertEqual(int(packet["radiotap.mactime"]), at // 1000 + 192 if at % 1000 == 0
                             else (at + 192000) // 1000)
            self.assertEqual(packet["radiotap.channel.freq"], "2412")
            self.assertEqual(packet["llc.type"], "0x88b5" if packet["type"] == "data" else "")
            header = int(packet["frame.len"]) - bits // 8
            self.assertIn(header, range(16, 40))

    def test_a_station_hears_what_the_database_says_it_received_and_what_it_sends(self):
        self.saturate("--set", "record.air_heard_by=sink", "--set", "radio.rts_threshold=0")
        packets = self.packets()
        sink = self.query("SELECT agent FROM agents WHERE name = 'sink'")[0][0]
        own = [packet for packet in packets if packet["radiotap.dbm_antsignal"] == ""]
        heard = [packet for packet in packets if packet["radiotap.dbm_antsignal"] != ""]
        self.assertEqual(collections.Counter(packet["type"] for packet in own), self.sent(f"agent = {sink}"))
        self.assertEqual(
            collections.Counter(packet["type"] for packet in heard),
            self.counts("SELECT CASE class WHEN 'unicast' THEN 'data' ELSE class END, sum(count) FROM receptions "
                        f"WHERE agent = {sink} AND verdict = 'delivered' GROUP BY 1"))
        self.assertEqual({packet["type"] for packet in own}, {"cts", "ack"})
        (lost,), = self.query(f"SELECT sum(count) FROM receptions WHERE agent = {sink} AND verdict <> 'delivered'")
        self.assertGreater(lost, 0)
        # 40 mW over 5 m by Friis at 2.412 GHz: -38.06 dBm.
        self.assertEqual({packet["radiotap.dbm_antsignal"] for packet in heard}, {"-38"})

    def test_access_points_are_what_the_database_says(self):
        self.run_baraka(ROOT / "config/scenarios/handover.yaml", "--until", 50, *IN_PROCESS, "--set",
                        "record.air=air.pcapng", "--set", "record.frames=all")
        packets = self.packets()
        self.assertEqual(collections.Counter(packet["type"] for packet in packets), self.sent())
        (retries,), = self.query("SELECT sum(retry) FROM frames")
        self.assertEqual(sum(packet["retry"] for packet in packets), retries)
        agents = dict(self.query("SELECT name, agent FROM agents"))
        left, right, walker, server = (address(agents[name]) for name in ("left", "right", "walker", "server"))
        beacons = collections.Counter(packet["wlan.ta"] for packet in packets if packet["type"] == "beacon")
        self.assertEqual(set(beacons), {left, right})
        for count in beacons.values():  # every 102.4 ms
            self.assertIn(count, range(487, 490))
        # Each frame of a handover is answered; one that its receiver lost is sent again.
        (handovers,), = self.query("SELECT count(*) FROM associations WHERE access_point IS NOT NULL")
        kinds = collections.Counter(MANAGEMENT[packet["wlan.fc.type_subtype"]] for packet in packets
                                    if packet["type"] == "management" and not packet["retry"])
        self.assertEqual(kinds["association response"] + kinds["reassociation response"], handovers)
        self.assertEqual(kinds["reassociation request"], 2, "over and back")
        # To DS from the walker to its access point and from there to the server.
        ways = collections.Counter((packet["wlan.fc.ds"], packet["wlan.ta"], packet["wlan.bssid"]) for packet in packets
                                   if packet["type"] == "data" and packet["wlan.sa"] == walker and
                                   packet["wlan.da"] == server)
        self.assertEqual(set(ways), {("0x01", walker, left), ("0x01", walker, right), ("0x02", left, left)})
        self.assertGreater(min(ways.values()), 1000)

    def test_channels_are_told(self):
        self.saturate("--set", "agents.sources.radio.channel=6", "--set", "agents.sink.radio.channel=6",
                      "--set", "record.air_heard_by=all", senders=2)
        self.assertEqual({packet["radiotap.channel.freq"] for packet in self.packets()}, {"2437"})

    def test_what_is_cut_or_in_the_air_at_the_end_is_not_there(self):
        # In the middle of a frame.
        self.run_baraka(SATURATION, "--until", 0.05, *IN_PROCESS, "--set", "record.frames=all", "--set",
                        "record.air=air.pcapng")
        (ended,), = self.query("SELECT value FROM run WHERE key = 'ended_ns'")
        frames = self.query("SELECT at_ns + airtime_ns FROM frames")
        self.assertTrue(any(end > ended for end, in frames))
        self.assertEqual([packet["at_ns"] for packet in self.packets()],
                         sorted(end for end, in frames if end <= ended))

    def test_a_second_run_writes_the_same_bytes_in_process_and_over_dds(self):
        captures = set()
        for where in (*DDS_AND_IN_PROCESS, IN_PROCESS):
            self.saturate(senders=3, where=where, file="other-name_1.pcapng")
            captures.add((self.out / "other-name_1.pcapng").read_bytes())
        self.assertEqual(len(captures), 1)
        self.assertGreater(len(captures.pop()), 10000)

    def test_it_changes_nothing_and_every_profile_can_be_captured(self):
        for profile in "mobility_framework", "ieee80211b", "ieee80211g", "disk", "ideal":
            with self.subTest(profile=profile):
                scenario = ROOT / "config/scenarios/two_motes.yaml"
                arguments = (scenario, "--until", 20, *IN_PROCESS, "--set", f"radio={{profile: {profile}}}")
                without = self.run_baraka(*arguments)["fingerprint"]
                self.assertFalse((self.out / "air.pcapng").exists())
                captured = self.run_baraka(*arguments, "--set", "record.air=air.pcapng")["fingerprint"]
                self.assertEqual(captured, without)
                packets = self.packets()
                self.assertTrue(packets)
                self.assertEqual(collections.Counter(packet["type"] for packet in packets), self.sent())

    def test_a_result_with_a_capture_is_replaced_like_any_other(self):
        for _ in range(2):
            finished = Program("baraka", "run", SATURATION, "--until", "0.1", *IN_PROCESS, "--out", self.folder / "out",
                               "--overwrite", "--set", "record.air=air.pcapng").finish()
            self.assertEqual(finished.status, 0, str(finished))
        self.assertTrue((self.folder / "out/air.pcapng").exists())
        self.assertIn("air.pcapng", (self.folder / "out/.baraka-result").read_text())

    def test_a_full_disk_ends_the_run_and_the_capture_can_be_read(self):
        disk, kept = self.folder / "disk", self.folder / "kept"
        disk.mkdir()
        kept.mkdir()
        command = " ".join(map(str, [BIN / "baraka", "run", SATURATION, *IN_PROCESS, "--set", "record.air=air.pcapng",
                                     "--out", "out"]))
        done = subprocess.run(
            ["unshare", "--map-root-user", "--mount", "sh", "-c",
             f"mount -t tmpfs -o size=2500k none {disk} || exit 99; cd {disk}; {command}; status=$?;"
             f" cp -a {disk}/. {kept}; exit $status"], capture_output=True, text=True, timeout=120, check=False)
        if done.returncode == 99 or "unshare failed" in done.stderr:
            self.skipTest("no right to mount")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"error: .*air\.pcapng: cannot be written: No space left on device")
        self.out = kept / "out"
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'result'"), [("failed",)])
        self.assertGreater(len(self.packets()), 100)


if __name__ == "__main__":
    if TSHARK is None:
        print("skipped: needs tshark", file=sys.stderr)
        sys.exit(SKIPPED)
    unittest.main()
