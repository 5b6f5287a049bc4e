#include "sim/radio/airtime.h"

#include <gtest/gtest.h>

#include "sim/radio/dcf_timing.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

struct AirtimeCase {
  const char* name;
  std::uint32_t bits;
  double rate;  ///< bit/s
  hal::Duration airtime;
};
std::string name_of(const testing::TestParamInfo<AirtimeCase>& c) { return c.param.name; }

// Replica of the Mobility Framework, section 2: 192 us + bits / rate, to the nearest nanosecond.
class ExactAirtime : public testing::TestWithParam<AirtimeCase> {};
TEST_P(ExactAirtime, IsPlcpPlusLengthOverRate) {
  const Airtime airtime(profile_defaults(Profile::kMobilityFramework));
  EXPECT_EQ(airtime.of(GetParam().bits, hal::BitsPerSecond{GetParam().rate}), GetParam().airtime);
}
INSTANTIATE_TEST_SUITE_P(
    Replica, ExactAirtime,
    testing::Values(AirtimeCase{"RtsAt11", 160, 11e6, 206545ns},   // 14545.4545
                    AirtimeCase{"CtsAt11", 112, 11e6, 202182ns},   // 10181.8182
                    AirtimeCase{"DataAt11", 272, 11e6, 216727ns},  // 24727.2727
                    AirtimeCase{"DataAt5", 272, 5.5e6, 241455ns},  // 49454.5455
                    AirtimeCase{"DataAt2", 272, 2e6, 328000ns},
                    AirtimeCase{"DataAt1", 272, 1e6, 464000ns}),
    name_of);

// IEEE Std 802.11-2016, 16.3.4: preamble + PLCP header + ceil(8 LENGTH / rate in Mb/s) us.
class StandardAirtime : public testing::TestWithParam<AirtimeCase> {};
TEST_P(StandardAirtime, RoundsUpToMicroseconds) {
  const Airtime airtime(profile_defaults(Profile::kIeee80211b));
  EXPECT_EQ(airtime.of(GetParam().bits, hal::BitsPerSecond{GetParam().rate}), GetParam().airtime);
}
INSTANTIATE_TEST_SUITE_P(
    Std80211Clause16, StandardAirtime,
    testing::Values(AirtimeCase{"AckAt1", 8 * 14, 1e6, 304us},
                    AirtimeCase{"RtsAt1", 8 * 20, 1e6, 352us},
                    AirtimeCase{"AckAt11", 8 * 14, 11e6, 203us},      // ceil(10.18)
                    AirtimeCase{"LongAt11", 8 * 1536, 11e6, 1310us},  // ceil(1117.09)
                    AirtimeCase{"LongAt5", 8 * 1536, 5.5e6, 2427us},  // ceil(2234.18)
                    AirtimeCase{"LongAt2", 8 * 1536, 2e6, 6336us}),
    name_of);

TEST(ShortPreamble, SavesHalfExceptAt1MbPerSecond) {
  RadioConfig config = profile_defaults(Profile::kIeee80211b);
  config.preamble = Preamble::kShort;
  const Airtime airtime(config);
  EXPECT_EQ(airtime.of(112, hal::BitsPerSecond{2e6}), 96us + 56us);
  EXPECT_EQ(airtime.of(112, hal::BitsPerSecond{1e6}), 192us + 112us);
}

TEST(MpduLength, IsPayloadAndHeadersInBytes) {
  const Airtime bytes(profile_defaults(Profile::kIeee80211b));
  EXPECT_EQ(bytes.mpdu_bits(FrameType::kData, 1500), 8u * 1536);  // 24 + 8 + 1500 + 4
  EXPECT_EQ(bytes.mpdu_bits(FrameType::kRts), 8u * 20);
  EXPECT_EQ(bytes.mpdu_bits(FrameType::kCts), 8u * 14);
  EXPECT_EQ(bytes.mpdu_bits(FrameType::kAck), 8u * 14);
}

TEST(MpduLength, IsFixedInTheReplicaWhateverThePayload) {
  RadioConfig config = profile_defaults(Profile::kMobilityFramework);
  EXPECT_EQ(Airtime(config).mpdu_bits(FrameType::kData, 1500), 272u);
  config.fixed_payload_bits = 96;
  EXPECT_EQ(Airtime(config).mpdu_bits(FrameType::kData, 1500), 368u);
}

// IEEE Std 802.11-2016, 10.3.2.3.7: EIFS = SIFS + ACK at the lowest rate + DIFS.
TEST(Interframe, SpacesOf80211b) {
  const DcfTiming timing(profile_defaults(Profile::kIeee80211b));
  EXPECT_EQ(timing.difs, 50us);
  EXPECT_EQ(timing.eifs, 364us);
  EXPECT_EQ(timing.response_timeout, 222us);  // SIFS + slot + 192 us
  EXPECT_EQ(timing.nav_reset, 556us);         // 2 SIFS + CTS + 192 us + 2 slots
}

}  // namespace
}  // namespace sim::radio::test
