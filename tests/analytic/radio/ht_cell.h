#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "tests/analytic/radio/peer.h"
#include "tests/analytic/radio/qos_cell.h"
#include "tests/analytic/radio/welch.h"

namespace sim::radio::test {

/// Value of a column that not every table has.
inline std::string column(const PeerRow& row, const std::string& name, const std::string& absent) {
  const auto found = row.find(name);
  return found == row.end() ? absent : found->second;
}

/// TXOP limits of the row; those it does not set stay.
inline void set_txop_limits(const PeerRow& row, EdcaConfig& edca) {
  for (AccessParameters& one : edca.categories) {
    if (column(row, "txop0", "0") == "1") one.txop_limit = {};
  }
  const auto set = [&](const std::string& name, AccessCategory category) {
    const long limit = std::stol(column(row, name, "-1"));
    if (limit >= 0) edca.of(category).txop_limit = std::chrono::microseconds{limit};
  };
  set("txop_be_us", AccessCategory::kBestEffort);
  set("txop_vi_us", AccessCategory::kVideo);
  set("txop_vo_us", AccessCategory::kVoice);
}

/// The cell of a row: 802.11n, ac or ax with what stock ns-3.37 does where it differs from the
/// standard (peer.h).
inline RadioConfig ht_like_the_peer(const PeerRow& row) {
  using namespace std::chrono_literals;
  const std::string& phy = row.at("phy");
  RadioConfig config = profile_defaults(phy == "n"    ? Profile::kIeee80211n
                                        : phy == "ac" ? Profile::kIeee80211ac
                                                      : Profile::kIeee80211ax);
  HtConfig& n = *ht_of(config);
  n.receiver.energy_detection = hal::Dbm{-82};
  n.receiver.min_sinr = hal::Decibels{std::stod(column(row, "preamble_db", "4"))};
  n.propagation.chain = {LogDistanceConfig{}};
  n.bits_at_risk = BitsAtRisk::kPayloadTime;
  n.mcs = {.mcs = static_cast<std::uint8_t>(std::stoi(row.at("mcs"))),
           .streams = static_cast<std::uint8_t>(std::stoi(column(row, "streams", "1"))),
           .width = static_cast<std::uint16_t>(std::stoi(row.at("width_mhz"))),
           .guard = hal::Duration{std::stol(row.at("gi_ns"))},
           .times = PpduTimes::kNs3};
  if (row.at("band_ghz") == "5") set_channel(n, 36);
  n.aggregation = {.max_ampdu = static_cast<std::uint32_t>(std::stoul(row.at("max_ampdu"))),
                   .max_amsdu = static_cast<std::uint32_t>(std::stoul(row.at("max_amsdu")))};
  set_txop_limits(row, n.edca);
  const double loss = std::stod(row.at("post_loss"));
  if (loss > 0) n.receiver.loss.links.push_back({"*", "s1", loss});
  return config;
}

inline QosCell cell_of(const PeerRow& row) {
  return {.best_effort = std::stoi(row.at("n_be")),
          .video = std::stoi(column(row, "n_vi", "0")),
          .voice = std::stoi(row.at("n_vo")),
          .distance = std::stod(column(row, "radius_m", "5")),
          .payload_best_effort = std::stoul(row.at("payload_be")),
          .payload_voice = std::stoul(row.at("payload_vo")),
          .voice_rate = std::stod(row.at("vo_rate_hz"))};
}

/// What ours yields in a cell, of what a row is about: a run for each seed from 1 on.
/// @param change  what is to differ from ht_like_the_peer().
inline std::vector<Served> runs_of(
    const PeerRow& row, int seeds, hal::Duration time,
    const std::function<void(HtConfig&)>& change = [](HtConfig&) {}) {
  std::vector<Served> served;
  for (int seed = 1; seed <= seeds; ++seed) {
    RadioConfig config = ht_like_the_peer(row);
    change(*ht_of(config));
    Air air(config);
    air.seed = static_cast<std::uint64_t>(seed);
    QosCell cell = cell_of(row);
    cell.time = time;
    QosRun run(air, cell);
    const std::string& category = row.at("ac");
    served.push_back(category == "BE"   ? run.best_effort()
                     : category == "VI" ? run.video()
                                        : run.voice());
  }
  return served;
}

inline std::vector<double> values_of(const std::vector<Served>& runs, double Served::*what) {
  std::vector<double> values;
  for (const Served& run : runs) values.push_back(run.*what);
  return values;
}

inline double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The same for all seeds of a cell.
inline std::string name_of_cell(const PeerRow& row) {
  const std::string streams = column(row, "streams", "1");
  std::string name = column(row, "phy", "n") == "n" ? "" : row.at("phy") + "_";
  name += row.at("band_ghz") + "GHz_" + row.at("width_mhz") + "_gi" + row.at("gi_ns") + "_mcs" +
          row.at("mcs") + (streams == "1" ? "" : "x" + streams) + "_n" + row.at("n_be") + "_" +
          row.at("payload_be") + "_ampdu" + row.at("max_ampdu") + "_amsdu" + row.at("max_amsdu") +
          "_loss" + row.at("post_loss");
  const std::map<std::string, std::string> usual{
      {"ac", "BE"},         {"n_vo", "0"},     {"vo_rate_hz", "0"}, {"txop_be_us", "-1"},
      {"txop_vi_us", "-1"}, {"radius_m", "5"}, {"preamble_db", "4"}};
  for (const auto& [key, value] : usual) {
    const std::string is = column(row, key, value);
    if (is != value) name += "_" + key + is;
  }
  std::ranges::replace(name, '.', 'p');
  return name;
}

/// One cell and the peer's seeds of it.
struct PeerCell {
  PeerRow row;
  std::vector<double> mbps{}, delays{};

