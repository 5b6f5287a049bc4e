#include "hal/robot/radio/datagram.h"

#include <gtest/gtest.h>

#include "hal/types/random.h"

namespace hal::robot::radio {
namespace {

// By hand from the table in datagram.h.
const Bytes kGolden{'B', 'R', 'K', 'A', 1, 0, 0x01, 0x02, 0x00, 0x03, 7, 8, 9};

TEST(Datagram, IsTheBytesOfItsTable) {
  EXPECT_EQ(to_datagram(AgentId{0x0102}, Bytes{7, 8, 9}), kGolden);
  const auto frame = from_datagram(kGolden);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->from, AgentId{0x0102});
  EXPECT_EQ(Bytes(frame->bytes.begin(), frame->bytes.end()), (Bytes{7, 8, 9}));
}

TEST(Datagram, MayCarryNothingAndTheLongestFrame) {
  for (const std::size_t size : {std::size_t{0}, kMaxFrame}) {
    const Bytes datagram = to_datagram(AgentId{1}, Bytes(size, 5));
    const auto frame = from_datagram(datagram);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->bytes.size(), size);
  }
}

TEST(Datagram, IsRefusedWhenCutAtAnyByteOrTooLong) {
  for (std::size_t size = 0; size < kGolden.size(); ++size) {
    EXPECT_FALSE(from_datagram({kGolden.data(), size})) << size;
  }
  Bytes longer = kGolden;
  longer.push_back(0);
  EXPECT_FALSE(from_datagram(longer));
  Bytes too_long(kDatagramHeader + kMaxFrame + 1);
  std::copy(kGolden.begin(), kGolden.begin() + 8, too_long.begin());
  too_long[8] = static_cast<std::uint8_t>((kMaxFrame + 1) >> 8);
  too_long[9] = static_cast<std::uint8_t>(kMaxFrame + 1);
  EXPECT_FALSE(from_datagram(too_long));
}

TEST(Datagram, IsRefusedWithAnotherBitInTheHeaderThanTheSenders) {
  for (std::size_t at = 0; at < kDatagramHeader; ++at) {
    if (at == 6 || at == 7) continue;  // the sender
    for (int bit = 0; bit < 8; ++bit) {
      Bytes changed = kGolden;
      changed[at] = static_cast<std::uint8_t>(changed[at] ^ (1 << bit));
      EXPECT_FALSE(from_datagram(changed)) << "byte " << at << " bit " << bit;
    }
  }
}

TEST(Datagram, IsRefusedFromAgentsThatCannotBe) {
  for (const std::uint8_t byte : {std::uint8_t{0x00}, std::uint8_t{0xff}}) {
    Bytes changed = kGolden;
    changed[6] = changed[7] = byte;
    EXPECT_FALSE(from_datagram(changed));
  }
}

TEST(Datagram, OfRandomBytesIsRefused) {
  RandomStream random(1, "garbage");
  for (int i = 0; i < 100'000; ++i) {
    Bytes bytes(random.below(64));
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
    ASSERT_FALSE(from_datagram(bytes));
  }
}

}  // namespace
}  // namespace hal::robot::radio
