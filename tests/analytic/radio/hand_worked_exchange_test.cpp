#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/types/random.h"
#include "tests/unit/sim/radio/air.h"

/// Exchanges worked out by hand to the nanosecond, IEEE Std 802.11-2016, waves that take their
/// time. Backoffs are what the stations' own streams give, drawn here once more.
namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kSifs = 10us, kSlot = 20us;  // table 16-4 (aSIFSTime, aSlotTime)
constexpr hal::Duration kDifs = kSifs + 2 * kSlot;   // 10.3.7
constexpr hal::Duration kHeader = 192us;             // 16.2.2.2: long preamble 144 us, header 48 us
constexpr hal::Duration kCts = kHeader + 112us;      // 14 octets at 1 Mb/s (16.3.4)
constexpr hal::Duration kAck = kHeader + 112us;
constexpr hal::Duration kEifs = kSifs + kAck + kDifs;  // 10.3.7, ACK at the lowest rate

/// Distance over 299792458 m/s.
constexpr hal::Duration kDelay300 = 1001ns, kDelay600 = 2001ns, kDelay700 = 2335ns;

/// The first numbers of slots that a station draws.
std::vector<std::int64_t> backoffs(std::uint64_t seed, const std::string& station,
                                   const std::vector<std::uint32_t>& windows) {
  hal::RandomStream stream(seed, station + "/backoff");
  std::vector<std::int64_t> slots;
  for (const std::uint32_t window : windows) slots.push_back(stream.below(window + 1));
  return slots;
}

std::vector<hal::Duration> starts(const Air& air) {
  std::vector<hal::Duration> result;
  for (const auto& start : air.log.starts) result.push_back(start.at.time_since_epoch());
  return result;
}

//   4 <--700 m--> 1 <--300 m--> 2 <--700 m--> 3      1 and 3, 2 and 4 do not hear each other
//
// 1 sends 1000 octets to 2 behind RTS/CTS; 3 hears the CTS, 4 the RTS. Both want the medium at 1
// ms.
class RtsCts : public testing::Test {
 protected:
  // 20 octets at 1 Mb/s.
  static constexpr hal::Duration kRts = kHeader + 160us;
  // 16.3.4: 1036 octets at 11 Mb/s, 753.45 us, rounded up.
  static constexpr hal::Duration kData = kHeader + 754us;
  // 10.3.4.2: the medium has been idle for DIFS, so the RTS goes at once. 10.3.2.7: CTS SIFS behind
  // the RTS, as it ends at 2.
  static constexpr hal::Duration kCtsStarts = kRts + kDelay300 + kSifs;
  // 10.3.2.3.3: DATA SIFS behind the CTS, as it ends at 1; 10.3.2.9: ACK SIFS behind the DATA.
  static constexpr hal::Duration kDataStarts = kCtsStarts + kCts + kDelay300 + kSifs;
  static constexpr hal::Duration kAckStarts = kDataStarts + kData + kDelay300 + kSifs;
  // 9.3.1.2: Duration of the RTS is CTS, DATA, ACK and three SIFS; 9.3.1.3: of the CTS, that less
  // CTS and SIFS.
  static constexpr hal::Duration kRtsDuration = 3 * kSifs + kCts + kData + kAck;
  static constexpr hal::Duration kCtsDuration = kRtsDuration - kSifs - kCts;

  RtsCts() : air(Profile::kIeee80211b) {
    waves_of(air.config)->contention.rts_threshold = 0;
    waves_of(air.config)->propagation.interference_floor = hal::Dbm{-82};
    air.add({0, 0, 0});
    air.add({300, 0, 0});
    air.add({1000, 0, 0});
    air.add({-700, 0, 0});
    air.build();
    air.send(1, 2, 1000);
    air.at(1ms, [this] {
      air.broadcast(3);
      air.broadcast(4);
    });
    air.run();
  }

  Air air;
};

