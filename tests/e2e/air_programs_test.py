#!/usr/bin/env python3
"""Programs that nobody here wrote, on the simulated air: ping, iperf3, sockets of Python."""
import json
import os
import pathlib
import re
import shutil
import signal
import sys
import time
import unittest

import wire
from baraka import BIN, Case, children, send, wait_for

SKIPPED = 77

REAL_TIME = ("--pace", "realtime")
SLOW_RADIO = "radio: {include: radios/ieee80211b.yaml, queue_limit: 20}\n"
FAST_RADIO = "radio: {include: radios/ieee80211g.yaml, queue_limit: 20}\n"


def station(name, x, programs="", more=""):
    """A group of one agent with a network."""
    return (f"  {name}:\n    name: {name}\n    station: {{}}\n    poses: [{{x: {x} m, y: 0 m}}]\n"
            f"    network: {{}}\n{more}    programs: [{programs}]\n")


def program(name, *command, start="200 ms", on_exit="ignore", environment="{}"):
    words = json.dumps(list(command))
    return (f"{{name: {name}, command: {words}, start: {start}, on_exit: {on_exit}, "
            f"environment: {environment}}}")


class Air(Case):
    def scenario(self, *stations, end="20 s", more="", radio=SLOW_RADIO):
        file = self.folder / "scenario.yaml"
        file.write_text("version: 1\nrouting: none\n" + radio + more + "agents:\n" + "".join(stations)
                        + f"end: [{{at: {end}, result: timeout}}]\n")
        return file

    def log(self, name):
        return (self.out / name).read_text()


