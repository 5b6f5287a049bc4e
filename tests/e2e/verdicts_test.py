#!/usr/bin/env python3
"""Why frames were lost: verdicts add up to what was sent, on every link and in all. The sums of the
results' views are compared with a count of each frame at each radio, made here from the rows of
`record: {frames: all}`, and where nothing is random with what the geometry says."""
import collections
import math
import unittest

from baraka import CASE_STUDY, ROOT, Case, Program

SCENARIOS = ROOT / "config/scenarios"
IN_PROCESS = ("--controllers", "in-process", "--set", "record.frames=all")
EVERYONE = (65534, 65535)
HEAD = """version: 1
name: verdicts
seed: 3
controller_latency: 0 s
control_period: 50 ms
routing: none
end: [{{at: {end}, result: done}}]
radio: {{{radio}}}
agents:
"""
GROUP = """  {name}:
    name: {name}{{}}
    station: {station}
    radio: {radio}
    {layout}
    controller: {{program: traffic_source, parameters: {{pattern: {pattern}, rate: 40 Hz, to: {to}, topic: t, size: {size}}}}}
"""


def group(name, layout, to="neighbours", station="{}", pattern="periodic", size=300, radio="{}"):
    return GROUP.format(name=name, layout=layout, to=to, station=station, pattern=pattern, size=size, radio=radio)


