#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "hal/types/math.h"
#include "sim/radio/phy/he_mode.h"
#include "sim/radio/phy/ht_mode.h"
#include "sim/radio/phy/ofdm_error_model.h"
#include "sim/radio/phy/vht_mode.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

const std::map<std::string, ModulationClass> kFormats{
    {"ht", ModulationClass::kHt}, {"vht", ModulationClass::kVht}, {"he", ModulationClass::kHe}};

bool exists(const ModeId& id) {
  return HtMode::exists(id) || VhtMode::exists(id) || HeMode::exists(id);
}

std::unique_ptr<PhyMode> make(const ModeId& id, McsMode::Options options = {}) {
  if (id.modulation == ModulationClass::kHt) return std::make_unique<HtMode>(id, options);
  if (id.modulation == ModulationClass::kVht) return std::make_unique<VhtMode>(id, options);
  return std::make_unique<HeMode>(id, options);
}

/// Rates by MCS in Mb/s of one stream, as printed in the standard's tables; 0: no such mode.
struct RateTable {
  const char* name;
  ModulationClass modulation;
  std::uint16_t width;
  hal::Duration guard;
  std::vector<double> rates;
};
void PrintTo(const RateTable& table, std::ostream* out) { *out << table.name; }

class McsRates : public testing::TestWithParam<RateTable> {};
// To the last digit printed, by the number of streams.
TEST_P(McsRates, AreThoseOfTheStandard) {
  const RateTable& table = GetParam();
  for (std::uint8_t mcs = 0; mcs < table.rates.size(); ++mcs) {
    const ModeId id{table.modulation, mcs, 1, table.width, table.guard};
    EXPECT_EQ(exists(id), table.rates[mcs] != 0) << int{mcs};
    if (!exists(id)) continue;
    EXPECT_NEAR(make(id)->rate().value / 1e6, table.rates[mcs], 0.05 + 1e-9) << int{mcs};
    EXPECT_EQ(make(id)->width(), table.width);
  }
}
// IEEE Std 802.11-2020, tables 19-27, 19-31, 21-30, 21-38 and 21-46; IEEE Std 802.11ax-2021, tables
// 27-65, 27-81 and 27-97 (RUs of 242, 484 and 996 tones).
INSTANTIATE_TEST_SUITE_P(
    Std80211, McsRates,
    testing::Values(
        RateTable{"Ht20", ModulationClass::kHt, 20, 800ns, {6.5, 13, 19.5, 26, 39, 52, 58.5, 65}},
        RateTable{"Ht20Short",
                  ModulationClass::kHt,
                  20,
                  400ns,
                  {7.2, 14.4, 21.7, 28.9, 43.3, 57.8, 65, 72.2}},
        RateTable{
            "Ht40", ModulationClass::kHt, 40, 800ns, {13.5, 27, 40.5, 54, 81, 108, 121.5, 135}},
        RateTable{
            "Ht40Short", ModulationClass::kHt, 40, 400ns, {15, 30, 45, 60, 90, 120, 135, 150, 0}},
        RateTable{"Vht20",
                  ModulationClass::kVht,
                  20,
                  800ns,
                  {6.5, 13, 19.5, 26, 39, 52, 58.5, 65, 78, 0, 0}},
        RateTable{"Vht40",
                  ModulationClass::kVht,
                  40,
                  800ns,
                  {13.5, 27, 40.5, 54, 81, 108, 121.5, 135, 162, 180}},
        RateTable{"Vht80",
                  ModulationClass::kVht,
                  80,
                  800ns,
                  {29.3, 58.5, 87.8, 117, 175.5, 234, 263.3, 292.5, 351, 390}},
        RateTable{"Vht80Short",
                  ModulationClass::kVht,
                  80,
                  400ns,
                  {32.5, 65, 97.5, 130, 195, 260, 292.5, 325, 390, 433.3}},
        RateTable{"He20",
                  ModulationClass::kHe,
                  20,
                  800ns,
                  {8.6, 17.2, 25.8, 34.4, 51.6, 68.8, 77.4, 86.0, 103.2, 114.7, 129, 143.4, 0}},
        RateTable{"He20Long",
                  ModulationClass::kHe,
                  20,
                  3200ns,
                  {7.3, 14.6, 21.9, 29.3, 43.9, 58.5, 65.8, 73.1, 87.8, 97.5, 109.7, 121.9}},
        RateTable{"He40",
                  ModulationClass::kHe,
                  40,
                  1600ns,
                  {16.3, 32.5, 48.8, 65, 97.5, 130, 146.3, 162.5, 195, 216.7, 243.8, 270.8}},
        RateTable{"He80",
                  ModulationClass::kHe,
                  80,
                  800ns,
                  {36, 72.1, 108.1, 144.1, 216.2, 288.2, 324.3, 360.3, 432.4, 480.4, 540.4, 600.5}},
        RateTable{"He80Long",
                  ModulationClass::kHe,
                  80,
                  3200ns,
                  {30.6, 61.3, 91.9, 122.5, 183.8, 245, 275.6, 306.3, 367.5, 408.3, 459.4, 510.4}}),
    [](const auto& c) { return std::string(c.param.name); });

