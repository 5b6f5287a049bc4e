#include "hal/node/agent/inbox.h"

#include <gtest/gtest.h>

#include "tests/support/printers.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::agent::Inbox;
using hal::node::exchange::ControlDue;
using hal::node::exchange::Event;
using hal::node::exchange::LinkChanged;
using hal::node::exchange::MessageArrived;
using hal::node::exchange::Notice;
using hal::node::exchange::Start;

/// @param mark  to know it again by.
Event event(Time at, Event::What what, std::uint16_t mark = 0) {
  Event e;
  e.agent = AgentId{mark};
  e.time = at;
  e.what = std::move(what);
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
  one.add(event(Time{2s}, ControlDue{}, 1));
  another.add(event(Time{1s}, ControlDue{}, 3));
  another.add(event(Time{1s}, MessageArrived{}, 2));
  std::vector<Event> events;
  one.take(events);
  another.take(events);
  ASSERT_EQ(events.size(), 3u);
  for (std::uint16_t i = 0; i < 3; ++i) EXPECT_EQ(events[i].agent.value, i + 1);
}

TEST(Inbox, MemoryIsUsedAgainWithoutWhatWasInIt) {
  for (std::uint16_t round = 0; round < 100; ++round) {
    std::vector<Inbox> inboxes(round % 7 + 1u);
    for (Inbox& inbox : inboxes) {
      for (std::uint16_t i = 0; i < round; ++i) inbox.add(event(Time{1s}, ControlDue{}, i));
    }
    for (Inbox& inbox : inboxes) {
      const auto events = taken(inbox);
      ASSERT_EQ(events.size(), round);
      for (std::uint16_t i = 0; i < round; ++i) EXPECT_EQ(events[i].agent.value, i);
      EXPECT_TRUE(taken(inbox).empty());
    }
  }
}

TEST(Inbox, OrdersByTimeThenCauseThenArrival) {
  Inbox inbox;
  inbox.add(event(Time{2s}, Start{}, 5));
  inbox.add(event(Time{1s}, ControlDue{}, 4));
  inbox.add(event(Time{1s}, Notice{}, 3));
  inbox.add(event(Time{1s}, MessageArrived{}, 1));
  inbox.add(event(Time{1s}, MessageArrived{}, 2));
  const auto events = taken(inbox);
  ASSERT_EQ(events.size(), 5u);
  for (std::uint16_t i = 0; i < 5; ++i) EXPECT_EQ(events[i].agent.value, i + 1);
  EXPECT_TRUE(inbox.empty());
}

TEST(Inbox, ChangesTravelWithTheFirstEventThatIsNotBeforeThem) {
  Inbox inbox;
  inbox.add(Time{1s}, route(1));
  inbox.add(event(Time{1s}, ControlDue{}));
  inbox.add(Time{1500ms}, route(2));
  inbox.add(event(Time{2s}, ControlDue{}));
  inbox.add(Time{3s}, route(3));
  auto events = taken(inbox);
  ASSERT_EQ(events.size(), 2u);
  ASSERT_EQ(events[0].routes.size(), 1u);
  EXPECT_EQ(events[0].routes[0], route(1));
  ASSERT_EQ(events[1].routes.size(), 1u);
  EXPECT_EQ(events[1].routes[0], route(2));

  inbox.add(event(Time{4s}, ControlDue{}));
  events = taken(inbox);
  ASSERT_EQ(events[0].routes.size(), 1u) << "a change after the last event waits for the next";
  EXPECT_EQ(events[0].routes[0], route(3));
}

TEST(Inbox, ANeighbourHeardOftenIsReportedOnceAsHeardLast) {
  Inbox inbox;
  inbox.add(Time{1ms}, hal::Neighbour{AgentId{4}, Time{1ms}, -50});
  inbox.add(Time{2ms}, hal::Neighbour{AgentId{3}, Time{2ms}, -60});
  inbox.add(Time{3ms}, hal::Neighbour{AgentId{4}, Time{3ms}, -55});
  inbox.add(event(Time{1s}, ControlDue{}));
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
  inbox.add(event(Time{1s}, LinkChanged{}));
  const auto events = taken(inbox);
  EXPECT_EQ(events[0].neighbours, std::vector{heard});
  EXPECT_EQ(events[0].lost_neighbours, std::vector{AgentId{5}});
}

}  // namespace
