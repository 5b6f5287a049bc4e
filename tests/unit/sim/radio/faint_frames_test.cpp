#include "sim/radio/channel/faint_frames.h"

#include <gtest/gtest.h>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "hal/types/random.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

using Seen = std::vector<std::tuple<hal::Time, std::uint64_t, hal::AgentId, hal::Verdict, double>>;

/// What 60 stations on the move notice of 600 broadcasts, and at how many radios these were faint.
/// @param energy  above it the sum of faint frames makes the medium busy.
std::pair<Seen, std::uint64_t> observe(bool is_asking, hal::Dbm energy, bool jams) {
  Ieee80211bConfig config;
  config.propagation.chain = {LogDistanceConfig{}};
  config.receiver.energy_detection = energy;
  Air air{RadioConfig{config}};
  air.antennas.is_remembering = is_asking;
  hal::RandomStream random(1, "places");
  for (int i = 0; i < 60; ++i) {
    const hal::Vec3 at{300 * random.uniform(), 300 * random.uniform(), 0};
    const hal::Vec3 velocity{40 * random.uniform() - 20, 40 * random.uniform() - 20, 0};
    air.add(at, i % 4 == 0 ? hal::Vec3{} : velocity);
  }
  air.build();
  for (int i = 0; i < 600; ++i) {
    const auto from = static_cast<std::uint16_t>(1 + random.below(60));
    air.events.schedule(hal::Time{} + hal::Duration{random.below(3'000'000'000)}, Rank::kNodeTimer,
                        hal::AgentId{from}, [&air, from] { air.broadcast(from, 200); });
  }
  for (int i = 0; jams && i < 300; ++i) {
    air.events.schedule(hal::Time{} + i * 10ms, Rank::kScenario, kWorld, [&air] {
      air.network->interfere({{150, 150, 0}, hal::Milliwatts{0.01}, std::nullopt, 2ms});
    });
  }
  air.run(4s);
  Seen seen;
  for (const Log::Reception& one : air.log.receptions) {
    seen.emplace_back(one.at, one.frame, one.receiver, one.verdict, one.rssi_dbm);
  }
  return {seen, air.log.faint};
}

TEST(FaintFramesTest, WhoAsksForPowersSeesWhatHeWouldIfHeWereTold) {
  for (const double energy : {-62.0, -82.0, -95.0}) {
    for (const bool jams : {false, true}) {
      const auto told = observe(false, hal::Dbm{energy}, jams);
      const auto asking = observe(true, hal::Dbm{energy}, jams);
      EXPECT_GT(told.second, 5000u) << "the case must be tried";
      EXPECT_EQ(asking.second, told.second) << energy;
      EXPECT_TRUE(asking.first == told.first) << energy << ' ' << jams;
    }
  }
}

}  // namespace
}  // namespace sim::radio::test
