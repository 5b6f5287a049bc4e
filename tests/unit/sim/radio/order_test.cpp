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

}  // namespace
}  // namespace sim::radio::test
