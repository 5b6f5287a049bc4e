#include "programs/lockstep/kernel_frames.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

namespace programs::lockstep {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kSecond = 1'000'000'000;

Bytes ethernet(std::uint16_t type, const Bytes& payload) {
  Bytes frame(12, 2);
  frame.push_back(static_cast<std::uint8_t>(type >> 8));
  frame.push_back(static_cast<std::uint8_t>(type));
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

/// The header of a published example (Wikipedia, "Internet checksum", 2024; its sum is
/// 0xb861 with the identification 0), 20 bytes, and as many of content.
Bytes ipv4(std::uint16_t identification, std::uint16_t fragment = 0, std::uint8_t protocol = 17) {
  Bytes packet{0x45, 0, 0,    0x73, 0, 0, 0x40, 0,    0x40, protocol,
               0,    0, 0xc0, 0xa8, 0, 1, 0xc0, 0xa8, 0,    0xc7};
  packet[4] = static_cast<std::uint8_t>(identification >> 8);
  packet[5] = static_cast<std::uint8_t>(identification);
  packet[6] = static_cast<std::uint8_t>(fragment >> 8);
  packet[7] = static_cast<std::uint8_t>(fragment);
  packet.resize(40, 7);
  return ethernet(0x0800, packet);
}

Bytes arp(std::uint8_t operation, std::uint8_t sender, std::uint8_t target) {
  return ethernet(0x0806, {0,  1,  8, 0,      6, 4, 0, operation, 2, 0, 0,  0,  0, sender,
                           10, 77, 0, sender, 0, 0, 0, 0,         0, 0, 10, 77, 0, target});
}

Bytes icmpv6(std::uint8_t type, bool behind_options = false) {
  Bytes packet{0x60, 0, 0, 0, 0, 24, 58, 255};
  packet.resize(40, 1);
  if (behind_options) {
    packet[6] = 0;
    packet.insert(packet.end(), {58, 0, 5, 2, 0, 0, 1, 0});
  }
  packet.insert(packet.end(), {type, 0, 0, 0, 0, 0, 0, 0});
  packet.resize(packet.size() + 16, 9);  // the target
  return ethernet(0x86dd, packet);
}

std::uint16_t word(KernelFrames::Frame frame, std::size_t at) {
  return static_cast<std::uint16_t>(frame[at] << 8 | frame[at + 1]);
}
std::uint16_t identification(KernelFrames::Frame frame) { return word(frame, 14 + 4); }

/// One's complement sum of the header's words, its own checksum among them: all ones if it is
/// right.
std::uint32_t sum_of_header(KernelFrames::Frame frame) {
  std::uint32_t sum = 0;
  for (std::size_t i = 14; i < 34; i += 2) sum += word(frame, i);
  while (sum >> 16 != 0) sum = (sum & 0xffff) + (sum >> 16);
  return sum;
}

TEST(KernelFramesTest, DropWhatTheKernelSendsByItsOwnTimers) {
  KernelFrames kernel;
  EXPECT_TRUE(kernel.on_sent(ipv4(1, 0, 2), 0).empty()) << "IGMP";
  for (const auto type : std::to_array<std::uint8_t>({130, 131, 132, 133, 137, 143})) {
    EXPECT_TRUE(kernel.on_sent(icmpv6(type), 0).empty()) << int{type};
    EXPECT_TRUE(kernel.on_sent(icmpv6(type, true), 0).empty()) << int{type};
  }
  for (const auto type : std::to_array<std::uint8_t>({1, 128, 129, 135, 136}))
    EXPECT_FALSE(kernel.on_sent(icmpv6(type), 0).empty()) << int{type};
  EXPECT_FALSE(kernel.on_sent(ipv4(1), 0).empty());
  for (const auto type : std::to_array<std::uint8_t>({0, 3, 5, 8, 11})) {
    Bytes icmp = ipv4(1, 0, 1);
    icmp[14 + 20] = type;
    EXPECT_EQ(kernel.on_sent(icmp, 0).empty(), type == 5) << int{type};
  }
  EXPECT_FALSE(kernel.on_sent(arp(1, 1, 2), 0).empty());
  EXPECT_FALSE(kernel.on_sent(Bytes{1, 2, 3}, 0).empty()) << "no frame at all is not its concern";
}

TEST(KernelFramesTest, CountIdentificationsAndMendTheChecksum) {
  KernelFrames kernel;
  for (std::uint16_t i = 1; i < 4; ++i) {
    const auto sent = kernel.on_sent(ipv4(static_cast<std::uint16_t>(0x9000 - 77 * i)), 0);
    EXPECT_EQ(identification(sent), i);
    EXPECT_EQ(sum_of_header(sent), 0xffffU);
  }
  // The published one: 0xb861 for identification 0, so 0xb860 for 1.
  KernelFrames anew;
  Bytes example = ipv4(0x1234, 0x4000);
  EXPECT_EQ(word(anew.on_sent(example, 0), 14 + 10), 0xb860);
}

TEST(KernelFramesTest, NumberTheFragmentsOfAPacketAlike) {
  KernelFrames kernel;
  constexpr std::uint16_t kMore = 0x2000;
  EXPECT_EQ(identification(kernel.on_sent(ipv4(50, kMore), 0)), 1);
  EXPECT_EQ(identification(kernel.on_sent(ipv4(60, kMore), 0)), 2) << "another packet between";
  EXPECT_EQ(identification(kernel.on_sent(ipv4(50, kMore | 185), 0)), 1);
  EXPECT_EQ(identification(kernel.on_sent(ipv4(50, 370), 0)), 1) << "its last";
  EXPECT_EQ(identification(kernel.on_sent(ipv4(50, kMore), 0)), 3) << "the next that is called so";
  EXPECT_EQ(identification(kernel.on_sent(ipv4(60, 185), 0)), 2);
}

TEST(KernelFramesTest, RepeatARequestEverySecondUntilItIsAnswered) {
  KernelFrames kernel;
  int sent = 0;
  const auto count = [&sent](KernelFrames::Frame frame) {
    ++sent;
    EXPECT_EQ(word(frame, 12), 0x0806);
  };
  EXPECT_EQ(kernel.next(), std::nullopt);
  kernel.on_sent(arp(1, 1, 2), 5);
  EXPECT_EQ(kernel.next(), 5 + kSecond);
  kernel.repeat(5 + kSecond - 1, count);
  EXPECT_EQ(sent, 0);
  kernel.on_received(arp(2, 3, 1));
  kernel.repeat(5 + kSecond, count);
  EXPECT_EQ(sent, 1) << "another station has answered";
  for (int i = 2; i <= 10; ++i) kernel.repeat(5 + i * kSecond, count);
  EXPECT_EQ(sent, 10) << "packets wait in the kernel, which never asks again by itself";
  kernel.on_received(arp(2, 2, 1));
  EXPECT_EQ(kernel.next(), std::nullopt);
}

TEST(KernelFramesTest, RepeatNeighbourSolicitationsOfIpv6LikeWise) {
  KernelFrames kernel;
  constexpr std::uint8_t kSolicitation = 135, kAdvertisement = 136;
  kernel.on_sent(icmpv6(kSolicitation), 0);
  EXPECT_EQ(kernel.next(), kSecond);
  kernel.on_received(icmpv6(kAdvertisement));
  EXPECT_EQ(kernel.next(), std::nullopt);
}

}  // namespace
}  // namespace programs::lockstep