// Four streams carry four times as much; 4 x 40 MHz, MCS 7: 540 and 600 Mb/s.
TEST(McsRate, GrowsWithTheStreams) {
  EXPECT_DOUBLE_EQ(make({ModulationClass::kHt, 7, 4, 40, 800ns})->rate().value, 540e6);
  EXPECT_DOUBLE_EQ(make({ModulationClass::kHt, 7, 4, 40, 400ns})->rate().value, 600e6);
  EXPECT_DOUBLE_EQ(make({ModulationClass::kVht, 9, 4, 80, 800ns})->rate().value, 1560e6);
}

// IEEE Std 802.11-2020, 21.5, up to four streams and 80 MHz: all modes that are left out.
TEST(VhtModes, ThatTheStandardLeavesOut) {
  std::string missing;
  for (const std::uint16_t width : std::initializer_list<std::uint16_t>{20, 40, 80}) {
    for (std::uint8_t streams = 1; streams <= 4; ++streams) {
      for (std::uint8_t mcs = 0; mcs <= 9; ++mcs) {
        if (exists({ModulationClass::kVht, mcs, streams, width, 800ns})) continue;
        missing +=
            std::to_string(width) + "/" + std::to_string(streams) + "/" + std::to_string(mcs) + " ";
      }
    }
  }
  EXPECT_EQ(missing, "20/1/9 20/2/9 20/4/9 80/3/6 ");
}

struct AirtimeRow {
  ModeId id;
  bool is_5ghz = false;
  std::uint32_t bytes = 0;
  std::int64_t ns = 0;
  std::string text;
};

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

/// The lines of a file after its provenance and heading.
std::vector<std::string> lines_of(const char* name) {
  std::ifstream file(std::string(TESTS_DIR) + "/analytic/radio/" + name);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('h') || line.starts_with('v')) lines.push_back(line);
  }
  return lines;
}

std::vector<AirtimeRow> peer_airtimes() {
  std::vector<AirtimeRow> rows;
  for (const std::string& line : lines_of("mode_airtimes_ns3.csv")) {
    const auto f = fields_of(line);
    const auto number = [&f](std::size_t i) { return std::stol(f[i]); };
    rows.push_back({{kFormats.at(f[0]), static_cast<std::uint8_t>(number(1)),
                     static_cast<std::uint8_t>(number(2)), static_cast<std::uint16_t>(number(3)),
                     hal::Duration{number(4)}},
                    f[5] == "5",
                    static_cast<std::uint32_t>(number(6)),
                    number(7),
                    line});
  }
  return rows;
}

// What ns-3.37 (tests/peer/ns3/modes) takes for a PSDU, to the nanosecond.
TEST(McsAirtimes, AreThePeersIfTheyAreToBe) {
  const auto rows = peer_airtimes();
  ASSERT_EQ(rows.size(), 2704u);
  for (const AirtimeRow& row : rows) {
    ASSERT_TRUE(exists(row.id)) << row.text;
    const auto mode = make(row.id, {.has_extension = !row.is_5ghz, .times = PpduTimes::kNs3});
    EXPECT_EQ(mode->airtime(8 * row.bytes).count(), row.ns) << row.text;
  }
}

struct WorkedAirtime {
  const char* name;
  ModeId id;
  std::uint32_t bits;
  hal::Duration airtime;
};
void PrintTo(const WorkedAirtime& c, std::ostream* out) { *out << c.name; }

