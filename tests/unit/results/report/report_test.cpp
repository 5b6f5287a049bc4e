#include "results/report/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <stdexcept>

#include "results/report/group.h"
#include "tests/unit/results/record/test_run.h"

namespace results::report::test {
namespace {

using record::test::Folder;
using record::test::make_result;

/// A run in which r0 drove from (0, 0) towards m1 at (3, 4), 5 m away, over 7.5 m; m0 sent m1 four
/// messages of which three arrived after 1, 2 and 4 ms, and one flood that reached two agents.
std::string run_sql(const std::string& profile, int seed, const std::string& result = "arrived") {
  return fmt::format(R"sql(
INSERT INTO run VALUES ('scenario','tiny'), ('profile','{}'), ('seed',{}), ('result','{}'),
  ('simulated_s',100.0), ('wall_s',4.0), ('exchanges',1000), ('events',5000);
INSERT INTO settings VALUES ('compare','labella2009');
INSERT INTO agents VALUES (1,'m0','mote','p',0,0,0), (2,'m1','mote','p',3,4,0),
  (3,'r0','robot','p',0,0,0);
INSERT INTO ends VALUES (2,'DONE',0,'arrived'), (NULL,NULL,0,'timeout');
INSERT INTO links VALUES (1,2), (1,3);
INSERT INTO bodies VALUES (3,7.5,0.4,0,3.0,3.9,0,0,2);
INSERT INTO packets VALUES (1,2,'unicast',10), (2,1,'unicast',20), (2,1,'broadcast',5);
INSERT INTO messages VALUES (1,1,2,'help',2,0,'handed over',1,'delivered',0),
  (1,2,2,'help',2,0,'handed over',1,'delivered',0), (1,3,2,'help',2,0,'handed over',1,'delivered',0),
  (1,4,2,'help',2,0,'no route',1,'no route',0), (1,5,65535,'help',2,0,'handed over',1,'delivered',0);
INSERT INTO deliveries VALUES (1,1,2,1000000,1000000,1), (1,2,2,2000000,2000000,2),
  (1,3,2,4000000,4000000,2), (1,5,2,300000,300000,1), (1,5,3,300000,300000,1);
INSERT INTO discoveries VALUES (1,'help',2,0,962181,1), (1,'help',2,0,3000000,1),
  (1,'help',2,0,15000000000,0);
)sql",
                     profile, seed, result);
}

/// The cells of the line that starts with `name`, joined by '|'.
std::string line(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("\n" + name + "  ");
  if (at == std::string::npos) return "no line '" + name + "'";
  const std::size_t start = at + 1 + name.size();
  const std::string rest = text.substr(start, text.find('\n', start) - start);
  std::string cells;
  std::size_t place = 0;
  while ((place = rest.find_first_not_of(' ', place)) != std::string::npos) {
    const std::size_t end = std::min(rest.find("  ", place), rest.size());
    cells += (cells.empty() ? "" : "|") + rest.substr(place, end - place);
    place = end;
  }
  return cells;
}

class ReportTest : public testing::Test {
 protected:
  ReportTest() : folder(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  void add(const std::string& name, const std::string& sql) {
    record::test::make_result(folder.path() / name, sql);
  }
  /// The runs are made of few settings, and so is the case study that they are of.
  std::string text(const std::optional<Settings>& case_study = Settings{}) const {
    return report(read_sources({folder.path()}), case_study);
  }

  Folder folder;
};

TEST_F(ReportTest, ListsEachRun) {
  add("a", run_sql("mobility_framework", 1));
  // Straight: to where m1, whose state ended the run, stood. Ratio 7.5 / 5.
  EXPECT_EQ(line(text(), (folder.path() / "a").string()),
            "mobility_framework|1|arrived|100.0|r0|7.5|5.0|1.50|0.40|0|2");
}

// Of 10 frames that m0 sent m1 it got 7, lost 2 to collisions, and noticed the last one not at all;
// r0 overheard 4 of them. Of m1's 3 broadcasts m0 got 1, and r0 is out of reach.
TEST_F(ReportTest, SaysWhyFramesWereLost) {
  add("a", run_sql("mobility_framework", 1) +
               "INSERT INTO frames_sent VALUES (1,2,'unicast',10), (2,65535,'broadcast',3);"
               "INSERT INTO receptions VALUES (2,1,'unicast',1,'delivered',7),"
               " (2,1,'unicast',1,'collision',2), (3,1,'unicast',0,'delivered',4),"
               " (1,2,'broadcast',1,'delivered',1);");
  EXPECT_EQ(line(text(), "delivered"), "7|1|4|12");
  EXPECT_EQ(line(text(), "collision"), "2|0|0|2");
  EXPECT_EQ(line(text(), "below sensitivity"), "1|5|6|12");
  EXPECT_EQ(line(text(), "frames sent x radios"), "10|6|10|26");
}

TEST_F(ReportTest, NamesTheLinksThatLostMost) {
  add("a", run_sql("mobility_framework", 1) +
               "INSERT INTO frames_sent VALUES (1,65535,'broadcast',40), (2,65535,'broadcast',30);"
               "INSERT INTO receptions VALUES (2,1,'broadcast',1,'delivered',39),"
               " (2,1,'broadcast',1,'noise',1), (1,2,'broadcast',1,'delivered',3),"
               " (1,2,'broadcast',1,'collision',5);");
  EXPECT_EQ(line(text(), "m1"), "m0|30|10.00|below sensitivity 22, collision 5");
  EXPECT_EQ(line(text(), "m0"), "m1|40|97.50|noise 1");
}

TEST_F(ReportTest, MeasuresTheStraightLineToTheEndIfNoGoalWasReached) {
  add("a", run_sql("mobility_framework", 1, "timeout"));
  // hypot(3.0, 3.9) = 4.92; 7.5 / 4.92 = 1.524.
  EXPECT_EQ(line(text(), (folder.path() / "a").string()),
            "mobility_framework|1|timeout|100.0|r0|7.5|4.9|1.52|0.40|0|2");
}

// It ended hypot(0.6, 0.4) = 0.72 m from where it started, after 7.5 m; then hypot(0.7, 0.4) = 0.81
// m, which is more than a tenth: 7.5 / 0.806 = 9.30.
TEST_F(ReportTest, ComparesNoPathWithAStraightLineIfTheRobotCameBack) {
  const auto ended_at = [](const char* x) {
    return run_sql("mobility_framework", 1, "timeout") + "UPDATE bodies SET x_m = " + x +
           ", y_m = 0.4;";
  };
  add("a", ended_at("0.6"));
  add("b", ended_at("0.7"));
  EXPECT_EQ(line(text(), (folder.path() / "a").string()),
            "mobility_framework|1|timeout|100.0|r0|7.5|0.7|-|0.40|0|2");
  EXPECT_EQ(line(text(), (folder.path() / "b").string()),
            "mobility_framework|1|timeout|100.0|r0|7.5|0.8|9.30|0.40|0|2");
}

// A goal stays what the path is compared with, however long the way to it was.
TEST_F(ReportTest, ComparesALongDetourWithTheWayToTheGoal) {
  add("a", run_sql("mobility_framework", 1) + "UPDATE bodies SET path_m = 75, x_m = 0, y_m = 0;");
  EXPECT_EQ(line(text(), (folder.path() / "a").string()),
            "mobility_framework|1|arrived|100.0|r0|75.0|5.0|15.00|0.40|0|2");
}

TEST_F(ReportTest, SetsTheProfilesSideBySideWithThePaper) {
  add("a", run_sql("mobility_framework", 1));
  add("b", run_sql("mobility_framework", 2));
  add("c", run_sql("ideal", 1));
  const std::string printed = text();
  EXPECT_EQ(line(printed, "figure"), "paper|basis|mobility_framework|ideal");
  EXPECT_EQ(line(printed, "runs"), "10|stated|2|1");
  EXPECT_EQ(line(printed, "results"), "2 arrived|1 arrived");
  EXPECT_EQ(line(printed, "run time, mean s"), "100.0|100.0");
  EXPECT_EQ(line(printed, "real-time factor"), "> 1|stated|25.0|25.0");
  EXPECT_EQ(line(printed, "exchanges per s"), "10.0|10.0");
  EXPECT_EQ(line(printed, "path, mean m"), "7.5|7.5");
  EXPECT_EQ(line(printed, "messages to one agent"), "8|4");
  EXPECT_EQ(line(printed, "delivered %"), "75.00|75.00");
  EXPECT_EQ(line(printed, "agents reached per flood"), "2.00|2.00");
  EXPECT_EQ(line(printed, "routes given up"), "2|1");
}

/// The lines of the section that begins with `head`.
std::string section(const std::string& text, const std::string& head) {
  const std::size_t at = text.find("\n" + head);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find("\n\n", at) - at);
}

TEST_F(ReportTest, NeverPoolsRunsOfDifferentSettings) {
  const auto with = [](int seed, const std::string& speed) {
    return run_sql("ideal", seed) +
           fmt::format(
               "INSERT INTO settings VALUES ('agents.robots.controller.parameters.speed','{}'),"
               " ('seed','{}'), ('radio.profile','ideal');",
               speed, seed);
  };
  add("a", with(1, "0.5 m/s"));
  add("b", with(2, "0.9 m/s"));
  add("c", with(3, "0.5 m/s"));
  const std::string printed = text(std::nullopt);
  EXPECT_EQ(line(printed, "figure"), "ideal, speed 0.5 m/s|ideal, speed 0.9 m/s");
  EXPECT_EQ(line(printed, "runs"), "2|1");
  EXPECT_EQ(
      line(section(printed, "Settings in which"), "agents.robots.controller.parameters.speed"),
      "0.5 m/s|0.9 m/s");
  EXPECT_EQ(section(printed, "Settings in which").find("seed"), std::string::npos);
}

TEST_F(ReportTest, GroupsThatDifferInMoreAreCalledAfterTheirFoldersAndListed) {
  add("a", run_sql("ideal", 1) + "INSERT INTO settings VALUES ('a','1'), ('b','1')");
  add("b", run_sql("ideal", 1) + "INSERT INTO settings VALUES ('a','2')");
  add("c", run_sql("disk", 1) + "INSERT INTO settings VALUES ('a','1'), ('b','1')");
  const std::string printed = text();
  EXPECT_EQ(line(printed, "figure"), "ideal, a|ideal, b|disk");
  const std::string settings = section(printed, "Settings in which");
  EXPECT_EQ(line(settings, "a"), "1|2|1");
  EXPECT_EQ(line(settings, "b"), "1|-|1");
}

TEST_F(ReportTest, LongFolderNamesAreShortenedAndExplained) {
  const std::string head = "an experiment about speeds of robots";
  for (const std::string end : {"1", "2"}) {
    add(head + end, run_sql("ideal", 1) +
                        fmt::format("INSERT INTO settings VALUES ('a','{0}'), ('b','{0}')", end));
  }
  const std::string printed = text();
  EXPECT_EQ(line(printed, "figure"),
            "ideal, an experi...1...speeds of robots1|"
            "ideal, an experi...2...speeds of robots2");
  EXPECT_NE(printed.find("\nideal, an experi...2...speeds of robots2: ideal, " + head + "2\n"),
            std::string::npos);
}

/// A robot that neither sends nor hears anything, and records what it finds.
const std::string kOwn = R"sql(
INSERT INTO run VALUES ('scenario','search'), ('profile','ideal'), ('seed',1), ('result','done'),
  ('simulated_s',10.0);
INSERT INTO agents VALUES (1,'r0','robot','finder',0,0,0);
INSERT INTO bodies VALUES (1,7.5,0.4,0,3.0,3.9,0,0,2);
INSERT INTO recorded VALUES (1,0,'found',0.0), (1,1000000000,'found',2.0);
INSERT INTO recorded_units VALUES ('finder','found','1');
INSERT INTO states VALUES (1,500000000,'looking'), (1,700000000,'looking');
INSERT INTO observables VALUES (1,'agents.speed',1,'m/s','counter',NULL,0);
INSERT INTO observable_sums VALUES (1,3,0.5,0.1,0.4,0.6,1.5,0.6,0.5);
)sql";