  bool is_alone() const { return cell_of(row).best_effort + cell_of(row).video == 1; }
  bool is_aggregate() const { return row.at("max_ampdu") != "0"; }
  bool has_txop() const {
    return column(row, "txop_be_us", "-1") != "-1" || column(row, "txop_vi_us", "-1") != "-1";
  }
};

inline void PrintTo(const PeerCell& cell, std::ostream* out) { *out << name_of_cell(cell.row); }

/// The cells of a table that `wanted` accepts.
inline std::vector<PeerCell> cells(const std::string& file,
                                   const std::function<bool(const PeerCell&)>& wanted) {
  std::map<std::string, PeerCell> by_name;
  for (const PeerRow& row : read_peer(file)) {
    PeerCell& cell = by_name.try_emplace(name_of_cell(row), PeerCell{row}).first->second;
    cell.mbps.push_back(std::stod(row.at("goodput_mbps")));
    cell.delays.push_back(std::stod(row.at("mean_delay_ms")));
  }
  std::vector<PeerCell> all;
  for (const auto& [name, cell] : by_name) {
    if (wanted(cell)) all.push_back(cell);
  }
  return all;
}

/// What tests/analytic/radio compares; of several senders of short frames at the highest rate it
/// takes seconds, so that they are in tests/slow/radio, as A-MPDUs of several are.
inline bool is_quick(const PeerCell& cell) {
  const bool is_short = cell.row.at("mcs") == "7" && cell.row.at("payload_be") == "200";
  return cell.is_alone() || (!cell.is_aggregate() && !is_short);
}

/// One sender: 0.5 %. Several, single MPDUs: 1.5 %, but 2.5 % for short frames at the highest rate
/// in 2.4 GHz, where an EIFS is as long as several frames. Where no station synchronises to one of
/// two colliding frames (preamble_db 20), so that none arises, that cell is within 1.5 %, too. Of
/// 69 waits replayed from ns-3.37's traces 40 fit an EIFS that a right frame does not end, 10 one
/// that it ends, as IEEE Std 802.11-2020, 10.3.2.3.7 has it and ours does, and 19 neither: its
/// timer is not set anew, and where it is (ht_restart_ns3.csv), that cell is within 1.5 %, too.
inline double tolerance_of(const PeerCell& cell) {
  if (cell.is_alone()) return 0.005;
  const bool has_eifs = column(cell.row, "preamble_db", "4") == "4";
  return has_eifs && cell.row.at("mcs") == "7" && cell.row.at("payload_be") == "200" ? 0.025
                                                                                     : 0.015;
}

/// Compares the mean goodput with that of ns-3.37.
inline void expect_goodput_of_the_peer(const PeerCell& cell, double tolerance) {
  const std::vector<Served> runs =
      runs_of(cell.row, cell.is_alone() ? 2 : 5, std::chrono::seconds{3});
  const double ours = mean_of(values_of(runs, &Served::mbps)), theirs = mean_of(cell.mbps);
  testing::Test::RecordProperty("mbps", std::to_string(ours));
  testing::Test::RecordProperty("theirs", std::to_string(theirs));
  EXPECT_NEAR(ours, theirs, tolerance * theirs);
}
inline void expect_goodput_of_the_peer(const PeerCell& cell) {
  expect_goodput_of_the_peer(cell, tolerance_of(cell));
}

/// Several senders of A-MPDUs, whose goodput spreads: the 95 % interval of the difference from
/// ns-3.37 lies within +-4 %. Ten seeds at least on each side.
inline void expect_interval_of_the_peer(const PeerCell& cell, hal::Duration time) {
  constexpr int kSeeds = 10;
  ASSERT_GE(cell.mbps.size(), kSeeds);
  const std::vector<double> ours = values_of(runs_of(cell.row, kSeeds, time), &Served::mbps);
  const auto [low, high] = relative_difference(ours, cell.mbps);
  testing::Test::RecordProperty("mbps", std::to_string(mean_of(ours)));
  testing::Test::RecordProperty("theirs", std::to_string(mean_of(cell.mbps)));
  testing::Test::RecordProperty("low", std::to_string(low));
  testing::Test::RecordProperty("high", std::to_string(high));
  EXPECT_GT(low, -0.04);
  EXPECT_LT(high, 0.04);
}

}  // namespace sim::radio::test
