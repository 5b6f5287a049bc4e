#include "sim/radio/phy/radio.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/radio/bench.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;
using hal::Verdict;
using Said = std::vector<std::string>;

// Free-space levels at 2 mW and 0.125 m: 3.0103 dBm - 20 log10(4 pi d / 0.125 m), so 100 m:
// -77.0357 dBm, 200 m: -83.0563 dBm. Empty broadcasts take 216727 ns.
constexpr hal::Duration kFrame = 216727ns;

class RadioTest : public testing::Test {
 protected:
  RadioTest() : bench(Profile::kMobilityFramework) {}
  void place(std::initializer_list<double> xs) {
    for (const double x : xs) bench.add({x, 0, 0});
    bench.build();
  }
  void expect_verdicts(std::size_t frame, std::uint16_t receiver, Verdict verdict) {
    EXPECT_EQ(bench.log.verdicts(frame, receiver), std::vector{verdict})
        << "frame " << frame << " at " << receiver;
  }

  Bench bench;
};

TEST_F(RadioTest, HearsAFrameFromStartToEnd) {
  place({0, 100});
  bench.send_at(1ms, 1);
  bench.run();
  EXPECT_EQ(bench.said(1), (Said{"sent"}));
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "frame", "idle"}));
  expect_verdicts(0, 2, Verdict::kDelivered);
  EXPECT_EQ(bench.log.receptions[0].at, hal::Time{} + 1ms + kFrame);
  EXPECT_NEAR(bench.listeners[1]->last_rssi.value, -77.0357, 1e-3);      // dBm, by hand
  EXPECT_NEAR(bench.listeners[1]->last_snr.value, 110 - 77.0357, 1e-3);  // dB over -110 dBm
}

TEST_F(RadioTest, NobodyBeyondTheInterferenceFloorNotices) {
  place({0, 251});
  bench.send_at(0us, 1);
  bench.run();
  EXPECT_TRUE(bench.said(2).empty());
  EXPECT_TRUE(bench.log.receptions.empty());
}

TEST_F(RadioTest, FaintFrameIsCountedAndNotSensed) {
  waves_of(bench.config)->propagation.interference_floor = hal::Dbm{-110};
  place({0, 251});
  bench.send_at(0us, 1);
  bench.run();
  EXPECT_TRUE(bench.said(2).empty());
  EXPECT_TRUE(bench.log.receptions.empty());
  EXPECT_EQ(bench.log.faint, 1u);
}

TEST_F(RadioTest, SumOfWeakFramesIsSensedAsEnergy) {
  waves_of(bench.config)->propagation.interference_floor = hal::Dbm{-110};
  place({-260, 0, 260});  // -85.34 dBm each: together -82.33 dBm
  bench.send_at(0us, 1);
  bench.send_at(100us, 3);
  bench.run();
  EXPECT_EQ(bench.said(2), (Said{"busy", "idle"}));
}

TEST_F(RadioTest, FirstFrameHoldsTheReceiverAndSurvivesAWeakerOne) {
  place({0, 50, 250});  // at 50 m from 1, 200 m from 3: 12 dB apart
  bench.send_at(0us, 1);
  bench.send_at(100us, 3);
  bench.run();
  expect_verdicts(0, 2, Verdict::kDelivered);
  expect_verdicts(1, 2, Verdict::kPreambleMissed);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "frame", "idle"}));
}

TEST_F(RadioTest, StrongerFrameComesTooLateWithoutCapture) {
  place({0, 200, 250});
  bench.send_at(0us, 1);
  bench.send_at(100us, 3);
  bench.run();
  expect_verdicts(0, 2, Verdict::kCollision);
  expect_verdicts(1, 2, Verdict::kPreambleMissed);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "collision", "idle"}));
}

TEST_F(RadioTest, StrongerFrameTakesOverInsideTheCaptureWindow) {
  waves_of(bench.config)->receiver.capture_margin = hal::Decibels{5};
  place({0, 200, 250});
  bench.send_at(0us, 1);
  bench.send_at(16us, 3);
  bench.run();
  expect_verdicts(0, 2, Verdict::kCollision);
  expect_verdicts(1, 2, Verdict::kDelivered);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "start", "frame", "idle"}));
}

TEST_F(RadioTest, CaptureEndsWithItsWindow) {
  waves_of(bench.config)->receiver.capture_margin = hal::Decibels{5};
  place({0, 200, 250});
  bench.send_at(0us, 1);
  bench.send_at(17us, 3);
  bench.run();
  expect_verdicts(1, 2, Verdict::kPreambleMissed);
}

TEST_F(RadioTest, CaptureWindowIsAKey) {
  waves_of(bench.config)->receiver.capture_margin = hal::Decibels{5};
  waves_of(bench.config)->receiver.capture_window = 192us;
  place({0, 200, 250});
  bench.send_at(0us, 1);
  bench.send_at(150us, 3);
  bench.run();
  expect_verdicts(1, 2, Verdict::kDelivered);
}