TEST_F(ReportTest, BeginsWithTheScenarioAndWhatItsOwnRunRecorded) {
  add("a", kOwn);
  const std::string printed = text();
  EXPECT_EQ(printed.find("Scenario: search\n"), 0U);
  EXPECT_EQ(line(printed, "controllers.found"), "r0|1|2|1|0|2|2");
  EXPECT_EQ(line(printed, "agents.speed"), "r0|m/s|3|0.5|0.4|0.6|0.6");
  EXPECT_NE(printed.find("r0     looking     1        2    0.500\n"), std::string::npos) << printed;
  EXPECT_LT(printed.find("search: values that controllers recorded, 1 run\n"),
            printed.find("\nFigures"));
  EXPECT_EQ(line(printed, "figure"), "search");
}

// What there is none of is left out; what was counted and is 0 stays.
TEST_F(ReportTest, AZeroIsShownAndWhatIsMissingIsNot) {
  add("a", kOwn);
  const std::string printed = text();
  EXPECT_EQ(line(printed, "messages to one agent"), "0");
  EXPECT_EQ(line(printed, "routes found"), "0");
  EXPECT_NE(printed.find("search: no frame was sent by radio\n"), std::string::npos);
  for (const char* missing :
       {"delivered %", "discovery, median ms", "delay, minimum ns", "packets, ratio"}) {
    EXPECT_NE(line(printed, missing).find("no line"), std::string::npos) << missing;
  }
  add("a", kOwn + "INSERT INTO settings VALUES ('record.messages','none'), ('routing','none');");
  for (const char* missing : {"messages to one agent", "floods", "routes found"}) {
    EXPECT_NE(line(text(), missing).find("no line"), std::string::npos) << missing;
  }
}

