#!/usr/bin/env python3
"""Priorities of messages: from the controller or the file to the access category of every frame, and what that
does to their delay."""
import unittest

from baraka import ROOT, Case, Program

SCENARIO = ROOT / "tests/e2e/priorities.yaml"
VOICE = ("--set", "agents.alarm.controller.parameters.priority=6")


class Priorities(Case):
    def play(self, *arguments, dds=False):
        where = () if dds else ("--controllers", "in-process")
        self.finished = self.run_baraka(SCENARIO, *arguments, *where)
        return self.finished["fingerprint"]

    def delay(self, topic):
        """95 % of the messages take at most this long, s."""
        delays = [ns for ns, in self.query(
            f"SELECT delay_ns FROM deliveries JOIN messages USING (sender, id) WHERE topic = '{topic}' ORDER BY 1")]
        self.assertGreater(len(delays), 350, topic)
        return delays[int(0.95 * len(delays))] / 1e9

    def of_messages(self, topic):
        return self.query(f"SELECT DISTINCT priority FROM messages WHERE topic = '{topic}'")

    def of_frames(self, agent):
        """The categories of the frames that carry messages of this agent, over both hops."""
        return sorted(self.query(
            "SELECT DISTINCT tid, category FROM frames WHERE packet = 'data' AND sender = "
            f"(SELECT agent FROM agents WHERE name = '{agent}')"))

    def test_a_voice_message_gets_ahead_of_bulk_at_its_sender_and_at_the_relay(self):
        self.play()
        without = self.delay("alarm")
        self.assertEqual(self.of_messages("alarm"), [(0,)])
        self.assertEqual(self.of_frames("alarm"), [(0, "BE")])
        self.play(*VOICE)
        self.assertEqual(self.of_messages("alarm"), [(6,)])
        self.assertEqual(self.of_messages("bulk"), [(0,)])
        self.assertEqual(self.of_frames("alarm"), [(6, "VO")])
        self.assertEqual(self.of_frames("bulk"), [(0, "BE")])
        # It waits for at most a few frames of bulk, 0.3 ms each, where it had waited for a queue of them.
        self.assertLess(self.delay("alarm"), 0.003)
        self.assertGreater(without, 0.02)

    def test_the_same_over_dds(self):
        few = ("--set", "end.0.at=3 s")  # alarms begin at 1 s
        self.assertEqual(self.play(*VOICE, *few), self.play(*VOICE, *few, dds=True))
        self.assertEqual(self.of_frames("alarm"), [(6, "VO")])

    def test_the_file_gives_topics_a_priority_without_a_change_of_the_controller(self):
        self.play(*VOICE)
        expected = self.query("SELECT * FROM deliveries")
        self.play("--set", "priorities.alarm=voice")
        self.assertEqual(self.query("SELECT * FROM deliveries"), expected)
        self.play(*VOICE, "--set", "priorities.alarm=background")
        self.assertEqual(self.of_messages("alarm"), [(1,)])
        self.assertEqual(self.of_frames("alarm"), [(1, "BK")])

    def test_a_topic_of_the_file_that_no_controller_has_is_a_mistake(self):
        text = SCENARIO.read_text().replace("../../config", str(ROOT / "config"))
        misspelt = self.folder / "misspelt.yaml"
        misspelt.write_text("priorities:\n  alarm: voice\n  bukl: 1\n" + text)
        mistake = f"{misspelt}:3:9: priorities.bukl: no agent sends or receives this topic; did you mean 'bulk'?"
        finished = Program("baraka", "check", misspelt).finish()
        self.assertEqual((finished.status, finished.err), (2, mistake + "\n"))
        misspelt.write_text(misspelt.read_text().replace("bukl", "bulk"))
        self.assertEqual(Program("baraka", "check", misspelt).finish().status, 0)

    def test_a_topic_of_the_file_that_no_message_had_is_said_at_the_end(self):
        # The controller of `relay` does not declare its topics.
        self.play("--set", "agents.relay.controller={program: gap_mote, parameters: {sink: sink}}",
                  "--set", "priorities={alarm: voice, bukl: 1}")
        line = "priorities.bukl: no message had this topic; did you mean 'bulk'?"
        self.assertIn(line, self.finished.err)
        self.assertIn(line, (self.out / "run.log").read_text())
        self.assertNotIn("priorities.alarm", self.finished.err)

    def test_without_qos_the_priority_is_carried_and_has_no_effect(self):
        self.play("--set", "radio.qos=false")
        plain = self.query("SELECT sender, id, receiver, transmissions FROM deliveries")
        self.play(*VOICE, "--set", "radio.qos=false")
        self.assertEqual(self.of_frames("alarm"), [(None, None)])
        self.assertEqual(self.query("SELECT sender, id, receiver, transmissions FROM deliveries"), plain)

    def test_observables_count_frames_and_delays_of_each_category(self):
        self.play(*VOICE, "--set", "record.observables=[{name: radio.*.frames_sent.*, as: counter},"
                  "{name: radio.*.block_ac*, as: counter}, {name: messages.sink.delay.*, on: change, as: counter}]",
                  "--set", "radio={include: ../../config/radios/ieee80211n.yaml}")
        kinds = {"best_effort": "BE", "voice": "VO", "background": "BK", "video": "VI"}
        frames = dict(self.query("SELECT a.name || '.' || category, count(*) FROM frames JOIN agents a "
                                 "ON a.agent = transmitter WHERE category NOT NULL GROUP BY 1"))
        sums = {(name, agent): (count, last) for name, agent, count, last in self.query(
            "SELECT o.name, a.name, count, last FROM observable_sums JOIN observables o USING (observable) "
            "JOIN agents a USING (agent)")}
        for agent in "alarm", "bulk", "relay", "sink":
            for name, category in kinds.items():
                self.assertEqual(sums[f"radio.frames_sent.{name}", agent][1], frames.get(f"{agent}.{category}", 0))
        self.assertGreater(frames["relay.VO"], 300)
        self.assertGreater(frames["relay.BE"], 300)
        for name, bitmap in ("block_acks", "LIKE"), ("block_ack_requests", "NOT LIKE"):
            found = dict(self.query(f"SELECT a.name, count(*) FROM frames JOIN agents a ON a.agent = transmitter "
                                    f"WHERE class = 'block_ack' AND block_ack {bitmap} '%:%' GROUP BY 1"))
            self.assertGreater(sum(found.values()), 0, name)
            for agent in "alarm", "bulk", "relay", "sink":
                self.assertEqual(sums[f"radio.{name}", agent][1], found.get(agent, 0), name)
        for name, topic in ("best_effort", "bulk"), ("voice", "alarm"):
            found = self.query(f"SELECT count(*) FROM deliveries JOIN messages USING (sender, id) WHERE topic = '{topic}'")
            self.assertEqual(sums[f"messages.delay.{name}", "sink"][0], found[0][0])
        self.assertEqual(sums.get(("messages.delay.video", "sink"), (0,))[0], 0)

    def test_packets_of_routing_have_a_key_of_their_own(self):
        for algorithm in "ants", "aodv", "anthocnet":
            with self.subTest(algorithm=algorithm):
                self.play(*VOICE, "--set", f"routing={{algorithm: {algorithm}, control_priority: 4}}")
                self.assertEqual(self.query("SELECT DISTINCT tid FROM frames WHERE packet NOT NULL AND packet <> 'data'"
                                            " AND receiver < 65534"), [(4,)])
                self.assertEqual(self.of_frames("alarm"), [(6, "VO")])


if __name__ == "__main__":
    unittest.main()
