#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "hal/types/random.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t kStations = 12;
/// m. No two distances are equal: of two equally strong frames a radio takes the lower address.
constexpr std::array<hal::Vec2, kStations> kPlaces{{{3, 11},
                                                    {157, 2},
                                                    {291, 17},
                                                    {452, 5},
                                                    {8, 139},
                                                    {143, 163},
                                                    {311, 148},
                                                    {457, 151},
                                                    {1, 307},
                                                    {162, 298},
                                                    {296, 316},
                                                    {443, 303}}};

/// (start of frame, type, place of the transmitter), and the same of receptions with their verdict.
using Seen = std::vector<std::tuple<hal::Time, int, std::uint16_t>>;

/// Places 1, 2, 3, … have the addresses 1, 2, 3, … or, reversed, …, 3, 2, 1. Streams belong to
/// places. Requests come on a coarse grid of times, so that many things happen at one instant.
Seen run(Profile profile, bool reversed) {
  Air air(profile);
  waves_of(air.config)->propagation.propagation_delay = false;
  if (profile == Profile::kIeee80211b) waves_of(air.config)->tx_power = hal::Milliwatts{2};
  const auto swap = [reversed](std::uint32_t number) {
    return static_cast<std::uint16_t>(reversed ? kStations + 1 - number : number);
  };
  for (std::uint32_t address = 1; address <= kStations; ++address) {
    const std::uint16_t place = swap(address);
    air.add({kPlaces.at(place - 1u).x, kPlaces.at(place - 1u).y, 0}, {},
            "p" + std::to_string(place));
  }
  air.build();
  hal::RandomStream random(5, "traffic");
  for (int i = 0; i < 300; ++i) {
    const std::uint16_t from = swap(1 + random.below(kStations));
    const std::uint16_t to = swap(1 + random.below(kStations));
    const bool broadcast = to == from || i % 2 == 0;
    air.at(random.below(400) * 1ms, [&air, from, to, broadcast] {
      air.send(from, broadcast ? hal::kEveryone.value : to, 200);
    });
  }
  air.run(30s);
  Seen seen;
  for (const auto& start : air.log.starts) {
    seen.emplace_back(start.at, static_cast<int>(start.frame.type),
                      swap(start.frame.transmitter.value));
  }
  for (const auto& reception : air.log.receptions) {
    seen.emplace_back(reception.at, 100 + static_cast<int>(reception.verdict),
                      swap(reception.receiver.value));
  }
  std::sort(seen.begin(), seen.end());
  return seen;
}

// Events of one instant run in order of addresses. If that order decided anything, e.g. who of two
// stations whose backoffs end together gets the medium, renumbering would change the run.
TEST(Simultaneity, AddressesDecideNothingInMobilityFramework) {
  EXPECT_EQ(run(Profile::kMobilityFramework, false), run(Profile::kMobilityFramework, true));
}

TEST(Simultaneity, AddressesDecideNothingInIeee80211b) {
  EXPECT_EQ(run(Profile::kIeee80211b, false), run(Profile::kIeee80211b, true));
}

/// Twelve stations, some of which move, send and are switched off and on, with propagation delay.
Seen run_far_apart(bool one_by_one) {
  Air air(Profile::kIeee80211b);
  air.one_by_one = one_by_one;
  for (std::uint16_t i = 0; i < kStations; ++i) {
    air.add({kPlaces[i].x, kPlaces[i].y, 0}, {i % 3 == 0 ? 2.0 : 0.0, 0, 0});
  }
  air.build();
  hal::RandomStream random(7, "traffic");
  const auto one = [&random] { return static_cast<std::uint16_t>(1 + random.below(kStations)); };
  for (int i = 0; i < 600; ++i) {
    const std::uint16_t from = one(), to = one();
    const bool broadcast = to == from || i % 3 == 0;
    air.at(random.below(1'000'000) * 1us, [&air, from, to, broadcast] {
      air.send(from, broadcast ? hal::kEveryone.value : to, 200);
    });
  }
  for (int i = 0; i < 20; ++i) {
    const std::uint16_t station = one();
    const auto off = random.below(1'000'000) * 1us;
    air.at(off, [&air, station] { air.sap(station).set_radio(false); });
    air.at(off + 3ms, [&air, station] { air.sap(station).set_radio(true); });
  }
  air.run(5s);
  Seen seen;
  for (const auto& reception : air.log.receptions) {
    seen.emplace_back(reception.at, static_cast<int>(reception.verdict), reception.receiver.value);
  }
  return seen;
}

// The events of a frame at its receivers do not wait in the queue where nothing comes between.
TEST(Simultaneity, WhetherTheEventsOfAFrameWaitForTheirTurnMakesNoDifference) {
  const Seen seen = run_far_apart(true);
  EXPECT_GT(seen.size(), 5000u);
  EXPECT_EQ(seen, run_far_apart(false));
}

}  // namespace
}  // namespace sim::radio::test
