#include "sim/radio/phy/phy_mode.h"

#include <gtest/gtest.h>

#include "sim/radio/mac/dcf_timing.h"
#include "sim/radio/mac/frame_lengths.h"
#include "sim/radio/phy/mode_set.h"

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
  const ModeSet modes(profile_defaults(Profile::kMobilityFramework));
  EXPECT_EQ(modes.at(hal::BitsPerSecond{GetParam().rate}).airtime(GetParam().bits),
            GetParam().airtime);
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
  const ModeSet modes(profile_defaults(Profile::kIeee80211b));
  EXPECT_EQ(modes.at(hal::BitsPerSecond{GetParam().rate}).airtime(GetParam().bits),
            GetParam().airtime);
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
  waves_of(config)->phy.preamble = Preamble::kShort;
  const ModeSet modes(config);
  EXPECT_EQ(modes.at(hal::BitsPerSecond{2e6}).airtime(112), 96us + 56us);
  EXPECT_EQ(modes.at(hal::BitsPerSecond{2e6}).preamble(), 72us);
  EXPECT_EQ(modes.at(hal::BitsPerSecond{1e6}).airtime(112), 192us + 112us);
  // 16.2.2.3: its 48 bits are at 2 Mb/s, so at 1.5 dB they are lost as often as such bits are.
  const double sinr = 1.4;
  EXPECT_EQ(modes.at(hal::BitsPerSecond{2e6}).header_success(sinr, 1),
            modes.at(hal::BitsPerSecond{2e6}).success(sinr, 48));
  EXPECT_EQ(modes.at(hal::BitsPerSecond{1e6}).header_success(sinr, 1),
            modes.at(hal::BitsPerSecond{1e6}).success(sinr, 48));
  EXPECT_EQ(&modes.lowest(), &modes.at(hal::BitsPerSecond{1e6}));
}

TEST(MpduLength, IsPayloadAndHeadersInBytes) {
  const LengthsConfig bytes = Ieee80211bConfig{}.lengths;
  EXPECT_EQ(mpdu_bits(bytes, FrameType::kData, 1500), 8u * 1536);  // 24 + 8 + 1500 + 4
  EXPECT_EQ(mpdu_bits(bytes, FrameType::kRts), 8u * 20);
  EXPECT_EQ(mpdu_bits(bytes, FrameType::kCts), 8u * 14);
  EXPECT_EQ(mpdu_bits(bytes, FrameType::kAck), 8u * 14);
}

TEST(MpduLength, IsFixedInTheReplicaWhateverThePayload) {
  LengthsConfig lengths = MobilityFrameworkConfig{}.lengths;
  EXPECT_EQ(mpdu_bits(lengths, FrameType::kData, 1500), 272u);
  lengths.payload_bits = 96;
  EXPECT_EQ(mpdu_bits(lengths, FrameType::kData, 1500), 368u);
}

// What has no PHY loses nothing on it, and takes bits over rate, or no time.
TEST(PlainModes, AreInstantOrBitsOverRate) {
  DiskConfig config;
  config.data_rate = hal::BitsPerSecond{3e6};
  const ModeSet disk(config);
  EXPECT_EQ(disk.data().airtime(8), 2667ns);
  EXPECT_EQ(disk.data().success(0, 1e6), 1);
  EXPECT_EQ(ModeSet(IdealConfig{}).data().airtime(8), 0ns);
}

// IEEE Std 802.11-2016, 10.3.2.3.7: EIFS = SIFS + ACK at the lowest rate + DIFS.
TEST(Interframe, SpacesOf80211b) {
  const Ieee80211bConfig config;
  const ModeSet modes(config);
  const DcfTiming timing(config, modes);
  EXPECT_EQ(timing.difs, 50us);
  EXPECT_EQ(timing.eifs, 364us);
  EXPECT_EQ(timing.response_timeout(modes.control()), 222us);  // SIFS + slot + 192 us
  EXPECT_EQ(timing.nav_reset(modes.control()), 556us);         // 2 SIFS + CTS + 192 us + 2 slots
}

// 18.4.4: DIFS = 10 + 2 * 9; EIFS = 10 + 304 + 28, the ACK being the one at 1 Mb/s; timeouts of
// OFDM answers 10 + 9 + 20.
TEST(Interframe, SpacesOf80211gWithTheShortSlot) {
  Ieee80211gConfig config;
  config.contention.slot = 9us;
  const ModeSet modes(config);
  const DcfTiming timing(config, modes);
  EXPECT_EQ(timing.difs, 28us);
  EXPECT_EQ(timing.eifs, 342us);
  EXPECT_EQ(timing.response_timeout(modes.control()), 39us);
  EXPECT_EQ(timing.nav_reset(modes.control()), 20us + 34us + 20us + 18us);  // CTS at 24 Mb/s: 34 us
}

