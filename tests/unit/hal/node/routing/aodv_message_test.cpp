#include "hal/node/routing/aodv_message.h"

#include <gtest/gtest.h>

namespace hal::node::routing {
namespace {

using namespace std::chrono_literals;

const AodvPacket kRequest{.ttl = 7,
                          .message = Rreq{.gratuitous = true,
                                          .destination_only = false,
                                          .hops = 3,
                                          .id = 0x01020304,
                                          .destination = AgentId{9},
                                          .destination_sequence = 0xfffffffe,
                                          .originator = AgentId{2},
                                          .originator_sequence = 5}};
const AodvPacket kReply{.ttl = 35,
                        .message = Rrep{.hops = 2,
                                        .destination = AgentId{9},
                                        .destination_sequence = 7,
                                        .originator = AgentId{2},
                                        .lifetime = 6000ms}};
const AodvPacket kError{
    .ttl = 1,
    .message = Rerr{.no_delete = true, .unreachable = {{AgentId{9}, 8}, {AgentId{4}, 1}}}};

// RFC 3561, section 5.1, octet by octet, behind the TTL.
TEST(AodvMessage, ARequestHasTheFormatOfTheRfc) {
  const Bytes expected{7,    1,    0x20, 0,    3, 1, 2, 3, 4, 0, 0, 0, 9,
                       0xff, 0xff, 0xff, 0xfe, 0, 0, 0, 2, 0, 0, 0, 5};
  EXPECT_EQ(encode(kRequest), expected);
}

TEST(AodvMessage, RepliesAndErrorsHaveTheLengthsOfTheRfc) {
  EXPECT_EQ(encode(kReply).size(), 1u + 20u);
  EXPECT_EQ(encode(kError).size(), 1u + 4u + 2u * 8u);
}

TEST(AodvMessage, WhatIsWrittenIsRead) {
  Rreq unknown = std::get<Rreq>(kRequest.message);
  unknown.destination_sequence.reset();
  unknown.destination_only = true;
  for (const AodvPacket& packet : {kRequest, kReply, kError, AodvPacket{1, unknown}}) {
    EXPECT_EQ(parse_aodv(encode(packet)), packet);
  }
}

TEST(AodvMessage, NothingShorterOrLongerIsRead) {
  for (const AodvPacket& packet : {kRequest, kReply, kError}) {
    Bytes bytes = encode(packet);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(parse_aodv({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}));
    }
    bytes.push_back(0);
    EXPECT_FALSE(parse_aodv(bytes));
  }
}

TEST(AodvMessage, WhatNoNodeSendsIsRefused) {
  const auto with = [](const AodvPacket& packet, std::size_t place, std::uint8_t octet) {
    Bytes bytes = encode(packet);
    bytes.at(place) = octet;
    return parse_aodv(bytes);
  };
  EXPECT_FALSE(with(kRequest, 0, 0));     // no TTL left
  EXPECT_FALSE(with(kRequest, 1, 5));     // no such type
  EXPECT_FALSE(with(kRequest, 2, 0x80));  // flag 'J': multicast
  EXPECT_FALSE(with(kRequest, 10, 1));    // an address beyond 16 bits
  EXPECT_FALSE(with(kRequest, 12, 2));    // who searches for itself
  EXPECT_FALSE(with(kError, 4, 0));       // an error without destinations
}

TEST(AodvMessage, NumbersAreComparedAcrossTheirRollover) {
  EXPECT_TRUE(is_newer(2, 1));
  EXPECT_FALSE(is_newer(1, 1));
  EXPECT_TRUE(is_newer(0, 0xffffffff));
  EXPECT_TRUE(is_newer(5, 0xfffffff0));
  EXPECT_FALSE(is_newer(0xfffffff0, 5));
}

}  // namespace
}  // namespace hal::node::routing