TEST_F(ReportTest, OnlyWhatRoutingRelaysIsAFlood) {
  const std::string both =
      "INSERT INTO messages VALUES (1,6,65534,'help',2,0,'handed over',1,'delivered',0);"
      "INSERT INTO deliveries VALUES (1,6,2,300000,300000,1);";
  add("a", run_sql("ideal", 1) + both);
  std::string printed = text();
  EXPECT_EQ(line(printed, "floods"), "1");
  EXPECT_EQ(line(printed, "agents reached per flood"), "2.00");
  EXPECT_EQ(line(printed, "broadcasts to neighbours"), "1");
  EXPECT_EQ(line(printed, "agents reached per broadcast"), "1.00");

  add("a", run_sql("ideal", 1) + both +
               "DELETE FROM settings; INSERT INTO settings VALUES ('routing','none');");
  printed = text();
  EXPECT_EQ(line(printed, "floods"), "no line 'floods'") << "nobody relays";
  EXPECT_EQ(line(printed, "broadcasts to neighbours"), "2");
  EXPECT_EQ(line(printed, "agents reached per broadcast"), "1.50");
}

TEST_F(ReportTest, SetsThePaperBesideItsCaseStudyOnlyAndSaysWhy) {
  const Settings case_study = {
      {"seed", "1"}, {"radio.profile", "ideal"}, {"world.walls.0.name", "w"}};
  const std::string same =
      "INSERT INTO settings VALUES ('seed','5'), ('radio.profile','disk'), ('--until','2 s'),"
      " ('world.walls.0.name','w');";
  add("a", run_sql("disk", 5) + same);
  EXPECT_EQ(line(text(case_study), "figure"), "paper|basis|disk");
  EXPECT_EQ(line(text(case_study), "most: m1"), "25|25.0|427.2");

  add("a", run_sql("disk", 5) + same + "UPDATE settings SET value = 'v' WHERE value = 'w'");
  std::string printed = text(case_study);
  EXPECT_EQ(line(printed, "figure"), "disk");
  EXPECT_EQ(line(printed, "replica score"), "no line 'replica score'");
  EXPECT_EQ(line(printed, "most: m1"), "25|25.0");
  EXPECT_NE(printed.find("disk: not the paper's case study: world.walls.0.name is v, not w\n"),
            std::string::npos);

  add("a", run_sql("disk", 5) + "INSERT INTO settings VALUES ('agents.x','9')");
  printed = text(case_study);
  EXPECT_NE(printed.find("agents.x is 9, not -, and 1 more settings differ\n"), std::string::npos);
  EXPECT_EQ(line(text(std::nullopt), "figure"), "disk");
}

