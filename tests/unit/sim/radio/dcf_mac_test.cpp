#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;
using hal::Verdict;

// IEEE Std 802.11-2016, 16.2.2 and 16.3.4, long preamble: 192 us + bits / rate, rounded up.
constexpr hal::Duration kRts = 352us;   // 20 bytes at 1 Mb/s
constexpr hal::Duration kCts = 304us;   // 14 bytes at 1 Mb/s
constexpr hal::Duration kAck = 304us;   // 14 bytes at 1 Mb/s
constexpr hal::Duration kData = 291us;  // 100 + 36 bytes at 11 Mb/s: 98.9 us
constexpr std::size_t kPayload = 100;   // bytes
constexpr hal::Duration kSifs = 10us;
constexpr hal::Duration kSlot = 20us;
constexpr hal::Duration kDifs = 50us;
constexpr hal::Duration kEifs = 364us;
constexpr hal::Duration kTimeout = 222us;

/// Stations 600 m apart hear their neighbours only: at 40 mW the carrier is sensed up to 787 m.
class DcfMacTest : public testing::Test {
 protected:
  DcfMacTest() : air(Profile::kIeee80211b) {
    air.config.propagation_delay = false;  // times by hand
    air.config.interference_floor = air.config.sensitivity;
  }
  void build_line(int stations) {
    air.add_line(stations, 600);
    air.build();
  }
  void without_rts() { air.config.rts_threshold = 2347; }
  void with_rts() { air.config.rts_threshold = 0; }
  hal::Duration start_of(std::size_t frame) const {
    return air.log.starts.at(frame).at.time_since_epoch();
  }
  void expect_slots(hal::Duration backoff, std::int64_t window) {
    EXPECT_GE(backoff, 0us);
    EXPECT_EQ(backoff % kSlot, 0us);
    EXPECT_LE(backoff / kSlot, window);
  }

  Air air;
};

