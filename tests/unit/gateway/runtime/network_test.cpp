#include <gtest/gtest.h>

#include "tests/unit/gateway/runtime/one_agent.h"
#include "tests/unit/gateway/runtime/scripted.h"

namespace {

using hal::AgentId;
using hal::node::exchange::LinkChanged;
using tests::Scripted;

hal::RouteChange change(const char* topic, std::uint16_t destination, std::uint16_t next_hop,
                        std::uint16_t hops) {
  return {.route = {.topic = topic,
                    .destination = AgentId{destination},
                    .next_hop = AgentId{next_hop},
                    .path = {.hops = hops}}};
}

hal::RouteChange removal(const char* topic, std::uint16_t destination, std::uint16_t next_hop) {
  return {.route = change(topic, destination, next_hop, 0).route, .removed = true};
}

/// (next hop, hops) of every route to a destination, after the changes of some events.
class Routes : public testing::Test {
 protected:
  using Hops = std::vector<std::pair<int, int>>;

  void learn(std::vector<hal::RouteChange> changes) {
    auto event = agent_->event(LinkChanged{});
    event.routes = std::move(changes);
    EXPECT_TRUE(agent_->feed(event).empty());
  }

  Hops to(const char* topic, std::uint16_t destination) {
    question_ = [=, this](hal::Robot& robot) {
      answer_.clear();
      for (const auto& route : robot.network().routes(topic, AgentId{destination})) {
        answer_.emplace_back(route.next_hop.value, route.path.hops);
      }
    };
    agent_->control();
    return answer_;
  }

  void invalidate(const char* topic, std::uint16_t destination) {
    question_ = [=](hal::Robot& robot) {
      EXPECT_TRUE(robot.network().invalidate(topic, AgentId{destination}).has_value());
    };
    agent_->control();
  }

  void SetUp() override {
    Scripted::next() = {.step = [this](hal::Robot& robot) { question_(robot); }};
    agent_ = std::make_unique<tests::OneAgent>(Scripted::kind(), tests::robot_session());
  }

  std::unique_ptr<tests::OneAgent> agent_;
  std::function<void(hal::Robot&)> question_;
  Hops answer_;
};

TEST_F(Routes, AreListedByNextHop) {
  learn({change("help", 9, 5, 2), change("help", 9, 3, 4), change("help", 8, 1, 1)});
  EXPECT_EQ(to("help", 9), (Hops{{3, 4}, {5, 2}}));
  EXPECT_EQ(to("help", 8), (Hops{{1, 1}}));
  EXPECT_TRUE(to("help", 7).empty());
}

TEST_F(Routes, ChangeAndGoEntryByEntry) {
  learn({change("help", 9, 3, 4), change("help", 9, 5, 2)});
  learn({change("help", 9, 3, 6), removal("help", 9, 5)});
  EXPECT_EQ(to("help", 9), (Hops{{3, 6}}));
}

TEST_F(Routes, OfTopicsNotAskedForAreEmpty) {
  learn({change("video", 9, 3, 4)});
  EXPECT_TRUE(to("video", 9).empty());
}

TEST_F(Routes, AreForgottenAtOnceWhenInvalidated) {
  learn({change("help", 9, 3, 4), change("help", 8, 3, 3)});
  invalidate("help", 9);
  EXPECT_TRUE(to("help", 9).empty());
  EXPECT_EQ(to("help", 8), (Hops{{3, 3}}));
}

TEST_F(Routes, RefuseToInvalidateATopicWithoutAName) {
  question_ = [](hal::Robot& robot) {
    EXPECT_EQ(robot.network().invalidate("", AgentId{9}).error().code, hal::Errc::kInvalidArgument);
  };
  EXPECT_EQ(tests::texts<hal::node::exchange::Log>(agent_->control()),
            std::vector<std::string>{"r0: invalidate: topic '' has 0 bytes, 1 to 32 are allowed"});
}

TEST_F(Routes, NeighboursAreListedByAddressUpdatedAndLost) {
  auto event = agent_->event(LinkChanged{});
  event.neighbours = {{.id = AgentId{5}, .rssi_dbm = -70}, {.id = AgentId{2}, .rssi_dbm = -60}};
  agent_->feed(event);
  event.neighbours = {{.id = AgentId{5}, .rssi_dbm = -75}, {.id = AgentId{3}, .rssi_dbm = -80}};
  event.lost_neighbours = {AgentId{2}};
  agent_->feed(event);
  question_ = [](hal::Robot& robot) {
    const std::vector<hal::Neighbour> expected = {{.id = AgentId{3}, .rssi_dbm = -80},
                                                  {.id = AgentId{5}, .rssi_dbm = -75}};
    EXPECT_EQ(robot.network().neighbours(), expected);
  };
  agent_->control();
}

}  // namespace
