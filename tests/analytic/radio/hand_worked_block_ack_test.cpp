#include <gtest/gtest.h>

#include "hal/types/random.h"
#include "sim/radio/mac/sequence_number.h"
#include "tests/unit/sim/radio/air.h"

/// Exchanges of QoS stations worked out by hand to the nanosecond: IEEE Std 802.11-2020, HT in 2.4
/// GHz, 20 MHz, MCS 7, long guard interval, stations 30 m apart.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kHtSifs = 10us, kHtSlot = 9us;
constexpr hal::Duration kDelay30 = 100ns;                 // 30 m / 299792458 m/s
constexpr hal::Duration kAifsBe = kHtSifs + 3 * kHtSlot;  // table 9-155
constexpr hal::Duration kAifsVo = kHtSifs + 2 * kHtSlot;
constexpr hal::Duration kHtHead = 36us;    // 19.3.2: 20 + HT-SIG 8 + STF 4 + LTF 4
constexpr hal::Duration kExtension = 6us;  // 19.3.2, 2.4 GHz
constexpr std::size_t kOctets = 100;
// 26 MAC header, 8 LLC/SNAP, 100, 4 FCS: 138 octets; with a delimiter 142, padded to 144.
// (16 + 6 + 8 x (144 + 144 + 142)) / 260 bits a symbol: 13.3, so 14 symbols of 4 us.
constexpr hal::Duration kThree = kHtHead + 14 * 4us + kExtension;
// One MPDU of 138 octets: (22 + 1104) / 260 = 4.3.
constexpr hal::Duration kOne = kHtHead + 5 * 4us + kExtension;
// BlockAck of 32 octets at 24 Mb/s: (22 + 256) / 96 = 2.9; ACK of 14: (22 + 112) / 96 = 1.4.
constexpr hal::Duration kBlockAckTime = 20us + 3 * 4us + kExtension;
constexpr hal::Duration kAckTime = 20us + 2 * 4us + kExtension;
// BlockAckReq of 24 octets at 24 Mb/s: (22 + 192) / 96 = 2.2.
constexpr hal::Duration kRequestTime = 20us + 3 * 4us + kExtension;

class BlockAckByHand : public testing::Test {
 protected:
  BlockAckByHand() : air(Profile::kIeee80211n) {}

  /// Two stations that have agreed, and station 1 sends three MSDUs at 100 ms.
  void send_three() {
    air.add_line(2, 30);
    air.build();
    air.send(1, 2, kOctets);
    air.at(100ms, [this] {
      first_ = air.log.starts.size();
      for (int i = 0; i < 3; ++i) air.send(1, 2, kOctets);
    });
  }
  /// Energy of 5 us on the axis beside a station.
  void jam(hal::Duration at, double x) {
    air.at(at, [this, x] {
      air.network->interfere({{x, 1, 0}, hal::Milliwatts{100}, std::nullopt, 5us});
    });
  }
  const Log::Start& frame(std::size_t index) const { return air.log.starts.at(first_ + index); }
  hal::Duration start(std::size_t index) const { return frame(index).at.time_since_epoch(); }
  hal::Verdict verdict(std::size_t index, std::uint16_t receiver) const {
    return air.log.verdicts(first_ + index, receiver).at(0);
  }
  static void expect_whole_slots(hal::Duration backoff, std::int64_t window) {
    EXPECT_EQ(backoff % kHtSlot, 0us);
    EXPECT_GE(backoff / kHtSlot, 0);
    EXPECT_LE(backoff / kHtSlot, window);
  }

  Air air;
  std::size_t first_ = 0;
};

// 10.12.3, 10.25.6: the BlockAck tells which MPDU is missing, and only that one is sent again. Jam
// beside station 2 covers part of the second subframe, which lasts from 36 us + 56 us x 1152 / 3440
// to 36 us + 56 us x 2288 / 3440.
TEST_F(BlockAckByHand, AnAmpduOfThreeWithOneLost) {
  send_three();
  jam(100ms + 60us, 30);
  air.run(200ms);
  constexpr hal::Duration kAnswer = 100ms + kThree + kDelay30 + kHtSifs;
  EXPECT_EQ(start(0), 100ms);
  EXPECT_EQ(start(2), 100ms);
  EXPECT_EQ(frame(2).frame.ampdu, frame(0).frame.ampdu);
  EXPECT_EQ(verdict(0, 2), hal::Verdict::kDelivered);
  EXPECT_NE(verdict(1, 2), hal::Verdict::kDelivered);
  EXPECT_EQ(verdict(2, 2), hal::Verdict::kDelivered);
  EXPECT_EQ(frame(0).frame.duration, kHtSifs + kBlockAckTime);
  EXPECT_EQ(frame(3).frame.type, FrameType::kBlockAck);
  EXPECT_EQ(start(3), kAnswer);
  const BlockAckFields& said = *frame(3).frame.block_ack;
  const std::uint32_t first = steps(said.start, frame(0).frame.sequence);
  EXPECT_TRUE(said.received[first]);
  EXPECT_FALSE(said.received[first + 1]);
  EXPECT_TRUE(said.received[first + 2]);
  // Success, so the window is the smallest.
  expect_whole_slots(start(4) - (kAnswer + kBlockAckTime + kDelay30 + kAifsBe), 15);
  EXPECT_EQ(frame(4).frame.sequence, frame(1).frame.sequence);
  EXPECT_TRUE(frame(4).frame.retry);
  EXPECT_EQ(frame(4).frame.ampdu, 0U) << "a single MPDU";
  EXPECT_EQ(frame(5).frame.type, FrameType::kAck);
  EXPECT_EQ(start(5), start(4) + kOne + kDelay30 + kHtSifs);
  // The third waited for the second.
  const auto& received = air.inbox(2).received;
  ASSERT_EQ(received.size(), 4U);
  EXPECT_EQ(received[1].at.time_since_epoch(), 100ms + kThree + kDelay30);
  EXPECT_EQ(received[2].at.time_since_epoch(), start(4) + kOne + kDelay30);
  EXPECT_EQ(received[3].at, received[2].at);
}

