#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;
using hal::AgentId;
using hal::node::routing::StaticRoute;
using Routes = std::vector<StaticRoute>;

/// Five stations, s0 to s4, with the addresses 1 to 5.
class StaticRoutes : public testing::Test {
 protected:
  StaticRoutes() { fs::create_directories(folder_); }
  ~StaticRoutes() override { fs::remove_all(folder_); }

  Scenario loaded(const std::string& routes) const {
    const fs::path file = folder_ / "five.yaml";
    std::ofstream(file) << "version: 1\n"
                           "radio: {profile: ideal, range: 100 m}\n"
                           "routing: {algorithm: static, routes: "
                        << routes
                        << "}\n"
                           "agents:\n"
                           "  s: {name: \"s{}\", station: {}, line: {count: 5, spacing: 10 m}}\n"
                           "end: [{at: 1 s, result: done}]\n";
    return load_scenario(file, {});
  }

  static const Routes& of(const Scenario& scenario, std::size_t agent) {
    return scenario.simulation.agents.at(agent).static_routes;
  }

  static StaticRoute route(int to, int via, int hops) {
    const auto id = [](int index) { return AgentId{static_cast<std::uint16_t>(index + 1)}; };
    return {id(to), id(via), static_cast<std::uint16_t>(hops)};
  }

  fs::path folder_ = fs::temp_directory_path() / ("static_routes." + std::to_string(::getpid()));
};

TEST_F(StaticRoutes, OfAPathGoBothWays) {
  const Scenario scenario = loaded("[{path: [\"s*\"]}]");
  EXPECT_EQ(of(scenario, 0),
            (Routes{route(1, 1, 1), route(2, 1, 2), route(3, 1, 3), route(4, 1, 4)}));
  EXPECT_EQ(of(scenario, 3),
            (Routes{route(0, 2, 3), route(1, 2, 2), route(2, 2, 1), route(4, 4, 1)}));
  EXPECT_TRUE(scenario.warnings.empty());
}

TEST_F(StaticRoutes, OfAPathAreInItsOrder) {
  const Scenario scenario = loaded("[{path: [s0, s3, s1]}]");
  EXPECT_EQ(of(scenario, 0), (Routes{route(1, 3, 2), route(3, 3, 1)}));
  EXPECT_EQ(of(scenario, 1), (Routes{route(0, 3, 2), route(3, 3, 1)}));
  EXPECT_TRUE(of(scenario, 2).empty());
}

TEST_F(StaticRoutes, OfAPatternLeaveOutTheDestinationAndTheNextHop) {
  const Scenario scenario = loaded("[{to: s4, via: s2}, {at: s2, to: s4}]");
  EXPECT_EQ(of(scenario, 0), (Routes{route(4, 2, 2)}));
  EXPECT_EQ(of(scenario, 2), (Routes{route(4, 4, 1)}));
  EXPECT_TRUE(of(scenario, 4).empty());
}

TEST_F(StaticRoutes, WithoutViaAreDirect) {
  const Scenario scenario = loaded("[{at: s0, to: \"*\"}]");
  EXPECT_EQ(of(scenario, 0),
            (Routes{route(1, 1, 1), route(2, 2, 1), route(3, 3, 1), route(4, 4, 1)}));
}

TEST_F(StaticRoutes, OfALaterItemReplaceThoseOfAnEarlierOne) {
  const Scenario scenario = loaded("[{path: [\"s*\"]}, {at: s0, to: s2}]");
  EXPECT_EQ(of(scenario, 0),
            (Routes{route(1, 1, 1), route(2, 2, 1), route(3, 1, 3), route(4, 1, 4)}));
}

TEST_F(StaticRoutes, ThatLeadOnlyPartOfTheWayHaveNoLength) {
  const Scenario scenario = loaded("[{at: s0, to: s2, via: s1}, {at: s3, to: s2, via: s0}]");
  EXPECT_EQ(of(scenario, 0), (Routes{route(2, 1, 0)}));
  EXPECT_EQ(of(scenario, 3), (Routes{route(2, 0, 0)}));
  ASSERT_EQ(scenario.warnings.size(), 1u);
  EXPECT_NE(scenario.warnings[0].find("s1 has no route to s2: what s0 sends there ends at s1"),
            std::string::npos);
}

TEST_F(StaticRoutes, AreWrittenSoThatTheyReadBack) {
  const Scenario scenario =
      loaded("[{path: [s0, s1, s2]}, {at: s3, to: \"s?\", via: s2}, {to: s3}]");
  const fs::path file = folder_ / "resolved.yaml";
  std::ofstream(file) << resolved_yaml(scenario);
  const Scenario again = load_scenario(file, {});
  for (std::size_t agent = 0; agent < 5; ++agent)
    EXPECT_EQ(of(again, agent), of(scenario, agent)) << agent;
  EXPECT_EQ(resolved_yaml(again), resolved_yaml(scenario));
}

}  // namespace
}  // namespace sim::scenario
