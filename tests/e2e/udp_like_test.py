#!/usr/bin/env python3
"""The case study over a link that tells routing nothing, as a UDP socket does not: `link: udp_like`.
Run with --all it plays ten seeds, beside those with transmit status, and prints both."""
import statistics
import sys
import unittest

from baraka import BIN, CASE_STUDY, Case, Program

QUICK, ALL = range(1, 4), range(1, 11)
seeds = QUICK


class Figures:
    """Of several runs: messages to one agent, and searches for a route."""

    def __init__(self):
        self.messages = self.delivered = self.without_fate = 0
        self.took_ms, self.given_up = [], 0

    def add(self, case):
        end = 1e9 * float(case.finished["simulated_s"])
        for verdict, fate, sent in case.query(
                "SELECT verdict, fate, sent_ns FROM messages WHERE destination != 65535"):
            self.messages += 1
            self.delivered += verdict == "delivered"
            # 750 ms pass before a hop is given up, 15 s before a search is.
            self.without_fate += fate is None and sent < end - 20e9
        # The records see through the numbers on its frames.
        (unknown,), = case.query("SELECT count(*) FROM deliveries WHERE transmissions IS NULL")
        case.assertEqual(unknown, 0)
        for took, found in case.query("SELECT took_ns, found FROM discoveries"):
            self.given_up += not found
            self.took_ms.append(took / 1e6)

    def ratio(self):
        return self.delivered / self.messages

    def __str__(self):
        quartiles = " / ".join(f"{q:.2f}" for q in statistics.quantiles(self.took_ms))
        return (f"{self.delivered} of {self.messages} messages delivered, "
                f"{len(self.took_ms)} discoveries, quartiles {quartiles} ms")


class UdpLike(Case):
    def play(self, link):
        figures = Figures()
        for seed in seeds:
            self.finished = self.run_baraka(CASE_STUDY, "--seed", seed, "--set", f"link={link}",
                                            "--controllers", "in-process")
            self.assertEqual(self.finished["result"], "arrived", f"{link}, seed {seed}")
            figures.add(self)
        print(f"link: {link}: {figures}", file=sys.stderr)
        return figures

    def test_the_robot_arrives_and_nearly_every_message_does(self):
        udp_like, mac = self.play("udp_like"), self.play("mac")
        self.assertGreater(udp_like.messages, 30 * len(seeds))
        # A hop must lose four frames in a row, and every other route as well: not one in 1000.
        self.assertGreaterEqual(udp_like.ratio(), mac.ratio() - 0.01)
        self.assertEqual(udp_like.without_fate, 0)
        self.assertEqual(udp_like.given_up, 0)
        # One lost acknowledgement costs a discovery 50 ms: it must be the exception.
        ours, theirs = statistics.median(udp_like.took_ms), statistics.median(mac.took_ms)
        self.assertLess(ours, theirs + 50)

    def test_over_dds_and_in_process_the_run_is_the_same_and_says_which_link_it_had(self):
        arguments = ("--set", "link=udp_like", "--until", 60)
        over_dds = self.run_baraka(CASE_STUDY, *arguments)
        self.assertIn("\nlink: udp_like\n", (self.out / "scenario.resolved.yaml").read_text())
        in_process = self.run_baraka(CASE_STUDY, *arguments, "--controllers", "in-process")
        self.assertEqual(over_dds["fingerprint"], in_process["fingerprint"])
        with_status = self.run_baraka(CASE_STUDY, "--until", 60, "--controllers", "in-process")
        self.assertNotEqual(with_status["fingerprint"], in_process["fingerprint"])

    def test_check_knows_the_key_and_refuses_what_it_is_not(self):
        right = Program("baraka", "check", CASE_STUDY, "--set", "link=udp_like",
                        "--set", "routing.ack_timeout=20 ms").finish()
        self.assertEqual(right.status, 0, str(right))
        wrong = Program("baraka", "check", CASE_STUDY, "--set", "link=udp").finish()
        self.assertEqual(wrong.status, 2, str(wrong))
        self.assertIn("--set link: 'udp' is not one of mac, udp_like", wrong.err)


if __name__ == "__main__":
    if "--all" in sys.argv:
        sys.argv.remove("--all")
        seeds = ALL
    if not (BIN / "baraka").exists():
        sys.exit(77)  # a build of the tests alone
    unittest.main()
