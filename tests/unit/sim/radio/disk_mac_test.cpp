#include "sim/radio/mac/disk_mac.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;
using hal::Verdict;

/// Stations at 0, 200 and 400 m; range 250.16 m.
Air& line(Air& air) {
  air.add_line(3, 200);
  air.build();
  return air;
}

// 64 bytes of payload + 36 of headers at 1 Mb/s: 800 us, no preamble, no contention.
TEST(Disk, FramesTakeLengthOverRateOneAfterTheOther) {
  Air air(Profile::kDisk);
  std::get<DiskConfig>(air.config).data_rate = hal::BitsPerSecond{1e6};
  line(air);
  air.send(1, 2, 64);
  air.send(1, 2, 64);
  air.run();
  ASSERT_EQ(air.inbox(2).received.size(), 2u);
  EXPECT_EQ(air.inbox(2).received[0].at, hal::Time{} + 800us);
  EXPECT_EQ(air.inbox(2).received[1].at, hal::Time{} + 1600us);
  EXPECT_EQ(air.inbox(1).ended.size(), 2u);
}

TEST(Disk, FramesNeverCollide) {
  Air air(Profile::kDisk);
  line(air);
  air.send(1, 2, 64);
  air.send(3, 2, 64);
  air.send(2, 1, 64);
  air.run();
  EXPECT_EQ(air.inbox(2).received.size(), 2u);
  EXPECT_EQ(air.inbox(1).received.size(), 1u);
}

TEST(Disk, BroadcastReachesThoseInRangeOnly) {
  Air air(Profile::kDisk);
  line(air);
  air.broadcast(1, 64);
  air.run();
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_TRUE(air.inbox(3).received.empty());
  EXPECT_EQ(air.inbox(1).ended.at(0).verdict, Verdict::kDelivered);
}

TEST(Disk, UnicastOutOfRangeOrToARadioThatIsOffFails) {
  Air air(Profile::kDisk);
  line(air);
  air.send(1, 3);
  air.sap(2).set_radio(false);
  air.send(1, 2);
  air.run();
  ASSERT_EQ(air.inbox(1).ended.size(), 2u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kRetryLimit);
  EXPECT_EQ(air.inbox(1).ended[1].verdict, Verdict::kRetryLimit);
  EXPECT_EQ(air.log.verdicts(1, 2), std::vector{Verdict::kRadioOff});
}

TEST(Disk, QueueIsLimited) {
  Air air(Profile::kDisk);
  line(air);
  for (int i = 0; i < 15; ++i) air.send(1, 2, 64);
  air.run();
  ASSERT_EQ(air.inbox(1).ended.size(), 15u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kQueueFull);
  EXPECT_EQ(air.inbox(2).received.size(), 14u);
}

TEST(Disk, RadioOffCutsTheFrameAndDropsTheQueue) {
  Air air(Profile::kDisk);
  line(air);
  air.send(1, 2, 1000);
  air.send(1, 2, 1000);
  air.at(1us, [&air] { air.sap(1).set_radio(false); });
  air.at(1s, [&air] { air.sap(1).set_radio(true); });
  air.run();
  EXPECT_TRUE(air.inbox(2).received.empty());
  ASSERT_EQ(air.inbox(1).ended.size(), 2u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, Verdict::kRadioOff);
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{Verdict::kRadioOff});
}

TEST(Ideal, DeliversAtTheSameInstantButNotFromWithinTransmit) {
  Air air(Profile::kIdeal);
  line(air);
  air.at(5ms, [&air] {
    for (int i = 0; i < 100; ++i) air.send(1, 2, 1000);
    EXPECT_TRUE(air.inbox(2).received.empty());
    EXPECT_TRUE(air.inbox(1).ended.empty());
  });
  air.run();
  ASSERT_EQ(air.inbox(2).received.size(), 100u);
  EXPECT_EQ(air.inbox(2).received.back().at, hal::Time{} + 5ms);
  EXPECT_EQ(air.inbox(1).ended.size(), 100u);
  EXPECT_EQ(air.sap(1).expected_delay(), 0ns);
}

// A relay that answers from within on_receive(): each hop is an event of its own, so the call stack
// does not grow.
TEST(Ideal, RelaysNeverRecurse) {
  Air air(Profile::kIdeal);
  line(air);
  int depth = 0;
  int deepest = 0;
  int hops = 0;
  for (const std::uint16_t here : {std::uint16_t{1}, std::uint16_t{2}}) {
    air.inbox(here).forward = [&, here](const MacIndication&) {
      deepest = std::max(deepest, ++depth);
      if (++hops < 1000) air.send(here, here == 1 ? 2 : 1);
      --depth;
    };
  }
  air.send(1, 2);
  air.run();
  EXPECT_EQ(hops, 1000);
  EXPECT_EQ(deepest, 1);
}

TEST(Ideal, SaysWhatItCannotTell) {
  Air air(Profile::kIdeal);
  line(air);
  EXPECT_TRUE(air.sap(1).capabilities().tx_status);
  EXPECT_FALSE(air.sap(1).capabilities().rssi);
}

}  // namespace
}  // namespace sim::radio::test
