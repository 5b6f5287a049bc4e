#include "hal/node/routing/route_table.h"

#include <gtest/gtest.h>

#include <string>

namespace hal::node::routing {
namespace {

class Changes final : public RoutingObserver {
 public:
  void on_route_change(const RouteChange& change) override {
    ++(change.removed ? removed : installed);
  }
  std::size_t installed = 0, removed = 0;
};

Route route(std::size_t topic, std::uint16_t destination = 9, std::uint16_t next_hop = 2) {
  return {"topic " + std::to_string(topic), AgentId{destination}, AgentId{next_hop}, {}};
}

TEST(RouteTable, KeepsSoManyClassesAndNoMore) {
  Changes changes;
  RouteTable table(changes);
  for (std::size_t i = 0; i < RouteTable::kMostClasses + 100; ++i) table.install(route(i));
  EXPECT_EQ(changes.installed, RouteTable::kMostClasses);
  EXPECT_TRUE(
      table.routes("topic " + std::to_string(RouteTable::kMostClasses), AgentId{9}).empty());
  table.install(route(0, 10));
  EXPECT_EQ(table.routes("topic 0", AgentId{10}).size(), 1u) << "a class that it knows";
}

TEST(RouteTable, AClassWhoseLastRouteIsGoneMakesRoomForAnother) {
  Changes changes;
  RouteTable table(changes);
  for (std::size_t i = 0; i < RouteTable::kMostClasses; ++i) table.install(route(i));
  table.remove("topic 7", AgentId{9});
  table.install(route(RouteTable::kMostClasses));
  EXPECT_EQ(changes.installed, RouteTable::kMostClasses + 1);
  table.remove_via(AgentId{2});
  EXPECT_EQ(changes.removed, RouteTable::kMostClasses + 1);
  table.install(route(RouteTable::kMostClasses + 1));
  EXPECT_EQ(changes.installed, RouteTable::kMostClasses + 2);
}

}  // namespace
}  // namespace hal::node::routing
