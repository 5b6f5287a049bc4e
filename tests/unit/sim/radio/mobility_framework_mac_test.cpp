#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;
using hal::Verdict;

// Airtimes at 11 Mb/s (replica of the Mobility Framework, section 2): 192 us + bits / 11 Mb/s.
constexpr hal::Duration kMfRts = 206545ns;   // 160 bits
constexpr hal::Duration kMfCts = 202182ns;   // 112 bits
constexpr hal::Duration kMfAck = kMfCts;     // 112 bits
constexpr hal::Duration kMfData = 216727ns;  // 272 bits
constexpr hal::Duration kMfDifs = 50us;
constexpr hal::Duration kMfSifs = 10us;
constexpr hal::Duration kMfSlot = 20us;
/// DIFS to the end of DATA.
constexpr hal::Duration kOneHop = kMfDifs + kMfRts + kMfSifs + kMfCts + kMfSifs + kMfData;

/// Stations 200 m apart, radio range 250.16 m: each hears its neighbours only.
class MobilityFrameworkMacTest : public testing::Test {
 protected:
  MobilityFrameworkMacTest() : air(Profile::kMobilityFramework) {}
  void build_line(int stations) {
    air.add_line(stations, 200);
    air.build();
  }
  hal::Duration start_of(std::size_t frame) const {
    return air.log.starts.at(frame).at.time_since_epoch();
  }

  Air air;
};

TEST_F(MobilityFrameworkMacTest, SendsUnicastAsRtsCtsDataAckAfterDifsOnly) {
  build_line(2);
  air.send(1, 2, 0, 77);
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 CTS2 DATA1 ACK2");
  EXPECT_EQ(start_of(0), kMfDifs);
  EXPECT_EQ(start_of(1), kMfDifs + kMfRts + kMfSifs);
  EXPECT_EQ(start_of(2), kOneHop - kMfData);
  ASSERT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_EQ(air.inbox(2).received[0].at, hal::Time{} + kOneHop);
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].tag, 77u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kDelivered);
  EXPECT_EQ(air.inbox(1).ended[0].at, hal::Time{} + kOneHop + kMfSifs + kMfAck);
}

TEST_F(MobilityFrameworkMacTest, DurationFieldsCoverTheRestOfTheExchange) {
  build_line(2);
  air.send(1, 2);
  air.run();
  EXPECT_EQ(air.log.starts[0].frame.duration, 3 * kMfSifs + kMfCts + kMfData + kMfAck);
  EXPECT_EQ(air.log.starts[1].frame.duration, 2 * kMfSifs + kMfData + kMfAck);
  EXPECT_EQ(air.log.starts[2].frame.duration, kMfSifs + kMfAck);
  EXPECT_EQ(air.log.starts[3].frame.duration, 0ns);
}

TEST_F(MobilityFrameworkMacTest, NeverProtectsOrAcknowledgesABroadcast) {
  build_line(3);
  air.broadcast(2);
  air.run();
  EXPECT_EQ(air.log.story(), "DATA2");
  EXPECT_EQ(air.inbox(1).received.size(), 1u);
  EXPECT_EQ(air.inbox(3).received.size(), 1u);
  ASSERT_EQ(air.inbox(2).ended.size(), 1u);
  EXPECT_EQ(air.inbox(2).ended[0].at, hal::Time{} + kMfDifs + kMfData);
}

TEST_F(MobilityFrameworkMacTest, SkipsRtsUpToTheThreshold) {
  waves_of(air.config)->contention.rts_threshold = 34;  // 272 bits
  build_line(2);
  air.send(1, 2);
  air.run();
  EXPECT_EQ(air.log.story(), "DATA1 ACK2");
  EXPECT_EQ(air.log.starts[0].frame.duration, 0ns);
  EXPECT_EQ(air.inbox(2).received.at(0).at, hal::Time{} + kMfDifs + kMfData);
}

