#!/usr/bin/env python3
"""`baraka diff`: whether the same happened in two runs, and if not, where they begin to differ. The digest of frames."""
import contextlib
import re
import shutil
import sqlite3
import textwrap
import unittest

import wire
from baraka import BIN, ROOT, Case, Program

TWO_MOTES = ROOT / "config/scenarios/two_motes.yaml"
IN_PROCESS = ("--controllers", "in-process", "--no-inspect")
ALL = ("--set", "record.frames=all")
REFUSED = wire.why_not()
# Broadcasts whose bytes and times are drawn.
TALK = """version: 1
name: talk
radio: {{profile: ieee80211b}}
routing: none
agents:
  stations:
    name: s{{}}
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}, {{x: 10 m, y: 0 m}}, {{x: 20 m, y: 0 m}}]
    controller:
      program: traffic_source
      parameters: {{pattern: poisson, rate: {rate} Hz, to: neighbours, topic: t, size: 57}}
end:
  - {{at: 2 s, result: done}}
"""


class Diff(Case):
    def talk(self, *arguments, rate=20):
        """The folder of a run, and what it printed."""
        file = self.folder / "talk.yaml"
        file.write_text(TALK.format(rate=rate), encoding="utf-8")
        finished = self.run_baraka(file, *IN_PROCESS, *arguments)
        return self.out, finished

    def diff(self, one, other, status):
        finished = Program("baraka", "diff", one, other).finish()
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def execute(self, folder, sql):
        with contextlib.closing(sqlite3.connect(folder / "run.sqlite")) as database, database:
            database.execute(sql)

    def copied(self, folder, sql):
        """A copy of a result, changed."""
        copy = self.folder / f"copy{self.runs}"
        self.runs += 1
        shutil.copytree(folder, copy)
        self.execute(copy, sql)
        return copy


class Digest(Diff):
    def test_it_is_printed_and_recorded_whatever_is_recorded_of_frames(self):
        digests, seen = set(), set()
        for frames in "none", "counts", "sample", "all":
            out, finished = self.talk("--set", f"record.frames={frames}")
            digests.add(finished["frames_digest"])
            seen.add(finished["fingerprint"])
            self.assertEqual(self.query("SELECT value FROM run WHERE key = 'frames_digest'"), [(finished["frames_digest"],)])
        self.assertEqual((len(digests), len(seen)), (1, 1))
        self.assertRegex(digests.pop(), "^[0-9a-f]{16}$")

    def test_a_finished_run_tells_it_again(self):
        out, finished = self.talk()
        again = self.start(self.folder / "talk.yaml", *IN_PROCESS, "--once", out=out).finish()
        self.assertIn("the result is there already", again.err)
        self.assertEqual(again["frames_digest"], finished["frames_digest"])

    def test_it_is_of_the_frames_only(self):
        """A value that a robot measures changes what happens, but no frame of stations that just talk."""
        _, finished = self.talk()
        _, other = self.talk("--set", "agents.stations.poses=[{x: 0 m, y: 0 m}, {x: 10 m, y: 0 m}, {x: 20 m, y: 1 m}]")
        self.assertNotEqual(finished["fingerprint"], other["fingerprint"])
        self.assertEqual(finished["frames_digest"], other["frames_digest"])


