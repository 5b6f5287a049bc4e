#include "hal/robot/platform/event_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <future>
#include <thread>
#include <vector>

#include "hal/robot/platform/signal_thread.h"
#include "tests/support/fake_clock.h"

namespace hal::robot::platform {
namespace {

using namespace std::chrono_literals;

TEST(EventLoop, TimersRunByTimeAndThenByOrderOfScheduling) {
  tests::FakeClock clock;
  EventLoop loop(clock);
  std::vector<int> order;
  const Time now = loop.now();
  loop.schedule(now + 300ms, [&] { loop.stop(); });
  loop.schedule(now + 200ms, [&] { order.push_back(2); });
  loop.schedule(now + 100ms, [&] { order.push_back(0); });
  loop.schedule(now + 100ms, [&] { order.push_back(1); });
  loop.run();
  EXPECT_EQ(order, (std::vector{0, 1, 2}));
  EXPECT_EQ(loop.now(), now + 300ms);
}

TEST(EventLoop, ACancelledTimerDoesNotRun) {
  EventLoop loop;
  bool ran = false;
  const auto handle = loop.schedule(loop.now() + 1ms, [&] { ran = true; });
  loop.schedule(loop.now() + 2ms, [&] { loop.stop(); });
  loop.cancel(handle);
  loop.cancel(handle);
  loop.run();
  EXPECT_FALSE(ran);
}

TEST(EventLoop, ATimerThatSetsAnotherOneInThePastLeavesDescriptorsTheirTurn) {
  EventLoop loop;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  bool readable = false;
  int rounds = 0;
  std::function<void()> again = [&] {
    if (++rounds < 1000 && !readable) loop.schedule(Time{}, again);
  };
  loop.schedule(Time{}, again);
  loop.watch(ends[0], [&] { readable = true, loop.stop(); });
  loop.run();
  EXPECT_LT(rounds, 1000);
  close(ends[0]), close(ends[1]);
}

TEST(EventLoop, AHandlerMayTakeAwayTheDescriptorOfAnother) {
  EventLoop loop;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  int calls = 0;
  EventLoop::Watch first = 0, second = 0;
  const auto take_both_away = [&] {
    ++calls;
    loop.unwatch(first);
    loop.unwatch(second);
  };
  first = loop.watch(ends[0], take_both_away);
  second = loop.watch(ends[0], take_both_away);
  loop.run_once(1s);
  loop.run_once(Duration::zero());
  EXPECT_EQ(calls, 1);
  close(ends[0]), close(ends[1]);
}

TEST(EventLoop, SeveralMayWatchOneDescriptor) {
  EventLoop loop;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  int first = 0, second = 0;
  loop.watch(ends[0], [&] { ++first; });
  loop.watch(ends[0], [&] { ++second; });
  loop.run_once(1s);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
  close(ends[0]), close(ends[1]);
}

TEST(EventLoop, WhatAnotherThreadPostsRunsInTheLoop) {
  EventLoop loop;
  std::thread::id ran_in;
  std::thread other([&] {
    loop.post([&] {
      ran_in = std::this_thread::get_id();
      loop.stop();
    });
  });
  loop.run();
  other.join();
  EXPECT_EQ(ran_in, std::this_thread::get_id());
}

TEST(EventLoop, SignalsComeOneByOneAndEndNothing) {
  EventLoop loop;
  std::vector<int> taken;
  loop.on_signals({SIGTERM, SIGUSR1}, [&](int signal) {
    taken.push_back(signal);
    if (taken.size() == 2) loop.stop();
  });
  kill(getpid(), SIGTERM);
  kill(getpid(), SIGUSR1);
  loop.run();
  EXPECT_EQ(taken.size(), 2u);
  EXPECT_NE(taken[0], taken[1]);
}

TEST(SignalThread, HeedsItsSignalsWhateverTheLoopIsDoing) {
  block_signals({SIGUSR1, SIGUSR2});
  kill(getpid(), SIGUSR1);  // It waits until it is asked for.
  std::promise<int> first, second;
  EventLoop loop;
  loop.schedule(loop.now(), [&] {
    SignalThread thread({SIGUSR1, SIGUSR2}, [&](int signal) {
      (signal == SIGUSR1 ? first : second).set_value(signal);
    });
    EXPECT_EQ(first.get_future().get(), SIGUSR1);
    kill(getpid(), SIGUSR2);
    EXPECT_EQ(second.get_future().get(), SIGUSR2);
    loop.stop();
  });
  loop.run();
}

}  // namespace
}  // namespace hal::robot::platform
