#include "hal/robot/platform/device_thread.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace hal::robot::platform {
namespace {

using namespace std::chrono_literals;

/// Answers as it is told to, and notes when it was asked.
class FakeDevice final : public Device {
 public:
  Result<void> connect() override {
    const std::scoped_lock lock(mutex_);
    attempts_.push_back(BootClock::now());
    return answer();
  }
  Result<void> work() override {
    ++works;
    return answer();
  }
  void on_lost() override { ++lost; }
  void leave() override { ++left; }

  std::vector<BootTime> attempts() const {
    const std::scoped_lock lock(mutex_);
    return attempts_;
  }

  std::atomic<bool> healthy{true};
  std::atomic<int> works{0}, lost{0}, left{0};

 private:
  Result<void> answer() const {
    if (healthy) return {};
    return fail(Errc::kProtocol, "it is ill");
  }

  mutable std::mutex mutex_;
  std::vector<BootTime> attempts_;
};

constexpr DeviceThread::Rules kRules{.period = 1ms, .late = {}, .silence = 10s};

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 4000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

TEST(DeviceThread, WorksAgainAndAgainAndLeavesAtTheEnd) {
  FakeDevice device;
  {
    const DeviceThread thread(device, kRules);
    EXPECT_TRUE(soon([&] { return device.works > 3; }));
    EXPECT_TRUE(thread.connected());
    EXPECT_EQ(thread.trouble(), "");
    EXPECT_EQ(thread.counts(), (DeviceCounts{.connections = 1}));
    EXPECT_EQ(device.left, 0);
  }
  EXPECT_EQ(device.left, 1);
}

TEST(DeviceThread, WaitsLongerAfterEachFailureToConnect) {
  FakeDevice device;
  device.healthy = false;
  DeviceThread thread(device, kRules);
  ASSERT_TRUE(soon([&] { return device.attempts().size() >= 4; }));
  EXPECT_FALSE(thread.connected());
  EXPECT_EQ(thread.trouble(), "it is ill");
  thread.finish();
  EXPECT_EQ(device.left, 0) << "nobody was there to say good-bye to";
  const auto attempts = device.attempts();
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_GE(attempts[i] - attempts[i - 1], 100ms * (1 << (i - 1)));
  }
}

TEST(DeviceThread, TellsTheDeviceThatItWasLostAndFindsItAgain) {
  FakeDevice device;
  const DeviceThread thread(device, kRules);
  ASSERT_TRUE(soon([&] { return thread.connected(); }));
  device.healthy = false;
  ASSERT_TRUE(soon([&] { return device.lost == 1; }));
  EXPECT_FALSE(thread.connected());
  device.healthy = true;
  ASSERT_TRUE(soon([&] { return thread.connected(); }));
  EXPECT_EQ(thread.counts().connections, 2U);
  EXPECT_GE(thread.counts().bad_answers, 1U);
  EXPECT_EQ(thread.counts().bad_answers, thread.counts().failures);
}

TEST(DeviceThread, WakesBeforeThePeriodIsOver) {
  FakeDevice device;
  DeviceThread thread(device, {.period = 1h, .late = {}, .silence = 2h});
  ASSERT_TRUE(soon([&] { return thread.connected(); }));
  EXPECT_EQ(device.works, 0);
  thread.wake();
  EXPECT_TRUE(soon([&] { return device.works == 1; }));
}

TEST(DeviceThread, ASilentDeviceCountsAsDisconnected) {
  FakeDevice device;
  const DeviceThread thread(device, {.period = 1h, .late = {}, .silence = 20ms});
  ASSERT_TRUE(soon([&] { return thread.counts().connections == 1; }));
  EXPECT_TRUE(soon([&] { return !thread.connected(); }));
  EXPECT_EQ(thread.trouble(), "silent for more than 0.02 s");
}

TEST(DeviceThread, CountsExchangesThatAreTooFarApart) {
  FakeDevice device;
  DeviceThread thread(device, {.period = 30ms, .late = 10ms, .silence = 10s});
  EXPECT_TRUE(soon([&] { return thread.counts().late_refresh >= 2; }));
}

/// Writes to somebody who has hung up.
class BrokenPipe final : public Device {
 public:
  Result<void> connect() override { return {}; }
  Result<void> work() override {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return fail(Errc::kProtocol, "no pipe");
    ::close(ends[0]);
    const bool failed = ::write(ends[1], "x", 1) < 0 && errno == EPIPE;
    ::close(ends[1]);
    if (failed) return fail(Errc::kNotConnected, "broken pipe");
    return fail(Errc::kProtocol, "written to nobody");
  }
};

TEST(DeviceThread, ADeviceThatHangsUpDoesNotEndTheProgram) {
  BrokenPipe device;
  const DeviceThread thread(device, kRules);
  ASSERT_TRUE(soon([&] { return thread.counts().failures > 0; }));
  EXPECT_EQ(thread.counts().bad_answers, 0U);
}

}  // namespace
}  // namespace hal::robot::platform
