#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

// A group frame through an access point, worked by hand with the clauses of IEEE Std 802.11-2016.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kBytes = 100;  // of payload; MPDU 136 (9.3.2: 24 + 4; LLC/SNAP 8)

/// Station 1 is the access point; 2 sends and is 90 m from it, 3 and 4 only listen.
class AccessPointRelay : public testing::Test {
 protected:
  AccessPointRelay() : air(Profile::kIeee80211b) {
    DcfConfig& dcf = *dcf_of(air.config);
    dcf.bss.access_points = {"s1"};
    dcf.contention.cw_min = 0;  // backoffs of 0 slots, but after failures: times by hand
    for (const hal::Vec3& place : {hal::Vec3{0, 0, 0}, {90, 0, 0}, {0, 30, 0}, {0, -60, 0}}) {
      air.add(place);
    }
    air.build();
    air.run(200ms);
    air.log.starts.clear();
    air.at(200ms, [this] { air.broadcast(2, kBytes); });
    air.run(204ms);
  }
  hal::Duration start_of(std::size_t frame) const {
    return air.log.starts.at(frame).at.time_since_epoch();
  }

  Air air;
};

TEST_F(AccessPointRelay, OfAGroupFrameIsThatOfTheStandardToTheNanosecond) {
  // Ways at 299,792,458 m/s: 90 m 300.2 ns, 30 m 100.1 ns, 60 m 200.1 ns.
  constexpr hal::Duration kWay2 = 300ns, kWay3 = 100ns, kWay4 = 200ns;
  ASSERT_EQ(air.log.story(), "DATA2 ACK1 DATA1");

  // 10.3.4.2: the medium has been idle for more than DIFS: at once. 9.3.2.1, table 9-26, To DS: a
  // group frame goes to the access point alone, RA = BSSID, TA = SA, third DA.
  const Frame& up = air.log.starts[0].frame;
  hal::Duration t = 200ms;
  EXPECT_EQ(start_of(0), t);
  EXPECT_EQ(up.receiver, hal::AgentId{1});
  EXPECT_EQ(up.ds, Ds::kTo);
  EXPECT_EQ(up.address3, hal::kEveryone);
  EXPECT_EQ(up.rate, hal::BitsPerSecond{11e6});
  // 9.2.5.2: SIFS and the ACK.
  EXPECT_EQ(up.duration, 10us + 304us);
  // 16.3.4: 144 + 48 us, 136 bytes at 11 Mb/s 98.9 us, up: 99 us.
  EXPECT_EQ(up.airtime, 291us);

  // 10.3.2.9: SIFS after it came in. 10.7.6.5.2: the only basic rate is 1 Mb/s.
  t += 291us + kWay2 + 10us;
  EXPECT_EQ(start_of(1), t);
  EXPECT_EQ(air.log.starts[1].frame.receiver, hal::AgentId{2});
  EXPECT_EQ(air.log.starts[1].frame.airtime, 192us + 112us);
  t += 304us;

  // 10.3.4.2 and 10.3.4.3: the frame to pass on came while the medium was busy: DIFS after its own
  // ACK and a backoff, here of no slots (SIFS + 2 slots, 10.3.7).
  t += 50us;
  EXPECT_EQ(start_of(2), t);
  // Table 9-26, From DS: RA = DA, TA = BSSID, third SA. 9.2.5.2: nothing follows a group frame.
  const Frame& down = air.log.starts[2].frame;
  EXPECT_EQ(down.receiver, hal::kEveryone);
  EXPECT_EQ(down.transmitter, hal::AgentId{1});
  EXPECT_EQ(down.ds, Ds::kFrom);
  EXPECT_EQ(down.address3, hal::AgentId{2});
  EXPECT_EQ(down.duration, 0us);
  // 10.7.5.3: group frames at a basic rate: 136 bytes at 1 Mb/s.
  EXPECT_EQ(down.rate, hal::BitsPerSecond{1e6});
  EXPECT_EQ(down.airtime, 192us + 1088us);
  t += 1280us;

  // The access point has had it since the first frame's end, the others get it now; its source
  // hears it as well and drops what bears its own address as SA (10.3.6: no acknowledgement).
  ASSERT_EQ(air.inbox(1).received.size(), 1u);
  EXPECT_EQ(air.inbox(1).received[0].at, hal::Time{} + 200ms + 291us + kWay2);
  ASSERT_EQ(air.inbox(3).received.size(), 1u);
  EXPECT_EQ(air.inbox(3).received[0].at, hal::Time{} + t + kWay3);
  ASSERT_EQ(air.inbox(4).received.size(), 1u);
  EXPECT_EQ(air.inbox(4).received[0].at, hal::Time{} + t + kWay4);
  EXPECT_TRUE(air.inbox(2).received.empty());
  EXPECT_EQ(air.log.verdicts(2, 2), std::vector{hal::Verdict::kDelivered});

  // The sender's request ended with the ACK.
  ASSERT_EQ(air.inbox(2).ended.size(), 1u);
  EXPECT_EQ(air.inbox(2).ended[0].at, hal::Time{} + 200ms + 291us + kWay2 + 10us + 304us + kWay2);
}

}  // namespace
}  // namespace sim::radio::test