class Runs(Diff):
    def test_equal_runs_are_equal_wherever_their_controllers_run(self):
        one, _ = self.talk(*ALL)
        file = self.folder / "talk.yaml"
        self.run_baraka(file, *ALL, "--no-inspect")
        finished = self.diff(one, self.out, 0)
        self.assertEqual((finished["runs"], finished["settings"]), ("equal", "equal"))
        self.assertNotIn("difference:", finished.out)
        self.assertNotIn(" | ", finished.out)
        self.assertEqual(self.diff(one, one, 0).out, finished.out)

    def test_another_seed_differs_from_the_first_frame_on(self):
        one, first = self.talk(*ALL)
        other, second = self.talk(*ALL, "--seed", 2)
        finished = self.diff(one, other, 1)
        self.assertEqual(finished["runs"], "different")
        self.assertEqual(finished["seed"], "1 | 2")
        self.assertEqual(finished["settings"], "1 differ")
        for key in "fingerprint", "frames_digest":
            self.assertEqual(finished[key], f"{first[key]} | {second[key]}")
        begin = min(self.query("SELECT MIN(at_ns) FROM frames", folder)[0][0] for folder in (one, other))
        self.assertTrue(finished["difference"].startswith(f"0.{begin:09} s, frames, s"), finished.out)
        self.assertRegex(finished["fingerprints"], r"^differ from second 0 on, first in \w+ of s\d$")
        swapped = self.diff(other, one, 1)
        self.assertEqual(swapped["difference"].split(",")[0], finished["difference"].split(",")[0])

    def test_a_value_patched_in_one_record_is_found_with_the_row_before(self):
        one, _ = self.talk(*ALL)
        (frame, at, sequence), (before,) = self.query(
            "SELECT frame, at_ns, sequence FROM frames ORDER BY rowid LIMIT 1 OFFSET 20", one)[0], self.query(
            "SELECT at_ns FROM frames ORDER BY rowid LIMIT 1 OFFSET 19", one)[0]
        patched = self.copied(one, f"UPDATE frames SET sequence = {sequence + 1} WHERE frame = {frame}")
        finished = self.diff(one, patched, 1)
        self.assertRegex(finished["difference"], rf"^0\.{at:09} s, frames, s\d to everyone, data: "
                                                 rf"sequence {sequence} \| {sequence + 1}$")
        self.assertIn(f"  before: 0.{before:09} s: ", finished.out)
        self.assertIn(f"  {one}: 0.{at:09} s: ", finished.out)
        self.assertIn(f"  {patched}: 0.{at:09} s: ", finished.out)

    def test_an_end_and_the_bytes_of_a_message_are_found(self):
        one, _ = self.talk(*ALL)
        frame, agent, at = self.query("SELECT frame, agent, at_ns FROM frame_ends ORDER BY rowid LIMIT 1 OFFSET 9", one)[0]
        ended = self.copied(one, f"UPDATE frame_ends SET verdict = 'noise' WHERE frame = {frame} AND agent = {agent}")
        self.assertRegex(self.diff(one, ended, 1)["difference"],
                         rf"^0\.{at:09} s, frame_ends, s\d to everyone, at s\d, data: verdict delivered \| noise$")
        bytes_ = self.copied(one, "UPDATE frames SET payload_hash = payload_hash + 1 WHERE rowid = 5")
        self.assertRegex(self.diff(one, bytes_, 1)["difference"], r", data: bytes of the payload \(record.air records them\)$")

    def test_a_run_that_ended_earlier_lacks_the_rest(self):
        one, _ = self.talk(*ALL)
        shorter, _ = self.talk(*ALL, "--until", 1)
        finished = self.diff(one, shorter, 1)
        first = self.query("SELECT MIN(at_ns) FROM frames WHERE at_ns > 1000000000", one)[0][0]
        self.assertEqual(finished["ended_ns"], "2000000000 | 1000000000")
        self.assertRegex(finished["difference"], rf"^1\.{first - 10**9:09} s, frames, .*: only in {one}$")
        self.assertIn(f"  {shorter}: no more\n", finished.out)
        self.assertRegex(self.diff(shorter, one, 1)["difference"], rf": only in {one}$")

    def test_frames_that_are_not_listed_are_said_with_the_key_to_set(self):
        counts = ("--set", "record.frames=counts")
        one, _ = self.talk(*counts)
        other, _ = self.talk(*counts, "--seed", 2)
        finished = self.diff(one, other, 1)
        self.assertEqual(finished["note"], "frames were not compared: record.frames is counts; --set record.frames=all lists "
                                           "every frame")
        self.assertNotIn("difference:", finished.out)
        self.assertRegex(finished["fingerprints"], "^differ from second 0 on")
        listed, _ = self.talk(*ALL)
        self.assertIn("record.frames is counts | all", self.diff(other, listed, 1)["note"])
        same = self.diff(one, listed, 0)
        self.assertNotIn("note:", same.out)
        self.assertEqual((same["runs"], same["settings"]), ("equal", "1 differ"))
        self.assertIn("  record.frames: counts | all\n", same.out)

    def test_a_sample_that_lacks_the_first_difference_is_said(self):
        sample = ("--set", "record.frames=sample")
        one, _ = self.talk(*sample)
        cut = self.copied(one, "DELETE FROM frames WHERE at_ns >= 1000000000")
        self.execute(cut, "UPDATE fingerprints SET hash = hash + 1 WHERE second = 0 AND part = 'air'")
        self.execute(cut, "UPDATE run SET value = '0' WHERE key = 'frames_digest'")
        finished = self.diff(one, cut, 1)
        self.assertTrue(finished["difference"].startswith("1."))
        self.assertIn("in second 0, is not among the frames listed: record.frames is sample; --set record.frames=all",
                      finished["note"])

    def test_a_run_that_was_killed_is_compared_as_far_as_it_came(self):
        one, _ = self.talk(*ALL)
        killed = self.copied(one, "DELETE FROM run WHERE key LIKE 'fingerprint%' OR key IN ('frames_digest', 'ended_ns', "
                                  "'simulated_s')")
        self.execute(killed, "UPDATE run SET value = 'running' WHERE key = 'result'")
        finished = self.diff(one, killed, 1)
        self.assertIn(f"warning: {killed}: this run is unfinished", finished.err)
        self.assertEqual(finished["result"], "done | running")
        self.assertRegex(finished["frames_digest"], r"^[0-9a-f]{16} \| -$")


