#include "results/campaign/extension.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/files/config/errors.h"
#include "tests/unit/results/record/test_run.h"

namespace results::campaign {
namespace {

WantedRuns wanted(const std::vector<std::string>& speeds, int replications) {
  WantedRuns runs;
  runs.values = {
      {"version", "1.0"}, {"until", "60 s"}, {"replications", std::to_string(replications)}};
  runs.factors = {{"a.speed", "m/s"}};
  for (const std::string& speed : speeds) {
    runs.points.push_back({static_cast<int>(runs.points.size()) + 1,
                           "speed=" + speed,
                           "speed: " + speed + "\n",
                           {{speed, 1.0}}});
  }
  runs.replications = replications;
  runs.base_seed = 5;
  return runs;
}

class Extensions : public testing::Test {
 protected:
  Extension extend(const WantedRuns& runs) {
    CampaignReader reader(folder_.path());
    Extension result = extension(runs, reader);
    database_.add(result.plan);
    return result;
  }
  void end_run(std::int64_t number) {
    RunRow row;
    row.plan = {.run = number};
    row.state = RunState::kDone;
    database_.finish(row, {});
  }
  std::string refused(const WantedRuns& runs) {
    CampaignReader reader(folder_.path());
    try {
      extension(runs, reader);
    } catch (const hal::files::config::ConfigErrors& errors) {
      return errors.what();
    }
    return "accepted";
  }

 private:
  record::test::Folder folder_{"extension"};
  CampaignDatabase database_{folder_.path()};
};

TEST_F(Extensions, TheSameAgainAddsNothing) {
  EXPECT_EQ(extend(wanted({"1", "2"}, 3)).plan.runs.size(), 6U);
  const Extension again = extend(wanted({"1", "2"}, 3));
  EXPECT_TRUE(again.plan.runs.empty());
  EXPECT_TRUE(again.plan.points.empty());
  EXPECT_EQ(again.said, "");
}

TEST_F(Extensions, RunsOfOtherProgramsAreNotMixed) {
  const auto with = [](const char* programs) {
    WantedRuns runs = wanted({"1"}, 2);
    runs.values.emplace_back("programs", programs);
    return runs;
  };
  extend(wanted({"1"}, 2));  // of a version that did not say
  extend(with("baraka 1, mine 2"));
  EXPECT_EQ(refused(with("baraka 1, mine 3")), "accepted") << "none of its runs counts yet";
  end_run(1);
  EXPECT_THAT(refused(with("baraka 1, mine 3")),
              testing::HasSubstr("programs: there 'baraka 1, mine 2', now 'baraka 1, mine 3'"));
  EXPECT_EQ(refused(with("baraka 1, mine 2")), "accepted");
}

TEST_F(Extensions, MoreReplicationsAndPointsAreAddedAndWhatWasThereKeepsItsNumber) {
  extend(wanted({"1", "2"}, 2));
  EXPECT_EQ(extend(wanted({"1", "2"}, 3)).said, "2 more runs");
  const Extension more = extend(wanted({"0.5", "1", "2"}, 3));  // a value before the others
  EXPECT_EQ(more.said, "1 more point, 3 more runs");
  ASSERT_EQ(more.plan.points.size(), 1U);
  EXPECT_EQ(more.plan.points[0].point, 3);
  EXPECT_EQ(more.plan.runs[0].run, 7);
  EXPECT_EQ(more.plan.runs[2].seed, 7U);
}

TEST_F(Extensions, WithoutAPaceTheRunsAreInLockStep) {
  extend(wanted({"1"}, 1));
  WantedRuns other = wanted({"1"}, 1);
  other.values.emplace_back("pace", "lockstep");
  extend(other);
  other.values.back().second = "realtime";
  EXPECT_THAT(refused(other), testing::HasSubstr("pace: there 'lockstep', now 'realtime'"));
}

TEST_F(Extensions, AnyOtherChangeIsRefusedByName) {
  extend(wanted({"1", "2"}, 2));
  EXPECT_THAT(refused(wanted({"1"}, 2)), testing::HasSubstr("point 2 there, speed=2"));
  EXPECT_THAT(refused(wanted({"1", "2"}, 1)), testing::HasSubstr("replications: there 2, now 1"));
  WantedRuns other = wanted({"1", "2"}, 2);
  other.values[1].second = "90 s";
  EXPECT_THAT(refused(other), testing::HasSubstr("until: there '60 s', now '90 s'"));
  other = wanted({"1", "2"}, 2);
  other.points[1].scenario = "speed: 2\nmore: 1\n";
  EXPECT_THAT(refused(other),
              testing::HasSubstr("another scenario (speed=2): there '', now 'more: 1'"));
  other = wanted({"1", "2"}, 2);
  other.factors[0].key = "b.speed";
  EXPECT_THAT(refused(other),
              testing::HasSubstr("there a.speed [m/s] is varied, now b.speed [m/s]"));
  other = wanted({"1", "2"}, 1);
  other.may_be_fewer = true;
  EXPECT_EQ(refused(other), "accepted");
}

TEST_F(Extensions, WhatNoRunDependsOnMayChangeAndIsKept) {
  WantedRuns runs = wanted({"1", "2"}, 2);
  runs.essence = [](const std::string& text) { return text.substr(0, text.find("report")); };
  extend(runs);
  runs.points[1].scenario += "report: []\n";
  runs.replications = 3;
  const Extension more = extend(runs);
  EXPECT_EQ(more.said, "2 more runs");
  ASSERT_EQ(more.plan.rewritten.size(), 1U);
  EXPECT_EQ(more.plan.rewritten[0].point, 2);
  EXPECT_TRUE(extend(runs).plan.rewritten.empty());  // it is the database's now
  runs.points[1].scenario = "speed: 3\nreport: []\n";
  EXPECT_THAT(refused(runs), testing::HasSubstr("there 'speed: 2', now 'speed: 3'"));
}

}  // namespace
}  // namespace results::campaign
