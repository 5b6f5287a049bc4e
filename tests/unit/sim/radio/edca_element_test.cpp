#include <gtest/gtest.h>

#include "sim/radio/infrastructure/edca_element.h"
#include "sim/radio/radio_rules.h"
#include "tests/unit/sim/radio/bss.h"

namespace sim::radio::test {
namespace {

// IEEE Std 802.11-2020, 9.4.2.28, by hand: ID 12, 18 octets, QoS Info, Update EDCA Info; then best
// effort, background, video and voice: ACI and AIFSN, exponents of the windows, TXOP in 32 us.
const hal::Bytes kDefaults{12,   18,   0,    0,                             //
                           0x03, 0xa4, 0x00, 0x00, 0x27, 0xa4, 0x00, 0x00,  //
                           0x42, 0x43, 0x80, 0x00, 0x62, 0x32, 0x41, 0x00};

TEST(EdcaElement, IsThatOfTheStandard) {
  hal::Bytes bytes;
  put_edca_element(bytes, edca_defaults(15, 1023, false));
  EXPECT_EQ(bytes, kDefaults);
}

TEST(EdcaElement, ComesBack) {
  EdcaConfig edca = edca_defaults(31, 1023, true);
  edca.of(AccessCategory::kVideo) = {0, 32'767, 15, kLongestTxop, {}};
  hal::Bytes bytes;
  put_edca_element(bytes, edca);
  EXPECT_EQ(take_edca_element(std::span(bytes).subspan(2)), edca);
  EXPECT_EQ(take_edca_element(std::span(bytes).subspan(3)), std::nullopt) << "too short";
}

TEST(EdcaElement, MustBePossible) {
  const auto broken = [](auto change) {
    Ieee80211nConfig config;
    config.bss.edca = config.edca;
    change(config);
    const auto rules = broken_rules(RadioConfig(config));
    return rules.empty() ? "" : rules.front().key + " " + rules.front().what;
  };
  EXPECT_EQ(broken([](auto&) {}), "");
  EXPECT_EQ(broken([](auto& c) { c.bss.edca->of(AccessCategory::kVoice).aifsn = 1; }),
            "bss.edca must have an aifsn of 2 .. 15");
  EXPECT_EQ(broken([](auto& c) { c.bss.edca->of(AccessCategory::kVoice).txop_limit += 1us; }),
            "bss.edca must have a txop_limit of 0 to 65535 times 32 us");
  EXPECT_EQ(broken([](auto& c) { c.bss.edca->of(AccessCategory::kVoice).cw_max = 65'535; }),
            "bss.edca must have a cw_max of at most 32767 that is not below its cw_min");
}

/// Station 1 is the access point and has other parameters than it announces. No backoff: the time
/// from an ACK to the next frame is the AIFS.
class AnnouncedEdca : public BssTest {
 protected:
  AnnouncedEdca() {
    dcf().qos = true;
    for (AccessParameters& c : dcf().edca.categories) c = {0, 0, kOwn, {}, {}};
    dcf().bss.edca = dcf().edca;
    for (AccessParameters& c : dcf().bss.edca->categories) c.aifsn = kAnnounced;
    without_rts();
  }
  /// Slots from the ACK of the first frame to the second, which a station has at this time.
  std::int64_t slots_at(hal::Duration at, std::uint16_t from, std::uint16_t to) {
    air.run(at);
    forget();
    air.send(from, to, kPayload);
    air.send(from, to, kPayload);
    air.run(at + 10ms);
    const auto& starts = air.log.starts;
    for (std::size_t i = 0; i + 2 < starts.size(); ++i) {
      if (starts[i].frame.type != FrameType::kData) continue;
      EXPECT_EQ(starts[i + 2].frame.type, FrameType::kData);
      const hal::Duration gap = start_of(i + 2) - start_of(i + 1) - starts[i + 1].frame.airtime;
      EXPECT_EQ((gap - kSifs) % kSlot, 0us);
      return (gap - kSifs) / kSlot;
    }
    ADD_FAILURE() << "no data";
    return 0;
  }
  static constexpr std::uint32_t kOwn = 4, kAnnounced = 9;
};

TEST_F(AnnouncedEdca, IsWhatStationsUseAndTheAccessPointDoesNot) {
  build({{0, 0, 0}, {50, 0, 0}});
  EXPECT_EQ(slots_at(1s, 2, 1), kAnnounced);
  EXPECT_EQ(slots_at(1020ms, 1, 2), kOwn);
}

TEST_F(AnnouncedEdca, IsNotForAnAdHocNetwork) {
  for (const hal::Vec3& place : {hal::Vec3{0, 0, 0}, hal::Vec3{50, 0, 0}}) air.add(place);
  air.build();
  EXPECT_EQ(slots_at(1s, 2, 1), kOwn);
}

// The windows, too: of 64 slots the mean of 50 backoffs is 32 +- 3, of none it is 0.
TEST_F(AnnouncedEdca, HasWindows) {
  for (AccessParameters& c : dcf().bss.edca->categories) c.cw_min = c.cw_max = 63;
  build({{0, 0, 0}, {50, 0, 0}});
  air.run(1s);
  std::int64_t sum = 0;
  for (int i = 0; i < 50; ++i) sum += slots_at(1s + (i + 1) * 20ms, 2, 1) - kAnnounced;
  EXPECT_NEAR(static_cast<double>(sum) / 50, 31.5, 3 * 18.5 / 7.1);
}

TEST_F(AnnouncedEdca, HasTxopLimits) {
  for (AccessParameters& c : dcf().bss.edca->categories) c.txop_limit = 312 * kTxopUnit;
  build({{0, 0, 0}, {50, 0, 0}});
  EXPECT_EQ(slots_at(1s, 2, 1), 0) << "SIFS, in the same TXOP";
  EXPECT_EQ(slots_at(1020ms, 1, 2), kOwn);
}

}  // namespace
}  // namespace sim::radio::test
