#include <gtest/gtest.h>

#include <string>

#include "sim/radio/phy/mcs_modes.h"
#include "tests/analytic/radio/peer.h"
#include "tests/analytic/radio/qos_cell.h"
#include "tests/analytic/radio/slotted_dcf.h"

namespace sim::radio::test {
namespace {

ModeId mode_of(const PeerRow& row) {
  const std::string& mode = row.at("mode");  // HeMcs7_80MHz
  const bool is_wide = mode.find("80MHz") != std::string::npos;
  return {.modulation = ModulationClass::kHe,
          .mcs = static_cast<std::uint8_t>(std::stoi(mode.substr(5))),
          .streams = 1,
          .width = static_cast<std::uint16_t>(is_wide ? 80 : 20),
          .guard = std::chrono::nanoseconds{800}};
}

/// As the formula of bianchi_he.csv assumes: DCF with DIFS, one MPDU, endless retries, no EIFS. It
/// does not say which guard interval and which rate of the ACK it had: 0.8 us and the highest of 6,
/// 12 and 24 Mb/s by the frame's reference rate fit all rows (Table).
RadioConfig as_in_the_formula(const PeerRow& row) {
  Ieee80211axConfig config;
  config.mcs.mcs = mode_of(row).mcs;
  config.mcs.width = mode_of(row).width;
  config.mcs.times = PpduTimes::kNs3;
  config.qos = false;
  config.contention.short_retry_limit = 1'000'000;
  config.contention.cw_min = 15;
  config.contention.cw_max = 1023;
  // No receiver synchronises to one of several frames that begin together: no EIFS follows.
  config.receiver.min_sinr = hal::Decibels{30};
  return config;
}

SlotTimes times_of(const PeerRow& row) {
  const auto mode = make_mcs_mode(mode_of(row), {.has_extension = false, .times = PpduTimes::kNs3});
  return {.frame = 1e6 * hal::to_seconds(mode->airtime(8 * 1536)),
          .answer = mode_of(row).mcs == 0 ? 44.0 : 28.0};
}

double goodput(const PeerRow& row) {
  constexpr int kSeeds = 3;
  const bool is_slow = row.at("mode") == "HeMcs0_20MHz";
  double mean = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Air air(as_in_the_formula(row));
    air.seed = seed;
    QosRun run(air, {.best_effort = std::stoi(row.at("n")),
                     .time = std::chrono::seconds{is_slow ? 20 : 4}});
    mean += run.best_effort().mbps / kSeeds;
  }
  return mean;
}

std::string name_of(const testing::TestParamInfo<PeerRow>& info) {
  return info.param.at("mode") + "_n" + info.param.at("n");
}

class Table : public testing::TestWithParam<PeerRow> {};

// What the table is: Bianchi's formula, in which a success takes one slot more than the frames and
// a collision only the frame and DIFS. To the last digit of the table's numbers.
TEST_P(Table, IsBianchisFormulaWithASlotMoreAfterASuccess) {
  const double table = std::stod(GetParam().at("Mbps"));
  const double formula = bianchi(std::stoi(GetParam().at("n")), times_of(GetParam()));
  RecordProperty("mbps", std::to_string(formula));
  EXPECT_NEAR(formula, table, 1e-4 + 2e-5 * table);
}

INSTANTIATE_TEST_SUITE_P(Ns3, Table, testing::ValuesIn(read_peer("bianchi_he.csv")), name_of);

class BianchiHe : public testing::TestWithParam<PeerRow> {};

double tolerance(const PeerRow& row) {
  if (row.at("n") == "50") return 0.03;
  return row.at("mode") == "HeMcs0_20MHz" && row.at("n") == "20" ? 0.025 : 0.02;
}

// Bianchi (2000) with HE's times: within 2 % for 5 and 20 stations, 3 % for 50. One is 2.4 % off:
// in the formula, every station counts down in a busy slot, too. By the standard (IEEE Std
// 802.11-2020, 10.3.4.3) the counter stands still until the medium has been idle for a DIFS, and
// those who collided join after their ACK timeout. Played slot by slot, the first rule gives the
// table within 0.7 % and the second ours within 0.7 %.
TEST_P(BianchiHe, HoldsButForCountingInBusySlots) {
  const int n = std::stoi(GetParam().at("n"));
  const SlotTimes times = times_of(GetParam());
  const double formula = std::stod(GetParam().at("Mbps")), ours = goodput(GetParam());
  RecordProperty("mbps", std::to_string(ours));
  EXPECT_NEAR(ours, formula, tolerance(GetParam()) * formula);
  EXPECT_NEAR(slotted_dcf(n, times, Counting::kInBusySlots), formula, 0.007 * formula);
  EXPECT_NEAR(slotted_dcf(n, times, Counting::kInIdleSlots), ours, 0.007 * ours);
}

std::vector<PeerRow> rows() {
  std::vector<PeerRow> rows = read_peer("bianchi_he.csv");
  std::erase_if(rows, [](const PeerRow& row) {
    const std::string& n = row.at("n");
    return n != "5" && n != "20" && n != "50";
  });
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Ns3, BianchiHe, testing::ValuesIn(rows()), name_of);

}  // namespace
}  // namespace sim::radio::test
