#!/usr/bin/env python3
"""Compares the radio with ns-3 and with closed forms, by runs, and writes docs/validation.md with its figures.

    .ci/validate                                                        everything; some half an hour
    tests/validation/validate.py [--short] [--only NAME] [--build DIR]  NAME of a section

--short takes some rows of each table, draws nothing, and fails if one leaves its tolerance or does not stand in
docs/validation.md as it was measured: equal files and seeds give equal runs. Full or not, the exit status is 1 if a
row leaves its tolerance."""
import argparse
import pathlib
import re
import sys

import aggregation
import aodv
import beacons
import errors
import he
import hidden
import ht_rates
import line
import more
import overlap
import peer
import propagation
import ranges
import rates
import runs
import saturation
import scenarios
from document import table

PAGE = runs.ROOT / "docs/validation.md"
FIGURES = runs.ROOT / "docs/validation"
SECTIONS = (saturation, aggregation, he, hidden, overlap, more, rates, ht_rates, ranges, errors, propagation, line,
            beacons, aodv)
HEAD = """# Validation

<!-- Written by `.ci/validate`; the texts are in tests/validation. -->

After this page you know how far the radio agrees with ns-3.37 (Debian's libns3-dev 3.37-2) and with closed forms. Figures
marked *ours* come from `baraka run` with controllers in process, of seeds 1 to 5 unless said otherwise; ns-3's come from the
tables named under each heading, whose first lines state the parameters. Programs for ns-3 are in `tests/peer/ns3`. The test
`validation.short` repeats a part of it.
"""


def measured(section, player, short):
    """Rows of a section, and what is wrong with them."""
    rows = [section.measure(player, case) for case in section.cases(short)]
    return rows, [row.mistake for row in rows if row.mistake]


def text_of(section, rows):
    files = getattr(section, "FILES", [section.FILE] if hasattr(section, "FILE") else [])
    source = "".join(f"\n\nns-3: `tests/analytic/radio/{file}`: {peer.origin(file)}" for file in files)
    return (f"## {section.TITLE}\n\n{section.TEXT}{source}\n\n![{section.TITLE}](validation/{section.NAME}.svg)\n\n"
            f"{table(section.COLUMNS, rows)}\n")


def write(texts):
    """Replaces the sections that were measured and keeps the others."""
    page = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    old = {title: text for text, title in re.findall(r"^(## ([^\n]+)\n.*?)(?=^## |\Z)", page, re.M | re.S)}
    parts = [texts.get(section.TITLE) or old.get(section.TITLE, "") for section in SECTIONS]
    PAGE.write_text("\n".join([HEAD, *[part.rstrip() + "\n" for part in parts if part]]), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--only", action="append")
    parser.add_argument("--build", type=pathlib.Path, default=runs.ROOT / "build/release")
    options = parser.parse_args()
    player = runs.Runs(options.build)
    mistakes, texts = [], {}
    page = PAGE.read_text(encoding="utf-8") if options.short else ""
    for section in SECTIONS:
        if options.only and section.NAME not in options.only:
            continue
        rows, wrong = measured(section, player, options.short)
        mistakes += wrong
        if options.short:
            mistakes += [f"not in docs/validation.md: {row.markdown()}" for row in rows if row.markdown() not in page]
        else:
            player.draw(section.draw(rows), FIGURES / f"{section.NAME}.svg")
            texts[section.TITLE] = text_of(section, rows)
        print(f"{section.NAME}: {len(rows)} rows, {len(wrong)} out of tolerance", flush=True)
    if not options.short:
        write(texts)
        for name, figure in scenarios.figures(player, options.only):
            player.draw(figure, runs.ROOT / f"docs/scenarios/{name}.svg")
            print(f"docs/scenarios/{name}.svg", flush=True)
    for mistake in mistakes:
        print(mistake)
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
