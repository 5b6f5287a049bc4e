#include "sim/core/event_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "hal/types/random.h"
#include "tests/support/printers.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using sim::EventQueue;
using sim::Rank;

class EventQueueTest : public testing::Test {
 protected:
  void note(Time at, Rank rank, std::uint16_t agent, const std::string& what) {
    ids_.push_back(queue_.schedule(at, rank, AgentId{agent}, [this, what] { seen_ += what; }));
  }
  void run_all() {
    while (queue_.next_time()) queue_.run_next();
  }

  EventQueue queue_;
  std::string seen_;
  std::vector<EventQueue::EventId> ids_;
};

TEST_F(EventQueueTest, RunsByTimeThenRankThenAgentThenCounter) {
  note(Time{2us}, Rank::kScenario, 1, "g");
  note(Time{1us}, Rank::kControl, 1, "f");
  note(Time{1us}, Rank::kRadio, 2, "d");
  note(Time{1us}, Rank::kRadio, 1, "b");
  note(Time{1us}, Rank::kRadio, 1, "c");
  note(Time{1us}, Rank::kNodeTimer, 1, "e");
  note(Time{1us}, Rank::kPhysics, 9, "a");
  run_all();
  EXPECT_EQ(seen_, "abcdefg");
  EXPECT_EQ(queue_.now(), Time{2us});
  EXPECT_EQ(queue_.executed(), 7u);
}

/// An agent's events at 1, 2, 3, … us, of which only the next one is in the queue, or none.
class Series {
 public:
  Series(EventQueue& queue, std::string& seen, std::uint16_t agent, int length)
      : queue_(queue), seen_(seen) {
    for (int i = 0; i < length; ++i) places_.push_back(queue.reserve(Rank::kRadio, AgentId{agent}));
    schedule();
  }

 private:
  Time due() const { return Time{1us} + next_ * 1us; }
  void schedule() {
    queue_.schedule(due(), places_[next_], [this] { work_off(); });
  }
  void work_off() {
    do {
      EXPECT_EQ(queue_.now(), due());
      seen_ += static_cast<char>('1' + next_);
      if (++next_ == places_.size()) return;
    } while (queue_.go_on(due(), places_[next_]));
    schedule();
  }

  EventQueue& queue_;
  std::string& seen_;
  std::vector<EventQueue::Place> places_;
  std::size_t next_ = 0;
};

TEST_F(EventQueueTest, ASeriesGoesOnOnlyWhileNothingComesBetween) {
  note(Time{3us}, Rank::kRadio, 5, "a");  // before, by its counter
  const Series series(queue_, seen_, 5, 6);
  note(Time{2us}, Rank::kRadio, 5, "c");  // after, by its counter
  note(Time{4us}, Rank::kRadio, 4, "d");  // before, by its agent
  note(Time{5us}, Rank::kControl, 1, "e");
  queue_.run_next(Time{4us});
  EXPECT_EQ(seen_, "12");
  EXPECT_EQ(queue_.executed(), 2u);
  while (queue_.next_time()) queue_.run_next(Time{10us});
  EXPECT_EQ(seen_, "12ca3d45e6");
  EXPECT_EQ(queue_.executed(), 10u);
}

TEST_F(EventQueueTest, ASeriesGoesNoFartherThanTheCallerLetsIt) {
  const Series series(queue_, seen_, 5, 6);
  queue_.run_next();
  EXPECT_EQ(seen_, "1");
  queue_.run_next(Time{4us});
  EXPECT_EQ(seen_, "1234");
  EXPECT_EQ(queue_.now(), Time{4us});
  EXPECT_EQ(queue_.next_time(), Time{5us});
  run_all();
  EXPECT_EQ(seen_, "123456");
}

TEST_F(EventQueueTest, OrderOfTwoAgentsDoesNotDependOnWhoScheduledFirst) {
  note(Time{1us}, Rank::kRadio, 7, "7");
  note(Time{1us}, Rank::kRadio, 3, "3");
  run_all();
  EXPECT_EQ(seen_, "37");
}

