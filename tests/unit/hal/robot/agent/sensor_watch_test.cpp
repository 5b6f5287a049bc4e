#include "hal/robot/agent/sensor_watch.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/robot/drivers/robotino.h"
#include "hal/types/log.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;

std::vector<std::string> said;

void remember(log::Level, Time, std::string_view, std::string_view text) {
  said.emplace_back(text);
}

class SensorWatchTest : public testing::Test {
 protected:
  void SetUp() override {
    log::set_level(log::Level::kInfo);
    log::set_sink(remember);
    said.clear();
    file_.wheels =
        std::make_shared<drivers::ChosenDriver<drivers::WheelDriver, drivers::RobotinoSettings>>(
            drivers::RobotinoSettings{}, drivers::make_robotino_wheels);
    watch_.look({}, {});
  }
  ~SensorWatchTest() override {
    log::set_sink([](log::Level, Time, std::string_view, std::string_view) {});
  }

  static std::vector<SilentDevice> silent(bool wanted) { return {{"odometry", "cable", wanted}}; }

  RobotFile file_;
  SensorWatch watch_{file_};
};

TEST_F(SensorWatchTest, TellsOnceWhatIsLostAndOnceThatItIsBack) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(watch_.look({}, silent(true)), "no odometry: cable");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(watch_.look({}, {}), "");
  EXPECT_EQ(said,
            (std::vector<std::string>{"odometry: lost (cable); the wheels stand until it is back",
                                      "odometry: back"}));
}

TEST_F(SensorWatchTest, LeavesTheWheelsAloneIfNobodyAskedForIt) {
  EXPECT_EQ(watch_.look({}, silent(false)), "");
  EXPECT_EQ(said, (std::vector<std::string>{"odometry: lost (cable)"}));
}

TEST_F(SensorWatchTest, LeavesTheWheelsAloneIfTheFileSaysSo) {
  file_.on_lost_sensor = OnLostSensor::kIgnore;
  EXPECT_EQ(watch_.look({}, silent(true)), "");
  EXPECT_EQ(said, (std::vector<std::string>{
                      "odometry: lost (cable); on_lost_sensor is 'ignore': the wheels may turn"}));
}

TEST_F(SensorWatchTest, WhatWasNeverHeardIsNotLostButStopsTheWheels) {
  SensorWatch fresh(file_);
  EXPECT_EQ(fresh.look({}, silent(true)), "no odometry: cable");
  fresh.look({}, {});
  EXPECT_TRUE(said.empty());
  fresh.look({}, silent(true));
  EXPECT_EQ(said.size(), 1u);
}

}  // namespace
}  // namespace hal::robot::agent
