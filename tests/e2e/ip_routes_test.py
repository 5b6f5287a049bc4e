#!/usr/bin/env python3
"""Routes of IP between agents' networks: packets that others forward, in real time and in lock-step."""
import re
import unittest

import wire
from baraka import ROOT, Case

REFUSED = wire.why_not()
PING = "ping -q -c 10 -i 0.2"
# The stations hear their neighbours in the line and nobody else.
HEAD = f"""version: 1
name: ip_routes
seed: 1
routing: none
record: {{frames: all, air: heard.pcapng}}
radio:
  include: {ROOT}/config/radios/ieee80211g.yaml
  propagation: [{{model: log_distance, exponent: 3}}]
  data_rate: 12 Mb/s
agents:
"""


def line(count, routes, network="", pings=()):
    """Stations s0, s1, … of one group in a line; `pings`: (agent, words)."""
    programs = "".join(
        f"\n      - {{name: p{i}, command: [sh, -c, 'case {{agent}} in {agent}) {words};; esac'], start: 100 ms, "
        "on_exit: ignore}"
        for i, (agent, words) in enumerate(pings))
    return (f"  s:\n    name: \"s{{}}\"\n    station: {{}}\n    line: {{count: {count}, spacing: 40 m}}\n"
            f"    network: {{{network}routes: {routes}}}\n    programs:{programs}\n")