TEST_F(RtsCts, ReservesTheMediumToTheNanosecond) {
  ASSERT_EQ(air.log.story(), "RTS1 CTS2 DATA1 ACK2 DATA4 DATA3");
  EXPECT_EQ(air.log.starts[0].frame.duration, kRtsDuration);
  EXPECT_EQ(air.log.starts[1].frame.duration, kCtsDuration);
  EXPECT_EQ(air.log.starts[2].frame.duration, kSifs + kAck);  // 9.2.5.2
  EXPECT_EQ(air.log.starts[3].frame.duration, 0us);           // 9.3.1.4
  const std::vector<hal::Duration> all = starts(air);
  EXPECT_EQ(std::vector(all.begin(), all.begin() + 4),
            (std::vector<hal::Duration>{0us, kCtsStarts, kDataStarts, kAckStarts}));
  // Added up by hand.
  EXPECT_EQ(kCtsStarts, 363001ns);
  EXPECT_EQ(kDataStarts, 678002ns);
  EXPECT_EQ(kAckStarts, 1635003ns);
  EXPECT_EQ(air.inbox(2).received.at(0).at, hal::Time{} + 1625003ns);
  EXPECT_EQ(air.inbox(1).ended.at(0).at, hal::Time{} + 1940004ns);
}

TEST_F(RtsCts, KeepsBystandersAwayToTheNanosecond) {
  ASSERT_EQ(air.log.story(), "RTS1 CTS2 DATA1 ACK2 DATA4 DATA3");
  // 10.3.2.4: the NAV of 4 counts from the end of the RTS there. The DATA, which it hears, extends
  // it: on its way through two more delays the exchange has become later than the RTS could say. It
  // hears nothing after that. 10.3.4.3: it found the medium busy, so DIFS and its backoff follow.
  const hal::Duration nav_from_rts = kRts + kDelay700 + kRtsDuration;
  const hal::Duration nav_of_4 = kDataStarts + kData + kDelay700 + kSifs + kAck;
  ASSERT_EQ(nav_of_4 - nav_from_rts, 2 * kDelay300);
  // The NAV of 3 counts from the end of the CTS there; the ACK, which it hears, ends later.
  const hal::Duration nav_of_3 = kCtsStarts + kCts + kDelay700 + kCtsDuration;
  const hal::Duration idle_at_3 = kAckStarts + kAck + kDelay700;
  ASSERT_GT(idle_at_3, nav_of_3);
  EXPECT_EQ(starts(air)[4], nav_of_4 + kDifs + backoffs(1, "s4", {31})[0] * kSlot);
  EXPECT_EQ(starts(air)[5], idle_at_3 + kDifs + backoffs(1, "s3", {31})[0] * kSlot);
  // Added up by hand.
  EXPECT_EQ(nav_from_rts, 1938335ns);
  EXPECT_EQ(nav_of_4, 1940337ns);
  EXPECT_EQ(idle_at_3, 1941338ns);
}

//   1 <--600 m--> 2 <--600 m--> 3
//
// 3 talks into the DATA that 1 sends to 2. 2 has a broadcast of its own and waits for EIFS; 1 has
// no ACK and tries again.
TEST(Collision, BringsEifsAndARetryToTheNanosecond) {
  // 10.3.3: 1 draws from 0 .. 63 after its failure; 2, which finds the medium busy, from 0 .. 31.
  std::uint64_t seed = 1;
  while (backoffs(seed, "s1", {63})[0] < 40 || backoffs(seed, "s2", {31})[0] > 4) ++seed;
  const std::int64_t slots_of_1 = backoffs(seed, "s1", {63})[0];
  const std::int64_t slots_of_2 = backoffs(seed, "s2", {31})[0];
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->propagation.interference_floor = hal::Dbm{-82};
  air.seed = seed;
  air.add_line(3, 600);
  air.build();
  air.send(1, 2, 1000);
  air.at(200us, [&air] { air.broadcast(3); });
  air.at(500us, [&air] { air.broadcast(2); });
  air.run();
  ASSERT_EQ(air.log.story(), "DATA1 DATA3 DATA2 DATA1 ACK2");
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{hal::Verdict::kCollision});

  const hal::Duration data = kHeader + 754us;       // 1036 octets at 11 Mb/s
  const hal::Duration broadcast = kHeader + 288us;  // 36 octets at 1 Mb/s
  // 10.3.2.3.7: EIFS from the end of the wrong frame, as it is at 2; then the backoff (10.3.4.3).
  const hal::Duration start_of_2 = data + kDelay600 + kEifs + slots_of_2 * kSlot;
  // 10.3.2.9: no PHY-RXSTART within SIFS, slot and aRxPHYStartDelay: the frame has failed; DIFS
  // and the backoff count from there. Whole slots count up to the broadcast of 2, one that it ends
  // within aCCATime and turnaround (15 us) included.
  const hal::Duration counting = data + kSifs + kSlot + kHeader + kDifs;
  const std::int64_t counted = (start_of_2 + kDelay600 + 15us - counting) / kSlot;
  ASSERT_GT(slots_of_1, counted);
  // 10.3.4.3: the rest of them after the broadcast and DIFS.
  const hal::Duration retry =
      start_of_2 + broadcast + kDelay600 + kDifs + (slots_of_1 - counted) * kSlot;
  const hal::Duration ack = retry + data + kDelay600 + kSifs;
  EXPECT_EQ(starts(air), (std::vector<hal::Duration>{0us, 200us, start_of_2, retry, ack}));
  EXPECT_EQ(start_of_2 - slots_of_2 * kSlot, 1312001ns);  // added up by hand
  EXPECT_EQ(counting, 1218us);
  // 9.2.4.1.7 and 10.3.2.11: the same sequence number, with the Retry bit.
  EXPECT_FALSE(air.log.starts[0].frame.retry);
  EXPECT_TRUE(air.log.starts[3].frame.retry);
  EXPECT_EQ(air.log.starts[3].frame.sequence, air.log.starts[0].frame.sequence);
  EXPECT_EQ(air.inbox(2).received.size(), 1u) << "the retry; the broadcast of 3 is lost";
}

