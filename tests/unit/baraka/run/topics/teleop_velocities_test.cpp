#include "baraka/run/topics/teleop_velocities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace baraka::run::topics {
namespace {

TEST(TeleopVelocities, EveryBitOfAVelocityPassesTheDoor) {
  const hal::Twist2 twist{0.1, -1e-300, std::nextafter(1.0, 2.0)};
  EXPECT_EQ(twist_of(to_bytes(twist)), twist);
  // 1.0 is 0x3ff0000000000000 in binary64, the lowest byte first.
  const std::vector<std::uint8_t> one{0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
  const std::vector<std::uint8_t> bytes = to_bytes({1, 0, 0});
  EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + 8), one);
}

TEST(TeleopVelocities, ARecordThatIsNoVelocityIsAnError) {
  EXPECT_THROW(twist_of(std::vector<std::uint8_t>(23)), std::runtime_error);
  EXPECT_THROW(twist_of(to_bytes({std::numeric_limits<double>::quiet_NaN(), 0, 0})),
               std::runtime_error);
}

TEST(TeleopVelocities, TheLastOneTakenInCountsAndEachHasItsNumber) {
  sim::OutsideInput input;
  const TeleopVelocities velocities(input, "r0");
  EXPECT_FALSE(velocities.last());
  input.put("cmd_vel of r0", to_bytes({0.5, 0, 0}));
  input.put("cmd_vel of r0", to_bytes({0.25, 0, 1}));
  EXPECT_FALSE(velocities.last());  // not before the run takes it in
  input.take(hal::Time{}, [](const sim::OutsideArrival&) {});
  ASSERT_TRUE(velocities.last());
  EXPECT_EQ(velocities.last()->twist, (hal::Twist2{0.25, 0, 1}));
  EXPECT_EQ(velocities.last()->number, 2u);
}

}  // namespace
}  // namespace baraka::run::topics
