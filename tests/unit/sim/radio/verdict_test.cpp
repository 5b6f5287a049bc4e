#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "hal/types/random.h"
#include "sim/radio/channel/propagation.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

struct TrafficCase {
  const char* name;
  Profile profile;
  bool propagation_delay;
  bool capture;
};

constexpr std::uint16_t kSixteenStations = 16;
constexpr int kRequests = 150;

/// Stations all over a square in which nobody reaches everybody, sending at random times to random
/// places, one of them switched off and on again and again.
void load(Air& air, const TrafficCase& c) {
  waves_of(air.config)->propagation.propagation_delay = c.propagation_delay;
  if (c.capture) waves_of(air.config)->receiver.capture_margin = hal::Decibels{5};
  if (c.profile == Profile::kIeee80211b) waves_of(air.config)->tx_power = hal::Milliwatts{2};
  if (c.profile == Profile::kMobilityFramework)
    waves_of(air.config)->propagation.interference_floor = hal::Dbm{-95};
  hal::RandomStream random(7, "traffic");
  for (int i = 0; i < kSixteenStations; ++i)
    air.add({600 * random.uniform(), 600 * random.uniform(), 0});
  air.build();
  for (int i = 0; i < kRequests; ++i) {
    const auto from = static_cast<std::uint16_t>(1 + random.below(kSixteenStations));
    auto to = static_cast<std::uint16_t>(1 + random.below(kSixteenStations));
    if (to == from || i % 3 == 0) to = hal::kEveryone.value;
    const std::size_t bytes = random.below(1000);
    air.at(hal::Duration{random.below(300'000'000)},
           [&air, from, to, bytes] { air.send(from, to, bytes); });
  }
  for (int i = 0; i < 40; ++i) {
    air.at(hal::Duration{random.below(300'000'000)},
           [&air] { air.sap(1).set_radio(!air.sap(1).radio_on()); });
  }
}

class EveryFrame : public testing::TestWithParam<TrafficCase> {};

TEST_P(EveryFrame, EndsInOneVerdictAtEveryRadioThatHearsIt) {
  Air air(GetParam().profile);
  load(air, GetParam());
  air.run(60s);
  std::map<std::uint64_t, std::multiset<std::uint16_t>> seen;
  for (const auto& reception : air.log.receptions) {
    seen[reception.frame].insert(reception.receiver.value);
  }
  const Propagation propagation(air.config, air.wall);
  std::uint64_t faint = 0;
  ASSERT_GT(air.log.starts.size(), static_cast<std::size_t>(kRequests));
  for (const auto& start : air.log.starts) {
    const hal::AgentId from = start.frame.transmitter;
    std::multiset<std::uint16_t> expected;
    for (std::uint16_t to = 1; to <= kSixteenStations; ++to) {
      const auto arrival =
          propagation.arrival(waves_of(air.config)->tx_power, air.antennas.position(from, {}),
                              air.antennas.position(hal::AgentId{to}, {}));
      if (to == from.value) continue;
      if (arrival.strength == Propagation::Strength::kAudible) expected.insert(to);
      if (arrival.strength == Propagation::Strength::kFaint) ++faint;
    }
    ASSERT_EQ(seen[start.frame.id], expected) << "frame " << start.frame.id;
  }
  EXPECT_EQ(air.log.faint, faint);
}

TEST_P(EveryFrame, EndsEveryRequestOnce) {
  Air air(GetParam().profile);
  load(air, GetParam());
  air.run(60s);
  EXPECT_EQ(air.log.request_ends, kRequests);
}

// The case is worth something only if it meets many ways to end.
TEST_P(EveryFrame, TrafficMeetsManyVerdicts) {
  Air air(GetParam().profile);
  load(air, GetParam());
  air.run(60s);
  std::set<hal::Verdict> met;
  for (const auto& reception : air.log.receptions) met.insert(reception.verdict);
  EXPECT_GE(met.size(), 5u);
}

TEST_P(EveryFrame, TwoRunsAreEqual) {
  Air one(GetParam().profile);
  Air two(GetParam().profile);
  load(one, GetParam());
  load(two, GetParam());
  one.run(60s);
  two.run(60s);
  ASSERT_EQ(one.log.receptions.size(), two.log.receptions.size());
  for (std::size_t i = 0; i < one.log.receptions.size(); ++i) {
    ASSERT_EQ(one.log.receptions[i].at, two.log.receptions[i].at) << i;
    ASSERT_EQ(one.log.receptions[i].verdict, two.log.receptions[i].verdict) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    RandomTraffic, EveryFrame,
    testing::Values(
        TrafficCase{"MobilityFramework", Profile::kMobilityFramework, false, false},
        TrafficCase{"MobilityFrameworkCapture", Profile::kMobilityFramework, false, true},
        TrafficCase{"MobilityFrameworkDelays", Profile::kMobilityFramework, true, false},
        TrafficCase{"Ieee80211b", Profile::kIeee80211b, false, false},
        TrafficCase{"Ieee80211bDelays", Profile::kIeee80211b, true, true}),
    [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace sim::radio::test