// One run beside the paper's ten: each per run. 4 ms are 0.0007 times 5.66 s, 2 ms 0.8 times 2.52.
TEST_F(ReportTest, ComparesEqualNumbersOfRunsAndNamesWhatIsFarOff) {
  add("a", run_sql("mobility_framework", 1));
  const std::string printed = text();
  EXPECT_EQ(line(printed, "packets per run, most of a mote"), "427.2|calibrated|25.0");
  const std::string off = section(printed, "More than a factor of two off");
  EXPECT_NE(off.find("mobility_framework, delay, maximum ms: 4.000, 0.00071 times the paper's\n"),
            std::string::npos)
      << off;
  EXPECT_EQ(off.find("delay, median"), std::string::npos);
  EXPECT_NE(printed.find("docs/case_study_tail.md"), std::string::npos);
  EXPECT_NE(printed.find("without any loss, a jitter of 1 ms"), std::string::npos)
      << "losses are not all that makes seconds";
}

TEST_F(ReportTest, AScenarioThatComparesItselfWithNothingShowsNoneOfThePapersWords) {
  add("a", run_sql("mobility_framework", 1) + "DELETE FROM settings");
  add("b", run_sql("ideal", 1) + "DELETE FROM settings");
  const std::string printed = text();
  EXPECT_EQ(line(printed, "figure"), "mobility_framework|ideal");
  for (const char* word : {"paper", "replica", "Fig.", "case study", "calibrated", "stated"}) {
    EXPECT_EQ(printed.find(word), std::string::npos) << word;
  }
}