class Mistakes(Diff):
    def test_what_cannot_be_compared_is_an_error_and_no_difference(self):
        self.run_baraka(TWO_MOTES, *IN_PROCESS)
        run = self.out
        (self.folder / "empty").mkdir()
        old = self.copied(run, "PRAGMA user_version = 3")
        damaged = self.copied(run, "INSERT INTO arrivals VALUES (5, 'air of a', '0g')")
        for folder, message in ((self.folder / "empty", "holds no result"), (self.folder / "emtpy", "there is no such folder; "
                                                                            "did you mean"),
                                (run / "run.sqlite", "is a file, and the folder of a result is wanted"),
                                (self.folder, "has results in folders of its own; name one"),
                                (old, "run.sqlite has tables of version 3, and this baraka reads version \\d+ only"),
                                (damaged, "table arrivals, row 1: bytes is '0g', not hexadecimal")):
            with self.subTest(message):
                for arguments in (run, folder), (folder, run):
                    finished = self.diff(*arguments, 2)
                    self.assertRegex(finished.err, f"^error: .*{message}")
                    self.assertEqual(finished.out, "")

    def test_a_campaign_is_no_run(self):
        file = self.folder / "talk.yaml"
        file.write_text(TALK.format(rate=5), encoding="utf-8")
        self.run_baraka(file, *IN_PROCESS, "--replications", 2)
        self.assertIn("is a campaign, and diff compares two runs; its runs lie below", self.diff(self.out, self.out, 2).err)
        runs = [self.out / f"replication-{i:02}" for i in (1, 2)]
        self.assertEqual(self.diff(*runs, 1)["seed"], "1 | 2")

    def test_one_folder_is_not_enough(self):
        self.assertEqual(Program("baraka", "diff", self.folder).finish().status, 2)


@unittest.skipIf(REFUSED, REFUSED)
class Packets(Diff):
    """Unmodified programs in lock-step."""

    def programs(self, data, *arguments):
        """Sends two datagrams, the second with this data."""
        code = textwrap.dedent(f"""
            import socket, time
            s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            for data in b"hello", b"{data}":
                time.sleep(0.1)
                s.sendto(data, ("10.77.0.2", 5000))
            time.sleep(0.1)""")
        file = self.folder / "packets.yaml"
        script = self.folder / "send.py"
        script.write_text(code, encoding="utf-8")
        file.write_text(textwrap.dedent(f"""\
            version: 1
            name: packets
            routing: none
            radio: {{include: {ROOT}/config/radios/ieee80211g.yaml}}
            agents:
              a:
                name: a
                station: {{}}
                poses: [{{x: 0 m, y: 0 m}}]
                network: {{}}
                programs: [{{name: send, command: [/usr/bin/python3, {script}], on_exit: end}}]
              b:
                name: b
                station: {{}}
                poses: [{{x: 10 m, y: 0 m}}]
                network: {{}}
            end: [{{at: 60 s, result: late}}]
            """), encoding="utf-8")
        finished = self.run_baraka(file, "--pace", "lockstep", "--no-inspect", *arguments)
        return self.out, finished

    def test_equal_programs_send_equal_frames_and_a_repetition_does(self):
        one, first = self.programs("world", *ALL)
        other, second = self.programs("world", *ALL)
        self.assertEqual(first["frames_digest"], second["frames_digest"])
        self.diff(one, other, 0)
        again = self.run_baraka(self.folder / "packets.yaml", *ALL, "--repeat", one, "--no-inspect")
        self.assertEqual(again["frames_digest"], first["frames_digest"])
        self.assertEqual(self.diff(one, self.out, 0)["pace"], "lockstep | repeated")

    def test_the_first_byte_that_a_program_sends_otherwise_is_found(self):
        one, first = self.programs("world", *ALL)
        other, second = self.programs("worse", *ALL)
        self.assertNotEqual(first["frames_digest"], second["frames_digest"])
        finished = self.diff(one, other, 1)
        self.assertRegex(finished["difference"], r"^0\.2\d{8} s, arrivals, a to b, IPv4 UDP \d+ > 5000: byte 4[01] \(UDP header\) "
                                                 r"of 47: [0-9a-f]{2} \| [0-9a-f]{2}; byte 45 \(UDP payload, byte 3\): 6c \| 73$")
        packet, = [packet for packet, in self.query("SELECT bytes FROM arrivals WHERE door = 'air of a'", one)
                   if packet.endswith(b"world".hex())]
        patched = self.copied(one, f"UPDATE arrivals SET bytes = '{packet[:-4]}7365' WHERE bytes = '{packet}'")
        self.assertRegex(self.diff(one, patched, 1)["difference"],
                         r", arrivals, a to b, IPv4 UDP \d+ > 5000: byte 45 \(UDP payload, byte 3\) of 47: 6c \| 73$")

    def test_frames_name_the_protocols_of_programs(self):
        one, _ = self.programs("world", *ALL)
        protocols = {protocol for protocol, in self.query("SELECT DISTINCT protocol FROM frames WHERE transmitter = 1")}
        self.assertIn("ARP", protocols)
        self.assertTrue(any(re.fullmatch(r"IPv4 UDP \d+ > 5000", one or "") for one in protocols), protocols)
        patched = self.copied(one, "UPDATE frames SET bits = bits + 8 WHERE rowid = "
                                   "(SELECT MIN(rowid) FROM frames WHERE protocol LIKE '%5000')")
        self.assertRegex(self.diff(one, patched, 1)["difference"],
                         r", frames, a to b, IPv4 UDP \d+ > 5000: bits \d+ \| \d+$")


if __name__ == "__main__":
    unittest.main()
