#include "controllers/ros_base/diagnostics.h"

#include <gtest/gtest.h>

#include "tests/unit/gateway/runtime/one_agent.h"
#include "tests/unit/gateway/runtime/scripted.h"

namespace {

using diagnostic_msgs::msg::dds_::DiagnosticStatus_;
using hal::node::exchange::Event;

/// The statuses after a control cycle with these readings.
class DiagnosticsOfARobot : public testing::Test {
 protected:
  std::vector<DiagnosticStatus_> after(std::vector<hal::node::exchange::Reading> readings,
                                       const std::string& state) {
    Event event = robot_.event(hal::node::exchange::ControlDue{});
    event.readings = std::move(readings);
    state_ = state;
    robot_.feed(std::move(event));
    return told_;
  }
  const DiagnosticStatus_& of(const std::vector<DiagnosticStatus_>& all, const std::string& task) {
    const auto found = std::ranges::find_if(
        all, [&](const DiagnosticStatus_& one) { return one.name() == "ros_base: " + task; });
    BARAKA_CHECK(found != all.end());
    return *found;
  }

 private:
  hal::ControllerKind kind() {
    tests::Scripted::next() = {.step = [this](hal::Robot& robot) {
      diagnostics_.observe(robot);
      told_ = diagnostics_.statuses(robot, state_, 3);
    }};
    return tests::Scripted::kind();
  }

  controllers::Diagnostics diagnostics_{"ros_base"};
  std::vector<DiagnosticStatus_> told_;
  std::string state_;
  const hal::ControllerKind kind_ = kind();
  tests::OneAgent robot_{kind_, tests::robot_session()};
};

TEST_F(DiagnosticsOfARobot, AChannelWithoutAReadingIsStaleWithTheReason) {
  constexpr std::uint16_t kOdometry = 2, kBattery = 3;
  auto all = after({{kOdometry, {0, 0, 0, 0, 0, 0}}}, "waiting");
  EXPECT_EQ(of(all, "odometry").level(), 0);
  EXPECT_EQ(of(all, "battery").level(), 3);
  EXPECT_EQ(of(all, "battery").message(), "channel 'battery' has not been sampled yet");
  EXPECT_EQ(of(all, "odometry").hardware_id(), "r0");
  all = after({{kBattery, {1, 12, 0.5, 1, 1}}}, "waiting");
  EXPECT_EQ(of(all, "battery").level(), 0);
  EXPECT_EQ(of(all, "odometry").values().at(0).value(), "2");
  EXPECT_EQ(of(all, "battery").values().at(0).value(), "1");
  all = after({{.channel = kBattery, .values = {}, .lost = true}}, "waiting");
  EXPECT_EQ(of(all, "battery").level(), 3);
  EXPECT_NE(of(all, "battery").message().find("is lost"), std::string::npos);
  EXPECT_EQ(of(all, "battery").values().at(0).value(), "1");
}

TEST_F(DiagnosticsOfARobot, CommandsThatStayAwayAreAWarning) {
  EXPECT_EQ(of(after({}, "driving"), "commands").level(), 0);
  const auto stopped = of(after({}, "stopped"), "commands");
  EXPECT_EQ(stopped.level(), 1);
  EXPECT_EQ(stopped.message(), "stopped");
  EXPECT_EQ(stopped.values().at(0).value(), "3");
}

}  // namespace
