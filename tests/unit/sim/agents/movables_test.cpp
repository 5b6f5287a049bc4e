// Movables in a run: who hears of them, fingerprints, and frames that they stop.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "sim/agents/fingerprint_feed.h"
#include "tests/unit/sim/agents/two_motes.h"
#include "tests/unit/sim/physics/robertino.h"

namespace tests {
namespace {

using sim::agents::FingerprintFeed;
using sim::physics::BodyPose;
using sim::physics::Movable;
using sim::physics::MovableBox;

/// A box that slides from x = 0 with 1 m/s and friction 0.2: 0.25 m in 0.51 s.
Movable thrown() {
  Movable box{.name = "box", .form = MovableBox{{0.2, 0.2, 0.2}}};
  box.velocity = {1, 0};
  box.friction = 0.2;
  return box;
}

class Movables : public TwoMotes {
 protected:
  Movables() { config.movables = {thrown()}; }

  Outcome run_with(std::vector<sim::agents::Observer*> observers, Time until) {
    sim::agents::Simulation simulation(config, observers);
    simulation.connect(std::make_shared<ScriptedPort>(nothing), {kA, kB}, {});
    NoPace pace;
    return simulation.run(until, pace);
  }

  std::uint64_t fingerprint() {
    FingerprintFeed feed;
    (void)run_with({&feed}, Time{2s});
    feed.finish();
    return feed.fingerprint().part(sim::Part::kBodies);
  }
};

TEST_F(Movables, AreReportedOncePerControlPeriodWhileTheyMove) {
  class Log final : public sim::agents::Observer {
   public:
    void on_movable(Time at, std::uint32_t number, const BodyPose& pose) override {
      EXPECT_EQ(number, 0u);
      rows.emplace_back(at, pose.position.x);
    }
    std::vector<std::pair<Time, double>> rows;
  } log;
  (void)run_with({&log}, Time{5s});
  ASSERT_GE(log.rows.size(), 7u);
  EXPECT_EQ(log.rows[0], (std::pair{Time{}, 0.0}));
  for (std::size_t i = 1; i < log.rows.size(); ++i)
    EXPECT_EQ(log.rows[i].first - log.rows[i - 1].first, config.control_period);
  EXPECT_LT(log.rows.back().first, Time{1500ms}) << "asleep";
  EXPECT_NEAR(log.rows.back().second, 1 / (2 * 0.2 * 9.81), 0.02 * 0.255);  // m
}

TEST_F(Movables, AreInTheFingerprintOfBodies) {
  const std::uint64_t first = fingerprint();
  EXPECT_EQ(fingerprint(), first);
  config.movables[0].velocity.x = 1.0001;
  EXPECT_NE(fingerprint(), first);
  config.movables.clear();
  EXPECT_NE(fingerprint(), first);
}

TEST_F(Movables, ThatAreLostAreNamed) {
  config.movables[0].velocity.x = 2e5;
  const Outcome outcome = run_with({}, Time{1s});
  ASSERT_EQ(outcome.bodies_lost.size(), 1u);
  EXPECT_EQ(outcome.bodies_lost[0].substr(0, 8), "box lost");
}

}  // namespace
}  // namespace tests
