#include "hal/robot/drivers/threaded_wheels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/unit/hal/robot/drivers/three_wheels.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

constexpr Twist2 kAhead{0.1, 0, 0};
constexpr Duration kTimeout = 300ms;

TEST(VelocityCommand, IsInForceForItsTimeAndThenZero) {
  VelocityCommand command(kTimeout);
  const platform::BootTime start{1h};
  EXPECT_EQ(command.current().velocity.at(start), Twist2{});
  command.set(kAhead, start);
  EXPECT_EQ(command.current().velocity.at(start + kTimeout - 1ns), kAhead);
  EXPECT_EQ(command.current().velocity.at(start + kTimeout), Twist2{});
}

TEST(VelocityCommand, IsKeptUnlessItHadRunOut) {
  VelocityCommand command(kTimeout);
  const platform::BootTime start{1h};
  command.set(kAhead, start);
  command.keep(start + kTimeout / 2);
  EXPECT_EQ(command.current().velocity.at(start + kTimeout), kAhead);
  command.keep(start);  // said earlier, heard later
  EXPECT_EQ(command.current().velocity.at(start + kTimeout), kAhead);
  command.keep(start + 2 * kTimeout);
  EXPECT_EQ(command.current().velocity.at(start + 2 * kTimeout), Twist2{});
  command.set(kAhead, start + 3 * kTimeout);
  command.stop();
  command.keep(start + 3 * kTimeout);
  EXPECT_EQ(command.current().velocity.at(start + 3 * kTimeout), Twist2{});
}

/// What the device was told, and a thread that can be held up on its way to it.
struct Told {
  std::vector<Twist2> velocities() const {
    const std::scoped_lock lock(mutex);
    return all;
  }
  mutable std::mutex mutex;
  std::vector<Twist2> all;
  /// Between the look at the clock and the write, as by a suspension. Once.
  std::atomic<bool> sleeps_before_writing = false;
};

class ToldWheels final : public WheelDevice {
 public:
  explicit ToldWheels(Told& told) : told_(told) {}
  Result<void> connect() override { return {}; }
  Result<Sent> send(const TimedVelocity& velocity) override {
    const Twist2 body = velocity.at(platform::BootClock::now());
    if (body != Twist2{} && told_.sleeps_before_writing.exchange(false)) {
      std::this_thread::sleep_for(2 * kTimeout);
    }
    const std::scoped_lock lock(told_.mutex);
    told_.all.push_back(body);
    return Sent{.body = body, .confirmed = true};
  }
  Result<WheelState> state(const platform::DeviceThread&) const override {
    return fail(Errc::kNotAvailable, "none");
  }

 private:
  Told& told_;
};

class ThreadedWheelsTest : public testing::Test {
 protected:
  std::unique_ptr<ThreadedWheels> wheels(Duration period) {
    auto wheels = std::make_unique<ThreadedWheels>(
        std::make_unique<ToldWheels>(told_),
        ThreadedWheels::Setup{node::devices::WheelDrive(three_wheels()),
                              {},
                              kTimeout,
                              {.period = period, .late = {}, .silence = 1h}});
    EXPECT_TRUE(until([&] { return wheels->connected(); }));
    return wheels;
  }
  template <class Condition>
  static bool until(Condition condition) {
    for (int i = 0; i < 10'000 && !condition(); ++i) std::this_thread::sleep_for(2ms);
    return condition();
  }

  Told told_;
};

TEST_F(ThreadedWheelsTest, ACommandRunsOutByItself) {
  const auto driver = wheels(10ms);
  ASSERT_TRUE(driver->drive(kAhead, hal::robot::platform::BootClock::now()));
  ASSERT_TRUE(until([&] {
    const auto told = told_.velocities();
    return !told.empty() && told.back() == kAhead;
  }));
  EXPECT_TRUE(until([&] { return told_.velocities().back() == Twist2{}; }));
}

TEST_F(ThreadedWheelsTest, ACommandThatIsOldAlreadyIsNeverSent) {
  const auto driver = wheels(10ms);
  ASSERT_TRUE(driver->drive(kAhead, hal::robot::platform::BootClock::now() - kTimeout));
  ASSERT_TRUE(until([&] { return told_.velocities().size() > 5; }));
  for (const Twist2& velocity : told_.velocities()) EXPECT_EQ(velocity, Twist2{});
}

TEST_F(ThreadedWheelsTest, OneThatRanOutOnItsWayIsFollowedByZeroAtOnce) {
  told_.sleeps_before_writing = true;
  const auto driver = wheels(1h);  // the next regular word would come much later
  ASSERT_TRUE(driver->drive(kAhead, hal::robot::platform::BootClock::now()));
  ASSERT_TRUE(until([&] { return told_.velocities().size() >= 2; }));
  EXPECT_EQ(told_.velocities(), (std::vector<Twist2>{kAhead, {}}));
}

}  // namespace
}  // namespace hal::robot::drivers