@unittest.skipIf(REFUSED, REFUSED)
class Routes(Case):
    pace = "lockstep"

    def play(self, agents, end="4 s"):
        file = self.folder / "routes.yaml"
        file.write_text(HEAD + agents + f"end: [{{at: {end}, result: done}}]\n", encoding="utf-8")
        self.finished = self.run_baraka(file, "--pace", self.pace, "--no-inspect", "--controllers", "in-process")

    def log(self, agent, program="p0"):
        return (self.out / f"{agent}.{program}.log").read_text(encoding="utf-8")

    def assert_all_answered(self, agent, program="p0"):
        self.assertIn("10 packets transmitted, 10 received", self.log(agent, program))

    def hops(self):
        """Who sent unicast frames of data to whom, as often."""
        return dict(((a, b), n) for a, b, n in self.query(
            "SELECT transmitter, receiver, COUNT(*) FROM frames WHERE class = 'unicast' GROUP BY 1, 2"))

    def test_without_routes_the_ends_do_not_hear_each_other(self):
        self.play(line(3, "[{at: s0, to: s1}]", pings=[("s0", PING + " s1"), ("s0", PING + " s2")]))
        self.assert_all_answered("s0")
        self.assertNotIn(" 10 received", self.log("s0", "p1"))
        self.assertEqual(set(self.hops()), {(1, 2), (2, 1)})

    def test_a_ping_over_three_takes_two_hops_each_way(self):
        for version in "-4", "-6":
            with self.subTest(version):
                self.play(line(3, "[{to: s2, via: s1}, {to: s0, via: s1}]",
                               pings=[("s0", f"ping {version} -c 10 -i 0.2 s2")]))
                self.assert_all_answered("s0")
                self.assertEqual(set(re.findall(r"ttl=(\d+)", self.log("s0"))), {"63"})
                hops = self.hops()
                self.assertEqual(set(hops), {(1, 2), (2, 3), (3, 2), (2, 1)})
                self.assertTrue(all(n >= 10 for n in hops.values()), hops)
                self.assertNotIn("edirect", self.log("s0"))

    def test_a_path_of_five_and_of_twelve(self):
        # A busy computer is late for twelve kernels.
        for count in (5, 12) if self.pace == "lockstep" else (5,):
            with self.subTest(count=count):
                self.play(line(count, '[{path: ["s*"]}]', pings=[
                    ("s0", f"ping -c 10 -i 0.2 s{count - 1}"), (f"s{count - 1}", "ping -6 -c 10 -i 0.2 s0")]), "6 s")
                self.assert_all_answered("s0")
                self.assert_all_answered(f"s{count - 1}", "p1")
                ttl = str(64 - (count - 2))
                self.assertEqual(set(re.findall(r"ttl=(\d+)", self.log("s0"))), {ttl})

    def test_routes_of_networks_and_of_everything(self):
        self.play(line(3, "[{at: s0, to: 10.77.0.3/32, via: s1}, {at: s2, to: default, via: s1}, "
                          "{at: s2, to: 10.77.0.0/24, via: s1}]",
                       pings=[("s0", PING + " -4 s2"), ("s0", "cat /proc/net/route"), ("s2", "cat /proc/net/route")]))
        self.assert_all_answered("s0")
        gateways = re.findall(r"wlan0\t(\w{8})\t(\w{8})", self.log("s2", "p2"))
        self.assertIn(("00000000", "02004D0A"), gateways)
        self.assertIn(("00004D0A", "02004D0A"), gateways)
        self.assertNotIn(("00000000", "02004D0A"), re.findall(r"wlan0\t(\w{8})\t(\w{8})", self.log("s0", "p1")))

    def test_only_agents_that_forward_are_routers(self):
        self.play(line(3, "[{to: s2, via: s1}, {to: s0, via: s1}]", pings=[
            (f"s{i}", "cd /proc/sys/net; cat ipv4/ip_forward ipv6/conf/all/forwarding ipv4/conf/wlan0/send_redirects "
                      "ipv4/conf/wlan0/accept_redirects ipv6/conf/wlan0/accept_redirects") for i in range(3)]))
        for agent, forwards in ("s0", "0"), ("s1", "1"), ("s2", "0"):
            with self.subTest(agent):
                self.assertEqual(self.log(agent, "p" + agent[1]).split(), [forwards, forwards, "0", "0", "0"])

    def test_an_end_beyond_the_last_hop_is_reported_to_the_source(self):
        self.play(line(4, "[{at: s0, to: s3, via: s1}, {at: s1, to: s3, via: s2}, {at: s2, to: s0, via: s1}, "
                          "{at: s3, to: s0, via: s2}]",
                       pings=[("s0", "ping -c 3 -t 1 s3"), ("s0", "ping -c 3 -t 2 s3"), ("s0", "ping -c 3 -t 3 s3")]))
        for program, where in ("p0", "s1"), ("p1", "s2"):
            self.assertRegex(self.log("s0", program), rf"From {where} .*Time to live exceeded")
        self.assertIn("3 packets transmitted, 3 received", self.log("s0", "p2"))

    def test_agents_on_different_networks_reach_each_other_over_one_on_both_sides(self):
        agents = "".join(
            f"  {name}:\n    name: {name}\n    station: {{}}\n    poses: [{{x: {x} m, y: 0 m}}]\n"
            f"    network: {{address: {address}, routes: {routes}}}\n{programs}"
            for name, x, address, routes, programs in (
                ("a", 0, "10.1.0.1/16", "[{to: r}, {to: 10.2.0.0/16, via: r}]",
                 f"    programs: [{{name: p0, command: [sh, -c, '{PING} 10.2.0.1'], start: 100 ms, on_exit: ignore}}]\n"),
                ("r", 40, "10.3.0.1/16", "[{to: a}, {to: b}]", ""),
                ("b", 80, "10.2.0.1/16", "[{to: r}, {to: default, via: r}]", "")))
        self.play(agents)
        self.assert_all_answered("a")

    def test_routers_send_no_redirects(self):
        """By the counters of the kernel: it would send the first six at once, and more later."""
        counters = "sleep 3; grep OutRedirects /proc/net/snmp6; grep ^Icmp: /proc/net/snmp"
        self.play(line(3, '[{path: ["s*"]}]', pings=[
            ("s0", PING + " -4 s2"), ("s0", PING + " -6 s2"), ("s1", counters)]), end="8 s")  # in real time, beside load
        self.assert_all_answered("s0", "p0")
        self.assert_all_answered("s0", "p1")
        ipv6, names, values = self.log("s1", "p2").splitlines()
        self.assertEqual(ipv6.split(), ["Icmp6OutRedirects", "0"])
        self.assertEqual(dict(zip(names.split(), values.split()))["OutRedirects"], "0")
        self.assertEqual(self.capture("icmp.type == 5 || icmpv6.type == 137"), "")
        self.assertNotEqual(self.capture("icmp.type == 0"), "")
        self.assertNotEqual(self.capture("icmpv6.type == 129"), "")

    def capture(self, what):
        return wire.subprocess.run(["tshark", "-r", self.out / "heard.pcapng", "-Y", what], capture_output=True,
                                   text=True, check=True).stdout


class InRealTime(Routes):
    pace = "realtime"


@unittest.skipIf(REFUSED, REFUSED)
class InLockstep(Routes):
    def test_equal_runs_have_equal_fingerprints(self):
        prints = set()
        for _ in range(2):
            self.play(line(5, '[{path: ["s*"]}]', pings=[("s0", PING + " -4 s4"), ("s4", PING + " -6 s0")]))
            prints.add(self.finished["fingerprint"])
        self.assertEqual(len(prints), 1)


del Routes  # its tests run in each pace


if __name__ == "__main__":
    unittest.main()
