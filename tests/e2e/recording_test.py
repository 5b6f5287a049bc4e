#!/usr/bin/env python3
"""What goes into the results: messages listed or counted, frames counted or not."""
import unittest

from baraka import Case, Program

SCENARIO = """version: 1
name: crowd
control_period: 100 ms
radio: {{profile: ieee80211b}}
routing: none
agents:
  stations:
    name: s{{}}
    station: {{}}
    uniform: {{count: {count}, from: [-300 m, -300 m], to: [300 m, 300 m]}}
    controller:
      program: traffic_source
      parameters: {{pattern: periodic, rate: 10 Hz, to: neighbours, topic: t, size: 57}}
  listener:
    name: listener
    station: {{}}
    poses: [{{x: 0 m, y: 0 m}}]
    controller: {{program: traffic_sink, parameters: {{topic: u}}}}
  talker:
    name: talker
    station: {{}}
    poses: [{{x: 5 m, y: 0 m}}]
    controller:
      program: traffic_source
      parameters: {{pattern: poisson, rate: 200 Hz, to: listener, topic: u, size: 500}}
end:
  - {{at: 1 s, result: done}}
"""
VIEWS = {
    "message_ends": "SELECT * FROM message_ends ORDER BY 1, 2, 3, 4",
    "message_fates": "SELECT * FROM message_fates ORDER BY 1, 2, 3, 4",
    "message_deliveries": "SELECT * FROM message_deliveries ORDER BY 1, 2, 3, 4, 5",
    "broadcast_sums": "SELECT * FROM broadcast_sums ORDER BY 1, 2",
}


class Recording(Case):
    def crowd(self, agents, *arguments):
        """A run of so many agents; its results are those of self.out."""
        file = self.folder / "crowd.yaml"
        file.write_text(SCENARIO.format(count=agents - 2), encoding="utf-8")
        return self.run_baraka(file, *arguments)["fingerprint"]

    def rows(self, table):
        return self.query(f"SELECT count(*) FROM {table}")[0][0]

    def views(self):
        return {view: self.query(sql) for view, sql in VIEWS.items()}

    def exported(self, table):
        finished = Program("baraka", "export", self.out, table).finish()
        self.assertEqual(finished.status, 0, str(finished))
        return finished.out

    def test_above_100_agents_messages_are_counted_unless_asked_for_and_the_counts_are_those_of_the_list(self):
        counted = self.crowd(101)
        self.assertEqual((self.rows("messages"), self.rows("deliveries"), self.rows("broadcasts")), (0, 0, 0))
        views = self.views()
        report = Program("baraka", "report", self.out).finish().out
        exports = [self.exported(view) for view in VIEWS]
        listed = self.crowd(101, "--set", "record.messages=all", "--controllers", "in-process")
        self.assertEqual(listed, counted)
        self.assertGreater(self.rows("messages"), 500)
        self.assertGreater(self.rows("deliveries"), self.rows("messages"))
        for view, rows in self.views().items():
            self.assertEqual(views[view], rows, view)
            self.assertTrue(rows, view)
        self.assertEqual(sum(count for *_, count, _ in views["message_ends"]), self.rows("messages"))
        self.assertEqual(exports, [self.exported(view) for view in VIEWS])
        # What a report says of numbers it says of both; only the list has quantiles.
        of_list = Program("baraka", "report", self.out).finish().out
        for figure in "messages to one agent", "delivered %", "broadcasts to neighbours", "agents reached per broadcast":
            lines = [[line.split() for line in text.splitlines() if line.startswith(figure)]
                     for text in (report, of_list)]
            self.assertEqual(lines[0], lines[1])
            self.assertTrue(lines[0])

    def test_up_to_100_agents_they_are_listed_but_for_those_to_many_beyond_the_first_of_each_second(self):
        two_seconds = ("--controllers", "in-process", "--set", "end.0.at=2 s")
        listed = self.crowd(100, *two_seconds, "--set", "record.messages=all")
        self.assertGreater(self.rows("messages"), 500)
        self.assertEqual(self.rows("counted_ends"), 0)
        views = self.views()
        to_many = ("SELECT sent_ns / 1000000000, sent_ns, sender, id, verdict, fate, (SELECT count(*) FROM deliveries d WHERE "
                   "d.sender = m.sender AND d.id = m.id) FROM messages m WHERE destination >= 65534 ORDER BY 2, 3")
        broadcasts = self.query(to_many)
        to_one = "SELECT sender, id, verdict, fate, delay_ns FROM messages LEFT JOIN deliveries USING (sender, id) WHERE destination < 65534"
        singles = self.query(to_one + " ORDER BY 1, 2")
        self.assertEqual(self.crowd(100, *two_seconds), listed)
        self.assertIn("messages: sample", (self.out / "scenario.resolved.yaml").read_text())
        self.assertEqual(self.query(to_one + " ORDER BY 1, 2"), singles)
        self.assertEqual(self.views(), views)
        sample = self.query(to_many)
        for second in 0, 1:
            first = [row for row in sample if row[0] == second]
            everything = [row for row in broadcasts if row[0] == second]
            self.assertEqual([row for row in everything if row[1] <= first[-1][1]], first)
            self.assertGreaterEqual(sum(1 + row[-1] for row in first), 1000)
            self.assertLess(len(first), len(everything))
        counted = self.crowd(100, *two_seconds, "--set", "record.messages=counts")
        self.assertEqual(self.rows("messages"), 0)
        self.assertEqual(self.views(), views)
        self.assertEqual(listed, counted)
        self.assertIn("messages: counts", (self.out / "scenario.resolved.yaml").read_text())

    def test_without_a_record_the_run_is_the_same(self):
        with_it = self.crowd(20, "--controllers", "in-process")
        without = self.crowd(20, "--controllers", "in-process", "--set", "record.messages=none",
                             "--set", "record.frames=none")
        self.assertEqual(with_it, without)
        for table in "messages", "message_ends", "message_deliveries", "receptions", "frames_sent", "packets":
            self.assertEqual(self.rows(table), 0, table)
        self.assertGreater(self.rows("fingerprints"), 0)

    def test_a_topic_that_nobody_hears_is_named_also_if_it_is_counted(self):
        far = ("--set", "agents.talker.poses=[{x: 9 km, y: 0 m}]", "--set", "agents.stations.controller.parameters.stop=0 s")
        for messages in "all", "sample", "counts":
            file = self.folder / "crowd.yaml"
            file.write_text(SCENARIO.format(count=1), encoding="utf-8")
            finished = self.run_baraka(file, "--controllers", "in-process", "--set", f"record.messages={messages}", *far)
            line, = [line for line in finished.err.splitlines() if "arrived at anyone" in line and "topic 'u'" in line]
            self.assertRegex(line, r"topic 'u': none of \d+ messages of talker arrived at anyone; retry limit \(\d+\)")


if __name__ == "__main__":
    unittest.main()
