#pragma once

#include <string>
#include <vector>

#include "results/campaign/campaign_file.h"
#include "results/campaign/rows.h"

namespace results::campaign {

/// The factors of a campaign and their levels at each point.
struct FactorTable {
  std::vector<Factor> factors;
  std::vector<PointRow> points;  ///< Numbered from 1; with labels and levels, without scenarios.
};

/// Numbers are in SI units; if all values of a factor are in dB or all in dBm, its numbers are,
/// too. A key that a point of a list does not set has the default level "" there.
/// @param keys  the varied keys.
FactorTable factor_table(const std::vector<std::string>& keys,
                         const std::vector<DesignPoint>& points);

/// Fills in the values of keys that points leave at their defaults: in levels, numbers and labels.
/// @param defaults  values of each point, by factor; "": its scenario has no such key.
void set_defaults(FactorTable& table, const std::vector<std::vector<std::string>>& defaults);

/// The seed of one replication at one point. kCommon: base + replication - 1. kIndependent: from a
/// random stream of the base seed named after the point's values and the replication, so that
/// adding points or replications does not change the other seeds.
std::uint64_t seed_of(Seeds seeds, std::uint64_t base, const PointRow& point, int replication);

}  // namespace results::campaign
