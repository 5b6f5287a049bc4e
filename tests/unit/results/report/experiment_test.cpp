#include "results/report/experiment.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "results/campaign/campaign_database.h"
#include "results/report/experiment_section.h"
#include "results/report/run_result.h"
#include "tests/unit/results/record/test_run.h"

namespace results::report::test {
namespace {

using record::test::Folder;
using record::test::make_result;

/// Ended at `ended` s; the sent and delivered messages make no difference here.
std::string experiment_sql(const std::string& settings, int seed, int ended,
                           const std::string& result = "done") {
  return fmt::format(R"sql(
INSERT INTO run VALUES ('scenario','own'), ('profile','ideal'), ('seed',{}), ('result','{}'),
  ('version','0.1'), ('simulated_s',{}.0), ('ended_ns',{}000000000);
INSERT INTO agents VALUES (1,'m0','mote','p',0,0,0), (2,'m1','mote','p',3,4,0);
INSERT INTO settings VALUES ('name','own'), ('seed','{}'){};
)sql",
                     seed, result, ended, ended, seed, settings);
}

class ExperimentTest : public testing::Test {
 protected:
  ExperimentTest() : folder(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  void add(const std::string& name, const std::string& sql) {
    record::test::make_result(folder.path() / name, sql);
  }
  Experiment read() const { return experiment_of(find_results({folder.path()})); }

  Folder folder;
};

TEST_F(ExperimentTest, HasAPointPerSettingAndPoolsSeedsOnly) {
  add("a", experiment_sql(", ('agents.r.speed','0.5 m/s')", 1, 10));
  add("b", experiment_sql(", ('agents.r.speed','0.3 m/s')", 1, 20));
  add("c", experiment_sql(", ('agents.r.speed','0.5 m/s')", 2, 30));
  const Experiment experiment = read();
  ASSERT_EQ(experiment.points.size(), 2u);
  EXPECT_EQ(experiment.points[0].runs, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(experiment.points[1].runs, (std::vector<std::size_t>{1}));
  ASSERT_EQ(experiment.factors.size(), 1u);
  EXPECT_EQ(experiment.factors[0].key, "agents.r.speed");
  EXPECT_EQ(experiment.factors[0].unit, "m/s");
  EXPECT_EQ(experiment.points[1].levels[0].number, 0.3);
  EXPECT_EQ(experiment.label(1), "speed 0.3 m/s");
  EXPECT_EQ(experiment.values.at({"run.simulated", ""}).at(2), 30);
  EXPECT_EQ(experiment.runs[2].seed, 2u);
}

TEST_F(ExperimentTest, WhatIsForTheReportOnlyMakesNoSettingsOfItsOwn) {
  add("a", experiment_sql(", ('report.0.plot','run.simulated'), ('report.0.as','table')", 1, 10));
  add("b", experiment_sql(", ('compare','labella2009')", 2, 20));
  const Experiment experiment = read();
  EXPECT_EQ(experiment.points.size(), 1u);
  EXPECT_TRUE(experiment.factors.empty());
  ASSERT_EQ(experiment.requests.size(), 1u);
  EXPECT_EQ(experiment.requests[0].plot, "run.simulated");
  EXPECT_EQ(experiment.requests[0].as, sim::scenario::PlotKind::kTable);
}

// A profile sets many keys: they differ between the same runs, and one name for it is enough.
TEST_F(ExperimentTest, OfSettingsThatDifferTogetherTheProfileNamesThem) {
  add("a",
      experiment_sql(", ('radio.bits','1'), ('radio.profile','disk'), ('speed','1 m/s')", 1, 10));
  add("b",
      experiment_sql(", ('radio.bits','2'), ('radio.profile','ideal'), ('speed','1 m/s')", 1, 10));
  add("c",
      experiment_sql(", ('radio.bits','2'), ('radio.profile','ideal'), ('speed','2 m/s')", 1, 10));
  const Experiment experiment = read();
  ASSERT_EQ(experiment.factors.size(), 3u);
  EXPECT_EQ(experiment.factors[0].key, "radio.profile");
  EXPECT_EQ(experiment.factors[1].key, "radio.bits");
  EXPECT_EQ(experiment.factors[1].same_as, 0u);
  EXPECT_EQ(experiment.factors[2].key, "speed");
  EXPECT_EQ(experiment.label(2), "profile ideal, speed 2 m/s");
  EXPECT_FALSE(experiment.points[0].levels[0].number);
}

// Three settings that change together: no effect of one, and each can be the axis.
TEST_F(ExperimentTest, SettingsThatDifferTogetherAreAllNamedAndCanAllBeTheAxis) {
  add("a",
      experiment_sql(", ('--until','60 s'), ('radio.tx_power','1 mW'), ('speed','1 m/s')", 1, 10));
  add("b",
      experiment_sql(", ('--until','90 s'), ('radio.tx_power','2 mW'), ('speed','2 m/s')", 1, 20));
  const Experiment experiment = read();
  const std::string text = experiment_section(experiment);
  EXPECT_NE(text.find("\n  radio.tx_power: 2 values (changes together with speed, --until)\n"),
            std::string::npos)
      << text;
  const Plot plot = make_plot(experiment, {.plot = "run.simulated", .versus = "speed"});
  EXPECT_EQ(plot.x_label, "speed / m/s");
  EXPECT_EQ(plot.curves.size(), 1u);
  EXPECT_EQ(make_plot(experiment, {.plot = "run.simulated", .by = "speed"}).curves.size(), 2u);
}

std::string with_fingerprint(const std::string& sql) {
  return sql + "INSERT INTO run VALUES ('fingerprint','39f33e64d3cc8d56');";
}

TEST_F(ExperimentTest, CopiesOfARunAreNoReplications) {
  add("a", with_fingerprint(experiment_sql("", 1, 10)));
  add("b", with_fingerprint(experiment_sql("", 1, 10)));
  add("c", with_fingerprint(experiment_sql("", 2, 10)));
  std::filesystem::create_directory_symlink(folder.path() / "a", folder.path() / "d");
  const auto found = find_results({folder.path(), folder.path() / "d", folder.path() / "c"});
  EXPECT_EQ(found.size(), 3u);
  const Experiment experiment = experiment_of(found);
  EXPECT_EQ(experiment.runs.size(), 2u);
  ASSERT_EQ(experiment.left_out.size(), 1u);
  EXPECT_NE(experiment.left_out[0].find("b: same run as "), std::string::npos);
}

TEST_F(ExperimentTest, BrokenRunsAreNamedAndLeftOut) {
  add("a", experiment_sql("", 1, 10));
  add("b", experiment_sql("", 2, 10, "failed"));
  const Experiment experiment = read();
  EXPECT_EQ(experiment.runs.size(), 1u);
  ASSERT_EQ(experiment.left_out.size(), 1u);
  EXPECT_TRUE(experiment.left_out[0].ends_with("b: failed")) << experiment.left_out[0];
}

/// In a run with a topic of its own, messages were sent.
std::string with_topic(const std::string& sql, const std::string& topic) {
  std::string all = sql + "INSERT INTO countable VALUES ('messages.ends', '', 'delivered');";
  if (!topic.empty()) {
    all += fmt::format(
        "INSERT INTO messages VALUES (1, 1, 2, '{}', 1, 0, NULL, NULL, 'delivered', 0);", topic);
  }
  return all;
}

// Nobody knows of a topic before it comes up: what one run has, another of the same controllers
// could have had, and one of others not.
TEST_F(ExperimentTest, ATopicThatOneRunHasIsZeroInOthersOfTheSameControllers) {
  const std::string slow = ", ('agents.r.speed','0.3 m/s'), ('radio.loss','0')";
  add("a", with_topic(experiment_sql(slow, 1, 10), "call"));
  add("b", with_topic(experiment_sql(slow, 2, 10), ""));
  add("c",
      with_topic(experiment_sql(", ('agents.r.speed','0.3 m/s'), ('radio.loss','1')", 1, 10), ""));
  add("d",
      with_topic(experiment_sql(", ('agents.r.speed','0.5 m/s'), ('radio.loss','0')", 1, 10), ""));
  add("e", experiment_sql(slow, 3, 10));  // without a record of messages
  const Experiment experiment = read();
  const auto& sent = experiment.values.at({"topics.call.sent", ""});
  EXPECT_EQ(sent, (std::map<std::size_t, double>{{0, 1}, {1, 0}, {2, 0}}));
}

/// A run with a network whose writer of "scan", if it was announced, sent four samples.
std::string with_scan(const std::string& sql, bool is_announced) {
  std::string all = sql + "INSERT INTO countable VALUES ('dds.lost', '', 'collision');";
  if (is_announced)
    all +=
        "INSERT INTO dds_endpoints VALUES ('aa', 1, 'writer', 'scan', 't', 'reliable',"
        " 'volatile', 0), ('bb', 2, 'reader', 'scan', 't', 'reliable', 'volatile', 0);"
        "INSERT INTO sample_sums VALUES ('aa', 2, 4, 3, 2, 0, 1, 4, 400, 8000000);";
  return all;
}

// What was never announced was not sent to anyone; what share of it arrived, no one can say.
TEST_F(ExperimentTest, ATopicThatWasNotAnnouncedHasNoSamplesAndNoShare) {
  const std::string setting = ", ('agents.r.speed','0.3 m/s'), ('radio.loss','0')";
  add("a", with_scan(experiment_sql(setting, 1, 10), true));
  add("b", with_scan(experiment_sql(setting, 2, 10), false));
  add("c", experiment_sql(setting, 3, 10));  // without a record of samples
  const Experiment experiment = read();
  const auto of = [&](const char* name) { return experiment.values.at({name, ""}); };
  EXPECT_EQ(of("dds.scan.samples"), (std::map<std::size_t, double>{{0, 4}, {1, 0}}));
  EXPECT_EQ(of("dds.scan.lost.collision"), (std::map<std::size_t, double>{{0, 0}, {1, 0}}));
  EXPECT_EQ(of("dds.scan.delivered_share"), (std::map<std::size_t, double>{{0, 0.75}}));
}

/// A run in which so many requests were given up.
std::string with_given_up(const std::string& sql, int count) {
  std::string all = sql + "INSERT INTO countable VALUES ('requests', '', 'retry limit');";
  if (count > 0) {
    all += fmt::format("INSERT INTO requests VALUES (1, 2, 'retry limit', {});", count);
  }
  return all;
}

// 0, 4, 0, 0 and 9, 9, 12, 10: means 1 and 10, differences 9, 5, 12, 10.
TEST_F(ExperimentTest, AVerdictThatSomeRunsHaveIsAMeanOverAllOfThem) {
  const int counts[2][4] = {{0, 4, 0, 0}, {9, 9, 12, 10}};
  for (const int loss : {0, 1}) {
    for (int seed = 1; seed <= 4; ++seed) {
      add(fmt::format("{}{}", loss, seed),
          with_given_up(experiment_sql(fmt::format(", ('radio.loss','{}')", loss), seed, 10),
                        counts[loss][seed - 1]));
    }
  }
  const Experiment experiment = read();
  const Plot plot = make_plot(experiment, {.plot = "requests.retry_limit"});
  const Plot::Mark& mark = plot.curves.at(0).marks.at(0);
  EXPECT_EQ(mark.count, 4u);
  EXPECT_EQ(mark.y, 1);
  EXPECT_GT(mark.interval->low, 0);
  const std::string pairs = pairs_text(experiment, {.plot = "requests.retry_limit"});
  EXPECT_NE(pairs.find("loss 1       4           9"), std::string::npos) << pairs;
}

campaign::RunRow done(std::int64_t run, int point, int replication, std::uint64_t seed) {
  campaign::RunRow row;
  row.plan = {run, point, replication, seed};
  row.state = campaign::RunState::kDone;
  row.result = "done";
  return row;
}

TEST_F(ExperimentTest, ACampaignIsReadFromItsDatabase) {
  {
    campaign::CampaignDatabase database(folder.path());
    campaign::CampaignDatabase::Plan plan;
    plan.values = {{"report.0.plot", "x"}, {"report.0.versus", "speed"}};
    plan.factors = {{"agents.r.speed", "m/s"}};
    plan.points = {{1, "speed=1 m/s", "", {{"1 m/s", 1, true}}},
                   {2, "speed=2 m/s", "", {{"2 m/s", 2}}}};
    plan.runs = {{1, 1, 1, 7}, {2, 2, 1, 7}, {3, 2, 2, 8}};
    database.add(plan);
    campaign::Measured measured;
    measured.measurements = {{{"x", "s", ""}, 4.0}, {{"y", "m", "r0"}, std::nullopt}};
    measured.series = {{{"z", "m", "r0"}, {{0, 1}, {1, 2}}}};
    measured.histograms = {{{"h", "m", ""}, {{0, 1, 5}}}};
    database.finish(done(1, 1, 1, 7), measured);
    measured.measurements = {{{"x", "s", ""}, 6.0}};
    database.finish(done(2, 2, 1, 7), measured);
  }
  const Experiment experiment = experiment_of_campaign(folder.path());
  ASSERT_EQ(experiment.runs.size(), 2u);
  EXPECT_EQ(experiment.left_out, (std::vector<std::string>{"run 3: waiting"}));
  EXPECT_EQ(experiment.label(1), "speed 2 m/s");
  EXPECT_EQ(experiment.values.at({"x", ""}).at(1), 6);
  EXPECT_FALSE(experiment.values.contains({"y", "r0"}));
  EXPECT_EQ(experiment.series.at({"z", "r0"}).at(0).size(), 2u);
  EXPECT_EQ(experiment.bins.at({"h", ""}).at(0)[0].count, 5u);
  ASSERT_EQ(experiment.requests.size(), 1u);
  EXPECT_EQ(experiment.requests[0].versus, "speed");
  // The same seed at both points: one pair is no comparison, and nothing is said of it.
  const std::string text = experiment_section(experiment);
  EXPECT_NE(text.find("2 settings, 2 complete runs"), std::string::npos) << text;
  EXPECT_EQ(text.find("in pairs"), std::string::npos);
}

}  // namespace
}  // namespace results::report::test
