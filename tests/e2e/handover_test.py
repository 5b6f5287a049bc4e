#!/usr/bin/env python3
"""Access points from YAML alone: where a walking station changes over, what it costs, and that the record
says so."""
import math
import unittest

from baraka import ROOT, Case

HANDOVER = ROOT / "config/scenarios/handover.yaml"
BEACON = 0.1024  # s
SPEED = 2.0      # m/s, of the walker, from x = 0 along y = 5 m; the access points are at 0 and 60 m


def crossing(hysteresis):
    """Where the right access point is `hysteresis` dB stronger, with 30 dB per decade: x in m."""
    low, high = 0.0, 60.0
    while high - low > 1e-6:
        x = (low + high) / 2
        lead = 15 * math.log10((x * x + 25) / ((60 - x) ** 2 + 25))
        low, high = (x, high) if lead < hysteresis else (low, x)
    return low


class Handover(Case):
    def play(self, *settings, controllers="in-process", until=None):
        arguments = [part for setting in settings for part in ("--set", setting)]
        arguments += ["--until", until] if until else []
        arguments += ["--controllers", controllers]
        self.finished = self.run_baraka(HANDOVER, *arguments)

    def associations(self):
        """[(s, name of the access point or None)] of the walker."""
        return self.query("SELECT x.at_ns / 1e9, ap.name FROM associations x JOIN agents s ON "
                          "s.agent = x.station LEFT JOIN agents ap ON ap.agent = x.access_point "
                          "WHERE s.name = 'walker' ORDER BY 1")

    def longest_gap(self):
        """Between two messages at the server, s, and when it began."""
        times = [at / 1e9 for at, in self.query(
            "SELECT d.at_ns FROM deliveries d JOIN agents a ON a.agent = d.receiver "
            "WHERE a.name = 'server' ORDER BY 1")]
        return max((after - before, before) for before, after in zip(times, times[1:]))

    def recorded(self, agent):
        return dict(self.query("SELECT r.name, r.value FROM recorded r JOIN agents a USING (agent) "
                               f"WHERE a.name = '{agent}'"))

    def test_it_changes_over_where_the_hysteresis_puts_it_and_back(self):
        for hysteresis in (0, 4, 8):
            with self.subTest(hysteresis=hysteresis):
                self.play(f"radio.bss.hysteresis={hysteresis} dB")
                names = [name for _, name in self.associations()]
                self.assertEqual(names, ["left", "right", "left"])
                _, (over, _), (back, _) = self.associations()
                # The mean with the weight 0.25 is three beacons late, and the next beacon decides.
                for x, at in ((crossing(hysteresis), over), (crossing(hysteresis), back - 30)):
                    late = SPEED * at - x
                    self.assertGreater(late, 0)
                    self.assertLess(late, SPEED * 5 * BEACON)

    def test_a_handover_costs_four_frames_and_no_message(self):
        self.play("record.frames=all")
        self.assertEqual(self.recorded("walker")["failed"], 0)
        self.assertEqual(self.recorded("server")["received"], self.recorded("walker")["sent"])
        gap, _ = self.longest_gap()
        self.assertLess(gap, 0.010)  # of 5 ms between messages
        (over, _), = self.associations()[1:2]
        story = self.query("SELECT f.class, t.name FROM frames f JOIN agents t ON t.agent = f.transmitter "
                           f"WHERE f.at_ns BETWEEN {over * 1e9} - 6e6 AND {over * 1e9} + 1e6 "
                           "AND f.class IN ('management', 'beacon') ORDER BY f.at_ns")
        self.assertEqual(story[-4:], [("management", "walker"), ("management", "right")] * 2)

    def test_a_station_that_stays_too_long_loses_messages_until_beacons_are_missed(self):
        self.play("radio.bss.hysteresis=40 dB")
        self.assertEqual([name for _, name in self.associations()],
                         ["left", None, "right", None, "left"])
        # The last beacon at the edge, 51.3 m; then ten missed ones.
        reach = 10 ** ((10 * math.log10(40) + 82 - 46.6777) / 30)
        edge = math.sqrt(reach ** 2 - 25) / SPEED
        lost = self.associations()[1][0]
        self.assertGreater(lost, edge + 9 * BEACON)
        self.assertLess(lost, edge + 11 * BEACON)
        gap, began = self.longest_gap()
        self.assertGreater(gap, 9 * BEACON)
        self.assertAlmostEqual(began % 30, edge, delta=0.2)
        walker = self.recorded("walker")
        self.assertGreater(walker["failed"], 20)
        self.assertEqual(walker["failed"] + walker["handed_over"], walker["sent"])
        # Every message has one verdict.
        self.assertEqual(dict(self.query("SELECT verdict, count(*) FROM messages GROUP BY 1")),
                         {"delivered": walker["handed_over"], "retry limit": walker["failed"]})

    def test_a_group_may_have_an_access_point_of_its_own(self):
        self.play("agents.walker.radio.bss.access_point=left", until=30)
        self.assertEqual([name for _, name in self.associations()], ["left", None])

    def test_without_access_points_it_is_ad_hoc(self):
        self.play("radio.bss.access_point=[]", until=20)
        self.assertEqual(self.associations(), [])
        classes = {kind for kind, in self.query("SELECT DISTINCT class FROM frames_sent")}
        self.assertEqual(classes, {"unicast", "ack"})

    def test_over_dds_it_is_the_same(self):
        self.play(until=20)
        in_process = self.finished["fingerprint"], self.associations()
        self.play(until=20, controllers="spawn")
        self.assertEqual((self.finished["fingerprint"], self.associations()), in_process)

    def test_messages_of_ants_go_through_an_access_point(self):
        """Routing is one more client: its hellos and ants are group frames that are relayed."""
        self.play("routing={}", until=10)
        received = self.recorded("server")["received"]
        self.assertGreater(received, 0.9 * self.recorded("walker")["sent"])


if __name__ == "__main__":
    unittest.main()
