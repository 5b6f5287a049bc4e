"""What the loads of tests/e2e/dds_load wrote down, taken together."""
import collections
import csv
import dataclasses


@dataclasses.dataclass
class Totals:
    """Of all writers and readers of some topics."""
    offered: int    # calls of write
    written: int    # that succeeded
    expected: int   # written, times the readers of the topic other than the writer
    received: int
    latencies: dict  # {(writer, reader): [s]}, from the call of write to the program that reads

    @property
    def delivered(self):
        return self.received / self.expected if self.expected else None

    def pooled(self):
        return sorted(one for values in self.latencies.values() for one in values)


def rows(file):
    """Of one journal; a program that was killed left half a line."""
    with open(file, newline="") as lines:
        return [row for row in csv.DictReader(lines) if row["stamp_ns"] is not None]


def totals(journals, topics=None):
    """journals: {reader's number: file}. Only what was written and received on `topics`, all if None."""
    content = {reader: [row for row in rows(file) if topics is None or row["topic"] in topics]
               for reader, file in journals.items()}
    readers = collections.defaultdict(set)
    for reader, events in content.items():
        for row in events:
            if row["event"] == "created" and row["topic"]:
                readers[row["topic"]].add(reader)
    offered = written = expected = 0
    for writer, events in content.items():
        for row in events:
            if row["event"] == "write":
                offered += 1
                written += row["ok"] == "1"
                expected += (row["ok"] == "1") * len(readers[row["topic"]] - {writer})
    latencies = collections.defaultdict(list)
    for reader, events in content.items():
        for row in events:
            if row["event"] == "receive":
                latencies[int(row["writer"]), reader].append((int(row["wall_ns"]) - int(row["stamp_ns"])) * 1e-9)
    return Totals(offered, written, expected, sum(map(len, latencies.values())), dict(latencies))


def matched_after(journals, wanted):
    """s of CLOCK_REALTIME from the first program's start until every one knew `wanted` readers and writers of others; None if one
    never did."""
    first, last = None, None
    for file in journals.values():
        known, reached = {}, None
        for row in rows(file):
            if row["event"] == "created":
                first = min(first or int(row["wall_ns"]), int(row["wall_ns"]))
            if row["event"] in ("readers", "writers") and reached is None:
                known[row["event"]] = int(row["number"])
                if len(known) == 2 and min(known.values()) >= wanted:
                    reached = int(row["wall_ns"])
        if reached is None:
            return None
        last = max(last or reached, reached)
    return (last - first) * 1e-9
