#include "hal/robot/agent/loop_watch.h"

#include <gtest/gtest.h>

#include "tests/unit/hal/robot/agent/fakes.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLimit = 100ms;

TEST(LoopWatch, StopsTheWheelsWhileTheLoopHangs) {
  platform::EventLoop loop;
  RecordedWheels wheels;
  const LoopWatch watch(loop, wheels, kLimit);
  ASSERT_TRUE(wheels.drive({0.1, 0, 0}, hal::robot::platform::BootClock::now()));
  loop.schedule(loop.now(), [&] {
    for (int i = 0; i < 500 && watch.hangs() == 0; ++i) std::this_thread::sleep_for(10ms);
  });
  loop.run_once(1s);
  EXPECT_EQ(watch.hangs(), 1u);
  EXPECT_GE(wheels.stops, 1);
  EXPECT_EQ(wheels.twist, Twist2{});
}

TEST(LoopWatch, LeavesALoopThatWorksAlone) {
  platform::EventLoop loop;
  RecordedWheels wheels;
  const LoopWatch watch(loop, wheels, 10 * kLimit);
  const Time end = loop.now() + kLimit;
  while (loop.now() < end) loop.run_once(end - loop.now());
  EXPECT_EQ(wheels.stops, 0);
}

}  // namespace
}  // namespace hal::robot::agent
