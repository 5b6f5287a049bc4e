#include "baraka/run/pace/wake_up_latency.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <thread>

namespace baraka::run::pace {
namespace {

using namespace std::chrono_literals;

TEST(WakeUpLatency, KnowsOfASleepHowLongAgoItEndedAtMost) {
  WakeUpLatency latency;
  const auto begin = std::chrono::steady_clock::now();
  latency.before_wait();
  std::this_thread::sleep_for(20ms);
  latency.after_wait();
  const auto end = std::chrono::steady_clock::now();
  if (!latency.at_most()) GTEST_SKIP() << "this system does not count how long threads are ready";
  EXPECT_GT(*latency.at_most(), 0ns);
  constexpr auto kRounding = 1us;  // of clocks that are read one after the other
  EXPECT_LE(*latency.at_most(), end - begin - 20ms + kRounding) << "for 20 ms at least it slept";
}

TEST(WakeUpLatency, DoesNotTakeALookForASleep) {
  WakeUpLatency latency;
  latency.before_wait();
  ::poll(nullptr, 0, 0);
  latency.after_wait();
  EXPECT_FALSE(latency.at_most());
}

}  // namespace
}  // namespace baraka::run::pace
