#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

// A group frame through an access point, worked by hand with the clauses of IEEE Std 802.11-2016.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kBytes = 100;  // of payload; MPDU 136 (9.3.2: 24 + 4; LLC/SNAP 8)

// Ways at 299,792,458 m/s: 90 m 300.2 ns, 30 m 100.1 ns, 60 m 200.1 ns.
constexpr hal::Duration kWay2 = 300ns, kWay3 = 100ns, kWay4 = 200ns;

// 10.3.4.2: the medium has been idle for more than DIFS: the station sends at once.
constexpr hal::Duration kUp = 200ms;
// 16.3.4: 144 + 48 us, and 136 bytes at 11 Mb/s, 98.9 us, up: 99 us.
constexpr hal::Duration kUpAirtime = 291us;
// 10.3.2.9: the ACK SIFS after it came in.
constexpr hal::Duration kAnswer = kUp + kUpAirtime + kWay2 + 10us;
// 10.7.6.5.2: the only basic rate is 1 Mb/s; 14 bytes.
constexpr hal::Duration kAnswerAirtime = 192us + 112us;
// 10.3.4.2 and 10.3.4.3: the frame to pass on came while the medium was busy: DIFS (SIFS + 2 slots,
// 10.3.7) after the access point's own ACK, and a backoff, here of no slots.
constexpr hal::Duration kDown = kAnswer + kAnswerAirtime + 50us;
// 10.7.5.3: group frames at a basic rate: 136 bytes at 1 Mb/s.
constexpr hal::Duration kDownAirtime = 192us + 1088us;

/// Station 1 is the access point; 2 sends a group frame and is 90 m from it, 3 and 4 only listen.
class AccessPointRelay : public testing::Test {
 protected:
  AccessPointRelay() : air(Profile::kIeee80211b) {
    DcfConfig& dcf = *dcf_of(air.config);
    dcf.bss.access_points = {"s1"};
    dcf.contention.cw_min = 0;  // backoffs of 0 slots, but after failures: times by hand
    air.add({0, 0, 0});
    air.add({90, 0, 0});
    air.add({0, 30, 0});
    air.add({0, -60, 0});
    air.build();
    air.run(kUp - 1ns);
    air.log.starts.clear();
    air.at(kUp, [this] { air.broadcast(2, kBytes); });
    air.run(204ms);
  }
  const Frame& frame(std::size_t i) const { return air.log.starts.at(i).frame; }
  hal::Duration start_of(std::size_t i) const { return air.log.starts.at(i).at.time_since_epoch(); }
  /// When the only message came.
  hal::Duration received_by(std::uint16_t station) {
    EXPECT_EQ(air.inbox(station).received.size(), 1u);
    return air.inbox(station).received.at(0).at.time_since_epoch();
  }

  Air air;
};

// Table 9-26, To DS: a group frame goes to the access point alone: RA = BSSID, TA = SA, third DA.
TEST_F(AccessPointRelay, GoesUpAsAnAcknowledgedFrame) {
  ASSERT_EQ(air.log.story(), "DATA2 ACK1 DATA1");
  EXPECT_EQ(start_of(0), kUp);
  EXPECT_EQ(frame(0).receiver, hal::AgentId{1});
  EXPECT_EQ(frame(0).ds, Ds::kTo);
  EXPECT_EQ(frame(0).address3, hal::kEveryone);
  EXPECT_EQ(frame(0).rate, hal::BitsPerSecond{11e6});
  EXPECT_EQ(frame(0).airtime, kUpAirtime);
  EXPECT_EQ(frame(0).duration, 10us + kAnswerAirtime);  // 9.2.5.2: SIFS and the ACK
  EXPECT_EQ(start_of(1), kAnswer);
  EXPECT_EQ(frame(1).receiver, hal::AgentId{2});
  EXPECT_EQ(frame(1).airtime, kAnswerAirtime);
  ASSERT_EQ(air.inbox(2).ended.size(), 1u);
  EXPECT_EQ(air.inbox(2).ended[0].at, hal::Time{} + kAnswer + kAnswerAirtime + kWay2);
}

// Table 9-26, From DS: RA = DA, TA = BSSID, third SA.
TEST_F(AccessPointRelay, ComesBackAsABroadcastAfterDifs) {
  ASSERT_EQ(air.log.story(), "DATA2 ACK1 DATA1");
  EXPECT_EQ(start_of(2), kDown);
  EXPECT_EQ(frame(2).receiver, hal::kEveryone);
  EXPECT_EQ(frame(2).transmitter, hal::AgentId{1});
  EXPECT_EQ(frame(2).ds, Ds::kFrom);
  EXPECT_EQ(frame(2).address3, hal::AgentId{2});
  EXPECT_EQ(frame(2).duration, 0us);  // 9.2.5.2: nothing follows a group frame
  EXPECT_EQ(frame(2).rate, hal::BitsPerSecond{1e6});
  EXPECT_EQ(frame(2).airtime, kDownAirtime);
}

// The access point has it since the first frame's end, the others from the second. The source hears
// that as well and drops what bears its own address as SA (9.3.2.1.2).
TEST_F(AccessPointRelay, IsHandedUpOnceByAllButItsSource) {
  EXPECT_EQ(received_by(1), kUp + kUpAirtime + kWay2);
  EXPECT_EQ(received_by(3), kDown + kDownAirtime + kWay3);
  EXPECT_EQ(received_by(4), kDown + kDownAirtime + kWay4);
  EXPECT_TRUE(air.inbox(2).received.empty());
  EXPECT_EQ(air.log.verdicts(2, 2), std::vector{hal::Verdict::kDelivered});
}

}  // namespace
}  // namespace sim::radio::test