TEST_F(ReportTest, LeavesOutWhatWasPutAsideUnlessItIsNamed) {
  for (const char* name : {"a", "a.1", "b.2", "a.not-started"}) add(name, run_sql("ideal", 1));
  const std::string printed = text();
  for (const char* name : {"a", "b.2"}) {
    EXPECT_NE(printed.find("\n" + (folder.path() / name).string() + " "), std::string::npos)
        << name;
  }
  EXPECT_EQ(line(printed, "runs"), "10|stated|2");
  EXPECT_EQ(line(report(read_sources({folder.path() / "a.1"}), Settings{}), "runs"), "10|stated|1");
}

// Delays 1, 2, 4 ms: type 7 quartiles 1.5, 2, 3. Twice the sample (two runs): positions 1.25, 2.5,
// 3.75 of 1 1 2 2 4 4 give 1.25, 2, 3.5.
TEST_F(ReportTest, PoolsTheQuartilesOfAllRuns) {
  add("a", run_sql("mobility_framework", 1));
  add("b", run_sql("mobility_framework", 2));
  add("c", run_sql("ideal", 1));
  const std::string printed = text();
  EXPECT_EQ(line(printed, "delay, minimum ns"), "700000|inferred|1000000|1000000");
  EXPECT_EQ(line(printed, "delay, quartile 1 ms"), "0.700|calibrated|1.250|1.500");
  EXPECT_EQ(line(printed, "delay, median ms"), "2.520|calibrated|2.000|2.000");
  EXPECT_EQ(line(printed, "delay, quartile 3 ms"), "8.700|calibrated|3.500|3.000");
  EXPECT_EQ(line(printed, "delay, maximum ms"), "5660.000|stated|4.000|4.000");
  EXPECT_EQ(line(printed, "discovery, minimum ns"), "960000|inferred|962181|962181");
}

