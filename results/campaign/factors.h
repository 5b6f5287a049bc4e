#pragma once

#include <string>
#include <vector>

#include "results/campaign/campaign_file.h"
#include "results/campaign/rows.h"

namespace results::campaign {

/// What is varied, and the value that each point has of it.
struct FactorTable {
  std::vector<Factor> factors;
  std::vector<PointRow> points;  ///< Numbered from 1, with labels and levels, without scenarios.
};

/// Numbers are given in SI units, levels in dB and dBm in these if all values of a factor are. A
/// key that a point of a list does not set has the default level "" there.
/// @param keys  that are varied.
FactorTable factor_table(const std::vector<std::string>& keys,
                         const std::vector<DesignPoint>& points);

/// Says what points have where they leave a key at its default: in their levels, with the numbers
/// that follow, and in their labels.
/// @param defaults  of each point, by factor; "": its scenario has no such key.
void set_defaults(FactorTable& table, const std::vector<std::vector<std::string>>& defaults);

/// Of one replication at one point: common: base + replication - 1; independent: from a random
/// stream of the base seed that is named after the point's values and the replication, so that more
/// points or replications change no other's.
std::uint64_t seed_of(Seeds seeds, std::uint64_t base, const PointRow& point, int replication);

}  // namespace results::campaign
