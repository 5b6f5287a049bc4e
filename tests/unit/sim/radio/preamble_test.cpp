#include <gtest/gtest.h>

#include "tests/unit/sim/radio/bench.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;
using hal::Verdict;
using Said = std::vector<std::string>;

/// ieee80211b at 40 mW; station 2 in the middle listens. Broadcasts at 1 Mb/s.
class PreambleTest : public testing::Test {
 protected:
  PreambleTest() : bench(Profile::kIeee80211b) {
    waves_of(bench.config)->propagation.propagation_delay = false;
  }
  /// Stations 1 and 3 at these distances from station 2, which is at the origin.
  void place(double first, double third) {
    bench.add({-first, 0, 0});
    bench.add({0, 0, 0});
    bench.add({third, 0, 0});
    bench.build();
  }
  Verdict at_2(std::size_t frame) { return bench.log.verdicts(frame, 2).at(0); }

  Bench bench;
};

TEST_F(PreambleTest, SynchronisesAtTheEndOfTheWindow) {
  place(100, 100);
  bench.send_at(0us, 1);
  bench.run();
  EXPECT_EQ(bench.said(2), (Said{"busy", "start", "frame", "idle"}));
  EXPECT_EQ(at_2(0), Verdict::kDelivered);
}

TEST_F(PreambleTest, StrongerFrameOfTheWindowIsTaken) {
  place(200, 100);  // 6 dB apart
  bench.send_at(0us, 1);
  bench.send_at(3us, 3);
  bench.run();
  EXPECT_EQ(at_2(0), Verdict::kCollision);
  EXPECT_EQ(at_2(1), Verdict::kDelivered);
}

TEST_F(PreambleTest, EqualFramesOfTheWindowAreBothLostWithoutSynchronising) {
  place(130, 100);  // 2.3 dB apart, 4 dB needed
  bench.send_at(0us, 1);
  bench.send_at(3us, 3);
  bench.run();
  EXPECT_EQ(at_2(0), Verdict::kCollision);
  EXPECT_EQ(at_2(1), Verdict::kCollision);
  EXPECT_EQ(bench.said(2), (Said{"busy", "idle"})) << "no error: no EIFS";
}

TEST_F(PreambleTest, StrongerFrameAfterTheWindowIsMissed) {
  place(200, 100);
  bench.send_at(0us, 1);
  bench.send_at(10us, 3);
  bench.run();
  EXPECT_EQ(at_2(1), Verdict::kPreambleMissed);
}

TEST_F(PreambleTest, SingleFrameNearTheNoiseIsLostToNoise) {
  waves_of(bench.config)->receiver.sensitivity = hal::Dbm{-95};
  place(100, 2000);  // 2000 m: -90.1 dBm, 3.9 dB over the noise
  bench.send_at(0us, 3);
  bench.run();
  EXPECT_EQ(at_2(0), Verdict::kNoise);
}

// Frame 0, 12 ms long, loses its PLCP header (32 us .. 192 us) to a short one that is 12 dB
// stronger. Nobody stays with a frame whose header was wrong: a later one comes in (16.3.7, PLCP
// receive).
TEST_F(PreambleTest, FrameWithAWrongHeaderDoesNotHoldTheReceiver) {
  place(400, 100);
  bench.send_at(0us, 1, 1500);
  bench.send_at(20us, 3);  // until 500 us
  bench.send_at(1ms, 3);
  bench.run();
  EXPECT_EQ(at_2(0), Verdict::kCollision);
  EXPECT_EQ(at_2(1), Verdict::kPreambleMissed);
  EXPECT_EQ(at_2(2), Verdict::kDelivered);
  EXPECT_EQ(bench.said(2), (Said{"busy", "start", "error", "start", "frame", "idle"}));
}

// As ns-3.37: what had begun during the preamble is not sensed any more after the wrong header,
// until a frame comes in, and then again until frame 0 is over.
TEST_F(PreambleTest, FrameWithAWrongHeaderIsForgottenIfToldSo) {
  waves_of(bench.config)->receiver.header_error = HeaderError::kForgotten;
  place(400, 100);
  bench.send_at(0us, 1, 1500);
  bench.send_at(20us, 3);  // until 500 us
  bench.send_at(1ms, 3);
  bench.run();
  EXPECT_EQ(at_2(2), Verdict::kDelivered);
  EXPECT_EQ(bench.said(2),
            (Said{"busy", "start", "error", "idle", "start", "busy", "frame", "idle"}));
}

// A frame that begins during the header, and goes on beyond it, is told of anew.
TEST_F(PreambleTest, FrameThatBeginsDuringAWrongHeaderIsSensed) {
  waves_of(bench.config)->receiver.header_error = HeaderError::kForgotten;
  place(400, 100);
  bench.send_at(0us, 1, 1500);
  bench.send_at(150us, 3);  // the header lasts from 144 us to 192 us
  bench.run();
  EXPECT_EQ(bench.said(2), (Said{"busy", "start", "error", "idle"}));
  EXPECT_EQ(bench.events.now(), hal::Time{} + 192us + 12288us) << "idle only then";
}

// Too weak to be sensed by its power, and at -13 dB its header is lost in 9999 of 10000 cases: the
// medium is busy as long as the frame is held, which is until the header's end.
TEST_F(PreambleTest, MediumIsIdleAfterAWrongHeaderThatAloneWasSensed) {
  WavesConfig& waves = *waves_of(bench.config);
  waves.receiver.sensitivity = waves.propagation.interference_floor = hal::Dbm{-120};
  waves.receiver.min_sinr = hal::Decibels{-20};
  place(100, 14000);  // -107 dBm
  bench.send_at(0us, 3, 1500);
  hal::Time idle{};
  while (bench.events.next_time()) {
    bench.events.run_next();
    const bool is_idle = !bench.said(2).empty() && bench.said(2).back() == "idle";
    if (is_idle && idle == hal::Time{}) idle = bench.events.now();
  }
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "error", "idle"}));
  EXPECT_EQ(idle, hal::Time{} + 192us);
  EXPECT_EQ(at_2(0), Verdict::kNoise);
}

// Below sensitivity by itself, but with 4.9 dB less than the wanted frame it breaks CCK at 11 Mb/s.
TEST_F(PreambleTest, FrameLostToUnreceivableOnesIsInterference) {
  waves_of(bench.config)->phy.broadcast_rate = hal::BitsPerSecond{11e6};
  place(700, 1230);  // -80.98 dBm, -85.88 dBm
  bench.send_at(0us, 1, 1000);
  bench.send_at(10us, 3, 1000);
  bench.run();
  EXPECT_EQ(at_2(0), Verdict::kInterference);
  EXPECT_TRUE(bench.log.verdicts(1, 2).empty()) << "faint";
}

// 5 dB of SINR: the interferer is gone before the PLCP header begins, so no bit is at risk.
TEST_F(PreambleTest, InterferenceCountsForTheBitsItCovers) {
  waves_of(bench.config)->phy.broadcast_rate = hal::BitsPerSecond{11e6};
  waves_of(bench.config)->propagation.interference_floor = hal::Dbm{-101};
  place(700, 1230);
  bench.send_at(0us, 3, 0);      // 192 + 27 us
  bench.send_at(80us, 1, 1000);  // its preamble lasts until 224 us
  bench.run();
  EXPECT_EQ(at_2(1), Verdict::kDelivered);
}

}  // namespace
}  // namespace sim::radio::test