TEST_F(ReportTest, LeavesBrokenRunsOutOfTheFigures) {
  add("a", run_sql("mobility_framework", 1));
  add("b", run_sql("mobility_framework", 2, "running"));
  add("c", run_sql("mobility_framework", 3, "failed"));
  const std::string printed = text();
  EXPECT_EQ(line(printed, "runs"), "10|stated|1");
  EXPECT_EQ(line(printed, "runs left out (broken off, copies)"), "2");
  EXPECT_NE(line(printed, (folder.path() / "b").string()).find("unfinished"), std::string::npos);
}

TEST_F(ReportTest, SurvivesAGroupWithoutACompleteRun) {
  add("a", run_sql("mobility_framework", 1, "failed"));
  const std::string printed = text();
  EXPECT_EQ(line(printed, "runs"), "10|stated|0");
  EXPECT_EQ(line(printed, "replica score"), "0|calibrated|-");
}

TEST_F(ReportTest, AddsUpPacketsAndGivesTheirMean) {
  add("a", run_sql("mobility_framework", 1));
  add("b", run_sql("mobility_framework", 2));
  const std::string printed = text();
  EXPECT_EQ(line(printed, "most: m1"), "50|25.0|427.2");
  EXPECT_EQ(line(printed, "least: m0"), "20|10.0|184.8");
  EXPECT_EQ(line(printed, "packets, ratio"), "2.31|calibrated|2.50");
}

TEST_F(ReportTest, ChecksDelaysAgainstTheLeastTheMacAllows) {
  add("a", run_sql("mobility_framework", 1));
  const std::string printed = text();
  // 695454.5 ns and 907636.4 ns more for the second hop (replica: 1603.09 us); 2 ms is above.
  EXPECT_EQ(line(printed, "transmissions"), "messages|least ns|lower edge ns|below it");
  EXPECT_EQ(line(printed, "1"), "1|1000000|695455|0");
  EXPECT_EQ(line(printed, "2"), "2|2000000|1603091|0");
}

TEST_F(ReportTest, CountsDelaysBelowTheEdge) {
  add("a", run_sql("mobility_framework", 1) +
               "UPDATE deliveries SET delay_ns = 1603070 WHERE id = 2;"
               "UPDATE deliveries SET delay_ns = 1603072 WHERE id = 3;");
  EXPECT_EQ(line(text(), "2"), "2|1603070|1603091|1");  // 20 ns below is rounding, more is not
}

TEST_F(ReportTest, AnotherProfileHasNoEdge) {
  add("a", run_sql("ideal", 1));
  EXPECT_EQ(line(text(), "1"), "1|1000000");
}

TEST_F(ReportTest, LaysAGridOfMotesOutAsItStands) {
  std::string sql = "INSERT INTO run VALUES ('profile','ideal'), ('result','until');";
  for (int i = 0; i < 6; ++i) {  // 3 columns, 2 rows, from the lower left
    sql += fmt::format("INSERT INTO agents VALUES ({0},'m{1}','mote','p',{2},{3},0);", i + 1, i,
                       i % 3, i / 3);
    sql += fmt::format("INSERT INTO packets VALUES ({0},9,'unicast',{1});", i + 1, 10 * (i + 1));
  }
  sql += "INSERT INTO links VALUES (1,2), (1,4);";
  add("a", sql);
  const std::string printed = text();
  EXPECT_NE(printed.find("  m3  1  m4  0  m5  0\n  m0  2  m1  1  m2  0\n"), std::string::npos);
  EXPECT_NE(printed.find("  m3  40  m4  50  m5  60\n  m0  10  m1  20  m2  30\n"),
            std::string::npos);
  EXPECT_NE(printed.find("2 links between motes"), std::string::npos);
  EXPECT_NE(printed.find("most: m5 (row 1 from the top, column 3)"), std::string::npos);
  EXPECT_NE(printed.find("least: m0 (row 2 from the top, column 1)"), std::string::npos);
}

