#include <gtest/gtest.h>

#include <map>

#include "sim/agents/simulation.h"
#include "sim/agents/surroundings.h"
#include "sim/core/event_queue.h"
#include "tests/support/slope.h"
#include "tests/unit/sim/agents/two_motes.h"

namespace sim::agents {
namespace {

using namespace tests;

/// Bodies as they are recorded.
class Bodies final : public Observer {
 public:
  void on_body(Time at, AgentId agent, const BodyState& body) override {
    seen[agent].emplace_back(at, body);
  }
  std::map<AgentId, std::vector<std::pair<Time, BodyState>>> seen;
};

/// A mote at 10 m, and a station that starts at 20 m and drives away along x at 5 m/s.
class Stations : public tests::TwoMotes {
 protected:
  Stations() {
    config.agents[1].body = Station{.path = LinePath{.speed = 5}};
    config.walls = {{.name = "far", .centre = {1000.5, 0, 0.5}, .size = {1, 1, 1}}};
  }
};

TEST_F(Stations, AreLocalisedWhereTheyAreNow) {
  int looked = 0;
  run(Time{2s},
      [&](const Event& event) -> std::vector<Action> {
        if (event.cause() != Cause::kControl) return {};
        for (const auto& reading : event.readings) {
          EXPECT_EQ(reading.values.size(), 3u);
          const double between = 10 + 5 * hal::to_seconds(event.time);
          const double expected = event.agent == tests::kA ? between : -between;
          EXPECT_NEAR(reading.values.at(1), expected, 1e-6) << hal::to_seconds(event.time);
          ++looked;
        }
        return {};
      },
      {.channels = {"localisation"}});
  EXPECT_GE(looked, 40) << "by both";
}

TEST_F(Stations, FollowTheGround) {
  config.world.ground = std::make_shared<tests::Slope>(3, 0.1);
  const physics::World world(config.world);
  const Paths paths(config);
  const AgentPositions positions(world, paths, 0);
  EXPECT_NEAR(positions.position(tests::kB, Time{2s}).x, 30, 1e-9);
  EXPECT_NEAR(positions.position(tests::kB, Time{2s}).z, 3 + 0.1 * 30, 1e-9);
  EXPECT_NEAR(positions.velocity(tests::kB, Time{2s}).z, 0.1 * 5, 1e-9);
}

TEST_F(Stations, HaveNoBodyAndAreRecordedAtControlInstants) {
  Bodies bodies;
  Simulation simulation(config, {&bodies});
  simulation.connect(std::make_shared<tests::ScriptedPort>(tests::nothing), {tests::kA, tests::kB},
                     {});
  tests::NoPace pace;
  simulation.run(Time{1s}, pace);
  const auto& seen = bodies.seen.at(tests::kB);
  ASSERT_EQ(seen.size(), 11u);
  for (const auto& [at, body] : seen) {
    EXPECT_NEAR(body.x, 20 + 5 * hal::to_seconds(at), 1e-9);
    EXPECT_NEAR(body.clearance, 1000 - body.x, 1e-6);
    EXPECT_EQ(body.tilt, 0);
  }
  EXPECT_NEAR(simulation.body(kB).x, 25, 1e-9);
  EXPECT_EQ(simulation.contacts(kB).wall_steps, 0u);
}

TEST_F(Stations, AloneNeedNoPhysicsSteps) {
  const auto events = [this] {
    Simulation simulation(config, {});
    simulation.connect(std::make_shared<tests::ScriptedPort>(tests::nothing),
                       {tests::kA, tests::kB}, {});
    tests::NoPace pace;
    return simulation.run(Time{10s}, pace).events;
  };
  const auto with_a_body = events();
  config.agents[0].body = Station{.path = {}};
  EXPECT_EQ(with_a_body - events(), 1000u);  // one each 10 ms
}

// Ideal radio, 250 m: it leaves at 230 m / 5 m/s.
TEST_F(Stations, HearOnlyWithinTheRangeOfWhereTheyAreNow) {
  config.routing.algorithm = hal::node::routing::Algorithm::kNone;
  std::vector<double> heard;
  run(Time{60s}, [&](const Event& event) -> std::vector<Action> {
    if (event.cause() == Cause::kMessage) heard.push_back(hal::to_seconds(event.time));
    if (event.cause() != Cause::kControl || event.agent != tests::kA) return {};
    static hal::MessageId id = 0;
    return {tests::send(hal::kNeighbours, ++id)};
  });
  ASSERT_FALSE(heard.empty());
  const double reach = sim::radio::kMobilityFrameworkRange.value;
  EXPECT_NEAR(heard.back(), (reach - 10) / 5, 0.11);
  EXPECT_NEAR(static_cast<double>(heard.size()), (reach - 10) / 0.5, 2);
}

}  // namespace
}  // namespace sim::agents
