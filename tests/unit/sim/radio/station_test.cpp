#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// Friis' range falls with the root of the power: at 2 mW it is 250.16 m, at 0.5 mW half of that.
class StationPower : public testing::TestWithParam<Profile> {};

TEST_P(StationPower, ReachAsFarAsTheirOwnPowerDoes) {
  Air air(GetParam());
  waves_of(air.config)->tx_power = hal::Milliwatts{2};
  waves_of(air.config)->propagation.interference_floor = hal::Dbm{-100};
  waves_of(air.config)->receiver.sensitivity = hal::Dbm{-85};
  waves_of(air.config)->receiver.cca_threshold = hal::Dbm{-85};
  waves_of(air.config)->propagation.wavelength = hal::Metres{0.125};
  air.add({0, 0, 0});
  air.add({200, 0, 0});
  air.set_tx_power(2, hal::Milliwatts{0.5});
  air.build();
  EXPECT_TRUE(air.network->links().empty()) << "a link goes both ways";
  air.broadcast(1);
  air.run(1s);
  air.broadcast(2);
  air.run(2s);
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_TRUE(air.inbox(1).received.empty());
  EXPECT_EQ(air.log.faint, 1u) << "of 2 at 1";
  EXPECT_DOUBLE_EQ(air.sap(1).transmit_energy(100), 4 * air.sap(2).transmit_energy(100));
}

INSTANTIATE_TEST_SUITE_P(WithAMedium, StationPower,
                         testing::Values(Profile::kMobilityFramework, Profile::kIeee80211b));

TEST(StationPowers, ArePositive) {
  Air air(Profile::kIeee80211b);
  air.add({0, 0, 0});
  air.set_tx_power(1, hal::Milliwatts{0});
  EXPECT_THROW(air.build(), std::invalid_argument);
}

}  // namespace
}  // namespace sim::radio::test
