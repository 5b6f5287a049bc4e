#include "programs/netns/addresses.h"

#include <gtest/gtest.h>

namespace programs::netns {
namespace {

TEST(Addresses, OfAnAgentCarryItsNumber) {
  EXPECT_EQ(mac_address(0x1234), (std::array<std::uint8_t, 6>{2, 0, 0, 0, 0x12, 0x34}));
  EXPECT_EQ(to_text(link_local_address(0x1234)), "fe80::ff:fe00:1234");
  EXPECT_EQ(to_text(unique_local_address(0x1234)), "fd00:ba4a:4a::ff:fe00:1234");
  EXPECT_EQ(to_text(0x0a4d0003), "10.77.0.3");
}

}  // namespace
}  // namespace programs::netns
