#include "sim/radio/mac/codec.h"

#include <gtest/gtest.h>

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

// Bytes by hand from IEEE Std 802.11-2016, 9.2 and 9.3; the last four of each by Python's
// zlib.crc32.
const hal::Bytes kAckTo1{0xd4, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00,
                         0x00, 0x00, 0x01, 0xd8, 0xd6, 0xbf, 0x8f};
const hal::Bytes kRtsFrom3To102{0xb4, 0x00, 0xe8, 0x03, 0x02, 0x00, 0x00, 0x00, 0x01, 0x02,
                                0x02, 0x00, 0x00, 0x00, 0x00, 0x03, 0x6f, 0xc2, 0x9d, 0x77};
const hal::Bytes kDataFrom1To2{0x08, 0x08, 0x3a, 0x01,              // data, retry, 314 us
                               0x02, 0x00, 0x00, 0x00, 0x00, 0x02,  // to 2
                               0x02, 0x00, 0x00, 0x00, 0x00, 0x01,  // from 1
                               0x02, 0x00, 0x00, 0x00, 0x00, 0x00,  // BSSID
                               0x30, 0x12,                          // sequence 0x123, fragment 0
                               0xaa, 0xaa, 0x03, 0x00, 0x00, 0x00,
                               0x88, 0xb5,  // LLC/SNAP, local experimental
                               0x68, 0x69,  // "hi"
                               0xcb, 0x83, 0x7e, 0x12};

Frame data_frame() {
  return {.type = FrameType::kData,
          .transmitter = hal::AgentId{1},
          .receiver = hal::AgentId{2},
          .duration = 313001ns,
          .sequence = 0x123,
          .retry = true,
          .ethertype = kEthertypeRouting,
          .payload = std::make_shared<const hal::Bytes>(hal::Bytes{'h', 'i'})};
}

TEST(Codec, FrameCheckSequenceGivesTheCatalogueValue) {
  const hal::Bytes digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(frame_check_sequence(digits), 0xcbf43926u);  // check value of CRC-32/ISO-HDLC
}

TEST(Codec, EncodesAcknowledgement) {
  EXPECT_EQ(encode({.type = FrameType::kAck, .receiver = hal::AgentId{1}}), kAckTo1);
}

TEST(Codec, EncodesRtsWithItsDuration) {
  EXPECT_EQ(encode({.type = FrameType::kRts,
                    .transmitter = hal::AgentId{3},
                    .receiver = hal::AgentId{0x102},
                    .duration = 1ms}),
            kRtsFrom3To102);
}

TEST(Codec, EncodesDataBehindLlcAndRoundsTheDurationUp) {
  EXPECT_EQ(encode(data_frame()), kDataFrom1To2);
}

TEST(Codec, EncodesBroadcastAsAllOnes) {
  Frame frame = data_frame();
  frame.receiver = hal::kEveryone;
  const hal::Bytes bytes = encode(frame);
  EXPECT_EQ(hal::Bytes(bytes.begin() + 4, bytes.begin() + 10), hal::Bytes(6, 0xff));
}

TEST(Codec, DecodesWhatItEncoded) {
  const auto frame = decode(kDataFrom1To2);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->type, FrameType::kData);
  EXPECT_EQ(frame->transmitter, hal::AgentId{1});
  EXPECT_EQ(frame->receiver, hal::AgentId{2});
  EXPECT_EQ(frame->duration, 314us);
  EXPECT_EQ(frame->sequence, 0x123);
  EXPECT_TRUE(frame->retry);
  EXPECT_EQ(frame->ethertype, kEthertypeRouting);
  EXPECT_EQ(*frame->payload, (hal::Bytes{'h', 'i'}));
  EXPECT_EQ(frame->air_length, 8u * 38);
  EXPECT_EQ(encode(*frame), kDataFrom1To2);
}

/// Wherever the destination stands: the first address, or To DS the third (table 9-26).
TEST(Codec, AGroupStaysWhatItIsOnTheAir) {
  const hal::Bytes mdns{0x01, 0x00, 0x5e, 0x00, 0x00, 0xfb};
  for (const Ds ds : {Ds::kNone, Ds::kTo, Ds::kFrom}) {
    Frame frame = data_frame();
    frame.ds = ds;
    (ds == Ds::kTo ? frame.address3 : frame.receiver) = hal::kEveryone;
    frame.group = 0x01005e0000fb;
    const hal::Bytes bytes = encode(frame);
    const auto at = bytes.begin() + (ds == Ds::kTo ? 16 : 4);
    EXPECT_EQ(hal::Bytes(at, at + 6), mdns);
    const auto decoded = decode(bytes);
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(decoded->destination(), hal::kEveryone);
    EXPECT_EQ(decoded->group, frame.group);
    EXPECT_EQ(encode(*decoded), bytes);
  }
}

TEST(Codec, DecodesControlFrames) {
  const auto rts = decode(kRtsFrom3To102);
  ASSERT_TRUE(rts.has_value());
  EXPECT_EQ(rts->type, FrameType::kRts);
  EXPECT_EQ(rts->transmitter, hal::AgentId{3});
  EXPECT_EQ(rts->duration, 1ms);
  const auto ack = decode(kAckTo1);
  ASSERT_TRUE(ack.has_value());
  EXPECT_EQ(ack->receiver, hal::AgentId{1});
}

TEST(Codec, RefusesEveryFlippedBit) {
  for (std::size_t bit = 0; bit < 8 * kRtsFrom3To102.size(); ++bit) {
    hal::Bytes bytes = kRtsFrom3To102;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_FALSE(decode(bytes).has_value()) << bit;
  }
}

/// With a good FCS, so that it is the content that is refused.
hal::Bytes sealed(hal::Bytes bytes) {
  const std::uint32_t fcs = frame_check_sequence(bytes);
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(fcs >> (8 * i)));
  return bytes;
}

TEST(Codec, RefusesForeignFrames) {
  EXPECT_FALSE(decode(hal::Bytes(13)).has_value()) << "too short";
  hal::Bytes probe(30);
  probe[0] = 0x40;
  EXPECT_FALSE(decode(sealed(probe)).has_value()) << "not one of our types";
  hal::Bytes rts(kRtsFrom3To102.begin(), kRtsFrom3To102.end() - 4);
  rts.push_back(0);
  EXPECT_FALSE(decode(sealed(rts)).has_value()) << "too long for an RTS";
  hal::Bytes foreign(kAckTo1.begin(), kAckTo1.end() - 4);
  foreign[4] = 0x00;
  EXPECT_FALSE(decode(sealed(foreign)).has_value()) << "not an address of ours";
  hal::Bytes no_snap(kDataFrom1To2.begin(), kDataFrom1To2.end() - 4);
  no_snap[24] = 0x42;
  EXPECT_FALSE(decode(sealed(no_snap)).has_value()) << "no LLC/SNAP";
}

}  // namespace
}  // namespace sim::radio::test
