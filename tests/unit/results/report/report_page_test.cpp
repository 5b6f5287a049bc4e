#include "results/report/report_page.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/unit/results/record/test_run.h"

namespace results::report::test {
namespace {

using record::test::Folder;
using record::test::make_result;

using Json = nlohmann::json;

/// m1 ended the run, r0 stood still from 31 s to 62 s and then left the scene; m0's message took
/// `delay_ns`, its search for a route 2 ms.
std::string run_sql(const std::string& profile, int seed, std::int64_t delay_ns) {
  return fmt::format(R"sql(
INSERT INTO run VALUES ('scenario','tiny'), ('profile','{}'), ('seed',{}), ('result','arrived'),
  ('simulated_s',95.5);
INSERT INTO settings VALUES ('compare','labella2009');
INSERT INTO agents VALUES (1,'m0','mote','p',0,0,0), (2,'m1','mote','p',3,4,0),
  (3,'r0','robot','p',1,1,0);
INSERT INTO ends VALUES (2,'DONE',0,'arrived');
INSERT INTO walls VALUES ('fence',5,6,0.5,2,0.25);
INSERT INTO links VALUES (1,2), (2,3);
INSERT INTO poses VALUES (3,0,1,1,0), (3,30000000000,2,1,0), (3,31000000000,2.5,1,0),
  (3,62000000000,9,9,0), (1,0,0,0,0);
INSERT INTO packets VALUES (1,2,'unicast',10), (2,1,'unicast',20), (2,1,'broadcast',5);
INSERT INTO messages VALUES (1,1,2,'help',2,0,'handed over',1,'delivered',0);
INSERT INTO deliveries VALUES (1,1,2,{},{},1);
INSERT INTO discoveries VALUES (1,'help',2,0,2000000,1), (1,'help',2,0,15000000000,0);
)sql",
                     profile, seed, delay_ns, delay_ns);
}

class ReportPageTest : public testing::Test {
 protected:
  ReportPageTest() : folder(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  void add(const std::string& name, const std::string& sql) {
    record::test::make_result(folder.path() / name, sql);
  }
  std::string page(const std::string& empty) const {
    return report_page(read_sources({folder.path()}), Settings{}, empty);
  }
  Json figures() const { return Json::parse(page("\"BARAKA FIGURES\"")); }

  Folder folder;
};

TEST_F(ReportPageTest, HasTheAirTimeOfEachSecondByUse) {
  add("a", run_sql("ideal", 1, 1000) + R"sql(
INSERT INTO air_accounts VALUES (0,1,'user','DATA',NULL,'scan',3,1,3,1,16000,16000000);
INSERT INTO dds_endpoints VALUES ('aa',1,'writer','scan','t','reliable','volatile',0);
INSERT INTO sample_sums VALUES ('aa',2,3,2,1,0,1,3,300,5000000);
INSERT INTO sample_latencies VALUES ('aa',2,4000000,2);
INSERT INTO air_seconds VALUES (0,'user','DATA',5), (0,'user','DATA_FRAG',6), (0,'user','HEARTBEAT',7),
  (0,'SEDP','DATA',8), (3,'802.11','ack',9);
)sql");
  const Json air = figures()["groups"][0]["air"];
  EXPECT_EQ(air["seconds"], Json::parse(R"([[[0, "SEDP", 8], [0, "user control", 7],
    [0, "user data", 11], [3, "802.11", 9]]])"));
  EXPECT_EQ(air["topics"][0]["samples"], 3);
  EXPECT_EQ(air["topics"][0]["p50"], 0.0040625);
  EXPECT_EQ(air["kinds"][0]["airtime_ns"], 16000000);
}

TEST_F(ReportPageTest, HasTheQueuesOfAllRuns) {
  for (const char* const run : {"a", "b"}) {
    add(run, run_sql("ideal", run[0], 1000) + R"sql(
INSERT INTO station_queues VALUES (1,2,'VO',20,3,5,700,40000000), (1,65535,'BE',1,0,1,9,0);
INSERT INTO station_queue_drops VALUES (1,2,'VO','expired',4), (1,2,'VO','queue full',6);
)sql");
  }
  EXPECT_EQ(figures()["groups"][0]["queues"], Json::parse(R"([
    {"agent": "m0", "receiver": "m1", "category": "VO", "frames": 40, "waiting": 6, "most": 5,
     "most_bytes": 700, "waited_ns": 80000000, "drops": {"expired": 8, "queue full": 12}},
    {"agent": "m0", "receiver": "everyone", "category": "BE", "frames": 2, "waiting": 0, "most": 1,
     "most_bytes": 9, "waited_ns": 0, "drops": {}}])"));
}

TEST_F(ReportPageTest, ShowsNodesLinksAndWallsAsTheyStood) {
  add("a", run_sql("ideal", 1, 1000));
  const Json group = figures()["groups"][0];
  EXPECT_EQ(group["nodes"], Json::parse(R"([
    {"name": "m0", "robot": false, "goal": false, "x": 0.0, "y": 0.0, "packets": 10},
    {"name": "m1", "robot": false, "goal": true, "x": 3.0, "y": 4.0, "packets": 25},
    {"name": "r0", "robot": true, "goal": false, "x": 1.0, "y": 1.0, "packets": 0}])"));
  EXPECT_EQ(group["links"], Json::parse("[[0, 1], [1, 2]]"));  // places in the list of nodes
  EXPECT_EQ(group["walls"], Json::parse(R"([{"name": "fence", "x": 5.0, "y": 6.0, "yaw": 0.5,
                                             "length_x": 2.0, "length_y": 0.25}])"));
}

