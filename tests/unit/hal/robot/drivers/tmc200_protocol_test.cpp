#include "hal/robot/drivers/tmc200_protocol.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/node/devices/wheel_drive.h"
#include "hal/types/math.h"
#include "tests/unit/hal/robot/drivers/three_wheels.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

node::devices::RobotDescription robot() {
  node::devices::RobotDescription robot;
  robot.wheels = three_wheels();
  return robot;
}

Tmc200Settings settings(bool inverted = false) {
  Tmc200Settings settings;
  settings.motor = {500, 16, 120 * math::kPi, inverted};
  settings.cut_off = 200ms;
  return settings;
}

TEST(Tmc200Protocol, SetsTheControllerUp) {
  // 2 pi 40 mm / (16 * 1000) = 15.708 um per step: 31 half micrometres
  EXPECT_EQ(Tmc200Protocol(settings(), robot()).set_up(),
            (std::vector<std::string>{"SMODE 1 \n", "SMZNM 20 \n", "SENCO M1 1000 3600 31 \n",
                                      "SENCO M2 1000 3600 31 \n", "SENCO M3 1000 3600 31 \n",
                                      "SSEND 1 \n"}));
}

TEST(Tmc200Protocol, SpeedsAreFractionsOfTheFullScale) {
  // Full scale at the wheel: 120 pi / 16 = 23.562 rad/s.
  const Tmc200Protocol protocol(settings(), robot());
  EXPECT_EQ(protocol.set_speeds({120 * math::kPi / 16, 0, -60 * math::kPi / 16}),
            "SV 1024 0 -512 \n");
  EXPECT_EQ(protocol.set_speeds({1000, -1000, 0.0231}), "SV 1024 -1024 1 \n");
}

TEST(Tmc200Protocol, ABodyVelocityBecomesWhatThreeOmniwheelsNeed) {
  // Forward at 0.3 m/s: wheel i turns at -sin(bearing) v / r: -6.495, 0, 6.495 rad/s.
  const node::devices::WheelDrive wheels(robot().wheels);
  const Tmc200Protocol protocol(settings(), robot());
  EXPECT_EQ(protocol.set_speeds(wheels.wheel_speeds({0.3, 0, 0})), "SV -282 0 282 \n");
  // Turning at 1 rad/s: all at 0.132 / 0.04 = 3.3 rad/s.
  EXPECT_EQ(protocol.set_speeds(wheels.wheel_speeds({0, 0, 1})), "SV 143 143 143 \n");
}

TEST(Tmc200Protocol, MotorsWiredTheOtherWayRoundChangeTheSignBothWays) {
  const Tmc200Protocol protocol(settings(true), robot());
  EXPECT_EQ(protocol.set_speeds({120 * math::kPi / 16, 0, 0}), "SV -1024 0 0 \n");
  EXPECT_NEAR(protocol.measured("V -1024 0 512 ")->front(), 120 * math::kPi / 16, 1e-12);
}

TEST(Tmc200Protocol, MeasuredSpeedsAreReadWhateverFollows) {
  const Tmc200Protocol protocol(settings(), robot());
  for (const std::string line :
       {"V 1024 -512 0", "V 1024 -512 0 ", "V 1024 -512 0 \t C 1 2 3 \t x 4 \t dT 5"}) {
    const auto speeds = protocol.measured(line);
    ASSERT_TRUE(speeds) << line << ": " << speeds.error().message;
    EXPECT_NEAR((*speeds)[0], 7.5 * math::kPi, 1e-12);
    EXPECT_NEAR((*speeds)[1], -3.75 * math::kPi, 1e-12);
    EXPECT_EQ((*speeds)[2], 0);
  }
}

TEST(Tmc200Protocol, OtherLinesAreNoAnswerToSv) {
  const Tmc200Protocol protocol(settings(), robot());
  for (const std::string line :
       {"", "V", "V ", "V 1 2", "V 1 2 x", "V 1 2 3x", "V 1.5 2 3", "v 1 2 3", "OK", " V 1 2 3",
        "V 1 2 99999", "V 1 2 99999999999999999999", "VV 1 2 3"}) {
    const auto speeds = protocol.measured(line);
    ASSERT_FALSE(speeds) << line;
    EXPECT_EQ(speeds.error().code, Errc::kProtocol);
  }
  EXPECT_TRUE(Tmc200Protocol::is_ok("OK \r"));
  EXPECT_FALSE(Tmc200Protocol::is_ok("NOK"));
}

}  // namespace
}  // namespace hal::robot::drivers