class Ping(Air):
    """Against the standard: IEEE Std 802.11-2016, clauses 10.3.4.3 and 16.2 (long preamble)."""
    PREAMBLE, SIFS, DIFS = 192e-6, 10e-6, 50e-6

    def airtime(self, octets, rate):
        """Of an MPDU; whole microseconds (16.3.4.7)."""
        microseconds = -(-8 * octets * 10**6 // int(rate))
        return self.PREAMBLE + microseconds * 1e-6

    def closed_form(self):
        """Seconds until what ping waits for, the second data frame, ends; its acknowledgement comes after."""
        packet = 20 + 8 + 56  # IPv4, ICMP, ping's own
        data = self.airtime(24 + 8 + packet + 4, 11e6)
        self.ack = self.airtime(14, 1e6)
        return data + self.SIFS + self.ack + self.DIFS + data

    def pinged(self, *pace):
        """The least of 200 round trips as ping says it, seconds."""
        # 2 ms apart: longer than the longest, with a backoff of 31 slots.
        scenario = self.scenario(
            station("a", 0, program("ping", "ping", "-q", "-c", "200", "-i", "0.002", "b", on_exit="end")),
            station("b", 5), more="record: {frames: all}\n")
        finished = self.run_baraka(scenario, *pace)
        self.assertEqual(finished["result"], "ping", str(finished))
        self.assertEqual(finished["frames_dropped"], "0")
        text = self.log("a.ping.log")
        self.assertIn("200 packets transmitted, 200 received", text)
        return float(re.search(r"rtt min/[^=]*= ([0-9.]+)/", text)[1]) * 1e-3

    def test_the_least_round_trip_is_that_of_the_standard_with_no_backoff(self):
        closed = self.closed_form()
        # What the machine itself needs, some 300 us where system calls are slow, counts a fiftieth; a slot is 20 us.
        least = self.pinged("--pace", "realtime:0.02")
        self.assertGreaterEqual(least, closed * 0.999)
        self.assertLess(least, closed + 20e-6, f"closed form {closed * 1e3:.3f} ms")
        # The whole exchange, from the first bit to the last, as the simulator has it.
        frames = self.query("SELECT at_ns, airtime_ns, class, transmitter FROM frames ORDER BY at_ns")
        exchanges = [last[0] + last[1] - first[0]
                     for first, _, _, last in zip(frames, frames[1:], frames[2:], frames[3:])
                     if first[2] == "unicast" and first[3] == 1 and last[2] == "ack" and last[3] == 1]
        self.assertGreater(len(exchanges), 150)
        self.assertAlmostEqual(min(exchanges) * 1e-9, closed + self.SIFS + self.ack, delta=2e-6)

    def test_in_lock_step_the_machine_adds_nothing_to_it(self):
        closed = self.closed_form()
        self.assertAlmostEqual(self.pinged(), closed, delta=2e-6)

    def test_both_versions_of_ip_and_multicast_work(self):
        """Names, ARP, neighbour discovery, and a group's address."""
        scenario = self.scenario(
            station("a", 0, ", ".join([
                program("four", "ping", "-c", "3", "-i", "0.1", "b"),
                program("six", "ping", "-6", "-c", "20", "-i", "0.2", "-I", "wlan0", "ff02::1"),
                program("end", "sleep", "5", on_exit="end")])),
            station("b", 5), station("c", 10))
        finished = self.run_baraka(scenario)
        self.assertEqual(finished["result"], "end", str(finished))
        self.assertRegex(self.log("a.four.log"), "3 received")
        answered = set(re.findall(r"from (fe80:[0-9a-f:]+)", self.log("a.six.log")))
        self.assertGreaterEqual(len(answered), 3, self.log("a.six.log"))


class Iperf(Air):
    """Against traffic_source, which fills its queue by itself."""
    LENGTH = 1470  # of a datagram; 28 of IP and UDP make an MSDU of 1498

    def source(self, radio):
        """Goodput of datagrams of that length, bit/s, in MSDUs of traffic_source."""
        file = self.folder / "source.yaml"
        file.write_text(f"""
version: 1
routing: none
controller_latency: 0 s
{radio}agents:
  a:
    name: a
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    controller:
      {{program: traffic_source, parameters: {{pattern: saturated, backlog: 4, to: b, topic: t, size: 1491}}}}
  b:
    name: b
    station: {{}}
    poses: [{{x: 5 m, y: 0 m}}]
    controller: {{program: traffic_sink, parameters: {{topic: t, overhead: 7, start: 1 s}}}}
end: [{{at: 21 s, result: done}}]
""")
        self.run_baraka(file, "--controllers", "in-process")
        ((goodput,),) = self.query("SELECT MAX(value) FROM recorded WHERE name = 'goodput'")
        return goodput * self.LENGTH / 1498

    def received(self, factor, radio):
        """Datagrams of iperf3 that arrived in 4 s of saturation, as bit/s, and the greatest lateness in s."""
        client = ["iperf3", "-c", "b", "-u", "-b", "0", "-l", str(self.LENGTH), "-t", "6"]
        scenario = self.scenario(
            station("a", 0, program("client", *client, start="500 ms")),
            station("b", 5, program("server", "iperf3", "-s", start="0 s")), end="6 s",
            more="record: {frames: all}\n", radio=radio)
        finished = self.run_baraka(scenario, "--pace", f"realtime:{factor}", timeout=300)
        self.assertEqual(finished["frames_dropped"], "0", str(finished))
        ((count,),) = self.query(
            "SELECT COUNT(*) FROM frames JOIN frame_ends USING (frame) WHERE bits > 12000 AND verdict = 'delivered' "
            "AND frame_ends.agent = 2 AND frames.at_ns BETWEEN 1500000000 AND 5500000000")
        return count * self.LENGTH * 8 / 4, max(
            float(finished[f"{edge}_lateness_max_s"]) for edge in ("entering", "leaving"))

    def check(self, factor, radio):
        expected = self.source(radio)
        for _ in range(4):  # while a busy computer halts the run for longer, a queue of 20 frames runs dry
            measured, late = self.received(factor, radio)
            if late < 0.005:
                break
        self.assertLess(abs(measured / expected - 1), 0.01, f"{measured} instead of {expected} bit/s")

    def test_saturating_11_mbit_s_it_gets_what_traffic_source_gets(self):
        self.check("1", SLOW_RADIO)

    def test_saturating_54_mbit_s_it_gets_what_traffic_source_gets(self):
        self.check("0.2", FAST_RADIO)

    def test_tcp_that_is_not_slowed_is_said(self):
        scenario = self.scenario(
            station("a", 0, program("client", "iperf3", "-c", "b", "-n", "20K", start="500 ms", on_exit="end")),
            station("b", 5, program("server", "iperf3", "-s", start="0 s")))
        finished = self.run_baraka(scenario, "--pace", "realtime:0.5")
        self.assertEqual(finished["result"], "client", str(finished))
        self.assertIn("programs used TCP at 0.5 of real time", finished.err)
        ((warnings,),) = self.query("SELECT value FROM run WHERE key = 'warnings'")
        self.assertIn("programs used TCP at 0.5 of real time", warnings)

    def test_tcp_runs(self):
        scenario = self.scenario(
            station("a", 0, program("client", "iperf3", "-c", "b", "-t", "2", start="500 ms", on_exit="end")),
            station("b", 5, program("server", "iperf3", "-s", start="0 s")))
        finished = self.run_baraka(scenario, *REAL_TIME)
        self.assertEqual(finished["result"], "client", str(finished))
        self.assertRegex(self.log("a.client.log"), r"receiver")
        self.assertNotIn("TCP", finished.err)


class Repetition(Air):
    def recorded(self, *arguments, **more):
        talker = ("import socket, time\n"
                  "s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n"
                  "for i in range(200):\n"
                  "    s.sendto(bytes(600), ('b', 5000)); time.sleep(0.005)\n")
        scenario = self.scenario(
            station("a", 0, program("talker", wire.PYTHON, "-c", talker, on_exit="end")),
            station("b", 30, program("ping", "ping", "-c", "20", "-i", "0.05", "a")), **more)
        return scenario, self.run_baraka(scenario, *arguments)

    def test_it_is_repeated_without_programs_to_the_same_fingerprint_and_faster(self):
        scenario, first = self.recorded()
        record = self.out
        self.assertEqual(first["result"], "talker", str(first))
        for _ in range(3):
            repeated = self.run_baraka(scenario, "--repeat", record)
            for key in ("fingerprint", "result", "simulated_s"):
                self.assertEqual(repeated[key], first[key], key)
        self.assertGreater(float(repeated["real_time_factor"]), float(first["real_time_factor"]))
        ((there,),) = self.query("SELECT COUNT(*) FROM arrivals WHERE door = 'air of a'", record)
        self.assertGreaterEqual(there, 200)

    def test_on_another_radio_it_is_an_open_loop(self):
        scenario, first = self.recorded()
        record = self.out
        for change in ("radio.data_rate=1 Mb/s", "radio.loss={probability: 0.3}",
                       "agents.b.poses=[{x: 60 m, y: 0 m}]"):
            other = self.run_baraka(scenario, "--repeat", record, "--set", change)
            self.assertIn("open loop: ", other.err)
            self.assertIn(change.split("=")[0], other.err)
            self.assertIn(change.split("=")[0], (self.out / "run.log").read_text())
            self.assertNotEqual(other["fingerprint"], first["fingerprint"])
            ((lines,),) = self.query("SELECT value FROM run WHERE key = 'open_loop'")
            self.assertIn("instead of", lines)
        for change in ("agents.b.network.mtu=1400", "seed=2", "agents.b.name=c"):
            refused = self.run_baraka(scenario, "--repeat", record, "--set", change, status=2)
            self.assertIn("is not of this scenario", refused.err)


class Programs(Air):
    def test_their_words_environment_and_logs_are_those_of_the_scenario(self):
        say = program("say", "sh", "-c", "echo {agent} {address} {number} $X; pwd; ls {results}",
                      environment="{X: \"{agent}!\"}", start="100 ms")
        finished = self.run_baraka(self.scenario(station("a", 0, say), station("b", 5, say), end="1 s"))
        self.assertIn("a 10.77.0.1 0 a!", self.log("a.say.log"))
        self.assertIn("b 10.77.0.2 0 b!", self.log("b.say.log"))
        self.assertIn("run.sqlite", self.log("b.say.log"))
        rows = self.query("SELECT agent, name, started_ns, status FROM programs ORDER BY agent")
        self.assertEqual([(1, "say", 0), (2, "say", 0)], [(a, n, s) for a, n, _, s in rows])
        self.assertGreaterEqual(min(started for _, _, started, _ in rows), 100_000_000)
        self.assertEqual(finished["result"], "timeout")

    def test_their_interface_is_that_of_the_scenario(self):
        look = program("look", "sh", "-c", "ip -4 address show wlan0; ip link show wlan0; ping -c 1 b", on_exit="fail")
        for network in ("{address: 192.168.9.7/24, mtu: 1400}", "{}"):
            scenario = self.scenario(station("a", 0, look), station("b", 5), end="2 s")
            scenario.write_text(scenario.read_text().replace("network: {}", f"network: {network}", 1).replace(
                "network: {}", "network: {address: 192.168.9.8/24}" if "192" in network else "network: {}", 2))
            self.run_baraka(scenario)
            address, mtu = ("192.168.9.7/24", 1400) if "192" in network else ("10.77.0.1/16", 1500)
            self.assertIn(f"inet {address} ", self.log("a.look.log"))
            self.assertIn(f"mtu {mtu} ", self.log("a.look.log"))
            self.assertIn("link/ether 02:00:00:00:00:01", self.log("a.look.log"))

    def test_one_that_fails_fails_the_run_if_the_scenario_says_so(self):
        for on_exit, status, result in (("ignore", 0, "timeout"), ("fail", 1, "failed"), ("end", 1, "failed")):
            bad = program("bad", "sh", "-c", "exit 3", on_exit=on_exit)
            finished = self.run_baraka(self.scenario(station("a", 0, bad), end="1 s"), status=status)
            self.assertEqual(finished["result"], result)
            self.assertEqual(self.query("SELECT status FROM programs"), [(3,)])
            if status:
                self.assertIn("program bad of a exited with status 3; see a.bad.log", finished.err)
        well = self.run_baraka(self.scenario(
            station("a", 0, program("well", "true", on_exit="fail")), end="1 s"))
        self.assertEqual(well["result"], "timeout")

    def test_one_that_is_not_there_is_named(self):
        finished = self.run_baraka(self.scenario(station("a", 0, program("x", "no-such-program"))), status=2)
        self.assertRegex(finished.err, r"scenario.yaml:\d+:\d+: command: no program 'no-such-program' in PATH")

    def test_one_whose_time_cannot_be_slowed_is_refused_before_the_run(self):
        still = BIN.parent / "tests/still"
        script = self.folder / "script"
        script.write_text(f"#!{still}\n")
        script.chmod(0o755)
        scenario = self.scenario(station("a", 0, ", ".join([
            program("well", "true"), program("still", str(still), start="900 ms"),
            program("script", str(script), start="900 ms")])), end="1 s")
        slowed = self.run_baraka(scenario, "--pace", "realtime:0.5", status=2)
        self.assertRegex(slowed.err, r"scenario.yaml:\d+:\d+: command: \S*/still is statically linked, so its time "
                                     r"cannot be slowed")
        self.assertRegex(slowed.err, r"scenario.yaml:\d+:\d+: command: \S*/script is run by \S*/still, which is "
                                     r"statically linked, so its time cannot be slowed")
        self.assertFalse(self.out.exists(), "no run has begun")
        self.run_baraka(scenario, "--pace", "realtime")

    def test_one_that_is_killed_is_noted(self):
        under_way = self.start(self.scenario(station("a", 0, program("victim", "sleep", "1234", on_exit="fail"))), *REAL_TIME)

        def victims():
            found = []
            for entry in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
                try:
                    words = entry.read_bytes().split(b"\0")
                    environment = (entry.parent / "environ").read_bytes()
                except OSError:
                    continue
                if words[:2] == [b"sleep", b"1234"] and str(self.folder).encode() in environment:
                    found.append(int(entry.parent.name))
            return found

        wait_for(lambda: (self.out / "run.log").exists() and "program victim started" in self.log("run.log"))
        found = [pid for pid in victims()]
        if not found:  # nothing in its environment names the run: then by its ancestors
            found = descendants(under_way.process.pid, "sleep")
        self.assertEqual(len(found), 1)
        send(found[0], "SIGKILL")
        finished = under_way.finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertIn("killed by signal 9", finished.err)
        self.assertEqual(self.query("SELECT status FROM programs"), [(137,)])

    def test_an_agent_may_have_a_controller_as_well(self):
        agent = station("a", 0, program("ping", "ping", "-c", "3", "-i", "0.1", "b", start="500 ms", on_exit="end"),
                        more="    controller: {program: traffic_source, parameters: {to: b, topic: t, rate: 20 Hz}}\n")
        sink = station("b", 5, more="    controller: {program: traffic_sink, parameters: {topic: t}}\n")
        finished = self.run_baraka(self.scenario(agent, sink))
        self.assertEqual(finished["result"], "ping", str(finished))
        ((received,),) = self.query("SELECT MAX(value) FROM recorded WHERE name = 'received'")
        self.assertGreater(received, 5)
        record = self.out
        repeated = self.run_baraka(self.folder / "scenario.yaml", "--repeat", record)
        self.assertEqual(repeated["fingerprint"], finished["fingerprint"])
        # Out of reach the sink has fewer events than in the record.
        away = self.run_baraka(self.folder / "scenario.yaml", "--repeat", record, "--set",
                               "agents.b.poses=[{x: 900 m, y: 0 m}]")
        self.assertIn("open loop", away.err)
        self.assertEqual(self.query("SELECT COUNT(*) FROM recorded WHERE name = 'received' AND value > 0"), [(0,)])


class Icmp(Air):
    """The kernel sends ICMP of all namespaces through one socket per processor, which is full of errors that wait for the
    addresses of neighbours that nobody has (programs/netns/icmp.h)."""
    STRANGERS = """
import socket, struct, time
s = socket.socket(socket.AF_INET, socket.SOCK_RAW, socket.IPPROTO_RAW)
to = socket.inet_aton("10.77.0.2")
for i in range(200):  # their ports are closed, their answers as long as such may be
    header = struct.pack("!BBHHHBBH4s4s", 0x45, 0, 1028, i, 0, 64, 17, 0, bytes([10, 77, 1, 1 + i]), to)
    s.sendto(header + struct.pack("!HHHH", 7000, 7000, 1008, 0) + bytes(1000), ("10.77.0.2", 0))
    time.sleep(0.005)
"""

    def pinged(self, *others):
        """A run in which b is pinged while it has 200 strangers to answer, and until it has not. @return its warnings."""
        processors = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {min(processors)})
        self.addCleanup(os.sched_setaffinity, 0, processors)
        finished = self.run_baraka(self.scenario(
            station("a", 0, ", ".join([program("strangers", wire.PYTHON, "-c", self.STRANGERS),
                                       program("ping", "ping", "-c", "100", "-i", "0.05", "-W", "1", "b", start="2 s", on_exit="end")])),
            station("b", 5), *others, radio=FAST_RADIO), *REAL_TIME)
        self.assertEqual(finished["result"], "ping", str(finished))
        return finished.err

    def test_what_the_kernel_never_sent_is_said(self):
        warnings = self.pinged()
        count = re.search(r"the kernel never sent (\d+) ICMP messages \(b: (\d+)\)", warnings)
        self.assertTrue(count, warnings)
        self.assertEqual(count[1], count[2])
        lost = 100 - int(re.search(r"(\d+) received", self.log("a.ping.log"))[1])
        self.assertGreater(lost, 10)
        self.assertGreaterEqual(int(count[1]), lost)
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'icmp_not_sent'"), [(int(count[1]),)])

    def test_above_four_agents_errors_are_bounded_and_leave_room(self):
        look = program("look", "cat", "/proc/sys/net/ipv4/icmp_msgs_burst", start="0 s")
        warnings = self.pinged(station("c", 10, look), station("d", 15), station("e", 20))
        if not (self.out / "c.look.log").read_text().strip().isdigit():
            self.skipTest("this kernel has one bound for all namespaces")
        self.assertEqual(self.log("c.look.log").strip(), "5")
        self.assertNotIn("ICMP", warnings)
        self.assertIn(" 100 received", self.log("a.ping.log"))