TEST_F(ReportTest, ReadsAFolderOfFoldersByName) {
  for (const int seed : {10, 2, 1}) add(std::to_string(seed), run_sql("ideal", seed));
  const std::string printed = text();
  const auto place = [&](const char* run) {
    return printed.find("\n" + (folder.path() / run).string() + "  ");
  };
  EXPECT_LT(place("1"), place("2"));
  EXPECT_LT(place("2"), place("10"));
}

/// Two samples of "scan" to agent 2, one of them repaired after 4 ms, and one lost; "map" nobody
/// reads. 40 ms of air time, half of it of "scan".
const char* const kAir = R"sql(
INSERT INTO air_accounts VALUES (0,1,'user','DATA',NULL,'scan',3,1,3,1,16000,16000000),
  (1,2,'user','ACKNACK',NULL,'scan',1,0,1,0,800,4000000),
  (2,1,'user','DATA',NULL,'map',1,0,1,0,4000,6000000),
  (3,1,'network','UDP',5201,NULL,2,0,2,0,8008,12000000), (4,2,'802.11','ack',NULL,NULL,5,0,5,0,560,2000000);
INSERT INTO dds_endpoints VALUES ('aa',1,'writer','scan','t','reliable','volatile',0);
INSERT INTO sample_sums VALUES ('aa',2,3,2,1,0,1,3,300,5000000);
INSERT INTO sample_latencies VALUES ('aa',2,1000000,1), ('aa',2,4000000,1);
INSERT INTO sample_losses VALUES ('aa',2,'collision',1,1);
INSERT INTO air_seconds VALUES (0,'user','DATA',22000000), (0,'user','ACKNACK',4000000),
  (2,'network','UDP',12000000), (2,'802.11','ack',2000000);
)sql";

// Middles of bins of 1/32 of their lower edge: 1 ms is 1.016.
TEST_F(ReportTest, SaysWhatTheAirWasUsedFor) {
  add("a", run_sql("ieee80211g", 1) + kAir);
  const std::string printed = text();
  EXPECT_EQ(line(printed, "scan"), "3|2|1|1|1.016|4.062|0.020000|50.00");
  EXPECT_EQ(line(printed, "map"), "0|0|0|0|-|-|0.006000|15.00");
  EXPECT_EQ(line(printed, "user DATA"), "4|1|5|2500|0.022000|55.00");
  EXPECT_EQ(line(printed, "network UDP:5201"), "2|0|2|1001|0.012000|30.00");
  EXPECT_LT(printed.find("user DATA "), printed.find("network UDP"));
}

TEST_F(ReportTest, PoolsTheAirOfRunsOfTheSameSettings) {
  add("a", run_sql("ieee80211g", 1) + kAir);
  add("b", run_sql("ieee80211g", 2) + kAir);
  EXPECT_EQ(line(text(), "scan"), "6|4|2|2|1.016|4.062|0.040000|50.00");
}

TEST_F(ReportTest, SaysWhySamplesDidNotComeAndWhere) {
  add("a", run_sql("ieee80211g", 1) + kAir);
  add("b",
      run_sql("ieee80211g", 2) + kAir +
          "INSERT INTO sample_losses VALUES ('aa',2,'queue full',2,5), ('aa',2,'unknown',0,3);");
  const std::string printed = text();
  const std::size_t begin =
      printed.find("why samples of programs were not delivered, total of 2 runs");
  ASSERT_NE(begin, std::string::npos);
  const std::string part = printed.substr(begin);
  EXPECT_TRUE(std::regex_search(part, std::regex("scan +collision +m0 +2\n"))) << part;
  EXPECT_TRUE(std::regex_search(part, std::regex("scan +queue full +m1 +5\n"))) << part;
  EXPECT_TRUE(std::regex_search(part, std::regex("scan +unknown +- +3\n"))) << part;
}

