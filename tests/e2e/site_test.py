#!/usr/bin/env python3
"""The site that `./setup docs` builds: every link leads somewhere, nothing is fetched from the network, what readers look for is near
its start page, and the search finds it in Chromium. Skipped (status 77) where the site was not built; the search where there is no
Chromium."""
import collections
import functools
import html.parser
import http.server
import os
import pathlib
import re
import sys
import threading
import unittest
import urllib.parse

from browser import CHROMIUM, Browser

SITE = pathlib.Path(os.environ["BARAKA_BIN"]).parent / "site"
# Attributes by which a page fetches something itself; a link is followed by the reader only.
FETCHED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("object", "data"), ("source", "src"), ("use", "href")}


class Page(html.parser.HTMLParser):
    """Links with their texts, anchors, and the text below each heading with an anchor."""

    def __init__(self, path):
        super().__init__()
        self.links, self.fetched, self.anchors = {}, [], set()
        self.sections = collections.defaultdict(str)
        self.section, self.link = "", None
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = {name: value or "" for name, value in attributes}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if re.fullmatch("h[1-6]", tag) and "id" in given:
            self.section = given["id"]
        if tag == "a" and "href" in given:
            # Of several links to one place the first that has a text.
            self.link = None if self.links.get(given["href"], "").strip() else given["href"]
            self.links.setdefault(given["href"], "")
        if tag == "link" and given.get("rel") not in ("canonical", "prev", "next"):
            self.fetched.append(given.get("href", ""))
        self.fetched += [given[name] for name in given if (tag, name) in FETCHED]

    def handle_endtag(self, tag):
        if tag == "a":
            self.link = None

    def handle_data(self, text):
        self.sections[self.section] += text
        if self.link is not None:
            self.links[self.link] += text


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
            for link in [*parsed.links, *parsed.fetched]:
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
        """Every (file, anchor) in so many clicks, with the texts of the links on the way there."""
        ways = {(start, ""): []}
        for _ in range(most):
            for (page, anchor), way in list(ways.items()):
                for link, text in self.pages[page].links.items() if page in self.pages else ():
                    found = self.target(page, link)
                    if found and found not in ways and text.strip():
                        ways[found] = [*way, " ".join(text.split())]
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
                print(f"{what}: start page -> {' -> '.join(ways[place])}")

    def test_reference_of_the_headers_is_part_of_it(self):
        ways = self.clicks(SITE / "index.html", 2)
        for header in ("controller", "robot", "real__world__object", "parameters"):
            self.assertIn((SITE / f"api/{header}_8h.html", ""), ways)

    def test_search_knows_the_pages(self):
        index = (SITE / "search/search_index.json").read_text(encoding="utf-8")
        for page in ("extending.html", "keys.html", "scenarios/two_turtlebots.html"):
            self.assertIn(page, index)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@unittest.skipUnless(CHROMIUM, "there is no chromium")
class Search(unittest.TestCase):
    """As a reader types into the search box of the start page."""

    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=SITE))
        cls.serving = threading.Thread(target=cls.server.serve_forever)
        cls.serving.start()
        cls.browser = Browser(1280, 720)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.shutdown()
        cls.serving.join()
        cls.server.server_close()

    def test_a_hit_leads_to_the_page_that_explains_the_word(self):
        browser, start = self.browser, f"http://127.0.0.1:{self.server.server_port}"
        for typed, page, anchor, words in (("cca_time", "glossary.html", "", "the time of carrier sense and turnaround"),
                                           ("cca_time", "keys.html", "#top-level-of-a-radio-file", "cca_time"),
                                           ("sbatch", "campaigns.html", "#on-a-cluster", "sbatch")):
            with self.subTest(f"{typed}: {page}"):
                browser.visit(f"{start}/index.html")
                browser.run("document.querySelector('.md-search__input').focus()")
                # What is typed while the index is being loaded may be lost.
                browser.wait("document.querySelector('.md-search-result__meta').textContent.includes('Type to start')")
                browser.type(typed)
                hit = f"{start}/{page}?h={typed}{anchor}"
                found = f"[...document.querySelectorAll('.md-search-result__link')].find(link => link.href === '{hit}')"
                browser.wait(found)
                browser.run(f"{found}.click()")
                browser.wait(f"location.href === '{hit}' && document.readyState === 'complete'")
                self.assertIn(words, browser.run("document.querySelector('article').innerText"))
                browser.wait(f"[...document.querySelectorAll('article mark')].some(mark => mark.innerText.includes('{typed}'))")
        self.assertEqual(browser.said, [])


if __name__ == "__main__":
    if not (SITE / "index.html").exists():
        print("skipped: ./setup docs builds the site")
        sys.exit(77)
    unittest.main()
