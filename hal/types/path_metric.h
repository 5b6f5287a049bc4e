#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal/types/random.h"
#include "hal/types/route.h"

namespace hal {

/// One statistic of the tuple of the routing tables, PathStatistics.
enum class PathStatistic : std::uint8_t { kHops, kDelay, kMinSnr, kEnergy };

inline constexpr std::array kPathStatistics{PathStatistic::kHops, PathStatistic::kDelay,
                                            PathStatistic::kMinSnr, PathStatistic::kEnergy};

/// "hops", "delay", "min_snr", "energy".
std::string_view name(PathStatistic statistic);

/// r(.) of equation 1 (Labella, Dietrich, Dressler, "Hybrid simulation of Sensor and Actor Networks
/// with BARAKA", 2009, section 6.1): a positive number, greater for better paths. It is the product
/// over the statistics of r_s(path)^weight_s, with
///
///   r_hops = 1 / hops   r_delay = 1 / delay [s]   r_energy = 1 / energy [J]
///   r_min_snr = log2(1 + SNR), SNR as a ratio: what the weakest link could carry per hertz
///       (C. E. Shannon, "Communication in the Presence of Noise", 1949)
///
/// so that one statistic with weight 1 is that statistic alone.
struct PathMetric {
  double hops = 1, delay = 0, min_snr = 0, energy = 0;  ///< Weights >= 0, not all 0.
  /// >= 0. H of the paper: stands for r if the next hop is the destination itself; 0: no exception.
  double direct_weight = 1e6;

  double weight(PathStatistic statistic) const;
  void set_weight(PathStatistic statistic, double weight);
  bool operator==(const PathMetric&) const = default;
};

/// That statistic alone.
PathMetric path_metric(PathStatistic statistic, double direct_weight = 1e6);
/// By its name(); none if there is no such statistic.
std::optional<PathStatistic> path_statistic(std::string_view name);

/// r. Finite and above 0 for every path: hops below 1 count as 1, delays below 1 ns and energies
/// below 1e-15 J as those, an SNR beyond +-100 dB as that.
/// @param is_destination  the next hop of the path is its destination.
double path_value(const PathMetric& metric, const PathStatistics& path, bool is_destination);

/// Draws a route with equation 1: P(n) = r(n)^beta / sum over all n' of r(n')^beta. Packets and
/// robots choose their next hop by it.
/// @param routes  of one destination, at least one.   @param beta  >= 1.
/// @param random  one number is drawn from it.
/// @return index into `routes`.
std::size_t draw_route(std::span<const Route> routes, const PathMetric& metric, double beta,
                       RandomStream& random);

}  // namespace hal