// 10.25.7: after a lost BlockAck the originator asks by a BlockAckReq, and sends nothing again. The
// BlockAck is wrong at station 1, which waits for EIFS, and its window has grown.
TEST_F(BlockAckByHand, ARequestAfterALostBlockAck) {
  send_three();
  constexpr hal::Duration kAnswer = 100ms + kThree + kDelay30 + kHtSifs;
  jam(kAnswer + 30us, 0);
  air.run(200ms);
  EXPECT_NE(verdict(3, 1), hal::Verdict::kDelivered);
  constexpr hal::Duration kLowestAck = 304us;  // 14 octets at 1 Mb/s: 192 us + 112 us
  const hal::Duration idle = kAnswer + kBlockAckTime + kDelay30;
  EXPECT_EQ(frame(4).frame.type, FrameType::kBlockAckRequest);
  expect_whole_slots(start(4) - (idle + kHtSifs + kLowestAck + kAifsBe), 31);
  EXPECT_EQ(frame(4).frame.block_ack->start, frame(0).frame.sequence);
  EXPECT_EQ(frame(4).frame.duration, kHtSifs + kBlockAckTime);
  EXPECT_EQ(frame(5).frame.type, FrameType::kBlockAck);
  EXPECT_EQ(start(5), start(4) + kRequestTime + kDelay30 + kHtSifs);
  EXPECT_EQ(air.log.starts.size(), first_ + 6);
  EXPECT_EQ(air.inbox(1).ended.size(), 4U);
  for (const Inbox::Ended& one : air.inbox(1).ended) {
    EXPECT_EQ(one.verdict, hal::Verdict::kDelivered);
  }
}

// 10.23.2.4: of two functions whose backoffs end in the same slot the higher one sends, and the
// lower one doubles its window. Both draw while station 2 sends.
TEST_F(BlockAckByHand, AnInternalCollision) {
  dcf_of(air.config)->aggregation.max_ampdu = 0;
  std::int64_t best_effort = 0, voice = 0, again = 0;
  for (air.seed = 1; voice != best_effort + 1; ++air.seed) {
    hal::RandomStream stream(air.seed + 1, "s1/backoff");
    best_effort = stream.below(16);
    voice = stream.below(4);
    again = stream.below(32);
  }
  air.add_line(2, 30);
  air.build();
  air.at(100ms, [this] {
    first_ = air.log.starts.size();
    air.broadcast(2, kOctets);
  });
  air.at(100ms + 50us, [this] {
    air.send(1, 2, kOctets);
    air.sap(1).transmit({.destination = hal::AgentId{2},
                         .priority = 6,
                         .payload = std::make_shared<const hal::Bytes>(kOctets)});
  });
  air.run(200ms);
  const hal::Duration idle = 100ms + frame(0).frame.airtime + kDelay30;
  EXPECT_EQ(start(1), idle + kAifsVo + voice * kHtSlot);
  EXPECT_EQ(start(1), idle + kAifsBe + best_effort * kHtSlot);
  EXPECT_EQ(frame(1).frame.priority, 6);
  EXPECT_EQ(start(2), start(1) + kOne + kDelay30 + kHtSifs);
  EXPECT_EQ(frame(3).frame.priority, 0);
  EXPECT_EQ(start(3), start(2) + kAckTime + kDelay30 + kAifsBe + again * kHtSlot);
  EXPECT_FALSE(frame(3).frame.retry) << "it was not on the air";
}