// IEEE Std 802.11-2016, 17.4.3 and 18.4.3: 20 us + 4 us * ceil((22 + bits) / NDBPS) + 6 us.
class OfdmAirtime : public testing::TestWithParam<AirtimeCase> {};
TEST_P(OfdmAirtime, IsWholeSymbolsAndTheSignalExtension) {
  const ModeSet modes(Ieee80211gConfig{});
  EXPECT_EQ(modes.at(hal::BitsPerSecond{GetParam().rate}).airtime(GetParam().bits),
            GetParam().airtime);
}
INSTANTIATE_TEST_SUITE_P(
    Std80211Clause18, OfdmAirtime,
    testing::Values(AirtimeCase{"AckAt6", 8 * 14, 6e6, 50us},        // 134 / 24: 6
                    AirtimeCase{"RtsAt9", 8 * 20, 9e6, 50us},        // 182 / 36: 6
                    AirtimeCase{"AckAt12", 8 * 14, 12e6, 38us},      // 134 / 48: 3
                    AirtimeCase{"RtsAt18", 8 * 20, 18e6, 38us},      // 182 / 72: 3
                    AirtimeCase{"AckAt24", 8 * 14, 24e6, 34us},      // 134 / 96: 2
                    AirtimeCase{"LongAt36", 8 * 1536, 36e6, 370us},  // 12310 / 144: 86
                    AirtimeCase{"LongAt48", 8 * 1536, 48e6, 286us},  // 12310 / 192: 65
                    AirtimeCase{"LongAt54", 8 * 1536, 54e6, 254us},  // 12310 / 216: 57
                    AirtimeCase{"WholeSymbolsAt54", 216 * 3 - 22, 54e6, 38us},
                    AirtimeCase{"OneBitMoreAt54", 216 * 3 - 21, 54e6, 42us}),
    name_of);

// Of 136 bytes at 54 Mb/s, 1088 bits, ns-3 puts six symbols and 6 us at risk: 54 * 30 bits.
TEST(OfdmBitsAtRisk, AreTheMpdusOrAsManyAsThePayloadTimeHolds) {
  Ieee80211gConfig config;
  const ModeSet standard(config);
  config.bits_at_risk = BitsAtRisk::kPayloadTime;
  const ModeSet peer(config);
  EXPECT_EQ(standard.data().bits_at_risk(1088), 1088);
  EXPECT_EQ(standard.data().signal_extension(), 6us);
  EXPECT_EQ(peer.data().bits_at_risk(1088), 1620);
  EXPECT_EQ(peer.data().signal_extension(), 0us);
  EXPECT_EQ(peer.data().airtime(1088), standard.data().airtime(1088));
  const PhyMode& dsss = peer.at(hal::BitsPerSecond{11e6});
  EXPECT_EQ(dsss.bits_at_risk(1088), 1088);
}

// 10.7.6.5.2: the highest basic rate that is not above the frame's, in its modulation class;
// without one the highest mandatory one.
TEST(ControlResponse, IsAtTheHighestBasicRateNotAboveTheFrames) {
  Ieee80211gConfig config;
  const auto response = [&config](double rate) {
    const ModeSet modes(config);
    return modes.response_to(modes.at(hal::BitsPerSecond{rate})).rate().value;
  };
  config.basic_rates = {hal::BitsPerSecond{5.5e6}, hal::BitsPerSecond{1e6},
                        hal::BitsPerSecond{2e6}};
  EXPECT_EQ(response(11e6), 5.5e6);
  EXPECT_EQ(response(5.5e6), 5.5e6);
  EXPECT_EQ(response(2e6), 2e6);
  EXPECT_EQ(response(1e6), 1e6);
  EXPECT_EQ(response(54e6), 24e6) << "mandatory";
  EXPECT_EQ(response(18e6), 12e6) << "mandatory";
  EXPECT_EQ(response(9e6), 6e6) << "mandatory";
  config.basic_rates = {hal::BitsPerSecond{6e6}, hal::BitsPerSecond{36e6}};
  EXPECT_EQ(response(54e6), 36e6);
  EXPECT_EQ(response(24e6), 6e6);
  EXPECT_EQ(response(11e6), 11e6) << "mandatory";
}

// The class tells 6 Mb/s of OFDM from any other mode of that rate, and the place its rate.
TEST(ModeIdentity, IsTheClassAndThePlaceOfTheRate) {
  const ModeSet modes(Ieee80211gConfig{});
  const PhyMode& slow = modes.at(hal::BitsPerSecond{6e6});
  EXPECT_EQ(slow.id(), (ModeId{.modulation = ModulationClass::kOfdm, .mcs = 0, .guard = 800ns}));
  EXPECT_EQ(modes.at(hal::BitsPerSecond{11e6}).id(),
            (ModeId{.modulation = ModulationClass::kDsss, .mcs = 3}));
  for (const auto& mode : modes.all()) {
    EXPECT_EQ(modes.find(mode->id()), mode.get());
    EXPECT_EQ(mode->reference_rate(), mode->rate());
    EXPECT_EQ(mode->width(), 20);
  }
  EXPECT_EQ(modes.find({.modulation = ModulationClass::kHt}), nullptr);
}

}  // namespace
}  // namespace sim::radio::test