class Runs(Air):
    def test_two_at_once_do_not_disturb_each_other(self):
        scenario = self.scenario(
            station("a", 0, program("ping", "ping", "-c", "10", "-i", "0.1", "b", on_exit="end")), station("b", 5))
        one = self.start(scenario)
        first = self.out
        two = self.start(scenario)
        for under_way, out in ((one, first), (two, self.out)):
            finished = under_way.finish()
            self.assertEqual(finished.status, 0, str(finished))
            self.assertIn("10 packets transmitted, 10 received", (out / "a.ping.log").read_text())

    def test_through_an_access_point(self):
        cell = "radio: {include: radios/ieee80211b.yaml, bss: {access_point: ap}}\n"
        scenario = self.scenario(
            station("ap", 0), station("a", 5, program("ping", "ping", "-c", "5", "-i", "0.5", "b", start="2 s",
                                                      on_exit="end")),  # it waits for the last as long as between two
            station("b", -5), radio=cell)
        finished = self.run_baraka(scenario)
        self.assertEqual(finished["result"], "ping", str(finished))
        self.assertIn("5 packets transmitted, 5 received", self.log("a.ping.log"))
        self.assertNotIn("DUP", self.log("a.ping.log"), "own broadcasts came back")

    def test_pace_is_that_of_the_clock_and_no_faster(self):
        scenario = self.scenario(station("a", 0), end="1 s")
        for pace in ("realtime:1.01", "realtime:0.009"):
            refused = self.run_baraka(scenario, "--pace", pace, status=2)
            self.assertIn("agents that have a network", refused.err)
        slower = self.run_baraka(scenario, *REAL_TIME, "--max-speed", "0.5", status=2)
        self.assertIn("--max-speed: runs with networks keep real time", slower.err)
        self.assertLess(float(self.run_baraka(scenario, *REAL_TIME)["real_time_factor"]), 1.1)

    def test_without_a_pace_they_are_held(self):
        agent = station("a", 0)
        self.run_baraka(self.scenario(agent, end="1 s"))
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'pace'"), [("lockstep",)])
        slow = self.run_baraka(self.scenario(agent, end="1 s"), "--max-speed", "2")
        self.assertLess(float(slow["real_time_factor"]), 2.1)
        inside = agent + "    controller: {program: traffic_sink, parameters: {topic: t}, inside: true}\n"
        self.run_baraka(self.scenario(inside, end="1 s"))
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'pace'"), [("lockstep",)])
        self.run_baraka(self.scenario(inside, end="1 s"), *REAL_TIME)
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'pace'"), [("realtime",)])

    def test_too_late_is_said(self):
        scenario = self.scenario(
            station("a", 0, program("ping", "ping", "-c", "100", "-i", "0.01", "b", on_exit="end")), station("b", 5))
        finished = self.run_baraka(scenario, *REAL_TIME, "--set", "lateness_limit=1 us")
        self.assertGreaterEqual(int(finished["entering_frames"]), 100)
        self.assertIn("this computer was too slow for this run", finished.err)
        ((warnings,),) = self.query("SELECT value FROM run WHERE key = 'warnings'")
        self.assertIn("too slow", warnings)
        self.assertGreater(float(finished["entering_late_share"]), 0.01)
        patient = self.run_baraka(scenario, *REAL_TIME, "--set", "lateness_limit=10 s")
        self.assertEqual(float(patient["entering_late_share"]), 0)
        self.assertNotIn("too slow", patient.err)

    def test_few_frames_that_are_late_are_counted_and_no_share_is_judged(self):
        scenario = self.scenario(
            station("a", 0, program("ping", "ping", "-c", "5", "-i", "0.1", "b", on_exit="end")), station("b", 5))
        finished = self.run_baraka(scenario, *REAL_TIME, "--set", "lateness_limit=1 us")
        self.assertLess(int(finished["entering_frames"]), 100)
        # Of the 10 frames of the pings; what the kernels sent before the run began, however much that is, is not late.
        late = float(finished["entering_late_share"]) * int(finished["entering_frames"])
        self.assertGreater(late, 5)
        self.assertRegex(finished.err, r"\d+ of the \d+ frames that programs sent were more than 0.001 ms late")
        self.assertNotIn("too slow", finished.err)

    def test_what_kernels_send_while_interfaces_come_up_is_not_late(self):
        self.run_baraka(self.scenario(station("a", 0), station("b", 5), end="50 ms"), *REAL_TIME)
        entered = [at for (at,) in self.query("SELECT at_ns FROM arrivals WHERE door LIKE 'air of %' ORDER BY at_ns")]
        self.assertTrue(entered, "the kernels told nothing of their interfaces")
        self.assertEqual(entered[0], 0)


def descendants(pid, name):
    """Pids of a program below another process."""
    parents = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:
            continue
        parents[int(stat.parent.name)] = (int(text.rpartition(")")[2].split()[1]), text.split("(", 1)[1])
    found = []
    for candidate, (parent, rest) in parents.items():
        above = parent
        while above in parents and above != pid:
            above = parents[above][0]
        if above == pid and rest.startswith(name + ")"):
            found.append(candidate)
    return found


def refused_here():
    """Why there are no namespaces here; empty: there are."""
    class Probe(Air):
        def runTest(self):
            self.finished = self.start(self.scenario(station("a", 0), end="10 ms")).finish()
    probe = Probe()
    probe.setUp()
    probe.runTest()
    probe.doCleanups()
    said = probe.finished.err.strip()
    if probe.finished.status != 0 and not wire.is_refusal(said):
        raise AssertionError(str(probe.finished))
    return "" if probe.finished.status == 0 else said.splitlines()[-1]


if __name__ == "__main__":
    missing = [name for name in ("ping", "iperf3") if not shutil.which(name)]
    reason = f"not installed: {', '.join(missing)}" if missing else refused_here()
    if reason:
        print("skipped:", reason)
        sys.exit(SKIPPED)
    unittest.main()