// An RTS before a frame of 40 MHz: a station of 802.11g hears RTS and CTS, and waits for their
// Duration, which it could not take from the frame itself.
TEST_F(BlockAckByHand, AnRtsBeforeAWideFrameWithAnOlderStation) {
  auto& n = std::get<Ieee80211nConfig>(air.config);
  n.mcs.width = 40;
  n.aggregation.max_ampdu = 0;
  n.contention.rts_threshold = 0;
  air.add_line(3, 30);
  air.station_config(3).standard = Standard::kIeee80211g;
  air.build();
  air.at(100ms, [this] { air.send(1, 2, kOctets); });
  air.at(100ms + 50us, [this] { air.broadcast(3, kOctets); });
  air.run(200ms);
  // RTS of 20 octets and CTS of 14 at 24 Mb/s: (22 + 160) / 96 = 1.9, (22 + 112) / 96 = 1.4.
  constexpr hal::Duration kRtsTime = 20us + 2 * 4us + kExtension;
  // 40 MHz, 540 bits a symbol: (22 + 1104) / 540 = 2.1.
  constexpr hal::Duration kWide = kHtHead + 3 * 4us + kExtension;
  EXPECT_EQ(frame(0).frame.type, FrameType::kRts);
  EXPECT_EQ(frame(0).frame.mode->modulation_class(), ModulationClass::kOfdm);
  EXPECT_EQ(frame(0).frame.duration, 3 * kHtSifs + kAckTime + kWide + kAckTime);
  const hal::Duration cts = 100ms + kRtsTime + kDelay30 + kHtSifs;
  EXPECT_EQ(start(1), cts);
  const hal::Duration data = cts + kAckTime + kDelay30 + kHtSifs;
  EXPECT_EQ(start(2), data);
  EXPECT_EQ(frame(2).frame.mode->width(), 40);
  EXPECT_EQ(verdict(2, 3), hal::Verdict::kPreambleMissed) << "it is no frame of its classes";
  const hal::Duration ack = data + kWide + kDelay30 + kHtSifs;
  EXPECT_EQ(start(3), ack);
  // The ACK's end at station 3, 30 m from its transmitter, is after the NAV; then DIFS and backoff.
  const hal::Duration idle = ack + kAckTime + kDelay30;
  EXPECT_EQ(frame(4).frame.transmitter.value, 3);
  expect_whole_slots(start(4) - (idle + kHtSifs + 2 * kHtSlot), 15);
}

/// Stations 1 and 2 send in 40 MHz, 3 knows HT but has only 20 MHz. It sends a broadcast that comes
/// to it while 1 sends.
class BesideTwentyMegahertz : public BlockAckByHand {
 protected:
  void run(bool is_protected) {
    auto& n = std::get<Ieee80211nConfig>(air.config);
    n.mcs.width = 40;
    n.aggregation.max_ampdu = 0;
    n.wide_protection = is_protected;
    air.add_line(3, 30);
    air.station_config(3).width = 20;
    air.build();
    air.at(100ms, [this] { air.send(1, 2, kOctets); });
    air.at(100ms + 10us, [this] { air.broadcast(3, kOctets); });
    air.run(200ms);
  }

  // 40 MHz, 540 bits a symbol: (22 + 1104) / 540 = 2.1.
  static constexpr hal::Duration kWide = kHtHead + 3 * 4us + kExtension;
};

// 10.27.3.1 asks for nothing: 3 takes the end of the frame from its L-SIG.
TEST_F(BesideTwentyMegahertz, AWideFrameIsNotProtectedAndTheNarrowStationDefers) {
  run(false);
  EXPECT_EQ(frame(0).frame.type, FrameType::kData);
  EXPECT_EQ(frame(0).frame.mode->width(), 40);
  EXPECT_EQ(start(0), 100ms);
  EXPECT_NE(verdict(0, 3), hal::Verdict::kDelivered);
  const hal::Duration ack = 100ms + kWide + kDelay30 + kHtSifs;
  EXPECT_EQ(start(1), ack);
  EXPECT_EQ(frame(2).frame.transmitter.value, 3);
  expect_whole_slots(start(2) - (ack + kAckTime + kDelay30 + kAifsBe), 15);
}

// As drivers do: a CTS-to-self of 14 octets at 24 Mb/s, whose Duration ends with the ACK.
TEST_F(BesideTwentyMegahertz, AWideFrameIsProtectedAsDriversDo) {
  run(true);
  EXPECT_EQ(frame(0).frame.type, FrameType::kCts);
  EXPECT_EQ(frame(0).frame.receiver.value, 1);
  EXPECT_EQ(frame(0).frame.mode->modulation_class(), ModulationClass::kOfdm);
  EXPECT_EQ(frame(0).frame.airtime, kAckTime);
  EXPECT_EQ(frame(0).frame.duration, kHtSifs + kWide + kHtSifs + kAckTime);
  EXPECT_EQ(verdict(0, 3), hal::Verdict::kDelivered);
  const hal::Duration data = 100ms + kAckTime + kHtSifs;
  EXPECT_EQ(start(1), data);
  EXPECT_EQ(frame(1).frame.mode->width(), 40);
  const hal::Duration ack = data + kWide + kDelay30 + kHtSifs;
  EXPECT_EQ(start(2), ack);
  EXPECT_EQ(frame(3).frame.transmitter.value, 3);
  expect_whole_slots(start(3) - (ack + kAckTime + kDelay30 + kAifsBe), 15);
}

}  // namespace
}  // namespace sim::radio::test
