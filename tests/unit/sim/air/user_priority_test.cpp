#include "sim/air/user_priority.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/air/ethertypes.h"

namespace sim::air {
namespace {

std::uint8_t of_ipv4(std::uint8_t tos) {
  return user_priority(kEthertypeIpv4, std::vector<std::uint8_t>{0x45, tos, 0, 20});
}
/// @param traffic_class  spread over two bytes (RFC 8200, 3).
std::uint8_t of_ipv6(std::uint8_t traffic_class) {
  const auto first = static_cast<std::uint8_t>(0x60 | traffic_class >> 4);
  const auto second = static_cast<std::uint8_t>(traffic_class << 4);
  return user_priority(kEthertypeIpv6, std::vector<std::uint8_t>{first, second, 0, 0});
}

// The DSCP is the upper six bits: CS0 .. CS7 are 0x00, 0x20, …, 0xe0; EF is 0xb8 (RFC 3246), AF41
// is 0x88 (RFC 2597).
TEST(UserPriority, IsThatOfTheClassSelector) {
  for (int n = 0; n < 8; ++n) {
    EXPECT_EQ(of_ipv4(static_cast<std::uint8_t>(n << 5)), n);
    EXPECT_EQ(of_ipv6(static_cast<std::uint8_t>(n << 5)), n);
  }
  EXPECT_EQ(of_ipv4(0xb8), 5);
  EXPECT_EQ(of_ipv6(0xb8), 5);
  EXPECT_EQ(of_ipv4(0x88), 4);
}

TEST(UserPriority, IsZeroOfWhatIsNotIp) {
  EXPECT_EQ(user_priority(kEthertypeArp, std::vector<std::uint8_t>{0xff, 0xff, 0xff}), 0);
  EXPECT_EQ(user_priority(kEthertypeIpv4, std::vector<std::uint8_t>{0x45}), 0);
  EXPECT_EQ(user_priority(kEthertypeIpv4, {}), 0);
}

}  // namespace
}  // namespace sim::air
