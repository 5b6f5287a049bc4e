#include "gateway/run/wait_watch.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <thread>

namespace gateway {
namespace {

using namespace std::chrono_literals;

TEST(WaitWatch, KnowsOfASleepHowLongAgoItEndedAtMost) {
  WaitWatch watch;
  const auto begin = std::chrono::steady_clock::now();
  watch.before();
  std::this_thread::sleep_for(20ms);
  watch.after();
  const auto end = std::chrono::steady_clock::now();
  if (!watch.woken()) GTEST_SKIP() << "this system does not count how long threads are ready";
  EXPECT_GT(*watch.woken(), 0ns);
  constexpr auto kRounding = 1us;  // of clocks that are read one after the other
  EXPECT_LE(*watch.woken(), end - begin - 20ms + kRounding) << "for 20 ms at least it slept";
}

TEST(WaitWatch, DoesNotTakeALookForASleep) {
  WaitWatch watch;
  watch.before();
  ::poll(nullptr, 0, 0);
  watch.after();
  EXPECT_FALSE(watch.woken());
}

}  // namespace
}  // namespace gateway