// Attempt n+1 starts at the timeout of attempt n, plus DIFS, plus 0 .. CW slots, where CW is 15,
// 31, 63, 127, 255, 255 after 1, 2, … 6 failures.
TEST_F(MobilityFrameworkMacTest, GivesUpAfterSevenRtsWithDoubledWindows) {
  build_line(1);
  air.send(1, 9);
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 RTS1 RTS1 RTS1 RTS1 RTS1 RTS1");
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kRetryLimit);
  const hal::Duration timeout = kMfRts + kMfSifs + kMfCts + 1ns;
  EXPECT_EQ(air.inbox(1).ended[0].at, hal::Time{} + start_of(6) + timeout);
  const std::vector<std::int64_t> windows{15, 31, 63, 127, 255, 255};
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const hal::Duration backoff = start_of(i + 1) - start_of(i) - timeout - kMfDifs;
    EXPECT_EQ(backoff % kMfSlot, 0ns) << i;
    EXPECT_LE(backoff / kMfSlot, windows[i]) << i;
  }
}

TEST_F(MobilityFrameworkMacTest, QueuesFourteenAndRefusesTheNext) {
  build_line(1);
  for (std::uint64_t tag = 0; tag < 15; ++tag) air.send(1, 9, 0, tag);
  EXPECT_TRUE(air.inbox(1).ended.empty()) << "never from within transmit()";
  air.run(1ns);
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].tag, 14u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kQueueFull);
}

TEST_F(MobilityFrameworkMacTest, BacksOffUpToSevenSlotsForASecondPacket) {
  build_line(2);
  air.send(1, 2);
  air.send(1, 2);
  air.run();
  ASSERT_EQ(air.log.story(), "RTS1 CTS2 DATA1 ACK2 RTS1 CTS2 DATA1 ACK2");
  const hal::Duration backoff = start_of(4) - (kOneHop + kMfSifs + kMfAck) - kMfDifs;
  EXPECT_EQ(backoff % kMfSlot, 0ns);
  EXPECT_LE(backoff, 7 * kMfSlot);
}

TEST_F(MobilityFrameworkMacTest, KeepsQuietForTheDurationOfAnOverheardRts) {
  build_line(3);
  air.send(2, 3);
  air.at(300us, [this] { air.broadcast(1); });  // after the RTS, which station 1 hears
  air.run();
  ASSERT_EQ(air.log.story(), "RTS2 CTS3 DATA2 ACK3 DATA1");
  const hal::Duration end = kOneHop + kMfSifs + kMfAck;
  const hal::Duration backoff = start_of(4) - end - kMfDifs;
  EXPECT_GE(backoff, 0ns);
  EXPECT_LE(backoff, 31 * kMfSlot);
  EXPECT_EQ(backoff % kMfSlot, 0ns);
}

// Station 1 first runs undisturbed to learn its backoff. Then station 2 cuts into it: what is left
// of it counts on, to the nanosecond, after the medium is idle and DIFS.
TEST_F(MobilityFrameworkMacTest, FrozenBackoffKeepsItsRestInContinuousTime) {
  const auto second_start = [](std::optional<hal::Duration> disturbed_at) {
    Air world(Profile::kMobilityFramework);
    world.seed = 3;
    world.add_line(2, 200);
    world.build();
    world.broadcast(1);
    world.broadcast(1);
    if (disturbed_at) world.at(*disturbed_at - kMfDifs, [&world] { world.broadcast(2); });
    world.run();
    return world.log.starts.back().at.time_since_epoch();
  };
  const hal::Duration undisturbed = second_start(std::nullopt);
  const hal::Duration first_end = kMfDifs + kMfData;
  ASSERT_GE(undisturbed - first_end - kMfDifs, 2 * kMfSlot)
      << "choose a seed with a longer backoff";
  const hal::Duration cut_in = first_end + kMfDifs + 27us;  // one slot and 7 us into the backoff
  EXPECT_EQ(second_start(cut_in), undisturbed + kMfData + kMfDifs);
}

// Station 3 does not hear the RTS of station 1 and starts 5 us after it.
TEST_F(MobilityFrameworkMacTest, CarrierCancelsAPendingAnswer) {
  build_line(3);
  air.send(1, 2);
  air.at(kMfRts + 5us, [this] { air.broadcast(3); });  // DIFS later it is on the air
  air.run();
  EXPECT_EQ(air.log.story(), "RTS1 DATA3 RTS1 CTS2 DATA1 ACK2");
}