TEST_F(EventQueueTest, CancelledEventsNeverRunAndIdsDoNotComeBackToLife) {
  note(Time{1us}, Rank::kRadio, 1, "a");
  note(Time{2us}, Rank::kRadio, 1, "b");
  EventQueue::EventId copy = ids_[0];
  EXPECT_TRUE(queue_.cancel(ids_[0]));
  EXPECT_FALSE(queue_.cancel(ids_[0]));
  EXPECT_FALSE(queue_.cancel(copy));
  EXPECT_EQ(queue_.pending(), 1u);
  run_all();
  note(Time{3us}, Rank::kRadio, 1, "c");  // may reuse the slot of the cancelled one
  EXPECT_FALSE(queue_.cancel(copy));
  run_all();
  EXPECT_EQ(seen_, "bc");
}

TEST_F(EventQueueTest, AnEventIsNotPendingWhileItRuns) {
  EventQueue::EventId id;
  bool pending_inside = true;
  id = queue_.schedule(Time{1us}, Rank::kRadio, AgentId{1},
                       [&] { pending_inside = queue_.is_pending(id); });
  EXPECT_TRUE(queue_.is_pending(id));
  run_all();
  EXPECT_FALSE(pending_inside);
}

TEST_F(EventQueueTest, WhatAHandlerSchedulesNowRunsNowByRank) {
  queue_.schedule(Time{1us}, Rank::kRadio, AgentId{5}, [this] {
    note(queue_.now(), Rank::kControl, 1, "z");
    note(queue_.now(), Rank::kRadio, 9, "y");
    seen_ += "x";
  });
  run_all();
  EXPECT_EQ(seen_, "xyz");
}

TEST_F(EventQueueTest, HandlersAreDestroyedOnceWhetherRunCancelledOrLeft) {
  const auto token = std::make_shared<int>(0);
  {
    EventQueue queue;
    for (int i = 0; i < 3; ++i) {
      auto id = queue.schedule(Time{1us}, Rank::kRadio, AgentId{1}, [token] { ++*token; });
      if (i == 1) queue.cancel(id);
    }
    queue.run_next();
    EXPECT_EQ(token.use_count(), 2);
  }
  EXPECT_EQ(token.use_count(), 1);
  EXPECT_EQ(*token, 1);
}

// Against an independent definition: sort all keys, and compare the order of execution.
TEST_F(EventQueueTest, TenThousandRandomEventsRunInSortedOrderWithHalfOfThemCancelled) {
  hal::RandomStream random(1, "queue");
  std::vector<std::tuple<std::int64_t, int, int, int>> expected, seen;
  std::vector<int> counters(8, 0);
  for (int i = 0; i < 10'000; ++i) {
    const auto at = static_cast<std::int64_t>(random.below(500));
    const int rank = static_cast<int>(random.below(6));
    const auto agent = static_cast<std::uint16_t>(random.below(8));
    const std::tuple key{at, rank, int{agent}, counters[agent]++};
    auto id = queue_.schedule(hal::time_from_ns(at), static_cast<Rank>(rank), AgentId{agent},
                              [&seen, key] { seen.push_back(key); });
    if (random.below(2) == 0) {
      queue_.cancel(id);
    } else {
      expected.push_back(key);
    }
  }
  std::sort(expected.begin(), expected.end());
  run_all();
  EXPECT_EQ(seen, expected);
}

/// A queue beside an independent one, a sorted set, that must agree on what comes next.
class BesideASet {
 public:
  explicit BesideASet(std::uint64_t seed) : random_(seed, "queue") {}

  void schedule(std::int64_t delay) {
    const std::int64_t at = hal::to_ns(queue_.now()) + delay;
    const auto agent = static_cast<std::uint16_t>(random_.below(4));
    const Key key{at, agent, counters_.at(agent)++};
    pending_.emplace(key, queue_.schedule(hal::time_from_ns(at), Rank::kRadio, AgentId{agent},
                                          [this, key] { seen_ = key; }));
  }

  void cancel_any() {
    const auto from = static_cast<std::int64_t>(random_.below(2'000'000));
    auto victim = pending_.lower_bound({hal::to_ns(queue_.now()) + from, 0, 0});
    if (victim == pending_.end()) return;
    EXPECT_TRUE(queue_.cancel(victim->second));
    pending_.erase(victim);
  }

  /// Delays of all magnitudes from 1 ns to an hour, and many equal ones.
  std::int64_t any_delay() {
    if (random_.below(4) == 0) return 1000;
    return std::int64_t{random_.below(1'000'000)} << random_.below(22) >> random_.below(20);
  }

  void run_one() {
    const Key expected = pending_.begin()->first;
    pending_.erase(pending_.begin());
    queue_.run_next();
    ASSERT_EQ(seen_, expected);
    ASSERT_EQ(queue_.pending(), pending_.size());
  }

