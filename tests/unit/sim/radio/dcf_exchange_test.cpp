#include <gtest/gtest.h>

#include "tests/unit/sim/radio/dcf.h"

namespace sim::radio::test {
namespace {

using hal::Verdict;

/// Frame exchanges, retries and queue.
class DcfExchange : public DcfMacTest {};

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
