#!/usr/bin/env python3
"""The report page as a browser shows it: every plot has as many points as the results have.

Needs the page (./setup report_page) and Chromium; where one is missing it is skipped (status 77).
BARAKA_SCREENSHOTS=DIR keeps the pictures it takes.
"""
import csv
import html.parser
import io
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import unittest
import urllib.parse

from baraka import BIN, CASE_STUDY, Case, Program, ROOT

MANY_ROBOTS = ROOT / "config/scenarios/many_robots.yaml"
# What has no place in a report about a scenario that compares itself with nothing.
PAPERS_WORDS = r"(?i)paper|replica score|case study|labella|fig\. ?\d|calibrated|inferred"
CHROMIUM = shutil.which("chromium")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--hide-scrollbars",
         "--disable-background-networking", "--disable-component-update", "--disable-sync"]
UNTIL = 65  # s: the robot goes round the wall; marks at 0, 30 and 60 s
SKIPPED = 77


class Element:
    def __init__(self, tag, attributes, parent):
        self.tag, self.attributes, self.parent = tag, dict(attributes), parent
        self.text, self.children = "", []

    def all(self, name):
        """Elements inside, by tag or by class."""
        for child in self.children:
            if name == child.tag or name in (child.attributes.get("class") or "").split():
                yield child
            yield from child.all(name)

    def count(self, name):
        return sum(1 for _ in self.all(name))

    def __getitem__(self, attribute):
        return self.attributes[attribute]


class Document(html.parser.HTMLParser):
    EMPTY = {"meta", "link", "br", "input"}

    def __init__(self, text):
        super().__init__()
        self.root = self.open = Element("document", {}, None)
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        element = Element(tag, attributes, self.open)
        self.open.children.append(element)
        if tag not in self.EMPTY:
            self.open = element

    def handle_endtag(self, tag):
        if tag not in self.EMPTY:
            assert self.open.tag == tag, f"<{self.open.tag}> ends as </{tag}>"
            self.open = self.open.parent

    def handle_data(self, data):
        self.open.text += data

    def section(self, name):
        return next(s for s in self.root.all("section") if s["id"] == name)