  bool empty() const { return pending_.empty(); }
  hal::RandomStream& random() { return random_; }

 private:
  using Key = std::tuple<std::int64_t, int, int>;

  EventQueue queue_;
  hal::RandomStream random_;
  std::map<Key, EventQueue::EventId> pending_;
  std::array<int, 4> counters_{};
  Key seen_{};
};

class EventQueuePhases : public testing::TestWithParam<int> {};

// Grows to some thousand events, shrinks to none, and again: near, far and in between.
TEST_P(EventQueuePhases, AgreesWithASortedSetWhileItGrowsShrinksAndCancels) {
  BesideASet both(static_cast<std::uint64_t>(GetParam()));
  for (const std::uint64_t growth : {8, 1, 6, 0, 3, 9, 0}) {  // of ten steps, those that schedule
    for (int i = 0; i < 6000; ++i) {
      if (both.random().below(10) < growth) {
        both.schedule(both.any_delay());
      } else if (both.random().below(4) == 0) {
        both.cancel_any();
      } else if (!both.empty()) {
        both.run_one();
      }
    }
  }
  while (!both.empty()) both.run_one();
}

INSTANTIATE_TEST_SUITE_P(Seeds, EventQueuePhases, testing::Values(1, 2, 3));

// What is scheduled first reaches far; all that comes later is before it.
TEST(EventQueueGrowth, AgreesWithASortedSetIfTheFirstEventIsTheLast) {
  BesideASet both(1);
  both.schedule(1'000'000'000'000);
  both.schedule(1);
  both.run_one();
  for (int i = 0; i < 5000; ++i) both.schedule(both.any_delay() % 1'000'000);
  for (int i = 0; i < 5000; ++i) {
    both.run_one();
    both.schedule(both.any_delay() % 1'000'000);
    both.cancel_any();
  }
  while (!both.empty()) both.run_one();
}

// Timeouts that hardly ever come to pass, near and far: cancelled ones soon outnumber the others.
TEST(EventQueueTimeouts, AgreesWithASortedSetIfMostEventsAreCancelled) {
  BesideASet both(2);
  for (int i = 0; i < 100; ++i) both.schedule(1000);
  for (int i = 0; i < 5000; ++i) {
    both.run_one();
    both.schedule(both.any_delay() % 100'000);
    for (int k = 0; k < 5; ++k) {
      both.schedule(1'000'000 + both.any_delay() % 1'000'000);
      both.cancel_any();
    }
  }
  while (!both.empty()) both.run_one();
}

// An event's slot serves the next one at once; the id of the first must not reach the second.
TEST_F(EventQueueTest, AnIdDoesNotReachTheEventThatCameAfterItsOwn) {
  const auto owned = std::make_shared<int>(0);
  for (int i = 0; i < 10; ++i) {
    auto plain = queue_.schedule(Time{2us}, Rank::kRadio, AgentId{1}, [this] { seen_ += "p"; });
    auto plain_copy = plain;
    EXPECT_TRUE(queue_.cancel(plain));
    auto owner = queue_.schedule(Time{1us}, Rank::kRadio, AgentId{1}, [owned] { ++*owned; });
    auto owner_copy = owner;
    EXPECT_FALSE(queue_.cancel(plain_copy));
    EXPECT_TRUE(queue_.is_pending(owner));
    EXPECT_TRUE(queue_.cancel(owner));
    EXPECT_FALSE(queue_.is_pending(owner_copy));
    EXPECT_EQ(owned.use_count(), 1);
  }
  EXPECT_EQ(queue_.pending(), 0u);
  EXPECT_FALSE(queue_.next_time());
  EXPECT_EQ(seen_, "");
}

TEST_F(EventQueueTest, TakesTheLastTimeThereIs) {
  note(Time::max(), Rank::kRadio, 1, "b");
  note(Time::max(), Rank::kControl, 1, "c");
  note(Time{1us}, Rank::kRadio, 1, "a");
  run_all();
  EXPECT_EQ(seen_, "abc");
}

TEST_F(EventQueueTest, SchedulingInThePastStopsTheProgram) {
  queue_.advance_to(Time{2us});
  EXPECT_DEATH(note(Time{1us}, Rank::kRadio, 1, "a"), "check failed: at >= now_");
}

}  // namespace
