#pragma once

#include <algorithm>
#include <string>

#include "tests/analytic/radio/peer.h"
#include "tests/analytic/radio/qos_cell.h"

namespace sim::radio::test {

/// The cell of one row of ht_saturation_ns3.csv or ht_blockack_ns3.csv: 802.11n in 2.4 GHz, one
/// stream, with what stock ns-3.37 does where it differs from the standard (peer.h).
inline RadioConfig ht_like_the_peer(const PeerRow& row) {
  using namespace std::chrono_literals;
  RadioConfig config = profile_defaults(Profile::kIeee80211n);
  auto& n = std::get<Ieee80211nConfig>(config);
  n.receiver.energy_detection = hal::Dbm{-82};
  n.propagation.chain = {LogDistanceConfig{}};
  n.bits_at_risk = BitsAtRisk::kPayloadTime;
  n.mcs.times = PpduTimes::kNs3;
  if (row.at("band_ghz") == "5") set_channel(n, 36);
  n.mcs.mcs = static_cast<std::uint8_t>(std::stoi(row.at("mcs")));
  n.mcs.width = static_cast<std::uint16_t>(std::stoi(row.at("width_mhz")));
  n.mcs.guard = hal::Duration{std::stol(row.at("gi_ns"))};
  n.aggregation.max_ampdu = static_cast<std::uint32_t>(std::stoul(row.at("max_ampdu")));
  n.aggregation.max_amsdu = static_cast<std::uint32_t>(std::stoul(row.at("max_amsdu")));
  const double loss = std::stod(row.at("post_loss"));
  if (loss > 0) n.receiver.loss.links.push_back({"*", "s1", loss});
  return config;
}

inline QosCell cell_of(const PeerRow& row) {
  return {.best_effort = std::stoi(row.at("n_be")),
          .voice = std::stoi(row.at("n_vo")),
          .payload_best_effort = std::stoul(row.at("payload_be")),
          .payload_voice = std::stoul(row.at("payload_vo")),
          .voice_rate = std::stod(row.at("vo_rate_hz"))};
}

/// Mean goodput of best effort over seeds 1 .. `seeds`, Mb/s.
inline double mean_goodput(const PeerRow& row, int seeds) {
  double sum = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Air air(ht_like_the_peer(row));
    air.seed = static_cast<std::uint64_t>(seed);
    QosRun run(air, cell_of(row));
    sum += run.best_effort().mbps;
  }
  return sum / seeds;
}

/// The rows of one cell, whatever the seed.
inline std::string name_of_cell(const PeerRow& row) {
  std::string name = row.at("band_ghz") + "GHz_" + row.at("width_mhz") + "_gi" + row.at("gi_ns") +
                     "_mcs" + row.at("mcs") + "_n" + row.at("n_be") + "_" + row.at("payload_be") +
                     "_ampdu" + row.at("max_ampdu") + "_amsdu" + row.at("max_amsdu") + "_loss" +
                     row.at("post_loss");
  std::ranges::replace(name, '.', 'p');
  return name;
}

}  // namespace sim::radio::test