def chromium(folder, page, *arguments):
    done = subprocess.run([CHROMIUM, *FLAGS, f"--user-data-dir={folder / 'profile'}", *arguments,
                           page.as_uri()], capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        raise AssertionError(f"chromium ended with {done.returncode}\n{done.stderr}")
    return done.stdout


def rows_of(link):
    """Rows of a file that is in a link, the head left out."""
    kind, text = link["href"].split(",", 1)
    assert kind == "data:text/csv;charset=utf-8", kind
    return list(csv.reader(io.StringIO(urllib.parse.unquote(text))))[1:]


class PageCase(Case):
    """A page of results that are made once."""

    def make(self):
        """What setUpClass calls a case for."""

    def report(self, page, *results):
        finished = Program("baraka", "report", "-o", page, *results).finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertEqual(finished["page"], str(page))

    def number(self, sql, *results):
        return sum(self.query(sql, out)[0][0] for out in results)

    def files(self, name):
        return {link["download"]: rows_of(link) for link in self.document.section(name).all("a")}


class Page(PageCase):
    """Two runs over 802.11 and one over an ideal radio."""

    @classmethod
    def setUpClass(cls):
        case = cls("make")
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        cls.results = []
        for seed, profile in (1, "mobility_framework"), (2, "mobility_framework"), (1, "ideal"):
            case.run_baraka(CASE_STUDY, "--controllers", "in-process", "--until", UNTIL, "--seed",
                            seed, "--set", f"radio.profile={profile}")
            cls.results.append(case.out)
        cls.home = case.folder
        cls.page = case.folder / "report.html"
        case.report(cls.page, *cls.results)
        cls.document = Document(chromium(cls.home, cls.page, "--dump-dom"))

    def panels(self, name):
        found = list(self.document.section(name).all("panel"))
        self.assertEqual(len(found), 2)
        return zip(found, (self.results[:2], self.results[2:]))

    def test_the_network_has_every_node_and_link(self):
        for panel, results in self.panels("network"):
            self.assertEqual((panel.count("node"), panel.count("robot")), (25, 1))
            links = self.number("SELECT COUNT(*) FROM links", results[0])
            self.assertGreater(links, 102)
            self.assertEqual(panel.count("link"), links)
        self.assertEqual(len(self.files("network")["nodes.csv"]), 2 * 26)

    def test_the_trajectory_has_every_place_and_a_mark_each_30_seconds(self):
        poses = "SELECT COUNT(*) FROM poses JOIN agents USING (agent) WHERE kind = 'robot'"
        for panel, results in self.panels("trajectory"):
            for plot in ("field", "close-up"):
                plot, = panel.all(plot)
                self.assertEqual(plot.count("mark"), 3)
                self.assertEqual(plot.count("wall"), 1)
                shown, = plot.all("shown")
                # A path is a move and a line for each further place.
                self.assertEqual(1 + shown["d"].count("L"), self.number(poses, results[0]))
                self.assertEqual(plot.count("other"), len(results) - 1)
        self.assertEqual(len(self.files("trajectory")["trajectory.csv"]),
                         self.number(poses, *self.results))
        self.assertEqual([float(row[4]) for row in self.files("trajectory")["marks.csv"]],
                         3 * [0, 30, 60])

    def test_the_close_up_shows_the_robot_at_the_wall(self):
        for panel, results in self.panels("trajectory"):
            plot, = panel.all("close-up")
            # The window is the wall's square, 20 m at 45 degrees, and 4 m around it.
            half = (20 + 0.3) / 2 * 0.5 ** 0.5 + 4
            inside = self.number(
                f"SELECT COUNT(*) FROM poses JOIN agents USING (agent) WHERE kind = 'robot'"
                f" AND abs(poses.x_m - 12.2) <= {half} AND abs(poses.y_m - 12.2) <= {half}", results[0])
            self.assertGreater(inside, 10)
            self.assertEqual(plot.count("body"), inside)

    def test_each_mote_has_a_circle_with_its_packets(self):
        for panel, results in self.panels("packets"):
            self.assertEqual(panel.count("packets"), 25)
            shown = [int(text.text.replace(",", "")) for text in panel.all("total")]
            packets = "SELECT IFNULL(SUM(count), 0) FROM packets WHERE agent = "
            motes = self.query("SELECT agent FROM agents WHERE kind = 'mote' ORDER BY agent",
                               results[0])
            self.assertEqual(shown, [self.number(packets + str(mote), *results) for mote, in motes])

    def test_the_losses_are_those_of_the_results_and_add_up_to_what_was_sent(self):
        for panel, results in self.panels("losses"):
            shown = [int(bar["data-count"]) for bar in panel.all("verdict")]
            self.assertEqual(shown, sorted(shown, reverse=True))
            verdicts = {title.text.rpartition(":")[0] for bar in panel.all("verdict") for title in bar.all("title")}
            self.assertIn("delivered", verdicts)
            self.assertEqual(sum(shown), self.number(
                "SELECT sum(count * CASE WHEN peer >= 65534 THEN (SELECT count(*) - 1 FROM agents) ELSE 1 END) "
                "FROM frames_sent", *results))
        files = self.files("losses")
        self.assertEqual(sum(int(row[4]) for row in files["verdicts.csv"]),
                         self.number("SELECT sum(count) FROM verdict_sums", *self.results))
        self.assertEqual(sum(int(row[4]) for row in files["link_verdicts.csv"]),
                         self.number("SELECT sum(count) FROM link_verdicts WHERE addressed", *self.results))

    def check_times(self, name, sql):
        for panel, results in self.panels(name):
            bars = sum(int(bar["data-count"]) for bar in panel.all("bar"))
            self.assertGreater(bars, 0)
            self.assertEqual(bars, self.number(f"SELECT COUNT(*) {sql}", *results))
            self.assertEqual((panel.count("quartile"), panel.count("box")), (3, 2))
            zeros = self.number(f"SELECT COUNT(*) {sql} AND time = 0", *results)
            beside = [bar for bar in panel.all("beside")
                      if next(bar.all("title")).text.startswith("0:")]
            self.assertEqual(sum(int(bar["data-count"]) for bar in beside), zeros)
        files = self.files(name)
        everything = self.number(f"SELECT COUNT(*) {sql}", *self.results)
        self.assertEqual(len(files[f"{name}.csv"]), everything)
        self.assertEqual(sum(int(row[3]) for row in files[f"{name}_bins.csv"]), everything)

    def test_the_histogram_of_discoveries_counts_each_once(self):
        self.check_times("discovery", "FROM (SELECT took_ns time FROM discoveries WHERE found)"
                         " WHERE TRUE")

    def test_the_histogram_of_delays_counts_each_once_and_zeros_beside_the_axis(self):
        delays = ("FROM (SELECT delay_ns time FROM deliveries JOIN messages USING (sender, id)"
                  " WHERE destination != 65535) WHERE TRUE")
        self.check_times("delay", delays)
        self.assertGreater(self.number(f"SELECT COUNT(*) {delays} AND time = 0", self.results[2]), 0)

    def test_the_profiles_stand_side_by_side_with_the_paper(self):
        head, *rows = self.document.section("comparison").all("tr")
        self.assertEqual([cell.text for cell in head.children],
                         ["figure", "paper", "basis", "mobility_framework", "ideal"])
        median = next(row for row in rows if row.children[0].text == "delay, median ms")
        self.assertEqual(median.children[1].text, "2.520")
        self.assertEqual(self.document.section("profiles").count("box"), 2 * 3)

    def test_what_differs_is_listed_and_the_paper_left_out_where_it_does_not_belong(self):
        keys = [row.children[0].text for row in self.document.section("differences").all("tr")]
        self.assertIn("radio.profile", keys)
        self.run_baraka(CASE_STUDY, "--controllers", "in-process", "--until", "5", "--set",
                        "agents.robots.controller.parameters.speed=0.5 m/s")
        page = self.folder / "slow.html"
        self.report(page, self.out)
        document = Document(chromium(self.folder, page, "--dump-dom"))
        head = next(document.section("comparison").all("tr"))
        self.assertEqual([cell.text for cell in head.children], ["figure", "mobility_framework"])
        reasons = [p.text for p in document.root.all("caption") if "case study" in p.text]
        self.assertEqual(len(reasons), 1)
        self.assertIn("speed is 0.5 m/s, not 0.94 m/s", reasons[0])
        for name in ("discovery", "delay"):
            for section in document.root.all("section"):
                if section["id"] == name:
                    self.assertNotIn("paper", [cell.text for cell in section.all("td")])

    def test_what_is_far_off_is_marked_and_what_a_figure_is_worth_is_said(self):
        rows = {row.children[0].text: row.children
                for row in self.document.section("comparison").all("tr")}
        self.assertEqual(rows["delay, median ms"][2].text, "calibrated")
        self.assertEqual(rows["delay, maximum ms"][2].text, "stated")
        for name, cells in rows.items():
            for cell in cells[3:]:
                if name not in ("delay, maximum ms", "discovery, maximum ms", "delay, median ms"):
                    continue
                times = float(cell.text) / float(cells[1].text)
                marked = "far-off" in (cell.attributes.get("class") or "")
                self.assertEqual(marked, not 0.5 <= times <= 2, f"{name}: {times}")
        self.assertEqual(self.document.section("comparison").count("no-tail"), 1)

    def test_the_settings_make_up_an_experiment_with_a_mark_for_each(self):
        part = self.document.section("experiment-0")
        plots = list(part.all("plot"))
        self.assertGreater(len(plots), 0)
        for plot in plots:
            self.assertEqual(sorted(point["data-runs"] for point in plot.all("point")), ["1", "2"])
        sent, = [plot for plot in plots if plot["data-plot"] == "frames.sent"]
        frames = [self.number("SELECT sum(count) FROM frames_sent", *results) / len(results)
                  for results in (self.results[:2], self.results[2:])]
        self.assertEqual([float(point["data-y"]) for point in sent.all("point")], frames)
        self.assertEqual(sent.count("interval"), 1)  # of the two runs; one run has none
        self.assertIn("only", next(sent.all("note")).text + "only")

    def test_it_needs_nothing_but_itself(self):
        source = Document(self.page.read_text()).root
        for element in [*source.all("script"), *source.all("link"), *source.all("img")]:
            address = element.attributes.get("src") or element.attributes.get("href") or "data:"
            self.assertTrue(address.startswith("data:"), address)
        style = next(source.all("style")).text
        self.assertNotIn("url(", style)
        self.assertNotIn("@import", style)

    def test_a_picture_of_it_is_as_large_as_asked_and_not_empty(self):
        folder = pathlib.Path(os.environ.get("BARAKA_SCREENSHOTS", self.home))
        for name, scheme in ("light", 1), ("dark", 0):
            picture = folder / f"report_{name}.png"
            chromium(self.home, self.page, f"--screenshot={picture}", "--window-size=1200,6000",
                     f"--blink-settings=preferredColorScheme={scheme}")
            content = picture.read_bytes()
            self.assertEqual(struct.unpack(">II", content[16:24]), (1200, 6000))
            self.assertGreater(len(content), 200_000)  # an empty page has 34 kB

    def test_a_file_that_cannot_be_written_is_named(self):
        page = self.folder / "missing" / "report.html"
        finished = Program("baraka", "report", "-o", page, self.results[0]).finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertIn(str(page), finished.err)

    def test_one_run_alone_makes_a_page_too(self):
        page = self.folder / "one.html"
        self.report(page, self.results[0])
        document = Document(chromium(self.folder, page, "--dump-dom"))
        self.assertEqual(document.section("packets").count("packets"), 25)
        self.assertNotIn("profiles", [s["id"] for s in document.root.all("section")])


class Team(PageCase):
    """Twelve robots at two speeds, two seeds each: a scenario that compares itself with nothing."""

    SPEEDS = "0.5 m/s", "0.9 m/s"
    REPORT = ("report=[{plot: frames.sent, versus: speed}, {plot: agents.path, agent: r3},"
              " {plot: agents.path, as: histogram}, {plot: run.simulated, as: table}]")

    @classmethod
    def setUpClass(cls):
        case = cls("make")
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        cls.results = []
        for speed in cls.SPEEDS:
            for seed in 1, 2:
                case.run_baraka(MANY_ROBOTS, "--controllers", "in-process", "--until", 32, "--seed", seed, "--set",
                                f"agents.robots.controller.parameters.speed={speed}", "--set", cls.REPORT)
                cls.results.append(case.out)
        cls.home = case.folder
        cls.page = case.folder / "report.html"
        case.report(cls.page, *cls.results)
        cls.document = Document(chromium(cls.home, cls.page, "--dump-dom"))

    def plot(self, index):
        return list(self.document.section("experiment-0").all("plot"))[index]

    def test_each_speed_is_a_column_and_a_mark(self):
        head, *_ = self.document.section("comparison").all("tr")
        self.assertEqual([cell.text for cell in head.children][1:],
                         [f"many_robots, speed {speed}" for speed in self.SPEEDS])
        points = list(self.plot(0).all("point"))
        self.assertEqual([(float(point["data-x"]), point["data-runs"]) for point in points],
                         [(0.5, "2"), (0.9, "2")])
        self.assertEqual(self.plot(0).count("interval"), 2)
        sql = "SELECT path_m FROM bodies JOIN agents USING (agent) WHERE name = 'r3'"
        self.assertEqual([float(point["data-y"]) for point in self.plot(1).all("point")],
                         [self.number(sql, *self.results[i:i + 2]) / 2 for i in (0, 2)])

    def test_a_histogram_counts_each_robot_once_and_a_table_needs_no_drawing(self):
        bins = sum(int(one["data-count"]) for one in self.plot(2).all("bin"))
        self.assertEqual(bins, 4 * 12)
        self.assertEqual((self.plot(3).count("svg"), self.plot(3).count("tr")), (0, 3))

    def test_every_robot_has_its_colour_in_the_legend_and_a_map_of_its_own(self):
        panels = list(self.document.section("trajectory").all("panel"))
        self.assertEqual(len(panels), 2)
        for panel in panels:
            self.assertEqual((panel.count("entry"), panel.count("multiple"), panel.count("shown")), (12, 12, 12))
            self.assertEqual(panel.count("mark"), 12 * 2)  # at 0 and 30 s
            looks = {(track["style"], track["stroke-dasharray"]) for track in panel.all("shown")}
            self.assertEqual(len(looks), 12)

    def test_none_of_the_papers_words_is_on_it(self):
        def words(element):
            yield element.text
            for child in element.children:
                if child.tag not in ("script", "style"):
                    yield from words(child)
        self.assertNotRegex(" ".join(words(self.document.root)), PAPERS_WORDS)


class Queues(PageCase):
    """Bulk and alarms through one relay, with a queue for each receiver and access category."""

    def test_each_queue_has_a_row_with_its_numbers(self):
        self.run_baraka(ROOT / "tests/e2e/priorities.yaml", "--controllers", "in-process", "--until", 3,
                        "--set", "radio.queues={per: station, limit: 15}", "--set", "priorities={alarm: voice}")
        page = self.folder / "report.html"
        self.report(page, self.out)
        self.document = Document(chromium(self.folder, page, "--dump-dom"))
        found = self.query(
            "SELECT a.name, ifnull(r.name, 'everyone'), category, frames, waiting, most, most_bytes, waited_ns, "
            "(SELECT ifnull(sum(count), 0) FROM station_queue_drops d WHERE d.agent = q.agent AND "
            "d.receiver = q.receiver AND d.category = q.category AND verdict = 'queue full') "
            "FROM station_queues q JOIN agents a USING (agent) LEFT JOIN agents r ON r.agent = receiver "
            "ORDER BY q.agent, receiver, category")
        self.assertGreater(len(found), 3)
        self.assertGreater(sum(row[8] for row in found), 0)
        rows = self.files("queues")["queues.csv"]
        self.assertEqual([row[1:10] for row in rows], [[str(cell) for cell in row] for row in found])
        body = list(self.document.section("queues").all("tr"))[1:]
        self.assertEqual([[cell.text for cell in row.children][:3] for row in body],
                         [list(row[:3]) for row in found])


if __name__ == "__main__":
    if not (BIN / "report_page.html").exists():
        print("skipped: the report page is not built; ./setup report_page installs npm and builds it")
        sys.exit(SKIPPED)
    if CHROMIUM is None:
        print("skipped: no chromium; apt-get install --no-install-recommends chromium")
        sys.exit(SKIPPED)
    unittest.main()
