#include "results/campaign/campaign_database.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "results/campaign/campaign_reader.h"
#include "results/campaign/schema.h"
#include "tests/unit/results/record/test_run.h"

namespace results::campaign {
namespace {

using record::test::Folder;

CampaignDatabase::Plan two_points() {
  return {.values = {{"name", "speeds"}, {"replications", "2"}},
          .factors = {{"agents.robots.controller.parameters.speed", "m/s"}, {"radio.profile", ""}},
          .points = {{1, "speed=30 cm/s", "version: 1\n", {{"30 cm/s", 0.3}, {"disk", {}}}},
                     {2, "speed=1 m/s", "version: 1\n", {{"1 m/s", 1.0}, {"disk", {}}}}},
          .runs = {{1, 1, 1, 7}, {2, 1, 2, 8}, {3, 2, 1, 7}, {4, 2, 2, 8}}};
}

RunRow ended(std::int64_t run) {
  RunRow row;
  row.plan.run = run;
  row.state = RunState::kDone;
  row.result = "arrived";
  row.expectations_met = true;
  row.fingerprint = "39f33e64d3cc8d56";
  row.simulated_s = 12.5;
  row.wall_s = 0.25;
  row.host = "here";
  row.ended = "2026-11-22T20:31:14Z";
  return row;
}

Measured two_values() {
  return {.measurements = {{{"delay.mean", "s", ""}, 0.25}, {{"energy", "J", "r1"}, std::nullopt}},
          .series = {{{"queue", "", "m0"}, {{0.0, 1.0}, {1.0, 3.0}}}},
          .histograms = {{{"delay", "s", ""}, {{0, 1, 5}, {1, 2, 7}}}}};
}

TEST(CampaignDatabase, ReadsBackWhatWasPlanned) {
  const Folder folder("campaign_database");
  {
    CampaignDatabase database(folder.path());
    EXPECT_TRUE(database.is_empty());
    database.add(two_points());
    EXPECT_FALSE(database.is_empty());
  }
  CampaignReader reader(folder.path());
  EXPECT_EQ(reader.value("name"), "speeds");
  EXPECT_EQ(reader.value("no such key"), "");
  ASSERT_EQ(reader.factors().size(), 2U);
  EXPECT_EQ(reader.factors()[0].unit, "m/s");
  const auto points = reader.points();
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].levels[0], (Level{"1 m/s", 1.0}));
  EXPECT_EQ(points[0].levels[1], (Level{"disk", std::nullopt}));
  const auto runs = reader.runs();
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[3].plan.point, 2);
  EXPECT_EQ(runs[3].plan.seed, 8U);
  EXPECT_EQ(runs[3].state, RunState::kWaiting);
  EXPECT_EQ(reader.count_rows().at("levels"), 4);
}

TEST(CampaignDatabase, ARunThatEndsIsThereWithWhatItMeasured) {
  const Folder folder("campaign_database");
  CampaignDatabase database(folder.path());
  database.add(two_points());
  database.start(std::array<std::int64_t, 2>{1, 3}, "2026-11-22T20:31:13Z");
  database.finish(ended(3), two_values());
  CampaignReader reader(folder.path());
  const auto runs = reader.runs();
  EXPECT_EQ(runs[0].state, RunState::kRunning);
  EXPECT_EQ(runs[2].state, RunState::kDone);
  EXPECT_EQ(runs[2].attempts, 1);
  EXPECT_EQ(runs[2].started, "2026-11-22T20:31:13Z");
  EXPECT_EQ(runs[2].expectations_met, true);
  EXPECT_EQ(runs[2].wall_s, 0.25);
  EXPECT_EQ(runs[2].user_s, std::nullopt);
  EXPECT_EQ(reader.count_rows().at("measurements"), 2);
  record::Statement value = reader.query(
      "SELECT value FROM measurements JOIN observables USING (observable) WHERE name = 'energy'");
  ASSERT_TRUE(value.next());
  EXPECT_TRUE(value.is_null(0));
}