TEST_F(MobilityFrameworkMacTest, BitErrorSilencesForEifs) {
  waves_of(air.config)->receiver.noise_floor =
      hal::Dbm{-90};  // 200 m: -83.06 dBm, 6.9 dB: no frame survives
  build_line(2);
  air.broadcast(1);
  air.at(100us, [this] { air.broadcast(2); });
  air.run();
  ASSERT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kNoise});
  const hal::Duration eifs = kMfSifs + kMfDifs + kMfAck;
  const hal::Duration backoff = start_of(1) - (kMfDifs + kMfData) - eifs - kMfDifs;
  EXPECT_GE(backoff, 0ns);
  EXPECT_EQ(backoff % kMfSlot, 0ns);
}

TEST_F(MobilityFrameworkMacTest, CollisionBringsNoEifs) {
  std::get<MobilityFrameworkConfig>(air.config).cw_broadcast = 0;
  air.add_line(3, 200);  // 1 and 3 do not hear each other
  air.build();
  air.broadcast(1);
  air.broadcast(3);
  air.at(100us, [this] { air.broadcast(2); });
  air.run();
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kCollision});
  EXPECT_EQ(air.log.verdicts(1, 2), std::vector{Verdict::kPreambleMissed});
  EXPECT_EQ(start_of(2), kMfDifs + kMfData + kMfDifs);
}

TEST_F(MobilityFrameworkMacTest, DeliversAgainWhenAnAcknowledgementWasLost) {
  waves_of(air.config)->contention.rts_threshold = 34;
  build_line(2);
  // The radio of station 1 is off when the ACK comes; the packet is then sent again.
  air.send(1, 2);
  air.at(kMfDifs + kMfData + kMfSifs + 1us, [this] {
    air.sap(1).set_radio(false);
    air.sap(1).set_radio(true);
    air.send(1, 2);
  });
  air.run();
  EXPECT_EQ(air.inbox(2).received.size(), 2u) << "no duplicate filter";
}

TEST_F(MobilityFrameworkMacTest, RadioOffCutsTheFrameAndDropsTheQueue) {
  build_line(2);
  air.broadcast(1);
  air.broadcast(1);
  air.at(100us, [this] { air.sap(1).set_radio(false); });
  air.at(200us, [this] { air.broadcast(1); });
  air.at(300us, [this] { air.sap(1).set_radio(true); });
  air.at(400us, [this] { air.broadcast(1); });
  air.run();
  ASSERT_EQ(air.log.starts.size(), 2u);
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kRadioOff});
  EXPECT_EQ(start_of(1), 400us + kMfDifs);
  EXPECT_EQ(air.log.verdicts(1, 2), std::vector{Verdict::kDelivered});
  ASSERT_EQ(air.inbox(1).ended.size(), 4u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kRadioOff);
  EXPECT_EQ(air.inbox(1).ended[1].verdict, Verdict::kRadioOff);
  EXPECT_EQ(air.inbox(1).ended[2].verdict, Verdict::kRadioOff);
  EXPECT_EQ(air.inbox(1).ended[3].verdict, Verdict::kDelivered);
}

TEST_F(MobilityFrameworkMacTest, ExpectedDelayGrowsByOneServiceTimePerQueuedFrame) {
  build_line(2);
  const hal::Duration empty = air.sap(1).expected_delay();
  EXPECT_GT(empty, 0ns);
  air.send(1, 2);
  air.send(1, 2);
  EXPECT_EQ(air.sap(1).expected_delay(), 3 * empty);
}

TEST_F(MobilityFrameworkMacTest, EnergyIsPowerTimesAirtime) {
  build_line(1);
  EXPECT_NEAR(air.sap(1).transmit_energy(100), 2e-3 * 216.727e-6, 1e-15);  // J; rounding of doubles
}

}  // namespace
}  // namespace sim::radio::test
