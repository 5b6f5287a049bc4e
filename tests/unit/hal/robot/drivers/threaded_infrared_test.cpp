#include "hal/robot/drivers/threaded_infrared.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

/// What the device of a test does, and counts.
struct Script {
  std::atomic<bool> is_there{true}, measures{true};
  std::atomic<int> connections{0}, measurements{0};
};

class ScriptedArray final : public InfraredDevice {
 public:
  explicit ScriptedArray(Script& script) : script_(script) {}

  Result<void> connect() override {
    if (!script_.is_there) return fail(Errc::kNotConnected, "no cable");
    ++script_.connections;
    return {};
  }
  Result<InfraredReadings> measure() override {
    if (!script_.measures) return fail(Errc::kProtocol, "nonsense");
    const int number = ++script_.measurements;
    return InfraredReadings{.metres = {0.1 * number}, .volts = {0.5}, .stamp = {}};
  }

 private:
  Script& script_;
};

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 10'000 && !condition(); ++i) std::this_thread::sleep_for(2ms);
  return condition();
}

constexpr DeviceTimes kLooksOften{.period = 1ms, .timeout = 1s, .stale_after = 10s};

TEST(ThreadedInfrared, MeasuresAgainAndAgainAndGivesTheLastReadings) {
  const platform::BootTime before = platform::BootClock::now();
  Script script;
  const ThreadedInfrared driver(std::make_unique<ScriptedArray>(script), kLooksOften);
  ASSERT_TRUE(soon([&] { return script.measurements >= 3 && driver.latest(); }));
  EXPECT_EQ(script.connections, 1);
  EXPECT_TRUE(driver.connected());
  EXPECT_GE(driver.latest()->stamp, before);
  const double metres = driver.latest()->metres.at(0);
  EXPECT_TRUE(soon([&] { return driver.latest()->metres.at(0) > metres; }));
}

TEST(ThreadedInfrared, WithoutADeviceThereIsNoReadingAndItIsLookedForAgain) {
  Script script;
  script.is_there = false;
  const ThreadedInfrared driver(std::make_unique<ScriptedArray>(script), kLooksOften);
  ASSERT_TRUE(soon([&] { return driver.trouble() == "no cable"; }));
  EXPECT_EQ(driver.latest().error().code, Errc::kNotConnected);
  script.is_there = true;
  EXPECT_TRUE(soon([&] { return driver.latest().has_value(); }));
}

TEST(ThreadedInfrared, AFailedMeasurementIsCountedAndTheDeviceReachedAnew) {
  Script script;
  const ThreadedInfrared driver(std::make_unique<ScriptedArray>(script), kLooksOften);
  ASSERT_TRUE(soon([&] { return driver.latest().has_value(); }));
  script.measures = false;
  ASSERT_TRUE(soon([&] { return driver.counts().bad_answers > 0; }));
  EXPECT_FALSE(driver.connected());
  EXPECT_TRUE(driver.latest()) << "the last reading is not too old yet";
  script.measures = true;
  EXPECT_TRUE(soon([&] { return driver.connected(); }));
  EXPECT_GE(script.connections, 2);
}

}  // namespace
}  // namespace hal::robot::drivers
