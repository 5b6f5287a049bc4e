#include "view/server/recorded.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/scenario/scenario.h"
#include "tests/unit/view/server/small_result.h"

namespace view::server::test {
namespace {

class Recorded : public testing::Test {
 protected:
  Recorded() : result(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  /// What the page gets of a record with these settings.
  json recorded(const std::vector<std::pair<std::string, std::string>>& settings) {
    result.recorder->add_settings(settings);
    result.end(1'000'000'000);
    server::Run run(result.path());
    return ask(run, "world").at("recorded");
  }

  SmallResult result;
};

TEST_F(Recorded, TheRecordTellsItsPosePeriodInAnyUnit) {
  const json found = recorded({{"record.frames", "all"}, {"record.pose_period", "1234567 ns"}});
  EXPECT_EQ(found["frames"], "all");
  EXPECT_EQ(found["messages"], "none");
  EXPECT_EQ(found["poses_period_ns"], 1'234'567);
}

TEST_F(Recorded, WhatItDoesNotTellIsNotZero) {
  EXPECT_EQ(recorded({})["poses_period_ns"], nullptr);
}

TEST_F(Recorded, APeriodInAnUnknownUnitIsRefused) {
  try {
    (void)recorded({{"record.pose_period", "5 blinks"}});
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("record.pose_period"), std::string::npos) << said;
    EXPECT_NE(said.find("5 blinks"), std::string::npos) << said;
  }
}

TEST(RecordedOfAScenario, IsThatOfTheScenario) {
  sim::scenario::Scenario scenario;
  scenario.name = "plan";
  scenario.simulation = results::record::test::small_config();
  scenario.record.pose_period = hal::Duration{1'234'567};
  scenario.record.readings = sim::scenario::Detail::kSample;
  server::Run run("plan.yaml", scenario, {});
  const json world = ask(run, "world");
  EXPECT_EQ(world["recorded"]["poses_period_ns"], 1'234'567);
  EXPECT_EQ(world["recorded"]["readings"], "ranges");
  const auto lacks_poses = [](const json& of) {
    return of["missing"].dump().find("poses ten times a second") != std::string::npos;
  };
  EXPECT_FALSE(lacks_poses(world));
  scenario.record.pose_period = 1s;
  server::Run rare("plan.yaml", scenario, {});
  EXPECT_TRUE(lacks_poses(ask(rare, "world")));
}

}  // namespace
}  // namespace view::server::test
