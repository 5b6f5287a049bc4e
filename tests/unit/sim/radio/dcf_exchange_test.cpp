#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/sim/radio/dcf.h"

namespace sim::radio::test {
namespace {

using hal::Verdict;

/// Frame exchanges, retries and queue.
class DcfExchange : public Ieee80211MacTest {};

TEST_F(DcfExchange, TakesALongIdleMediumAtOnce) {
  build_line(2);
  air.at(5ms, [this] { air.send(1, 2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 ACK2");
  EXPECT_EQ(start_of(0), 5ms);
  EXPECT_EQ(start_of(1), 5ms + kData + kSifs);
  EXPECT_EQ(air.log.starts[0].frame.duration, kSifs + kAck);
  EXPECT_EQ(air.inbox(2).received.at(0).at, hal::Time{} + 5ms + kData);
  EXPECT_EQ(air.inbox(1).ended.at(0).at, hal::Time{} + 5ms + kData + kSifs + kAck);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kDelivered);
}

TEST_F(DcfExchange, ProtectsFramesAboveTheThreshold) {
  with_rts();
  build_line(2);
  air.send(1, 2, kPayload);
  air.run();
  ASSERT_EQ(air.log.story(), "RTS1 CTS2 DATA1 ACK2");
  EXPECT_EQ(start_of(1), kRts + kSifs);
  EXPECT_EQ(start_of(2), kRts + kSifs + kCts + kSifs);
  EXPECT_EQ(air.log.starts[0].frame.duration, 3 * kSifs + kCts + kData + kAck);
  EXPECT_EQ(air.log.starts[1].frame.duration, 2 * kSifs + kData + kAck);
}

TEST_F(DcfExchange, ThresholdIsTheLargestFrameWithoutRts) {
  waves_of(air.config)->contention.rts_threshold =
      136;  // bytes: header 24, LLC/SNAP 8, payload 100, FCS 4
  build_line(2);
  air.send(1, 2, kPayload);
  air.send(1, 2, kPayload + 1);
  air.run();
  EXPECT_EQ(air.log.story(), "DATA1 ACK2 RTS1 CTS2 DATA1 ACK2");
}

// Attempt n+1 starts DIFS and 0 .. CW slots after the ACK timeout of attempt n; CW is 63, 127, …
// 1023 after 1, 2, … failures.
TEST_F(DcfExchange, GivesUpAfterSevenDataFramesWithDoubledWindows) {
  build_line(1);
  air.send(1, 9, kPayload);
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA1 DATA1 DATA1 DATA1 DATA1 DATA1");
  const std::vector<std::int64_t> windows{63, 127, 255, 511, 1023, 1023};
  for (std::size_t i = 0; i < windows.size(); ++i) {
    expect_slots(start_of(i + 1) - start_of(i) - kData - kTimeout - kDifs, windows[i]);
    EXPECT_EQ(air.log.starts[i + 1].frame.sequence, air.log.starts[0].frame.sequence);
    EXPECT_EQ(air.log.starts[i].frame.retry, i > 0);
  }
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kRetryLimit);
  EXPECT_EQ(air.inbox(1).ended[0].at, hal::Time{} + start_of(6) + kData + kTimeout);
}

TEST_F(DcfExchange, GivesUpAfterSevenRts) {
  with_rts();
  build_line(1);
  air.send(1, 9, kPayload);
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 RTS1 RTS1 RTS1 RTS1 RTS1 RTS1");
}

// 5 dB over the noise 1 Mb/s gets through and a long frame at 11 Mb/s never does.
TEST_F(DcfExchange, GivesUpAfterFourDataFramesBehindRts) {
  with_rts();
  waves_of(air.config)->receiver.noise_floor = hal::Dbm{-84.65};  // 600 m: -79.65 dBm
  build_line(2);
  air.send(1, 2, 2000);
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 CTS2 DATA1 RTS1 CTS2 DATA1 RTS1 CTS2 DATA1 RTS1 CTS2 DATA1");
  EXPECT_EQ(air.inbox(1).ended.at(0).verdict, Verdict::kRetryLimit);
}

// Station 3, 190 m from station 1 and out of reach of station 2, wakes up in the middle of the
// first DATA and talks into the ACK: 10 dB stronger, it destroys it.
TEST_F(DcfExchange, RepeatedFrameIsAcknowledgedAgainAndDeliveredOnce) {
  air.seed = 2;
  air.add({0, 0, 0});
  air.add({600, 0, 0});
  air.add({-190, 0, 0});
  air.build();
  air.sap(3).set_radio(false);
  air.send(1, 2, kPayload);
  air.at(250us, [this] {
    air.sap(3).set_radio(true);
    air.broadcast(3);
  });
  air.run();
  // Station 3 sees the medium busy until 291 us, waits for DIFS and its backoff.
  ASSERT_LT(start_of(2), kData + kSifs + kAck - 50us) << "choose a seed with a shorter backoff";
  ASSERT_EQ(air.log.story(), "DATA1 ACK2 DATA3 DATA1 ACK2");
  EXPECT_EQ(air.log.verdicts(1, 1).size(), 1u);
  EXPECT_NE(air.log.verdicts(1, 1)[0], Verdict::kDelivered);
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended.at(0).verdict, Verdict::kDelivered);
}

// 10.3.2.9: the ACK's PHY-RXSTART must come within SIFS + slot + 192 us of the frame's end, so both
// ways together may take 20 us: 2998 m. That the receiver has synchronised to it is not enough.
TEST_F(DcfExchange, AckThatBeginsTooLateIsNone) {
  for (const double distance : {2900.0, 3100.0, 6000.0}) {
    Air world(Profile::kIeee80211b);
    waves_of(world.config)->tx_power = hal::Milliwatts{4000};  // 7.8 km
    world.add_line(2, distance);
    world.build();
    world.send(1, 2, kPayload);
    world.run();
    ASSERT_EQ(world.inbox(1).ended.size(), 1u);
    EXPECT_EQ(world.inbox(1).ended[0].verdict,
              distance < 2998 ? Verdict::kDelivered : Verdict::kRetryLimit)
        << distance << " m";
    EXPECT_EQ(world.inbox(2).received.size(), 1u) << distance << " m";
  }
}

// Three DATA fail, then seven RTS, so the frame is given up with a long retry count of three. The
// next frame has four tries with DATA as the first had.
TEST_F(DcfExchange, RetriesOfOneFrameDoNotCountForTheNext) {
  with_rts();
  waves_of(air.config)->receiver.noise_floor =
      hal::Dbm{-84.65};  // as above: DATA never gets through
  build_line(2);
  const auto data = [this] {
    return std::ranges::count_if(air.log.starts, [](const Log::Start& start) {
      return start.frame.type == FrameType::kData && start.frame.transmitter.value == 1;
    });
  };
  air.send(1, 2, 2000);
  while (data() < 3) air.events.run_next();
  air.sap(2).set_radio(false);
  air.run();
  ASSERT_EQ(air.inbox(1).ended.at(0).verdict, Verdict::kRetryLimit);
  ASSERT_EQ(data(), 3);
  air.sap(2).set_radio(true);
  air.send(1, 2, 2000);
  air.run(2s);
  EXPECT_EQ(data(), 3 + 4);
}

TEST_F(DcfExchange, AnswersAtTheHighestBasicRateNotAboveTheFrames) {
  dcf_of(air.config)->basic_rates = {hal::BitsPerSecond{1e6}, hal::BitsPerSecond{5.5e6}};
  with_rts();
  build_line(2);
  air.send(1, 2, kPayload);
  air.run();
  ASSERT_EQ(air.log.story(), "RTS1 CTS2 DATA1 ACK2");
  EXPECT_EQ(air.log.starts[1].frame.rate.value, 1e6) << "the RTS was at 1 Mb/s";
  EXPECT_EQ(air.log.starts[3].frame.rate.value, 5.5e6);
  const hal::Duration ack = 192us + 21us;  // 112 bits at 5.5 Mb/s: 20.4 us
  EXPECT_EQ(air.log.starts[2].frame.duration, kSifs + ack);
  EXPECT_EQ(air.log.starts[0].frame.duration, 3 * kSifs + kCts + kData + ack);
}

TEST_F(DcfExchange, RadioOffForgetsQueueNavAndBackoff) {
  build_line(2);
  air.send(1, 2, kPayload);
  air.send(1, 2, kPayload);
  air.at(100us, [this] { air.sap(1).set_radio(false); });
  air.at(200us, [this] { air.send(1, 2, kPayload); });
  air.at(10ms, [this] {
    air.sap(1).set_radio(true);
    air.send(1, 2, kPayload);
  });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA1 ACK2");
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kRadioOff});
  EXPECT_EQ(start_of(1), 10ms + kDifs) << "idle time counts from switching on";
  ASSERT_EQ(air.inbox(1).ended.size(), 4u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(air.inbox(1).ended[i].verdict, Verdict::kRadioOff);
  EXPECT_EQ(air.inbox(1).ended[3].verdict, Verdict::kDelivered);
}

TEST_F(DcfExchange, QueueIsLimited) {
  waves_of(air.config)->contention.queue_limit = 2;
  build_line(2);
  for (std::uint64_t tag = 1; tag <= 3; ++tag) air.send(1, 2, kPayload, tag);
  air.run(1ns);
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].tag, 3u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kQueueFull);
}

}  // namespace
}  // namespace sim::radio::test