class Verdicts(Case):
    def play(self, groups, radio="profile: ieee80211b", end="1 s", arguments=()):
        file = self.folder / "verdicts.yaml"
        file.write_text(HEAD.format(radio=radio, end=end) + groups, encoding="utf-8")
        return self.sums_hold(file, *arguments)

    def sums_hold(self, scenario, *arguments):
        """Runs it and compares; gives the verdicts in all."""
        self.run_baraka(scenario, *IN_PROCESS, *arguments)
        self.check_countable()
        expected, links = self.count_each_frame_at_each_radio()
        totals = collections.Counter()
        for kind, addressed, verdict, count in self.query("SELECT * FROM verdict_sums"):
            totals[kind, addressed, verdict] += count
        self.assertEqual(totals - expected, expected - totals)
        self.assertEqual(totals, expected)
        by_link = collections.defaultdict(collections.Counter)
        for agent, peer, kind, addressed, verdict, count in self.query("SELECT * FROM link_verdicts"):
            self.assertGreater(count, 0)
            by_link[agent, peer][kind, addressed, verdict] += count
        self.assertEqual(set(by_link), set(self.query("SELECT DISTINCT agent, peer FROM receptions")))
        for link, counts in by_link.items():
            self.assertEqual(counts, links[link], link)
        # The views alone: what was sent is the sum.
        radios = self.query("SELECT count(*) - 1 FROM agents")[0][0]
        (sent,), = self.query("SELECT ifnull(sum(count), 0) FROM frames_sent")
        self.assertEqual(sum(totals.values()), sent * radios)
        (faint,), = self.query("SELECT ifnull(sum(count), 0) FROM faint")
        verdicts = collections.Counter()
        for (_, _, verdict), count in totals.items():
            verdicts[verdict] += count
        self.assertLessEqual(faint, verdicts["below sensitivity"] + verdicts["under way"])
        return verdicts

    def count_each_frame_at_each_radio(self):
        agents = [agent for agent, in self.query("SELECT agent FROM agents")]
        (ended,), = self.query("SELECT value FROM run WHERE key = 'ended_ns'")
        delayed = self.query("SELECT 1 FROM settings WHERE key = 'radio.propagation_delay' AND value = 'true'")
        tail = 10 ** 6 if delayed else 0  # ns: it may still arrive somewhere
        ends = {}
        for frame, agent, verdict in self.query("SELECT frame, agent, verdict FROM frame_ends"):
            self.assertNotIn((frame, agent), ends, "a frame ends once at a radio")
            ends[frame, agent] = verdict
        cut = {frame for (frame, _), verdict in ends.items() if verdict == "radio off"}
        totals, links = collections.Counter(), collections.defaultdict(collections.Counter)
        for frame, kind, sender, receiver, end in self.query(
                "SELECT frame, class, transmitter, receiver, at_ns + airtime_ns FROM frames"):
            for agent in agents:
                if agent == sender:
                    self.assertNotIn((frame, agent), ends, "nobody hears itself")
                    continue
                verdict = ends.get((frame, agent))
                if verdict is None:
                    under_way = end + tail >= ended and frame not in cut
                    verdict = "under way" if under_way else "below sensitivity"
                addressed = int(receiver in (agent, *EVERYONE))
                totals[kind, addressed, verdict] += 1
                links[agent, sender][kind, addressed, verdict] += 1
        return totals, links

    def test_the_case_study(self):
        for seed in 1, 2:
            verdicts = self.sums_hold(CASE_STUDY, "--seed", seed, "--until", 70)
            self.assertGreater(verdicts["below sensitivity"], verdicts["delivered"])
            self.assertGreater(verdicts["delivered"], 1000)

    def test_hidden_terminals(self):
        for rts in (), ("--set", "radio.rts_threshold=0"):
            verdicts = self.sums_hold(SCENARIOS / "hidden_terminal.yaml", "--until", 1, *rts)
            self.assertGreater(verdicts["collision"], 5)
            (senders,), = self.query(
                "SELECT count(*) FROM link_verdicts l JOIN agents a USING (agent) JOIN agents p ON p.agent = l.peer "
                "WHERE a.name LIKE 's%' AND p.name LIKE 's%'")
            self.assertEqual(senders, 0, "they do not hear each other")

    def test_a_radio_that_is_switched_off_while_it_sends(self):
        flickers = ("  f:\n    name: f{{}}\n    station: {{}}\n    line: {{count: {}, spacing: 20 m}}\n"
                    "    controller: {{program: flicker}}\n")
        verdicts = self.play(flickers.format(3) + group("w", "poses: [{x: 5 m, y: 9 m}]"))
        self.assertGreater(verdicts["radio off"], 20)
        self.assertGreater(verdicts["delivered"], 20)
        self.play(flickers.format(2), radio="profile: disk, range: 100 m")
        self.assertGreater(self.query("SELECT sum(count) FROM receptions WHERE verdict = 'radio off'")[0][0], 5)

    def test_stations_that_move_out_of_range_and_back(self):
        moving = group("m", "poses: [{x: 700 m, y: 0 m}, {x: 0 m, y: 5 m}]",
                       station="{path: {waypoints: {points: [{x: 700 m, y: 0 m}, {x: 900 m, y: 0 m}], speed: 80 m/s}}}")
        verdicts = self.play(moving + group("s", "poses: [{x: 0 m, y: 0 m}]"), end="4 s")
        self.assertGreater(verdicts["delivered"], 20)
        self.assertGreater(verdicts["below sensitivity"], 20)

    def test_frames_that_protect_others_are_addressed_to_nobody_else(self):
        cell = (group("r", "poses: [{x: 0 m, y: 0 m}]") +
                group("n", "line: {count: 3, spacing: 4 m, origin: [2 m, 3 m]}", to="r0", pattern="saturated", size=900) +
                group("o", "poses: [{x: 3 m, y: 9 m}]", radio="{standard: ieee80211b}"))
        for protection in "auto", "rts_cts":
            with self.subTest(protection=protection):
                self.play(cell, f"profile: ieee80211g, protection: {protection}")
                (to_oneself,), = self.query("SELECT ifnull(sum(count), 0) FROM frames_sent WHERE agent = peer")
                self.assertEqual(to_oneself > 0, protection == "auto")

    def test_channels(self):
        verdicts = self.play(group("a", "line: {count: 3, spacing: 9 m}") +
                             group("b", "line: {count: 3, spacing: 9 m, origin: [0 m, 4 m]}", radio="{channel: 6}"))
        (across,), = self.query("SELECT count(*) FROM link_verdicts l JOIN agents a USING (agent) JOIN agents p ON "
                                "p.agent = l.peer WHERE substr(a.name, 1, 1) <> substr(p.name, 1, 1)")
        self.assertEqual(across, 0)
        self.assertGreater(verdicts["delivered"], 100)
        # Three of a frame's five other radios are on the other channel.
        self.assertGreater(verdicts["below sensitivity"], verdicts["delivered"])

    def test_access_points(self):
        self.sums_hold(SCENARIOS / "handover.yaml", "--until", 25)
        classes = {kind for kind, in self.query("SELECT DISTINCT class FROM link_verdicts")}
        self.assertEqual(classes, {"ack", "beacon", "management", "unicast"})

    def test_obstacles(self):
        verdicts = self.sums_hold(CASE_STUDY, "--until", 40, "--set", "radio.obstacles=true")
        self.assertGreater(verdicts["obstacle"], 0)

    def test_every_profile(self):
        crowd = group("c", "uniform: {count: 12, from: [0 m, 0 m], to: [600 m, 600 m]}")
        talk = group("t", "poses: [{x: 0 m, y: 0 m}]", to="c0", pattern="saturated", size=900)
        for profile in ("mobility_framework", "ieee80211b", "ieee80211g", "disk, range: 250 m", "ideal, range: 250 m"):
            with self.subTest(profile=profile):
                verdicts = self.play(crowd + talk, radio=f"profile: {profile}")
                self.assertGreater(verdicts["delivered"], 500)
                if "range" in profile:
                    self.assertEqual(set(verdicts) - {"under way"}, {"delivered", "below sensitivity"})
                    self.no_loss_within(250)

    def no_loss_within(self, reach):
        """By the geometry: a link is one if and only if it is that short, and then nothing is out of reach."""
        place = {agent: (x, y) for agent, x, y in self.query("SELECT agent, x_m, y_m FROM agents")}
        links = set(self.query("SELECT agent, peer FROM link_verdicts"))
        out_of_reach = set(self.query("SELECT agent, peer FROM link_verdicts WHERE verdict = 'below sensitivity'"))
        senders = {agent for agent, in self.query("SELECT DISTINCT agent FROM frames_sent")}
        for agent, here in place.items():
            for peer, there in place.items():
                if agent == peer or peer not in senders:
                    continue
                self.assertEqual((agent, peer) in links, math.dist(here, there) <= reach)
        self.assertEqual(out_of_reach, set())

    def test_with_propagation_delay_and_an_end_in_the_middle_of_frames(self):
        far = group("f", "line: {count: 4, spacing: 150 m}", size=1400) + group(
            "u", "poses: [{x: 0 m, y: 30 m}]", to="f3", pattern="saturated", size=1400)
        seen = 0
        for end in "401 ms", "402500 us", "403123 us", "407777 us", "411 ms":
            for delay in "true", "false":
                seen += self.play(far, radio=f"profile: ieee80211b, propagation_delay: {delay}", end=end)["under way"]
        self.assertGreater(seen, 0)

    def test_two_stations_out_of_reach(self):
        verdicts = self.play(group("a", "poses: [{x: 0 m, y: 0 m}, {x: 9 km, y: 0 m}]"))
        (sent,), = self.query("SELECT sum(count) FROM frames_sent")
        self.assertGreater(sent, 70)
        self.assertEqual(verdicts["below sensitivity"] + verdicts["under way"], sent)
        self.assertEqual(self.query("SELECT * FROM link_verdicts"), [])

    def test_nobody_sends_and_nobody_is_there(self):
        silent = "  s: {name: s, station: {}, poses: [{x: 0 m, y: 0 m}], controller: {program: traffic_sink}}\n"
        self.assertEqual(self.play(silent), {})
        self.assertEqual(self.query("SELECT * FROM link_verdicts"), [])
        alone = self.play(group("a", "poses: [{x: 0 m, y: 0 m}]"))
        self.assertEqual(alone, {}, "of one agent there is no other radio")

    def test_130_agents_that_are_counted_are_those_that_are_listed(self):
        crowd = group("c", "uniform: {count: 130, from: [0 m, 0 m], to: [3 km, 3 km]}")
        verdicts = self.play(crowd)
        listed = self.query("SELECT * FROM verdict_sums"), self.query("SELECT * FROM link_verdicts")
        self.run_baraka(self.folder / "verdicts.yaml")
        self.assertEqual((self.query("SELECT * FROM verdict_sums"), self.query("SELECT * FROM link_verdicts")), listed)
        self.assertEqual(self.query("SELECT count(*) FROM frame_ends"), [(0,)])
        self.assertGreater(verdicts["collision"] + verdicts["receiver transmitting"], 0)
        exported = Program("baraka", "export", self.out, "link_verdicts").finish().out.splitlines()
        self.assertEqual(exported[0], "agent,peer,class,addressed,verdict,count")
        self.assertEqual(len(exported) - 1, len(listed[1]))


if __name__ == "__main__":
    unittest.main()