TEST_F(RadioTest, CannotReceiveWhileItTransmits) {
  place({0, 100});
  bench.send_at(0us, 1);
  bench.send_at(100us, 2);
  bench.run();
  expect_verdicts(0, 2, Verdict::kReceiverTransmitting);
  expect_verdicts(1, 1, Verdict::kReceiverTransmitting);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "sent", "idle"}));
}

TEST_F(RadioTest, TransmissionsOfOneInstantMissEachOther) {
  place({0, 100});
  bench.send_at(0us, 1);
  bench.send_at(0us, 2);
  bench.run();
  expect_verdicts(0, 2, Verdict::kReceiverTransmitting);
  expect_verdicts(1, 1, Verdict::kReceiverTransmitting);
}

// What ends now is over: neither blocks the receiver nor counts as interference, whichever of the
// two events comes first.
TEST_F(RadioTest, FrameMayFollowAnotherWithoutAGap) {
  for (const std::uint16_t first : {std::uint16_t{1}, std::uint16_t{3}}) {
    Bench row(Profile::kMobilityFramework);
    for (const double x : {0, 200, 400}) row.add({x, 0, 0});
    row.build();
    row.send_at(0us, first);
    row.send_at(kFrame, first == 1 ? 3 : 1);
    row.run();
    EXPECT_EQ(row.log.verdicts(0, 2), std::vector{Verdict::kDelivered}) << first;
    EXPECT_EQ(row.log.verdicts(1, 2), std::vector{Verdict::kDelivered}) << first;
  }
}

TEST_F(RadioTest, SwitchedOffRadioLosesFramesAndKeepsQuiet) {
  place({0, 100});
  bench.send_at(0us, 1);
  bench.events.schedule(hal::Time{} + 50us, Rank::kRadio, hal::AgentId{2},
                        [this] { bench.radio(2).set_on(false); });
  bench.send_at(300us, 1);
  bench.run();
  expect_verdicts(0, 2, Verdict::kRadioOff);
  expect_verdicts(1, 2, Verdict::kRadioOff);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy"}));
}

TEST_F(RadioTest, SwitchedOnInAFrameItSensesButCannotReceive) {
  place({0, 100});
  bench.radio(2).set_on(false);
  bench.send_at(0us, 1);
  bench.events.schedule(hal::Time{} + 50us, Rank::kRadio, hal::AgentId{2},
                        [this] { bench.radio(2).set_on(true); });
  bench.run();
  expect_verdicts(0, 2, Verdict::kRadioOff);
  EXPECT_EQ(bench.said(2), (Said{"idle"}));
}

TEST_F(RadioTest, CutFrameIsLostWhenItIsCut) {
  place({0, 100});
  bench.send_at(0us, 1);
  bench.events.schedule(hal::Time{} + 50us, Rank::kRadio, hal::AgentId{1},
                        [this] { bench.radio(1).set_on(false); });
  bench.run();
  expect_verdicts(0, 2, Verdict::kRadioOff);
  EXPECT_EQ(bench.log.receptions[0].at, hal::Time{} + 50us);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "error", "idle"}));
}

TEST_F(RadioTest, WallThatCostsTheFrameIsNamed) {
  waves_of(bench.config)->propagation.obstacles = true;
  bench.wall.at = 50;
  bench.wall.crossing = hal::Decibels{20};  // 100 m: -97 dBm behind it
  place({0, 100, -100});
  bench.send_at(0us, 1);
  bench.run();
  expect_verdicts(0, 2, Verdict::kObstacle);
  expect_verdicts(0, 3, Verdict::kDelivered);
  EXPECT_TRUE(bench.said(2).empty()) << "below the floor it is no energy either";
}

TEST_F(RadioTest, ThinWallOnlyWeakensTheFrame) {
  waves_of(bench.config)->propagation.obstacles = true;
  bench.wall.at = 50;
  bench.wall.crossing = hal::Decibels{5};
  place({0, 100});
  bench.send_at(0us, 1);
  bench.run();
  expect_verdicts(0, 2, Verdict::kDelivered);
  EXPECT_NEAR(bench.log.receptions[0].rssi_dbm, -82.0357, 1e-3);  // dBm
}

TEST_F(RadioTest, PropagationDelayShiftsTheWholeFrame) {
  waves_of(bench.config)->propagation.propagation_delay = true;
  place({0, 150});
  bench.send_at(0us, 1);
  bench.run();
  // 150 m / 299792458 m/s = 500.3 ns
  EXPECT_EQ(bench.log.receptions.at(0).at, hal::Time{} + kFrame + 500ns);
  EXPECT_EQ(bench.said(2), (Said{"start", "busy", "frame", "idle"}));
}

TEST_F(RadioTest, CutReachesReceiversAfterThePropagationDelay) {
  waves_of(bench.config)->propagation.propagation_delay = true;
  place({0, 150});
  bench.send_at(0us, 1);
  bench.events.schedule(hal::Time{} + 50us, Rank::kRadio, hal::AgentId{1},
                        [this] { bench.radio(1).set_on(false); });
  bench.run();
  expect_verdicts(0, 2, Verdict::kRadioOff);
  EXPECT_EQ(bench.log.receptions[0].at, hal::Time{} + 50us + 500ns);
}

}  // namespace
}  // namespace sim::radio::test