TEST(CampaignDatabase, ARunThatIsDoneAgainLeavesNothingOfItsFirstResult) {
  const Folder folder("campaign_database");
  CampaignDatabase database(folder.path());
  database.add(two_points());
  database.finish(ended(3), two_values());
  database.finish(ended(3), two_values());
  EXPECT_EQ(CampaignReader(folder.path()).count_rows().at("measurements"), 2);
  database.reset(std::array<std::int64_t, 1>{3});
  CampaignReader reader(folder.path());
  EXPECT_EQ(reader.runs()[2].state, RunState::kWaiting);
  EXPECT_EQ(reader.runs()[2].result, "");
  for (const char* table : {"measurements", "series", "bins"}) {
    EXPECT_EQ(reader.count_rows().at(table), 0) << table;
  }
}

TEST(CampaignDatabase, AValueThatIsNoNumberIsNotDefined) {
  const Folder folder("campaign_database");
  CampaignDatabase database(folder.path());
  database.add(two_points());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  database.finish(ended(1), {{{{"ratio", "", ""}, nan}}, {}, {}});
  CampaignReader reader(folder.path());
  record::Statement value = reader.query("SELECT value FROM measurements");
  ASSERT_TRUE(value.next());
  EXPECT_TRUE(value.is_null(0));
}

TEST(CampaignDatabase, WhatCannotBeWrittenIsNotThereAtAll) {
  const Folder folder("campaign_database");
  CampaignDatabase database(folder.path());
  database.add(two_points());
  EXPECT_THROW(database.add(two_points()), std::runtime_error);  // these points are there
  EXPECT_EQ(CampaignReader(folder.path()).factors().size(), 2U);
  database.finish(ended(1), two_values());  // and it can be used
  EXPECT_EQ(CampaignReader(folder.path()).count_rows().at("series"), 2);
}

TEST(CampaignDatabase, AWriterThatIsKilledLeavesWholeRunsOnly) {
  const Folder folder("campaign_database");
  { CampaignDatabase(folder.path()).add(two_points()); }
  for (int attempt = 0; attempt < 5; ++attempt) {
    const pid_t writer = ::fork();
    if (writer == 0) {
      CampaignDatabase database(folder.path());
      for (std::int64_t run = 1;; run = run % 4 + 1) database.finish(ended(run), two_values());
    }
    ::usleep(static_cast<useconds_t>(7'000 * (attempt + 1)));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    CampaignReader reader(folder.path());
    record::Statement broken = reader.query(
        "SELECT COUNT(*) FROM runs WHERE (SELECT COUNT(*) FROM measurements m WHERE m.run = "
        "runs.run) <> CASE state WHEN 'done' THEN 2 ELSE 0 END");
    ASSERT_TRUE(broken.next());
    EXPECT_EQ(broken.integer(0), 0);
  }
}

TEST(CampaignDatabase, AnotherVersionIsRefused) {
  const Folder folder("campaign_database");
  { CampaignDatabase(folder.path()).add(two_points()); }
  {
    record::Database database(folder.path() / kCampaignDatabase, record::Database::Mode::kUpdate);
    database.execute("PRAGMA user_version = 77");
  }
  EXPECT_THROW(CampaignReader{folder.path()}, std::runtime_error);
  EXPECT_THROW(CampaignDatabase{folder.path()}, std::runtime_error);
}

TEST(CampaignReader, TellsACampaignFromReplications) {
  const Folder folder("replications");
  { CampaignDatabase(folder.path()).add(two_points()); }
  EXPECT_TRUE(CampaignReader::is_campaign(folder.path()));
  std::ofstream(folder.path() / kReplicationsFile) << "version: 1\n";
  EXPECT_FALSE(CampaignReader::is_campaign(folder.path()));
  EXPECT_TRUE(CampaignReader::has_database(folder.path()));
}

TEST(CampaignReader, NeedsTheFile) {
  const Folder folder("campaign_database");
  EXPECT_FALSE(CampaignReader::is_campaign(folder.path()));
  EXPECT_THROW(CampaignReader{folder.path()}, std::runtime_error);
}

}  // namespace
}  // namespace results::campaign
