#include <gtest/gtest.h>

#include <optional>

#include "tests/unit/sim/radio/dcf.h"

namespace sim::radio::test {
namespace {

using hal::Verdict;

/// When a station may send: DIFS, EIFS, backoff, NAV.
class DcfAccess : public Ieee80211MacTest {};

TEST_F(DcfAccess, WaitsForDifsAfterAFrameOfOthers) {
  build_line(2);
  air.broadcast(1, kPayload);  // at 1 Mb/s: 192 + 1088 us
  air.at(1290us, [this] { air.send(2, 1, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA2 ACK1");
  EXPECT_EQ(start_of(1), 1280us + kDifs);
}

TEST_F(DcfAccess, PostBackoffSeparatesFramesOfOneStation) {
  build_line(2);
  air.send(1, 2, kPayload);
  air.send(1, 2, kPayload);
  air.run();
  ASSERT_EQ(air.log.starts.size(), 4u);
  expect_slots(start_of(2) - (kData + kSifs + kAck + kDifs), 31);
}

TEST_F(DcfAccess, PostBackoffCountsWithoutAFrame) {
  build_line(2);
  air.send(1, 2, kPayload);
  const hal::Duration done = kData + kSifs + kAck + kDifs + 31 * kSlot;
  air.at(done, [this] { air.send(1, 2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.starts.size(), 4u);
  EXPECT_EQ(start_of(2), done);
}

TEST_F(DcfAccess, RequestInAPostBackoffDoesNotShiftItsSlots) {
  const auto second_start = [](hal::Duration requested_at) {
    Air world(Profile::kIeee80211b);
    waves_of(world.config)->propagation.propagation_delay = false;
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
TEST_F(DcfAccess, BacksOffWhenTheDifsIsInterrupted) {
  hal::Duration most{};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Air world(Profile::kIeee80211b);
    waves_of(world.config)->propagation.propagation_delay = false;
    waves_of(world.config)->propagation.interference_floor =
        waves_of(world.config)->receiver.sensitivity;
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

TEST_F(DcfAccess, BacksOffWhenTheMediumIsBusy) {
  build_line(2);
  air.broadcast(1, kPayload);
  air.at(100us, [this] { air.broadcast(2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA2");
  expect_slots(start_of(1) - 1280us - kDifs, 31);
}

// Station 1 runs undisturbed to learn its backoff; then station 2 cuts in 22 us after the DIFS, or
// 27 us. The first slot is counted. In the second one, a frame that begins 18 us before its end is
// noticed, and the slot does not count; one that begins 13 us before it, less than the 15 us of
// aCCATime and turnaround, is not (10.3.7).
TEST_F(DcfAccess, FrozenBackoffCountsWholeSlotsUpToItsCcaTime) {
  const auto second_start = [](std::optional<hal::Duration> disturbed) {
    Air world(Profile::kIeee80211b);
    waves_of(world.config)->propagation.propagation_delay = false;
    world.seed = 2;
    world.add_line(2, 600);
    world.build();
    world.broadcast(1);  // 36 bytes at 1 Mb/s: 480 us
    world.broadcast(1);
    if (disturbed) world.at(480us + kDifs + *disturbed, [&world] { world.broadcast(2); });
    world.run();
    return world.log.starts.back().at.time_since_epoch();
  };
  const hal::Duration slots = second_start(std::nullopt) - 480us - kDifs;
  ASSERT_GE(slots, 3 * kSlot) << "choose a seed with a longer backoff";
  const hal::Duration again = 480us + kDifs + 480us + kDifs;
  EXPECT_EQ(second_start(22us), again + 22us + slots - kSlot);
  EXPECT_EQ(second_start(27us), again + 27us + slots - 2 * kSlot);
}

TEST_F(DcfAccess, StaysAwayForTheDurationOfAnOverheardRts) {
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
TEST_F(DcfAccess, NavOfAnUnansweredRtsIsReset) {
  with_rts();
  waves_of(air.config)->contention.short_retry_limit = 1;
  build_line(2);
  air.send(1, 9, 2000);
  air.at(400us, [this] { air.broadcast(2, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "RTS1 DATA2");
  const hal::Duration reset = kRts + 2 * kSifs + kCts + 192us + 2 * kSlot;
  expect_slots(start_of(1) - reset - kDifs, 31);
}

// The exchange is so short that the reset would fall into its ACK, which station 1 does not hear.
TEST_F(DcfAccess, NavOfAnAnsweredRtsIsKept) {
  with_rts();
  build_line(3);
  air.send(2, 3);  // DATA: 192 + 27 us
  air.at(400us, [this] { air.broadcast(1, kPayload); });
  air.run();
  ASSERT_EQ(air.log.story(), "RTS2 CTS3 DATA2 ACK3 DATA1");
  const hal::Duration end = kRts + kSifs + kCts + kSifs + 219us + kSifs + kAck;
  expect_slots(start_of(4) - end - kDifs, 31);
}

TEST_F(DcfAccess, DoesNotAnswerAnRtsWhileItsNavIsSet) {
  with_rts();
  waves_of(air.config)->contention.short_retry_limit = 1;
  build_line(4);
  air.send(1, 2, 2000);
  // Station 3 overhears the CTS of station 2; station 4 hears neither and asks station 3.
  air.at(1ms, [this] { air.send(4, 3, kPayload); });
  air.run(2ms);
  EXPECT_EQ(air.log.story(), "RTS1 CTS2 DATA1 RTS4");
  EXPECT_EQ(air.log.verdicts(3, 3), std::vector{Verdict::kDelivered}) << "heard, not answered";
}

TEST_F(DcfAccess, WaitsForEifsAfterAWrongFrame) {
  waves_of(air.config)->receiver.noise_floor =
      hal::Dbm{-84.65};  // 5 dB: a long frame at 11 Mb/s is always wrong
  waves_of(air.config)->contention.short_retry_limit = 1;
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
TEST_F(DcfAccess, GoodFrameEndsTheEifs) {
  waves_of(air.config)->receiver.noise_floor = hal::Dbm{-84.65};
  waves_of(air.config)->contention.short_retry_limit = 1;
  waves_of(air.config)->phy.broadcast_rate = hal::BitsPerSecond{5.5e6};
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
TEST_F(DcfAccess, FramesOfOneSlotCollideAndBringNoEifs) {
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

/// Stations 1 and 3 do not hear each other. Their broadcasts at 11 Mb/s, 946 us long, overlap at
/// station 2, equally strong: it follows that of station 1 and finds the FCS wrong.
class DcfOverlap : public DcfAccess {
 protected:
  void overlap(hal::Duration second) {
    waves_of(air.config)->phy.broadcast_rate = hal::BitsPerSecond{11e6};
    build_line(3);
    air.broadcast(1, 1000);
    air.at(100us, [this] { air.broadcast(2); });
    air.at(second, [this] { air.broadcast(3, 1000); });
    air.run();
    ASSERT_EQ(air.log.story(), "DATA1 DATA3 DATA2");
    EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kCollision});
  }
};

// IEEE Std 802.11-2016, 10.3.2.3.7.
TEST_F(DcfOverlap, EifsBeginsAsTheMediumBecomesIdle) {
  overlap(310us);
  expect_slots(start_of(2) - 310us - 946us - kEifs, 31);
}

TEST_F(DcfOverlap, EifsBeginsAtTheEndOfTheWrongFrameIfToldSo) {
  dcf_of(air.config)->eifs_start = EifsStart::kFrameEnd;
  overlap(310us);
  expect_slots(start_of(2) - 946us - kEifs, 31);  // 310 us is no whole number of slots
}

TEST_F(DcfOverlap, EnergyBeyondAnEifsFromTheFramesEndIsFollowedByDifs) {
  dcf_of(air.config)->eifs_start = EifsStart::kFrameEnd;
  overlap(600us);
  expect_slots(start_of(2) - 600us - 946us - kDifs, 31);
}

/// Station 1 begins a broadcast of 1280 us at 1 Mb/s; the preamble is still coming when station 3
/// begins one of 480 us, 17.5 dB stronger at station 2: the PHY header of the first is wrong.
class DcfWrongHeader : public DcfAccess {
 protected:
  void lose_header() {
    air.add({-750, 0, 0});
    air.add({0, 0, 0});
    air.add({100, 0, 0});
    air.build();
    air.broadcast(1, 100);
    air.at(20us, [this] { air.broadcast(3); });
    air.at(30us, [this] { air.broadcast(2); });
    air.run();
    ASSERT_EQ(air.log.story(), "DATA1 DATA3 DATA2");
  }
};

TEST_F(DcfWrongHeader, BringsEifs) {
  lose_header();
  expect_slots(start_of(2) - 1280us - kEifs, 31);
}

TEST_F(DcfWrongHeader, IsForgottenIfToldSo) {
  dcf_of(air.config)->receiver.header_error = HeaderError::kForgotten;
  lose_header();
  expect_slots(start_of(2) - 192us - kDifs, 31);
}

}  // namespace
}  // namespace sim::radio::test
