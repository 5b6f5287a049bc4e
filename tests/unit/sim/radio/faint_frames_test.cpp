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

/// Stations in a square of 300 m that could move and do not, whose frames are looked for directly.
class FaintFramesOfTest : public testing::Test {
 protected:
  static constexpr std::uint16_t kStations = 30;  // twice, and none is forgotten for their number

  void place(const hal::Vec3& corner) {
    antennas.is_remembering = true;
    hal::RandomStream random(1, "places");
    std::vector<Neighbourhood::Antenna> stations;
    for (std::uint16_t i = 1; i <= kStations; ++i) {
      const hal::Vec3 way{300 * random.uniform(), 300 * random.uniform(), 0};
      antennas.place(hal::AgentId{i}, {.start = corner + way, .fastest = 1});
      stations.push_back({hal::AgentId{i}, hal::Milliwatts{40}});
    }
    neighbourhood.emplace(events, antennas, propagation, stations);
    frames.emplace(*neighbourhood);
    for (std::uint16_t i = 0; i < kStations; ++i) frames->add_receiver();
  }
  void go_to(hal::Time at) {
    while (events.next_time() && *events.next_time() <= at) events.run_next();
    events.advance_to(at);
  }
  /// All of them send, one per microsecond from `at` on.
  void send(hal::Time at) {
    for (StationIndex i = 0; i < kStations; ++i) {
      go_to(at + i * 1us);
      neighbourhood->links_from(i);
      departures.push_back(neighbourhood->departure(i, events.now()));
      frames->start(i, events.now(), 1ms);
    }
  }
  /// From which stations the receiver finds frames, and from which it should.
  std::pair<std::vector<StationIndex>, std::vector<StationIndex>> found(StationIndex receiver) {
    std::vector<FaintSignal> signals;
    frames->collect(receiver, events.now(), signals);
    std::vector<StationIndex> is, should;
    for (const FaintSignal& signal : signals) is.push_back(signal.from);
    for (const Departure& frame : departures) {
      const auto arrival = neighbourhood->mean_arrival(frame, receiver);
      if (frame.station == receiver || frame.at + arrival.delay + 1ms <= events.now()) continue;
      if (arrival.strength == Propagation::Strength::kFaint) should.push_back(frame.station);
    }
    return {is, should};
  }

  EventQueue events;
  PlacedAntennas antennas;
  Wall free_air;
  Propagation propagation{RadioConfig{log_distance()}, free_air};
  std::optional<Neighbourhood> neighbourhood;
  std::optional<FaintFrames> frames;
  std::vector<Departure> departures;

 private:
  static Ieee80211bConfig log_distance() {
    Ieee80211bConfig config;
    config.propagation.chain = {LogDistanceConfig{}};
    return config;
  }
};

// Where a float knows a place to 64 m.
TEST_F(FaintFramesOfTest, FarFromTheOriginAllAreFound) {
  place({1e9, -1e9, 0});
  send(hal::Time{});
  std::size_t some = 0;
  for (StationIndex receiver = 0; receiver < kStations; ++receiver) {
    const auto [is, should] = found(receiver);
    EXPECT_EQ(is, should) << receiver;
    some += should.size();
  }
  EXPECT_GT(some, 150u) << "the case must be tried";
}

// Steps of 2^8 ns fit into 32 bits for 549.76 s.
TEST_F(FaintFramesOfTest, AfterAMinuteOrTenWithoutFramesTheNextAreFound) {
  for (const auto silence :
       {60'000'000us, 549'755'000us, 549'755'500us, 550'000'000us, 4000'000'000us}) {
    place({});
    send(events.now());
    departures.clear();
    send(events.now() + silence);
    const auto [is, should] = found(0);
    EXPECT_EQ(is, should) << silence.count();
    EXPECT_GT(should.size(), 5u) << "the case must be tried";
    go_to(events.now() + 2ms);
    EXPECT_TRUE(found(0).first.empty());
  }
}

}  // namespace
}  // namespace sim::radio::test
