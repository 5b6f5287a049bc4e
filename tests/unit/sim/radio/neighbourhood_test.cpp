#include "sim/radio/channel/neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "hal/types/random.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::Milliwatts kTxPower{2};

/// Counts how often each antenna's position is asked for.
class CountedAntennas final : public Positions {
 public:
  hal::Vec3 position(hal::AgentId agent, hal::Time at) const override {
    ++asked;
    return antennas.position(agent, at);
  }
  hal::Vec3 velocity(hal::AgentId agent, hal::Time at) const override {
    return antennas.velocity(agent, at);
  }
  hal::Time valid_until(hal::AgentId agent, hal::Time at) const override {
    return antennas.valid_until(agent, at);
  }
  double max_speed(hal::AgentId agent) const override { return antennas.max_speed(agent); }

  PlacedAntennas antennas;
  mutable int asked = 0;
};

class NeighbourhoodTest : public testing::Test {
 protected:
  void add(const hal::Vec3& at, const hal::Vec3& velocity = {}) {
    agents_.push_back({hal::AgentId{static_cast<std::uint16_t>(agents_.size() + 1)}, kTxPower});
    positions.antennas.place(agents_.back().agent, {at, velocity});
  }
  void build() { neighbourhood.emplace(events, positions, propagation, agents_); }
  std::vector<StationIndex> noticing(StationIndex from) {
    std::vector<StationIndex> found;
    const Links& links = neighbourhood->links_from(from);
    for (const AudibleLink& link : links.audible) found.push_back(link.receiver);
    for (const FaintLink& link : links.faint) found.push_back(link.receiver);
    std::ranges::sort(found);
    return found;
  }
  std::vector<StationIndex> expected(StationIndex from) const {
    std::vector<StationIndex> found;
    const hal::Vec3 here = positions.antennas.position(agents_[from].agent, events.now());
    for (StationIndex i = 0; i < agents_.size(); ++i) {
      const hal::Vec3 there = positions.antennas.position(agents_[i].agent, events.now());
      const double d2 = hal::dot(there - here, there - here);
      if (i != from && d2 <= propagation.reach(kTxPower) * propagation.reach(kTxPower)) {
        found.push_back(i);
      }
    }
    return found;
  }
  void run_until(hal::Duration until) {
    while (*events.next_time() <= hal::Time{} + until) events.run_next();
    events.advance_to(hal::Time{} + until);
  }

  EventQueue events;
  CountedAntennas positions;
  Wall free_air;
  Propagation propagation{MobilityFrameworkConfig{}, free_air};
  std::optional<Neighbourhood> neighbourhood;

 private:
  std::vector<Neighbourhood::Antenna> agents_;
};

TEST_F(NeighbourhoodTest, FindsExactlyThoseInReachWhateverTheCell) {
  hal::RandomStream random(1, "places");
  for (int i = 0; i < 120; ++i) {
    add({3000 * random.uniform() - 1500, 3000 * random.uniform() - 1500, 5 * random.uniform()});
  }
  build();
  for (StationIndex i = 0; i < 120; ++i) EXPECT_EQ(noticing(i), expected(i)) << i;
}

TEST_F(NeighbourhoodTest, FollowsMovingStationsAcrossCells) {
  hal::RandomStream random(2, "places");
  for (int i = 0; i < 60; ++i) {
    const hal::Vec3 at{2000 * random.uniform(), 2000 * random.uniform(), 0};
    const hal::Vec3 velocity{60 * random.uniform() - 30, 60 * random.uniform() - 30, 0};
    add(at, i % 2 == 0 ? velocity : hal::Vec3{});
  }
  build();
  for (const auto time : {1ms, 1000ms, 7000ms, 30000ms, 60000ms}) {
    run_until(time);
    for (StationIndex i = 0; i < 60; ++i) ASSERT_EQ(noticing(i), expected(i)) << i;
  }
}

TEST_F(NeighbourhoodTest, AsksFixedStationsOnce) {
  for (int i = 0; i < 10; ++i) add({100.0 * i, 0, 0});
  build();
  for (StationIndex i = 0; i < 10; ++i) noticing(i);
  const int before = positions.asked;
  for (StationIndex i = 0; i < 10; ++i) noticing(i);
  EXPECT_EQ(positions.asked, before);
}

// Reach 250 m: from 300 m at 10 m/s it takes five seconds, and both may be looked at meanwhile for
// their own sake.
TEST_F(NeighbourhoodTest, LooksAtADistantStationOnlyWhenItMayHaveComeIntoReach) {
  add({0, 0, 0});
  add({300.5, 0, 0}, {-10, 0, 0});
  build();
  run_until(1ms);
  EXPECT_TRUE(noticing(0).empty());
  noticing(0);  // it has moved since its cell was found: now its way is known
  const int before = positions.asked;
  for (int i = 0; i < 100; ++i) {
    events.schedule(events.now() + 1ms + i * 40ms, Rank::kScenario, kWorld,
                    [this] { EXPECT_TRUE(noticing(0).empty()); });
  }
  run_until(4s);
  EXPECT_LE(positions.asked - before, 4) << "but for the looks at its cell";
  for (const auto time : {4900ms, 5020ms, 5060ms, 6000ms}) {
    run_until(time);
    EXPECT_EQ(noticing(0), expected(0));
  }
  EXPECT_EQ(noticing(0), std::vector<StationIndex>{1});
}

TEST_F(NeighbourhoodTest, AMoverFarAwayCostsThoseWhoStandNothing) {
  add({0, 0, 0});
  add({100, 0, 0});
  add({5000, 0, 0}, {1, 0, 0});
  build();
  run_until(1ms);
  noticing(0);
  const int before = positions.asked;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(noticing(0), std::vector<StationIndex>{1});
  EXPECT_EQ(positions.asked, before);
}

TEST_F(NeighbourhoodTest, LooksAtMovingStationsLessThanOncePerMarginOfTheirWay) {
  add({0, 0, 0}, {10, 0, 0});  // reach 250 m: margin 25 m, so one look in 2.5 s
  build();
  const std::uint64_t before = events.executed();
  run_until(100s);
  EXPECT_LE(events.executed() - before, 41u);
  EXPECT_GE(events.executed() - before, 39u);
}

TEST_F(NeighbourhoodTest, InfiniteReachIsOneCell) {
  IdealConfig config;
  config.range = hal::Metres{std::numeric_limits<double>::infinity()};
  propagation = Propagation(config, free_air);
  add({0, 0, 0});
  add({1e7, 0, 0}, {5, 0, 0});
  build();
  EXPECT_EQ(noticing(0), std::vector<StationIndex>{1});
}

}  // namespace
}  // namespace sim::radio::test
