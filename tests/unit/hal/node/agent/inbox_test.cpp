#include "hal/node/agent/inbox.h"

#include <gtest/gtest.h>

#include "tests/support/printers.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::agent::Inbox;
using hal::node::exchange::Cause;
using hal::node::exchange::Event;

Event event(Time at, Cause cause, hal::TimerId mark = 0) {
  Event e;
  e.time = at;
  e.cause = cause;
  e.timer = mark;
  return e;
}

hal::RouteChange route(std::uint16_t next_hop) {
  return {{"help", AgentId{9}, AgentId{next_hop}, {}}, false};
}

std::vector<Event> taken(Inbox& inbox) {
  std::vector<Event> events;
  inbox.take(events);
  return events;
}

TEST(Inbox, TakenEventsFollowThoseThatAreThere) {
  Inbox one, another;
  one.add(event(Time{2s}, Cause::kControl, 1));
  another.add(event(Time{1s}, Cause::kControl, 3));
  another.add(event(Time{1s}, Cause::kMessage, 2));
  std::vector<Event> events;
  one.take(events);
  another.take(events);
  ASSERT_EQ(events.size(), 3u);
  for (hal::TimerId i = 0; i < 3; ++i) EXPECT_EQ(events[i].timer, i + 1);
}

TEST(Inbox, OrdersByTimeThenCauseThenArrival) {
  Inbox inbox;
  inbox.add(event(Time{2s}, Cause::kStart, 5));
  inbox.add(event(Time{1s}, Cause::kControl, 4));
  inbox.add(event(Time{1s}, Cause::kNotice, 3));
  inbox.add(event(Time{1s}, Cause::kMessage, 1));
  inbox.add(event(Time{1s}, Cause::kMessage, 2));
  const auto events = taken(inbox);
  ASSERT_EQ(events.size(), 5u);
  for (hal::TimerId i = 0; i < 5; ++i) EXPECT_EQ(events[i].timer, i + 1);
  EXPECT_TRUE(inbox.empty());
}

TEST(Inbox, ChangesTravelWithTheFirstEventThatIsNotBeforeThem) {
  Inbox inbox;
  inbox.add(Time{1s}, route(1));
  inbox.add(event(Time{1s}, Cause::kControl));
  inbox.add(Time{1500ms}, route(2));
  inbox.add(event(Time{2s}, Cause::kControl));
  inbox.add(Time{3s}, route(3));
  auto events = taken(inbox);
  ASSERT_EQ(events.size(), 2u);
  ASSERT_EQ(events[0].routes.size(), 1u);
  EXPECT_EQ(events[0].routes[0], route(1));
  ASSERT_EQ(events[1].routes.size(), 1u);
  EXPECT_EQ(events[1].routes[0], route(2));

  inbox.add(event(Time{4s}, Cause::kControl));
  events = taken(inbox);
  ASSERT_EQ(events[0].routes.size(), 1u) << "a change after the last event waits for the next";
  EXPECT_EQ(events[0].routes[0], route(3));
}

TEST(Inbox, ANeighbourHeardOftenIsReportedOnceAsHeardLast) {
  Inbox inbox;
  inbox.add(Time{1ms}, hal::Neighbour{AgentId{4}, Time{1ms}, -50});
  inbox.add(Time{2ms}, hal::Neighbour{AgentId{3}, Time{2ms}, -60});
  inbox.add(Time{3ms}, hal::Neighbour{AgentId{4}, Time{3ms}, -55});
  inbox.add(event(Time{1s}, Cause::kControl));
  const auto events = taken(inbox);
  const std::vector<hal::Neighbour> expected{{AgentId{3}, Time{2ms}, -60},
                                             {AgentId{4}, Time{3ms}, -55}};
  EXPECT_EQ(events[0].neighbours, expected);
}

TEST(Inbox, OfANeighbourAnEventHasTheLastWord) {
  Inbox inbox;
  const hal::Neighbour heard{AgentId{4}, Time{1s}, -50};
  inbox.add_lost(Time{1s}, AgentId{4});
  inbox.add(Time{1s}, heard);
  inbox.add(Time{1s}, hal::Neighbour{AgentId{5}, Time{1s}, -50});
  inbox.add_lost(Time{1s}, AgentId{5});
  inbox.add(event(Time{1s}, Cause::kLink));
  const auto events = taken(inbox);
  EXPECT_EQ(events[0].neighbours, std::vector{heard});
  EXPECT_EQ(events[0].lost_neighbours, std::vector{AgentId{5}});
}

}  // namespace