/// 1 has 30 frames for 2, of which 10 find no room, and two for everyone.
const char* const kRelays = R"sql(
INSERT INTO relays VALUES (1,2,3,'delivered',15), (1,2,3,'queue full',10), (1,4,3,'retry limit',2),
  (1,4,3,'expired',1), (1,4,3,'waiting',2), (1,2,65535,'transmitted',2);
INSERT INTO relay_queues VALUES (1,3,20,2,7,40000000), (1,65535,2,0,1,1000000);
)sql";

TEST_F(ReportTest, SaysWhatAccessPointsPassedOn) {
  add("a", run_sql("ieee80211g", 1) + kRelays);
  const std::string printed = text();
  const auto has = [&printed](const char* row) {
    return std::regex_search(printed, std::regex(row));
  };
  EXPECT_TRUE(has("m0 +r0 +30 +15 +0 +10 +2 +1 +2 +7 +2.000\n")) << printed;
  EXPECT_TRUE(has("m0 +everyone +2 +2 +0 +0 +0 +0 +0 +1 +0.500\n")) << printed;
  EXPECT_EQ(printed.find("why samples"), std::string::npos);
}

TEST_F(ReportTest, SaysWhatWaitedInQueuesOfReceivers) {
  add("a", run_sql("ieee80211g", 1) +
               "INSERT INTO station_queues VALUES(1, 2, 'VO', 20, 3, 5, 700, 40000000);"
               "INSERT INTO station_queue_drops VALUES(1, 2, 'VO', 'expired', 4),"
               "(1, 65535, 'BE', 'queue full', 6);");
  const std::string printed = text();
  EXPECT_TRUE(std::regex_search(printed, std::regex("VO +20 +2.000 +5 +700 +3 +0 +0 +4 +0\n")))
      << printed;
  EXPECT_TRUE(std::regex_search(printed, std::regex("everyone +BE +0 +- +0 +0 +0 +6 +0 +0 +0\n")))
      << printed;
}

TEST_F(ReportTest, IsSilentOfTheAirWhereNobodyHasANetwork) {
  add("a", run_sql("ieee80211g", 1));
  EXPECT_EQ(text().find("air time"), std::string::npos);
}

TEST_F(ReportTest, SaysWhichFolderHoldsNoResult) {
  try {
    text();
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()), folder.path().string() + ": holds no result (no run.sqlite)");
  }
}

TEST_F(ReportTest, RefusesAnotherVersionOfTheTables) {
  add("a", "PRAGMA user_version = 999");
  EXPECT_THROW(text(), std::runtime_error);
}

TEST_F(ReportTest, RefusesAFileThatIsNoDatabase) {
  std::filesystem::create_directories(folder.path() / "a");
  std::FILE* file = std::fopen((folder.path() / "a" / "run.sqlite").c_str(), "w");
  std::fputs("nothing of the kind, and long enough to have a header of one hundred bytes", file);
  std::fclose(file);
  EXPECT_THROW(text(), std::runtime_error);
}

// Twice the paper's quartiles everywhere: |ln 2| each.
TEST(ReplicaScore, IsTheMeanLogarithmicMisfitOfTheQuartiles) {
  const Quantiles discovery{.min = 0, .q1 = 4.22e-3, .median = 20.54e-3, .q3 = 121.44e-3, .max = 0};
  const Quantiles delay{.min = 0, .q1 = 0.35e-3, .median = 5.04e-3, .q3 = 4.35e-3, .max = 0};
  EXPECT_NEAR(replica_score(discovery, delay).value(), std::log(2.0), 1e-12);  // rounding only
  EXPECT_FALSE(replica_score(std::nullopt, delay));
}

}  // namespace
}  // namespace results::report::test
