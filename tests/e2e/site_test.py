#!/usr/bin/env python3
"""The site that `./setup docs` builds: every link leads somewhere, nothing is fetched from the network, and what readers look for
is near its front page. Skipped (status 77) where the site was not built."""
import collections
import html.parser
import os
import pathlib
import re
import sys
import unittest
import urllib.parse

SITE = pathlib.Path(os.environ["BARAKA_BIN"]).parent / "site"
# Attributes by which a page fetches something itself; a link is followed by the reader only.
FETCHED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("object", "data"), ("source", "src"), ("use", "href")}


class Page(html.parser.HTMLParser):
    """Links, anchors and the text below each heading with an anchor."""

    def __init__(self, path):
        super().__init__()
        self.links, self.fetched, self.anchors = [], [], set()
        self.sections = collections.defaultdict(str)
        self.section = ""
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = {name: value or "" for name, value in attributes}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if re.fullmatch("h[1-6]", tag) and "id" in given:
            self.section = given["id"]
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if tag == "link" and given.get("rel") not in ("canonical", "prev", "next"):
            self.fetched.append(given.get("href", ""))
        self.fetched += [given[name] for name in given if (tag, name) in FETCHED]

    def handle_data(self, text):
        self.sections[self.section] += text


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = {path: Page(path) for path in SITE.rglob("*.html")}

    def target(self, page, link):
        """(file, anchor) of a link inside the site; none of one that leads out of it."""
        parts = urllib.parse.urlsplit(link)
        if parts.scheme in ("javascript", "data"):
            return page, ""
        if parts.scheme or parts.netloc:
            return None
        path = pathlib.Path(os.path.normpath(page.parent / urllib.parse.unquote(parts.path))) if parts.path else page
        return path, urllib.parse.unquote(parts.fragment)

    def test_every_link_leads_to_a_file_and_an_anchor(self):
        seen = 0
        for page, parsed in self.pages.items():
            for link in parsed.links + parsed.fetched:
                if not self.target(page, link):
                    continue
                path, anchor = self.target(page, link)
                seen += 1
                where = f"{page.relative_to(SITE)}: {link}"
                self.assertTrue(path.is_relative_to(SITE) and path.is_file(), where)
                if anchor and path in self.pages:
                    self.assertIn(anchor, self.pages[path].anchors | {"__top"}, where)
        self.assertGreater(seen, 1000)

    def test_every_page_of_docs_is_there(self):
        docs = pathlib.Path(__file__).resolve().parents[2] / "docs"
        for page in docs.rglob("*.md"):
            self.assertIn((SITE / page.relative_to(docs)).with_suffix(".html"), self.pages)

    def test_nothing_is_fetched_from_the_network(self):
        for page, parsed in self.pages.items():
            for link in parsed.fetched:
                self.assertIsNotNone(self.target(page, link), f"{page.relative_to(SITE)} fetches {link}")
            # The theme's script would fetch the library that draws them.
            self.assertNotIn("mermaid", page.read_text(encoding="utf-8"))
        for sheet in SITE.rglob("*.css"):
            far = re.search(r"""(url\(|@import)\s*["']?(https?:)?//""", sheet.read_text(encoding="utf-8"))
            self.assertIsNone(far, sheet)

    def clicks(self, start, most):
        """Every (file, anchor) in so many clicks, with the way there."""
        ways = {(start, ""): []}
        for _ in range(most):
            for (page, anchor), way in list(ways.items()):
                for link in self.pages[page].links if page in self.pages else ():
                    found = self.target(page, link)
                    if found and found not in ways:
                        ways[found] = [*way, link]
        return ways

    def test_what_readers_look_for_is_two_clicks_away(self):
        ways = self.clicks(SITE / "index.html", 2)
        for what, page, anchor, words in (
                ("add a sensor", "extending.html", "a-sensor", "sensor"),
                ("what cca_time means", "glossary.html", "", "cca_time"),
                ("a campaign on Slurm", "campaigns.html", "on-a-cluster", "Slurm"),
                ("how far the radio can be trusted", "validation.html", "", "ns-3")):
            with self.subTest(what):
                place = (SITE / page, anchor)
                self.assertIn(place, ways)
                sections = self.pages[place[0]].sections
                self.assertIn(words, sections[anchor] if anchor else "".join(sections.values()))
                print(f"{what}: index.html -> {' -> '.join(ways[place])}")

    def test_reference_of_the_headers_is_part_of_it(self):
        ways = self.clicks(SITE / "index.html", 2)
        for header in ("controller", "robot", "real__world__object", "parameters"):
            self.assertIn((SITE / f"api/{header}_8h.html", ""), ways)

    def test_search_knows_the_pages(self):
        index = (SITE / "search/search_index.json").read_text(encoding="utf-8")
        for page in ("extending.html", "keys.html", "scenarios/two_turtlebots.html"):
            self.assertIn(page, index)


if __name__ == "__main__":
    if not (SITE / "index.html").exists():
        print("skipped: ./setup docs builds the site")
        sys.exit(77)
    unittest.main()
