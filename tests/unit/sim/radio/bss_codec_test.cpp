#include <gtest/gtest.h>

#include "sim/radio/infrastructure/management.h"
#include "sim/radio/mac/codec.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

// Bytes by hand from IEEE Std 802.11-2016, 9.2 to 9.4, without the FCS.
const hal::Bytes kBeaconOfAp1{0x80, 0x00, 0x00, 0x00,                          // beacon
                              0xff, 0xff, 0xff, 0xff, 0xff, 0xff,              // to everyone
                              0x02, 0x00, 0x00, 0x00, 0x00, 0x01,              // from 1
                              0x02, 0x00, 0x00, 0x00, 0x00, 0x01,              // BSSID
                              0x70, 0x00,                                      // sequence 7
                              0x80, 0x91, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00,  // TSF: 102784 us
                              0x64, 0x00,                                      // 100 time units
                              0x21, 0x04,             // ESS, short preamble, short slot
                              0x00, 0x02, 'a',  'b',  // SSID
                              0x01, 0x08, 0x82, 0x84, 0x0b, 0x0c, 0x12, 0x16, 0x18, 0x24,  // rates
                              0x03, 0x01, 0x06,                    // channel 6
                              0x05, 0x04, 0x00, 0x01, 0x00, 0x00,  // TIM: no traffic
                              0x2a, 0x01, 0x03,   // ERP: non-ERP present, use protection
                              0x32, 0x01, 0x30};  // extended rates

BssParameters network() {
  return {.ssid = "ab",
          .rates = {0x82, 0x84, 0x0b, 0x0c, 0x12, 0x16, 0x18, 0x24, 0x30},
          .channel = 6,
          .short_preamble = true,
          .short_slot = true,
          .erp = true,
          .use_protection = true};
}

Frame management(FrameType type, hal::AgentId to, const hal::Bytes& body) {
  return {.type = type,
          .transmitter = hal::AgentId{1},
          .receiver = to,
          .sequence = 7,
          .address3 = hal::AgentId{1},
          .payload = std::make_shared<const hal::Bytes>(body)};
}

hal::Bytes without_fcs(hal::Bytes bytes) {
  bytes.resize(bytes.size() - 4);
  return bytes;
}

TEST(BssCodec, EncodesBeacon) {
  const hal::Bytes body =
      encode(Beacon{.timestamp = hal::Time{} + 102784us, .interval = 102400us, .bss = network()});
  EXPECT_EQ(without_fcs(encode(management(FrameType::kBeacon, hal::kEveryone, body))),
            kBeaconOfAp1);
}

TEST(BssCodec, DecodesBeacon) {
  const hal::Bytes bytes = encode(management(
      FrameType::kBeacon, hal::kEveryone,
      encode(Beacon{.timestamp = hal::Time{} + 102784us, .interval = 102400us, .bss = network()})));
  const auto frame = decode(bytes);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->type, FrameType::kBeacon);
  EXPECT_EQ(frame->address3, hal::AgentId{1});
  EXPECT_EQ(frame->sequence, 7);
  const auto beacon = decode_beacon(*frame->payload);
  ASSERT_TRUE(beacon.has_value());
  EXPECT_EQ(beacon->timestamp, hal::Time{} + 102784us);
  EXPECT_EQ(beacon->interval, 102400us);
  EXPECT_EQ(beacon->bss, network());
  EXPECT_EQ(encode(*frame), bytes);
}

// Table 9-26: address 1 is the access point or the destination, 2 the source or the access point, 3
// the other one.
TEST(BssCodec, DataHasItsThreeAddressesByTheDsBits) {
  Frame frame{.type = FrameType::kData,
              .transmitter = hal::AgentId{2},
              .receiver = hal::AgentId{1},
              .ds = Ds::kTo,
              .address3 = hal::AgentId{3},
              .ethertype = kEthertypeRouting,
              .payload = std::make_shared<const hal::Bytes>(hal::Bytes{'h', 'i'})};
  const hal::Bytes up = encode(frame);
  EXPECT_EQ(up[0], 0x08);
  EXPECT_EQ(up[1], 0x01);
  EXPECT_EQ(up[9], 1);
  EXPECT_EQ(up[15], 2);
  EXPECT_EQ(up[21], 3);
  const auto back = decode(up);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->ds, Ds::kTo);
  EXPECT_EQ(back->source(), hal::AgentId{2});
  EXPECT_EQ(back->destination(), hal::AgentId{3});

  frame.ds = Ds::kFrom;
  frame.transmitter = hal::AgentId{1};
  frame.receiver = hal::kEveryone;
  frame.address3 = hal::AgentId{2};
  frame.retry = true;
  const auto down = decode(encode(frame));
  ASSERT_TRUE(down.has_value());
  EXPECT_EQ(encode(frame)[1], 0x0a);
  EXPECT_EQ(down->ds, Ds::kFrom);
  EXPECT_TRUE(down->retry);
  EXPECT_EQ(down->source(), hal::AgentId{2});
  EXPECT_EQ(down->destination(), hal::kEveryone);
}

TEST(BssCodec, BodiesOfManagementComeBack) {
  const auto authentication =
      decode_authentication(encode(Authentication{.transaction = 2, .status = 17}));
  ASSERT_TRUE(authentication.has_value());
  EXPECT_EQ(authentication->transaction, 2);
  EXPECT_EQ(authentication->status, 17);

  const hal::Bytes first = encode(AssociationRequest{.bss = network()});
  EXPECT_EQ(decode_association_request(first, false)->bss.ssid, "ab");
  const hal::Bytes again =
      encode(AssociationRequest{.bss = network(), .current_access_point = hal::AgentId{9}});
  EXPECT_EQ(again.size(), first.size() + 6);
  EXPECT_EQ(decode_association_request(again, true)->current_access_point, hal::AgentId{9});

  const auto response = decode_association_response(
      encode(AssociationResponse{.bss = network(), .status = 0, .association_id = 2007}));
  ASSERT_TRUE(response.has_value());
  EXPECT_EQ(response->association_id, 2007);
  EXPECT_EQ(response->bss.rates, network().rates);

  EXPECT_EQ(decode_reason(encode_reason(kReasonNotAssociated)), kReasonNotAssociated);
}

TEST(BssCodec, CutBodiesAreRefused) {
  const hal::Bytes beacon = encode(Beacon{.interval = 102400us, .bss = network()});
  std::size_t accepted = 0;
  for (std::size_t size = 0; size < beacon.size(); ++size) {
    accepted += decode_beacon(Body(beacon).first(size)).has_value() ? 1 : 0;
  }
  EXPECT_EQ(accepted, 6u);  // between two of its six elements, or before the first
  EXPECT_FALSE(decode_authentication(hal::Bytes{0, 0, 1}).has_value());
  EXPECT_FALSE(decode_authentication(hal::Bytes{1, 0, 1, 0, 0, 0}).has_value());  // shared key
  EXPECT_FALSE(decode_reason(hal::Bytes{7}).has_value());
}

TEST(BssCodec, DsBitsBelongToDataOnly) {
  hal::Bytes beacon = kBeaconOfAp1;
  beacon[1] = 0x01;
  hal::Bytes mesh(40);
  mesh[0] = 0x08;
  mesh[1] = 0x03;
  for (hal::Bytes* bytes : {&beacon, &mesh}) {
    const std::uint32_t fcs = frame_check_sequence(*bytes);
    for (int i = 0; i < 4; ++i) bytes->push_back(static_cast<std::uint8_t>(fcs >> (8 * i)));
    EXPECT_FALSE(decode(*bytes).has_value());
  }
}

}  // namespace
}  // namespace sim::radio::test
