#!/usr/bin/env python3
"""Routing protocols by their names in a scenario: what they deliver, and what is counted of what they do."""
import unittest

from baraka import ROOT, Case, Program

SCENARIO = ROOT / "tests/e2e/routing_protocols.yaml"


class RoutingProtocols(Case):
    def play(self, routing, *more, dds=False):
        where = () if dds else ("--controllers", "in-process")
        self.finished = self.run_baraka(SCENARIO, "--set", f"routing={routing}", *where, *more)
        self.check_countable()
        return dict(self.query("SELECT event, SUM(count) FROM routing_events GROUP BY event"))

    def ends(self):
        return dict(self.query("SELECT IFNULL(verdict, 'under way'), COUNT(*) FROM messages GROUP BY 1"))

    def test_ants_find_and_count(self):
        events = self.play("{algorithm: ants}")
        self.assertEqual(self.ends(), {"delivered": 40})
        self.assertGreaterEqual(events["backward ant home"], 1)
        self.assertEqual(events["forward ant sent"], 1)

    def test_aodv_finds_and_counts(self):
        events = self.play("{algorithm: aodv}")
        self.assertGreaterEqual(self.ends()["delivered"], 38)
        self.assertGreaterEqual(events["rreq sent"], 2)  # a ring of one hop, a wider one
        self.assertGreaterEqual(events["rrep received"], 1)
        self.assertGreater(events["hello sent"], 20)
        self.assertNotIn("forward ant sent", events)
        hops = {n for n, in self.query("SELECT DISTINCT transmissions FROM deliveries")}
        self.assertIn(4, hops)

    def test_flooding_needs_no_search(self):
        events = self.play("{algorithm: flooding}")
        self.assertGreaterEqual(self.ends()["delivered"], 30)
        self.assertGreater(events["flood relayed"], 100)
        self.assertEqual(self.query("SELECT COUNT(*) FROM discoveries"), [(0,)])
        self.assertEqual(sum(self.ends().values()), 40)
        self.assertNotIn("under way", self.ends())  # those that went nowhere have expired

    def test_a_route_of_another_metric_is_another_choice(self):
        prints = set()
        for metric in ("hops", "{delay: 1}"):
            self.play(f"{{metric: {metric}, beta: 100}}")
            self.assertEqual(self.ends(), {"delivered": 40})
            prints.add(self.finished["fingerprint"])
        self.assertEqual(len(prints), 2)

    def test_aodv_is_the_same_over_dds(self):
        self.play("{algorithm: aodv}", "--until", 5)
        one = self.finished["fingerprint"]
        self.play("{algorithm: aodv}", "--until", 5, dds=True)
        self.assertEqual(self.finished["fingerprint"], one)

    def test_the_report_says_what_routing_did(self):
        self.play("{algorithm: aodv}")
        program = Program("baraka", "report", self.out)
        self.addCleanup(program.clean_up)
        finished = program.finish()
        self.assertIn("routing events, all agents", finished.out)
        self.assertIn("rreq sent", finished.out)


if __name__ == "__main__":
    unittest.main()