TEST_F(DcfMacTest, TakesALongIdleMediumAtOnce) {
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

TEST_F(DcfMacTest, WaitsForDifsAfterAFrameOfOthers) {
  build_line(2);
  air.broadcast(1, kPayload);  // at 1 Mb/s: 192 + 1088 us
  air.at(1290us, [this] { air.send(2, 1, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA2 ACK1");
  EXPECT_EQ(start_of(1), 1280us + kDifs);
}

TEST_F(DcfMacTest, ProtectsFramesAboveTheThreshold) {
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

TEST_F(DcfMacTest, ThresholdIsTheLargestFrameWithoutRts) {
  air.config.rts_threshold = 136;  // bytes: header 24, LLC/SNAP 8, payload 100, FCS 4
  build_line(2);
  air.send(1, 2, kPayload);
  air.send(1, 2, kPayload + 1);
  air.run();
  EXPECT_EQ(air.log.story(), "DATA1 ACK2 RTS1 CTS2 DATA1 ACK2");
}

TEST_F(DcfMacTest, PostBackoffSeparatesFramesOfOneStation) {
  build_line(2);
  air.send(1, 2, kPayload);
  air.send(1, 2, kPayload);
  air.run();
  ASSERT_EQ(air.log.starts.size(), 4u);
  expect_slots(start_of(2) - (kData + kSifs + kAck + kDifs), 31);
}

TEST_F(DcfMacTest, PostBackoffCountsWithoutAFrame) {
  build_line(2);
  air.send(1, 2, kPayload);
  const hal::Duration done = kData + kSifs + kAck + kDifs + 31 * kSlot;
  air.at(done, [this] { air.send(1, 2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.starts.size(), 4u);
  EXPECT_EQ(start_of(2), done);
}

TEST_F(DcfMacTest, RequestInAPostBackoffDoesNotShiftItsSlots) {
  const auto second_start = [](hal::Duration requested_at) {
    Air world(Profile::kIeee80211b);
    world.config.propagation_delay = false;
    world.seed = 2;
    world.add_line(2, 600);
    world.build();
    world.broadcast(1);  // 36 bytes at 1 Mb/s: 480 us
    world.at(requested_at, [&world] { world.broadcast(1); });
    world.run();
    return world.log.starts.back().at.time_since_epoch();
  };
  const hal::Duration first = second_start(0us);
  ASSERT_GE(first, 480us + kDifs + 2 * kSlot) << "choose a seed with a longer backoff";
  EXPECT_EQ(second_start(480us + kDifs + 27us), first);
}

// Station 2 asks while the medium has been idle for less than DIFS, which needs no backoff; then a
// frame of station 3, which has not heard station 1, comes in between.
TEST_F(DcfMacTest, BacksOffWhenTheDifsIsInterrupted) {
  hal::Duration most{};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Air world(Profile::kIeee80211b);
    world.config.propagation_delay = false;
    world.config.interference_floor = world.config.sensitivity;
    world.seed = seed;
    world.add_line(3, 600);
    world.build();
    world.broadcast(1);  // until 480 us
    world.at(490us, [&world] { world.broadcast(2); });
    world.at(500us, [&world] { world.broadcast(3); });
    world.run();
    ASSERT_EQ(world.log.story(), "DATA1 DATA3 DATA2");
    const hal::Duration backoff =
        world.log.starts[2].at.time_since_epoch() - (500us + 480us) - kDifs;
    expect_slots(backoff, 31);
    most = std::max(most, backoff);
  }
  EXPECT_GT(most, 0us) << "five backoffs of no slot at all: no backoff";
}

TEST_F(DcfMacTest, BacksOffWhenTheMediumIsBusy) {
  build_line(2);
  air.broadcast(1, kPayload);
  air.at(100us, [this] { air.broadcast(2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA2");
  expect_slots(start_of(1) - 1280us - kDifs, 31);
}

// Station 1 runs undisturbed to learn its backoff; then station 2 cuts in 27 us after the DIFS. The
// first slot is counted, the 7 us of the second are not.
TEST_F(DcfMacTest, FrozenBackoffCountsWholeSlotsOnly) {
  const auto second_start = [](bool disturbed) {
    Air world(Profile::kIeee80211b);
    world.config.propagation_delay = false;
    world.seed = 2;
    world.add_line(2, 600);
    world.build();
    world.broadcast(1);  // 36 bytes at 1 Mb/s: 480 us
    world.broadcast(1);
    if (disturbed) world.at(480us + kDifs + 27us, [&world] { world.broadcast(2); });
    world.run();
    return world.log.starts.back().at.time_since_epoch();
  };
  const hal::Duration undisturbed = second_start(false);
  const hal::Duration slots = undisturbed - 480us - kDifs;
  ASSERT_GE(slots, 2 * kSlot) << "choose a seed with a longer backoff";
  EXPECT_EQ(second_start(true), 480us + kDifs + 27us + 480us + kDifs + slots - kSlot);
}

// Attempt n+1 starts DIFS and 0 .. CW slots after the ACK timeout of attempt n; CW is 63, 127, …
// 1023 after 1, 2, … failures.
TEST_F(DcfMacTest, GivesUpAfterSevenDataFramesWithDoubledWindows) {
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

TEST_F(DcfMacTest, GivesUpAfterSevenRts) {
  with_rts();
  build_line(1);
  air.send(1, 9, kPayload);
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 RTS1 RTS1 RTS1 RTS1 RTS1 RTS1");
}

// 5 dB over the noise 1 Mb/s gets through and a long frame at 11 Mb/s never does.
TEST_F(DcfMacTest, GivesUpAfterFourDataFramesBehindRts) {
  with_rts();
  air.config.noise_floor = hal::Dbm{-84.65};  // 600 m: -79.65 dBm
  build_line(2);
  air.send(1, 2, 2000);
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 CTS2 DATA1 RTS1 CTS2 DATA1 RTS1 CTS2 DATA1 RTS1 CTS2 DATA1");
  EXPECT_EQ(air.inbox(1).ended.at(0).verdict, Verdict::kRetryLimit);
}

TEST_F(DcfMacTest, StaysAwayForTheDurationOfAnOverheardRts) {
  with_rts();
  build_line(3);
  air.send(2, 3, kPayload);
  air.at(400us, [this] { air.broadcast(1, kPayload); });  // station 1 hears the RTS, not the CTS
  air.run();
  ASSERT_EQ(air.log.story(), "RTS2 CTS3 DATA2 ACK3 DATA1");
  const hal::Duration end = kRts + kSifs + kCts + kSifs + kData + kSifs + kAck;
  expect_slots(start_of(4) - end - kDifs, 31);
}

// Nothing follows the RTS: its NAV is void 2 SIFS + CTS + 192 us + 2 slots after its end.
TEST_F(DcfMacTest, NavOfAnUnansweredRtsIsReset) {
  with_rts();
  air.config.short_retry_limit = 1;
  build_line(2);
  air.send(1, 9, 2000);
  air.at(400us, [this] { air.broadcast(2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "RTS1 DATA2");
  const hal::Duration reset = kRts + 2 * kSifs + kCts + 192us + 2 * kSlot;
  expect_slots(start_of(1) - reset - kDifs, 31);
}

// The exchange is so short that the reset would fall into its ACK, which station 1 does not hear.
TEST_F(DcfMacTest, NavOfAnAnsweredRtsIsKept) {
  with_rts();
  build_line(3);
  air.send(2, 3);  // DATA: 192 + 27 us
  air.at(400us, [this] { air.broadcast(1, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "RTS2 CTS3 DATA2 ACK3 DATA1");
  const hal::Duration end = kRts + kSifs + kCts + kSifs + 219us + kSifs + kAck;
  expect_slots(start_of(4) - end - kDifs, 31);
}

TEST_F(DcfMacTest, DoesNotAnswerAnRtsWhileItsNavIsSet) {
  with_rts();
  air.config.short_retry_limit = 1;
  build_line(4);
  air.send(1, 2, 2000);
  // Station 3 overhears the CTS of station 2; station 4 hears neither and asks station 3.
  air.at(1ms, [this] { air.send(4, 3, kPayload); });
  air.run(2ms);
  EXPECT_EQ(air.log.story(), "RTS1 CTS2 DATA1 RTS4");
  EXPECT_EQ(air.log.verdicts(3, 3), std::vector{Verdict::kDelivered}) << "heard, not answered";
}

TEST_F(DcfMacTest, WaitsForEifsAfterAWrongFrame) {
  air.config.noise_floor = hal::Dbm{-84.65};  // 5 dB: a long frame at 11 Mb/s is always wrong
  air.config.short_retry_limit = 1;
  build_line(3);
  air.send(1, 2, 2000);  // 192 + 1481 us
  air.at(100us, [this] { air.broadcast(2); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA2");
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kNoise});
  expect_slots(start_of(1) - 1673us - kEifs, 31);
}

// Station 3 has not heard the wrong frame and sends a short one at 5.5 Mb/s, 192 + 53 us, 10 us
// after it. It comes in well, so DIFS counts again, before the EIFS would have been over.
TEST_F(DcfMacTest, GoodFrameEndsTheEifs) {
  air.config.noise_floor = hal::Dbm{-84.65};
  air.config.short_retry_limit = 1;
  air.config.broadcast_rate = hal::BitsPerSecond{5.5e6};
  build_line(3);
  air.send(1, 2, 2000);  // until 1673 us
  air.at(100us, [this] { air.broadcast(2); });
  air.at(1683us, [this] { air.broadcast(3); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA3 DATA2");
  ASSERT_EQ(air.log.verdicts(1, 2), std::vector{Verdict::kDelivered});
  expect_slots(start_of(2) - 1928us - kDifs, 31);
}

// Two stations take the idle medium at the same instant, equally strong at the third: nobody
// synchronises, so the third waits for DIFS, not EIFS.
TEST_F(DcfMacTest, FramesOfOneSlotCollideAndBringNoEifs) {
  air.add({0, 0, 0});
  air.add({0, 600, 0});
  air.add({300, 300, 0});
  air.build();
  air.broadcast(1);
  air.broadcast(2);
  air.at(100us, [this] { air.broadcast(3); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA2 DATA3");
  EXPECT_EQ(air.log.verdicts(0, 3), std::vector{Verdict::kCollision});
  EXPECT_EQ(air.log.verdicts(1, 3), std::vector{Verdict::kCollision});
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kReceiverTransmitting});
  EXPECT_EQ(air.log.verdicts(1, 1), std::vector{Verdict::kReceiverTransmitting});
  expect_slots(start_of(2) - 480us - kDifs, 31);
}

// Station 3, 190 m from station 1 and out of reach of station 2, wakes up in the middle of the
// first DATA and talks into the ACK: 10 dB stronger, it destroys it.
TEST_F(DcfMacTest, RepeatedFrameIsAcknowledgedAgainAndDeliveredOnce) {
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

TEST_F(DcfMacTest, RadioOffForgetsQueueNavAndBackoff) {
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

TEST_F(DcfMacTest, QueueIsLimited) {
  air.config.queue_limit = 2;
  build_line(2);
  for (std::uint64_t tag = 1; tag <= 3; ++tag) air.send(1, 2, kPayload, tag);
  air.run(1ns);
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].tag, 3u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kQueueFull);
}

}  // namespace
}  // namespace sim::radio::test
