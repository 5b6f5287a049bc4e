"""Tables of ns-3's figures; lines that begin with # are comments, the first says where they come from."""
import csv

from runs import ROOT

FOLDER = ROOT / "tests/analytic/radio"


def rows(name):
    with open(FOLDER / name, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def origin(name):
    with open(FOLDER / name, encoding="utf-8") as file:
        return " ".join(line[1:].strip() for line in file if line.startswith("#"))
