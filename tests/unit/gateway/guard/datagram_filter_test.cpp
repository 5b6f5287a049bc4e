#include "gateway/guard/datagram_filter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/fake_clock.h"
#include "tests/unit/gateway/guard/udp_socket.h"
#include "tests/unit/hal/rtps/datagrams.h"

namespace gateway::guard {
namespace {

constexpr std::uint32_t kLocalhost = 0x7f000001;
const UdpSender kSender{kLocalhost, 40000};

/// A HEARTBEAT of a participant whose GUID prefix ends with a number.
hal::rtps::Datagram heartbeat(std::uint8_t participant, std::uint8_t first = 1) {
  hal::rtps::Datagram datagram = hal::rtps::datagram(
      "0701 1c00 00000107 00000102 00000000 01000000 00000000 ff000000 01000000");
  datagram[19] = participant;
  datagram[36] = first;
  return datagram;
}

hal::rtps::GuidPrefix prefix_of(const hal::rtps::Datagram& datagram) {
  hal::rtps::GuidPrefix prefix;
  std::ranges::copy(hal::rtps::octets_of(datagram).subspan(8, 12), prefix.octets.begin());
  return prefix;
}

class StarFilter : public testing::Test {
 protected:
  bool lets_in(const hal::rtps::Datagram& datagram, const UdpSender& sender = kSender) {
    return filter_.lets_in(hal::rtps::octets_of(datagram), sender);
  }
  DatagramFilter filter_{{.networks = networks_of({"127.0.0.1"}), .is_star = true}};
};

TEST_F(StarFilter, LetsInWhatRealParticipantsSend) {
  for (const hal::rtps::Datagram& one : hal::rtps::recorded("fast_dds")) {
    EXPECT_TRUE(lets_in(one, {kLocalhost, one[19]}));  // each participant from its own port
  }
  EXPECT_EQ(filter_.drops(), "");
}

TEST_F(StarFilter, DropsGarbageAndTellsHowMuchAndFromWhom) {
  hal::rtps::Datagram cut = heartbeat(1);
  cut.resize(40);
  EXPECT_FALSE(lets_in(cut));
  EXPECT_FALSE(lets_in(cut, {kLocalhost, 40001}));
  EXPECT_FALSE(lets_in({1, 2, 3}));
  EXPECT_EQ(filter_.drops(),
            "3 datagrams from 127.0.0.1:40000: 2 submessage: it is longer than the datagram; "
            "1 header: it is shorter than 20 octets");
}

TEST(GuestsFilter, LetsInOnlyWhatComesFromThePortsOfItsHost) {
  DatagramFilter filter({.networks = networks_of({"127.0.0.1"}), .is_star = true, .ports = {7, 8}});
  const auto lets_in = [&](std::uint8_t participant, std::uint16_t port) {
    return filter.lets_in(hal::rtps::octets_of(heartbeat(participant)), {kLocalhost, port});
  };
  EXPECT_TRUE(lets_in(1, 7));
  EXPECT_TRUE(lets_in(2, 8));
  EXPECT_FALSE(lets_in(3, 9));
  EXPECT_EQ(filter.drops(),
            "1 datagrams from 127.0.0.1:9: 1 sender: it is not the process that invited this one");
}

TEST_F(StarFilter, DropsWhatComesFromBeyondTheInterface) {
  EXPECT_TRUE(lets_in(heartbeat(1), {0x7f000007, 1}));
  EXPECT_FALSE(lets_in(heartbeat(2), {0xcb007107, 1}));
  EXPECT_EQ(filter_.drops(),
            "1 datagrams from 203.0.113.7:1: 1 sender: it is beyond the interfaces "
            "of this participant");
}

TEST_F(StarFilter, BindsAParticipantToThePortItSpeaksFromWhileItHasIt) {
  const guard::UdpSocket second;
  {
    const guard::UdpSocket first;
    EXPECT_TRUE(lets_in(heartbeat(1), first.sender()));
    EXPECT_FALSE(lets_in(heartbeat(1), second.sender()));
    EXPECT_TRUE(lets_in(heartbeat(1), first.sender()));
    EXPECT_TRUE(lets_in(heartbeat(2), second.sender()));
    EXPECT_EQ(filter_.sender_of(prefix_of(heartbeat(1))), first.sender());
  }
  EXPECT_TRUE(lets_in(heartbeat(1), second.sender())) << "nobody has the first port any more";
  EXPECT_EQ(filter_.sender_of(prefix_of(heartbeat(1))), second.sender());
  EXPECT_EQ(filter_.sender_of(prefix_of(heartbeat(3))), std::nullopt);
}

TEST_F(StarFilter, WhatWasDroppedBindsNobody) {
  hal::rtps::Datagram cut = heartbeat(1);
  cut.resize(40);
  EXPECT_FALSE(lets_in(cut, {kLocalhost, 40001}));
  EXPECT_TRUE(lets_in(heartbeat(1)));
}

TEST_F(StarFilter, HearsNobodyWhoIsIgnored) {
  filter_.ignore(prefix_of(heartbeat(1)));
  EXPECT_FALSE(lets_in(heartbeat(1)));
  EXPECT_TRUE(lets_in(heartbeat(2)));
}

TEST(SilentParticipant, IsOneOfWhomNothingWasLetInForThatLong) {
  tests::FakeClock clock;
  DatagramFilter filter({.networks = networks_of({"127.0.0.1"}), .is_star = true, .clock = clock});
  const auto silence = [&filter](std::uint8_t participant) {
    return filter.silence_of(prefix_of(heartbeat(participant)));
  };
  ASSERT_TRUE(filter.lets_in(hal::rtps::octets_of(heartbeat(1)), kSender));
  clock.run_until(hal::Time{std::chrono::milliseconds{700}});
  EXPECT_EQ(silence(1), std::chrono::milliseconds{700});
  EXPECT_EQ(silence(2), std::nullopt);
  ASSERT_TRUE(filter.lets_in(hal::rtps::octets_of(heartbeat(1)), kSender));
  EXPECT_EQ(silence(1), hal::Duration{});
  filter.ignore(prefix_of(heartbeat(1)));
  filter.ignore(prefix_of(heartbeat(3)));
  clock.run_until(hal::Time{std::chrono::milliseconds{2700}});
  EXPECT_FALSE(filter.lets_in(hal::rtps::octets_of(heartbeat(1)), kSender));
  EXPECT_EQ(silence(1), std::chrono::seconds{2});
  EXPECT_EQ(silence(3), std::nullopt) << "never heard";
}

TEST_F(StarFilter, NumbersThatReceiversWouldCountUpToMustBeNear) {
  hal::rtps::Datagram far = heartbeat(1);
  far[36] = 0, far[39] = 0x04;  // the first: 2^26
  far[40] = 1;                  // the last is far beyond
  EXPECT_TRUE(lets_in(far));
  far[39] = 0x09;
  EXPECT_FALSE(lets_in(far)) << "2^26 above the last";
  far[39] = 0x08;
  EXPECT_TRUE(lets_in(far));
  EXPECT_FALSE(lets_in([] {
    hal::rtps::Datagram first = heartbeat(2);
    first[39] = 0x7f, first[40] = 1;
    return first;
  }()));
}

TEST(OpenFilter, AllowsSeveralPortsAndRelayedDiscovery) {
  DatagramFilter filter({.networks = networks_of({"127.0.0.1"}), .is_star = false});
  EXPECT_TRUE(filter.lets_in(hal::rtps::octets_of(heartbeat(1)), kSender));
  EXPECT_TRUE(filter.lets_in(hal::rtps::octets_of(heartbeat(1)), {kLocalhost, 40001}));
  for (const hal::rtps::Datagram& one : hal::rtps::recorded("cyclone_dds")) {
    EXPECT_TRUE(filter.lets_in(hal::rtps::octets_of(one), kSender));
  }
}

TEST(Networks, AreThoseOfTheInterfacesWithTheAddresses) {
  const auto networks = networks_of({"127.0.0.1", "203.0.113.7"});
  ASSERT_GE(networks.size(), 3) << "and the addresses of this host, of which 127.0.0.1 is one";
  EXPECT_TRUE(networks[0].holds(0x7f123456)) << "127.0.0.0/8";
  EXPECT_FALSE(networks[0].holds(0x80000001));
  EXPECT_TRUE(networks[1].holds(0xcb007107)) << "nobody has it, so nobody else is near";
  EXPECT_FALSE(networks[1].holds(0xcb007108));
}

}  // namespace
}  // namespace gateway::guard
