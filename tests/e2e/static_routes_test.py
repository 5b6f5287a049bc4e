#!/usr/bin/env python3
"""Static routes of messages in a scenario: what they deliver, and how messages end without one."""
import unittest

from baraka import ROOT, Case

SCENARIO = ROOT / "tests/e2e/static_routes.yaml"


class StaticRoutes(Case):
    def play(self, count, routes, *more):
        self.finished = self.run_baraka(
            SCENARIO, "--set", f"agents.stations.line.count={count}", "--set", f"routing.routes={routes}",
            "--controllers", "in-process", "--set", f"agents.stations.controller.overrides="
            f"[{{agents: s0, parameters: {{to: s{count - 1}, start: 1 s, stop: 11 s}}}}]", *more)
        self.check_countable()

    def ends(self):
        return dict(self.query("SELECT IFNULL(verdict, 'under way'), COUNT(*) FROM messages GROUP BY 1"))

    def hops(self):
        return {n for n, in self.query("SELECT DISTINCT transmissions FROM deliveries")}

    def test_two_five_and_twelve_in_a_chain(self):
        for count in 2, 5, 12:
            with self.subTest(count=count):
                self.play(count, '[{path: ["s*"]}]')
                self.assertEqual(self.ends(), {"delivered": 20})
                self.assertEqual(self.hops(), {count - 1})
                self.assertEqual(self.query("SELECT DISTINCT packet FROM frames WHERE packet NOT NULL"), [("data",)])

    def test_rows_for_each_hop_are_the_same_as_a_path(self):
        self.play(3, "[{path: [s0, s1, s2]}]")
        one = self.finished["fingerprint"]
        self.play(3, "[{at: s0, to: s2, via: s1}, {at: s1, to: s2}, {at: s2, to: s0, via: s1}, {at: s1, to: s0},"
                     "{at: s0, to: s1}, {at: s2, to: s1}]")
        self.assertEqual(self.finished["fingerprint"], one)

    def test_without_a_route_messages_end_where_it_is_missing(self):
        self.play(3, "[{at: s1, to: s0}]")
        self.assertEqual(self.ends(), {"no route": 20})
        self.play(3, "[{at: s0, to: s2, via: s1}]")
        self.assertEqual(self.ends(), {"no route": 20})
        self.assertGreater(self.query("SELECT COUNT(*) FROM frames WHERE packet = 'data'")[0][0], 0)

    def test_a_next_hop_out_of_range_or_down_does_not_answer(self):
        self.play(3, "[{at: s0, to: s2}]")  # 80 m instead of 40 m
        self.assertEqual(self.ends(), {"retry limit": 20})
        self.play(3, '[{path: ["s*"]}]', "--set", "events=[{at: 6 s, do: [{switch_off: s1}]}]")
        ends = self.ends()
        self.assertEqual(ends["delivered"], 10)
        self.assertEqual(ends["retry limit"], 10)

    def test_udp_like_links_have_routes_too(self):
        self.play(5, '[{path: ["s*"]}]', "--set", "link=udp_like")
        self.assertEqual(self.ends(), {"delivered": 20})
        self.assertEqual(self.hops(), {4})


if __name__ == "__main__":
    unittest.main()
