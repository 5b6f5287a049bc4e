#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/radio/radio_config.h"

namespace sim::radio::test {

/// Rows of a table of the peer's by the names of its columns. Lines that begin with # are comments.
using PeerRow = std::map<std::string, std::string>;

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

/// @param name  of a file in tests/analytic/radio.
inline std::vector<PeerRow> read_peer(const std::string& name) {
  std::ifstream file(std::string(TESTS_DIR) + "/analytic/radio/" + name);
  std::vector<std::string> columns;
  std::vector<PeerRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const std::vector<std::string> parts = split(line);
    if (columns.empty()) {
      columns = parts;
      continue;
    }
    PeerRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < parts.size(); ++i) row[columns.at(i)] = parts[i];
  }
  return rows;
}

/// A mode as the peer's tables name it: b11, g54.
inline hal::BitsPerSecond rate_of_mode(const std::string& mode) {
  return hal::BitsPerSecond{std::stod(mode.substr(1)) * 1e6};
}

/// The profile with what stock ns-3.37 does where it differs from the standard: carrier sense adds
/// up all energy against the threshold of a frame, an RTS that fails never costs the frame, and the
/// pad bits and the signal extension of OFDM frames must arrive, too.
inline RadioConfig like_the_peer(const std::string& mode, bool rts) {
  RadioConfig config =
      profile_defaults(mode.starts_with('g') ? Profile::kIeee80211g : Profile::kIeee80211b);
  WavesConfig& waves = *waves_of(config);
  waves.receiver.energy_detection = hal::Dbm{-82};
  waves.contention.rts_threshold = rts ? 0 : 2347;
  if (rts) waves.contention.short_retry_limit = 1'000'000;
  waves.phy.data_rate = rate_of_mode(mode);
  if (auto* const g = std::get_if<Ieee80211gConfig>(&config)) {
    g->bits_at_risk = BitsAtRisk::kPayloadTime;
  }
  return config;
}

}  // namespace sim::radio::test
