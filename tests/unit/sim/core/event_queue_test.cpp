#include "sim/core/event_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
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

TEST_F(EventQueueTest, SchedulingInThePastStopsTheProgram) {
  queue_.advance_to(Time{2us});
  EXPECT_DEATH(note(Time{1us}, Rank::kRadio, 1, "a"), "check failed: at >= now_");
}

}  // namespace
