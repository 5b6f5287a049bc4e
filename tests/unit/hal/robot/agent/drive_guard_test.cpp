#include "hal/robot/agent/drive_guard.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/fake_clock.h"
#include "tests/unit/hal/robot/agent/fakes.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTimeout = 400ms;

class Guarded : public testing::Test {
 protected:
  void run_for(Duration time) {
    const Time end = loop_.now() + time;
    while (loop_.now() < end) loop_.run_once(end - loop_.now());
  }

  tests::FakeClock clock_;
  platform::EventLoop loop_{clock_};
  RecordedWheels wheels_{drivers::SpeedLimits(0.5, 1.0)};
  DriveGuard guard_{wheels_, loop_, kTimeout, "r0"};
};

TEST_F(Guarded, ACommandWithinTheLimitsGoesThroughAsItIs) {
  ASSERT_TRUE(guard_.drive({0.3, -0.4, 1.0}, loop_.now()));
  EXPECT_EQ(wheels_.twist, (Twist2{0.3, -0.4, 1.0}));
  EXPECT_EQ(guard_.counts().limited, 0u);
}

TEST_F(Guarded, ACommandBeyondTheOperatorsLimitIsScaledAndKeepsItsDirection) {
  ASSERT_TRUE(guard_.drive({0.6, 0.8, 0.5}, loop_.now()));  // 1 m/s where 0.5 are allowed
  EXPECT_DOUBLE_EQ(wheels_.twist.vx, 0.3);
  EXPECT_DOUBLE_EQ(wheels_.twist.vy, 0.4);
  EXPECT_DOUBLE_EQ(wheels_.twist.omega, 0.25);
  EXPECT_EQ(guard_.counts().limited, 1u);
}

TEST_F(Guarded, WheelSpeedsMoveTheBody) {
  ASSERT_TRUE(guard_.drive_wheels(std::vector<double>{1, 1, 1}, loop_.now()));
  // All wheels alike turn it in place: omega = radius * speed / distance.
  EXPECT_NEAR(wheels_.twist.omega, 0.04 / 0.132, 1e-12);
  EXPECT_NEAR(wheels_.twist.vx, 0, 1e-12);
}

TEST_F(Guarded, TheWheelsStopWhenTheControllerHasBeenSilentForTheTimeout) {
  guard_.feed(loop_.now());
  ASSERT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
  run_for(kTimeout - 1ns);
  EXPECT_NE(wheels_.twist, Twist2{});
  run_for(1ns);
  EXPECT_EQ(wheels_.twist, Twist2{});
  EXPECT_EQ(guard_.counts().silences, 1u);
}

TEST_F(Guarded, AnswersKeepTheWheelsTurning) {
  guard_.feed(loop_.now());
  ASSERT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
  for (int i = 0; i < 30; ++i) {
    run_for(kTimeout - 1ns);
    guard_.feed(loop_.now());
  }
  EXPECT_EQ(wheels_.twist, (Twist2{0.1, 0, 0}));
}

TEST_F(Guarded, TheDriverLearnsHowOldACommandIs) {
  const Time then = loop_.now();
  run_for(5ms);
  guard_.feed(then);
  EXPECT_EQ(wheels_.kept, loop_.on_boot_clock(then));
  ASSERT_TRUE(guard_.drive({0.1, 0, 0}, then + 1ms));
  EXPECT_EQ(wheels_.as_of, loop_.on_boot_clock(then + 1ms));
}

TEST_F(Guarded, AnEmergencyStopOutranksEveryCommandUntilItIsReleased) {
  ASSERT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
  guard_.set_emergency_stop(true);
  EXPECT_EQ(wheels_.twist, Twist2{}) << "at once, before the loop runs";
  EXPECT_EQ(guard_.drive({0.2, 0, 0}, loop_.now()).error().code, Errc::kNotAvailable);
  EXPECT_TRUE(guard_.drive({}, loop_.now()));
  run_for(1ms);
  EXPECT_EQ(wheels_.twist, Twist2{});
  EXPECT_EQ(guard_.counts().stopped, 1u);
  guard_.set_emergency_stop(false);
  run_for(1ms);
  EXPECT_EQ(wheels_.twist, Twist2{}) << "released, not resumed";
  guard_.feed(loop_.now());
  EXPECT_TRUE(guard_.drive({0.2, 0, 0}, loop_.now()));
  EXPECT_EQ(wheels_.twist, (Twist2{0.2, 0, 0}));
}

TEST_F(Guarded, AnEmergencyStopIsInForceUntilEachSourceHasReleasedIt) {
  guard_.set_emergency_stop(true, StopSource::kOperator);
  guard_.set_emergency_stop(true, StopSource::kTopic);
  guard_.set_emergency_stop(false, StopSource::kTopic);
  EXPECT_TRUE(guard_.is_emergency_stopped());
  EXPECT_FALSE(guard_.drive({0.1, 0, 0}, loop_.now()));
  guard_.set_emergency_stop(false, StopSource::kOperator);
  EXPECT_FALSE(guard_.is_emergency_stopped());
  EXPECT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
}

TEST_F(Guarded, ACommandThatTheDriverRefusesStopsWhatItRepeats) {
  ASSERT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
  wheels_.reachable = false;
  EXPECT_FALSE(guard_.drive({}, loop_.now()));
  EXPECT_EQ(wheels_.twist, Twist2{});
}

TEST_F(Guarded, AnEmergencyStopFromAnotherThreadNeverLosesToACommand) {
  for (int i = 0; i < 200; ++i) {
    std::thread button([&] { guard_.set_emergency_stop(true); });
    while (!guard_.is_emergency_stopped()) (void)guard_.drive({0.1, 0, 0}, loop_.now());
    button.join();
    ASSERT_EQ(wheels_.twist, Twist2{}) << "trial " << i;
    guard_.set_emergency_stop(false);
  }
}

TEST_F(Guarded, ABlindRobotStands) {
  ASSERT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
  guard_.set_blind("dust");
  EXPECT_EQ(wheels_.twist, Twist2{});
  EXPECT_FALSE(guard_.drive({0.1, 0, 0}, loop_.now()));
  EXPECT_EQ(guard_.counts().blind, 1u);
  guard_.set_blind({});
  EXPECT_TRUE(guard_.drive({0.1, 0, 0}, loop_.now()));
}

TEST_F(Guarded, ACommandThatTheDriverCannotPassOnIsCounted) {
  wheels_.reachable = false;
  EXPECT_EQ(guard_.drive({0.1, 0, 0}, loop_.now()).error().code, Errc::kNotConnected);
  EXPECT_EQ(guard_.counts().not_connected, 1u);
}

TEST(DriveGuard, LeavesTheWheelsStanding) {
  platform::EventLoop loop;
  RecordedWheels wheels;
  {
    DriveGuard guard(wheels, loop, 1s, "r0");
    ASSERT_TRUE(guard.drive({0.1, 0, 0}, loop.now()));
  }
  EXPECT_EQ(wheels.twist, Twist2{});
}

}  // namespace
}  // namespace hal::robot::agent