class McsAirtime : public testing::TestWithParam<WorkedAirtime> {};
TEST_P(McsAirtime, IsPreambleAndWholeSymbols) {
  EXPECT_EQ(make(GetParam().id, {.has_extension = false})->airtime(GetParam().bits),
            GetParam().airtime);
  EXPECT_EQ(make(GetParam().id)->airtime(GetParam().bits), GetParam().airtime + 6us);
}
constexpr std::uint32_t kLong = 8 * 1538;  // bits; with service and tail 12,326
INSTANTIATE_TEST_SUITE_P(
    HandWorked, McsAirtime,
    testing::Values(
        // 36 us, and 12,326 / 260: 48 symbols of 4 us.
        WorkedAirtime{"Ht20", {ModulationClass::kHt, 7, 1, 20, 800ns}, kLong, 228us},
        // 36 us, and 48 symbols of 3.6 us: 172.8 us, so 176.
        WorkedAirtime{"Ht20Short", {ModulationClass::kHt, 7, 1, 20, 400ns}, kLong, 212us},
        // Three streams have four training fields: 48 us, and 12,326 / 780: 16 symbols.
        WorkedAirtime{"Ht20Streams3", {ModulationClass::kHt, 7, 3, 20, 800ns}, kLong, 112us},
        // Two encoders: 12 tail bits. 2160 bits in a symbol of 4 us.
        WorkedAirtime{
            "Ht40FullSymbols", {ModulationClass::kHt, 7, 4, 40, 800ns}, 3 * 2160 - 28, 60us},
        WorkedAirtime{
            "Ht40OneBitMore", {ModulationClass::kHt, 7, 4, 40, 800ns}, 3 * 2160 - 27, 64us},
        // 40 us with VHT-SIG-B, and 12,326 / 1560: 8 symbols.
        WorkedAirtime{"Vht80", {ModulationClass::kVht, 9, 1, 80, 800ns}, kLong, 72us},
        // 8 symbols of 3.6 us: 28.8 us, so 32.
        WorkedAirtime{"Vht80Short", {ModulationClass::kVht, 9, 1, 80, 400ns}, kLong, 72us},
        // 36 us and one 2x HE-LTF of 7.2 us; 12,326 / 8166: 2 symbols of 13.6 us.
        WorkedAirtime{"He80", {ModulationClass::kHe, 11, 1, 80, 800ns}, kLong, 70'400ns},
        // 36 us and one 4x HE-LTF of 16 us; 2 symbols of 16 us.
        WorkedAirtime{"He80Long", {ModulationClass::kHe, 11, 1, 80, 3200ns}, kLong, 84us},
        // 36 us and two 2x HE-LTFs of 8 us; 12,326 / 234: 53 symbols of 14.4 us.
        WorkedAirtime{"He20Streams2", {ModulationClass::kHe, 0, 2, 20, 1600ns}, kLong, 815'200ns}),
    [](const auto& c) { return std::string(c.param.name); });

// Every row of the NIST model of ns-3.37, one stream in 20 MHz. The same published formula.
TEST(McsPacketErrors, AreThePeers) {
  const auto lines = lines_of("mode_errors_ns3.csv");
  for (const std::string& line : lines) {
    const auto f = fields_of(line);
    const ModeId id{kFormats.at(f[0]), static_cast<std::uint8_t>(std::stoi(f[1])), 1, 20, 800ns};
    // The peer's VHT has MCS 9 in 20 MHz, too; HE has the same constellation and code.
    const ModeId known = exists(id) ? id : ModeId{ModulationClass::kHe, id.mcs, 1, 20, 800ns};
    const double sinr = hal::math::pow(10, std::stod(f[4]) / 10);
    const double error = 1 - make(known)->success(sinr, 8 * std::stod(f[3]));
    const double expected = std::stod(f[5]);
    EXPECT_NEAR(error, expected, 1e-6 * expected) << line;
  }
  EXPECT_EQ(lines.size(), 844u);
}

// Streams and widths change nothing at the same SINR of a subcarrier.
TEST(McsPacketErrors, DependOnTheMcsAlone) {
  const double one = make({ModulationClass::kHt, 5, 1, 20, 800ns})->success(60, 8000);
  EXPECT_LT(one, 1);
  EXPECT_EQ(make({ModulationClass::kVht, 5, 4, 80, 400ns})->success(60, 8000), one);
}

// L-SIG 24 and HT-SIG 48 bits in BPSK 1/2; VHT-SIG-B of 80 MHz 29 more; HE-SIG-A has 52.
TEST(McsHeader, IsLostAsOftenAsItsBits) {
  const double sinr = 1.5;
  const auto bpsk = [sinr](double bits) {
    return ofdm_success_probability(sinr, {Constellation::kBpsk, CodeRate::kHalf}, bits);
  };
  const auto header = [sinr](const ModeId& id) { return make(id)->header_success(sinr, 1); };
  EXPECT_LT(bpsk(72), 0.99);
  EXPECT_DOUBLE_EQ(header({ModulationClass::kHt, 7, 1, 20, 800ns}), bpsk(72));
  EXPECT_DOUBLE_EQ(header({ModulationClass::kVht, 7, 1, 80, 800ns}), bpsk(101));
  EXPECT_DOUBLE_EQ(header({ModulationClass::kHe, 7, 1, 80, 800ns}), bpsk(76));
  EXPECT_DOUBLE_EQ(make({ModulationClass::kHt, 7, 1, 20, 800ns})->header_success(sinr, 0.5),
                   bpsk(36));
}

// As of OFDM in 20 MHz: with payload_time as many bits as the data field and the extension hold.
TEST(McsBitsAtRisk, AreThePsdusOrAsManyAsTheTimeHolds) {
  const ModeId id{ModulationClass::kHt, 7, 1, 20, 800ns};
  EXPECT_EQ(make(id)->bits_at_risk(kLong), kLong);
  EXPECT_EQ(make(id)->signal_extension(), 6us);
  const auto peer = make(id, {.at_risk = BitsAtRisk::kPayloadTime});
  EXPECT_DOUBLE_EQ(peer->bits_at_risk(kLong), 65 * (48 * 4 + 6));
  EXPECT_EQ(peer->signal_extension(), 0us);
}

}  // namespace
}  // namespace sim::radio::test
