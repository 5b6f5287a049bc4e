#!/usr/bin/env python3
"""Runs every N-th test of a file, from the INDEX-th (from 0), so that N processes run all of them side by side.

Usage: part.py INDEX N FILE [argument of unittest...]
"""
import functools
import runpy
import sys
import unittest


def flat(suite):
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from flat(test)
        else:
            yield test


class Dealer(unittest.TestLoader):
    """Deals a file's tests out in their order."""

    def __init__(self, index, count):
        super().__init__()
        self.index, self.count = index, count

    def loadTestsFromModule(self, *arguments, **options):
        tests = list(flat(super().loadTestsFromModule(*arguments, **options)))
        return unittest.TestSuite(tests[self.index::self.count])


def main():
    index, count, file = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    if not 0 <= index < count:
        sys.exit(f"part.py: there is no part {index} of {count}")
    sys.argv = sys.argv[3:]
    sys.path.insert(0, file.rpartition("/")[0] or ".")
    unittest.main = functools.partial(unittest.main, testLoader=Dealer(index, count))
    runpy.run_path(file, run_name="__main__")


if __name__ == "__main__":
    main()