//   1 <--10 m--> 2      3, of 802.11b, 300 m from both: what it gets of OFDM is below its energy
//                       detection, so that only the CTS keeps it away
TEST(MixedCell, ProtectsOfdmToTheNanosecond) {
  Air air(Profile::kIeee80211g);
  waves_of(air.config)->propagation.propagation_delay = false;
  air.add({0, 0, 0});
  air.add({0, 10, 0});
  air.add({300, 0, 0});
  air.station_config(3).standard = Standard::kIeee80211b;
  air.build();
  air.send(1, 2, 1000);
  air.at(320us, [&air] { air.send(3, 1, 100); });
  air.run();
  ASSERT_EQ(air.log.story(), "CTS1 DATA1 ACK2 DATA3 ACK1");

  // 10.3.2.12: a CTS to oneself, 14 octets at 1 Mb/s of DSSS (10.26.2), then SIFS.
  const hal::Duration data_starts = kCts + kSifs;
  // 18.4.3, 17.4.3: 16 + 8 * 1036 + 6 bits in symbols of 216 are 39 of 4 us; preamble and SIGNAL
  // 20 us; signal extension 6 us.
  const hal::Duration data = 20us + 39 * 4us + 6us;
  // 10.7.6.5.2: OFDM is answered in OFDM. No basic rate is: the highest mandatory one not above
  // 54 Mb/s is 24. 134 bits in symbols of 96 are two.
  const hal::Duration ofdm_ack = 20us + 2 * 4us + 6us;
  const hal::Duration ack_starts = data_starts + data + kSifs;
  // The Duration of the CTS covers DATA, ACK and their SIFS (9.3.1.3); 3 sets its NAV from it.
  EXPECT_EQ(air.log.starts[0].frame.duration, kSifs + data + kSifs + ofdm_ack);
  const hal::Duration nav_of_3 = kCts + kSifs + data + kSifs + ofdm_ack;
  EXPECT_EQ(nav_of_3, 540us);  // added up by hand
  // 10.3.4.3: DIFS with the slot of 20 us (18.4.4), and a backoff of aCWmin(0) = 31.
  const hal::Duration start_of_3 = nav_of_3 + kDifs + backoffs(1, "s3", {31})[0] * kSlot;
  // 136 octets at 11 Mb/s, 98.9 us, rounded up; answered at 1 Mb/s, the basic rate of all.
  const hal::Duration ack_to_3 = start_of_3 + kHeader + 99us + kSifs;
  EXPECT_EQ(starts(air),
            (std::vector<hal::Duration>{0us, data_starts, ack_starts, start_of_3, ack_to_3}));
  EXPECT_EQ(air.log.starts[1].frame.rate.value, 54e6);
  EXPECT_EQ(air.log.starts[2].frame.rate.value, 24e6);
  EXPECT_EQ(air.log.starts[4].frame.rate.value, 1e6);
  EXPECT_EQ(air.log.verdicts(1, 3), std::vector{hal::Verdict::kPreambleMissed});
  EXPECT_EQ(air.log.verdicts(0, 3), std::vector{hal::Verdict::kDelivered}) << "the CTS";
}

}  // namespace
}  // namespace sim::radio::test
