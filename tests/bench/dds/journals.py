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
    """journals: {reader's number: file}. Only what was written and received on `topics`, all if None. Expected are the
    readers that a writer knew when it wrote."""
    found = Totals(0, 0, 0, 0, collections.defaultdict(list))
    for number, file in journals.items():
        known = 0
        for row in rows(file):
            if topics is not None and row["topic"] not in topics:
                continue
            if row["event"] == "readers":
                known = int(row["number"])
            elif row["event"] == "write":
                found.offered += 1
                found.written += row["ok"] == "1"
                found.expected += known * (row["ok"] == "1")
            elif row["event"] == "receive":
                found.received += 1
                late = int(row["wall_ns"]) - int(row["stamp_ns"])
                found.latencies[int(row["writer"]), number].append(late * 1e-9)
    return found


def matched_after(journals, wanted):
    """s of CLOCK_REALTIME from the first program's start until every one knew `wanted` readers and writers of others;
    None if one never did."""
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