TEST_F(ReportPageTest, FollowsTheRobotsOnly) {
  add("a", run_sql("ideal", 1, 1000));
  const Json run = figures()["groups"][0]["runs"][0];
  ASSERT_EQ(run["robots"].size(), 1u);
  EXPECT_EQ(run["robots"][0]["name"], "r0");
  EXPECT_EQ(run["robots"][0]["track"],
            Json::parse("[[0.0,1.0,1.0], [30.0,2.0,1.0], [31.0,2.5,1.0], [62.0,9.0,9.0]]"));
}

// The run ends at 95.5 s: marks at 0, 30, 60, 90. At 60 s it stands where it was at 31 s.
TEST_F(ReportPageTest, MarksWhereARobotWasEvery30Seconds) {
  add("a", run_sql("ideal", 1, 1000));
  EXPECT_EQ(figures()["groups"][0]["runs"][0]["robots"][0]["ticks"],
            Json::parse("[[0.0,1.0,1.0], [30.0,2.0,1.0], [60.0,2.5,1.0], [90.0,9.0,9.0]]"));
}

TEST_F(ReportPageTest, PoolsTimesAndPacketsOfAGroupAndKeepsProfilesApart) {
  add("a", run_sql("mobility_framework", 1, 1'000'000));
  add("b", run_sql("mobility_framework", 2, 3'000'000));
  add("c", run_sql("ideal", 1, 0));
  const Json groups = figures()["groups"];
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0]["name"], "mobility_framework");
  EXPECT_EQ(groups[0]["delay"]["runs_ns"], Json::parse("[[1000000], [3000000]]"));
  EXPECT_NEAR(groups[0]["delay"]["quantiles"]["median"], 2e-3, 1e-15);  // s, rounding
  EXPECT_EQ(groups[0]["nodes"][1]["packets"], 50);
  EXPECT_EQ(groups[1]["delay"]["zeros"], 1);
  EXPECT_EQ(groups[1]["delay"]["quantiles"]["max"], 0);
}

TEST_F(ReportPageTest, CountsTheSearchesThatFoundARoute) {
  add("a", run_sql("ideal", 1, 1000));
  const Json discovery = figures()["groups"][0]["discovery"];
  EXPECT_EQ(discovery["runs_ns"], Json::parse("[[2000000]]"));
  ASSERT_EQ(discovery["bins"].size(), 40u);
  EXPECT_EQ(discovery["bins"][8], 1);  // (log10(2e-3) + 4) / 0.15 = 8.67
}

TEST_F(ReportPageTest, SetsThePapersFiguresBesideOurs) {
  add("a", run_sql("mobility_framework", 1, 1'000'000));
  add("b", run_sql("ideal", 1, 0));
  const Json all = figures();
  EXPECT_EQ(all["paper"]["delay"]["median"], 2.52e-3);
  EXPECT_EQ(all["paper"]["most_packets"], 4272);
  const Json row = {{"figure", "delay, median ms"},
                    {"paper", "2.520"},
                    {"basis", "calibrated"},
                    {"far_off", {true, true}},
                    {"ours", {"1.000", "0.000"}}};
  EXPECT_NE(std::find(all["comparison"].begin(), all["comparison"].end(), row),
            all["comparison"].end());
}

TEST_F(ReportPageTest, LeavesThePaperOutWhereItDoesNotBelongAndShowsWhatDiffers) {
  add("a", run_sql("ideal", 1, 0) + "INSERT INTO settings VALUES ('agents.x','9')");
  EXPECT_TRUE(figures()["paper"].is_null());
  EXPECT_EQ(figures()["groups"][0]["not_the_papers"], "agents.x is 9, not -");
  add("b", run_sql("ideal", 1, 0));
  EXPECT_EQ(figures()["groups"][1]["not_the_papers"], "");
  EXPECT_FALSE(figures()["paper"].is_null());
  EXPECT_EQ(figures()["differences"],
            Json::parse(R"([{"key": "agents.x", "values": ["9", "-"]}])"));
}

TEST_F(ReportPageTest, LeavesBrokenRunsOut) {
  add("a", "INSERT INTO run VALUES ('profile','ideal'), ('result','failed')");
  const Json group = figures()["groups"][0];
  EXPECT_EQ(group["left_out"], 1);
  EXPECT_TRUE(group["runs"].empty());
}

TEST_F(ReportPageTest, SurvivesARunWithoutRobotsAndMessages) {
  add("a",
      "INSERT INTO run VALUES ('profile','ideal'), ('result','until');"
      "INSERT INTO agents VALUES (1,'m0','mote','p',0,0,0)");
  const Json group = figures()["groups"][0];
  EXPECT_TRUE(group["runs"][0]["robots"].empty());
  EXPECT_TRUE(group["delay"]["quantiles"].is_null());
}

TEST_F(ReportPageTest, NoNameEndsTheScriptElementOrBreaksTheJson) {
  add("\xff", run_sql("ideal", 1, 1000) +  // a folder whose name is no UTF-8
                  "UPDATE agents SET name = '</script>' WHERE agent = 1");
  const std::string text = page("<script>\"BARAKA FIGURES\"</script>");
  EXPECT_EQ(text.find("</script>"), text.size() - 9);
  const Json all = Json::parse(text.substr(8, text.size() - 17));
  EXPECT_EQ(all["groups"][0]["nodes"][0]["name"], "</script>");
}

TEST_F(ReportPageTest, RefusesAPageWithoutAPlaceForTheFigures) {
  add("a", run_sql("ideal", 1, 1000));
  EXPECT_THROW(page("<html></html>"), std::runtime_error);
}

}  // namespace
}  // namespace results::report::test
