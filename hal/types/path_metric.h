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

/// A member of PathStatistics.
enum class PathStatistic : std::uint8_t {
  kHops,    ///< Number of links.
  kDelay,   ///< Sum of the expected delays of the hops.
  kMinSnr,  ///< SNR of the weakest link.
  kEnergy   ///< Energy to transmit one packet along the path.
};

/// All path statistics.
inline constexpr std::array kPathStatistics{PathStatistic::kHops, PathStatistic::kDelay,
                                            PathStatistic::kMinSnr, PathStatistic::kEnergy};

/// "hops", "delay", "min_snr", "energy".
std::string_view name(PathStatistic statistic);

/// r(.) of equation 1 (Labella, Dietrich, Dressler, "Hybrid simulation of Sensor and Actor Networks
/// with BARAKA", 2009, section 6.1): a positive number, greater for better paths. It is the product
/// over the statistics of r_s(path)^weight_s, with
///
///   r_hops = 1 / hops   r_delay = 1 / delay [s]   r_energy = 1 / energy [J]
///   r_min_snr = log2(1 + SNR), SNR as a ratio: capacity of the weakest link per hertz
///       (C. E. Shannon, "Communication in the Presence of Noise", 1949)
///
/// so that one statistic with weight 1 is that statistic alone.
struct PathMetric {
  double hops = 1,  ///< Weight of r_hops, >= 0. Not all weights are 0.
      delay = 0,    ///< Weight of r_delay, >= 0.
      min_snr = 0,  ///< Weight of r_min_snr, >= 0.
      energy = 0;   ///< Weight of r_energy, >= 0.
  /// >= 0. H of the paper: replaces r if the next hop is the destination itself; 0: no exception.
  double direct_weight = 1e6;

  /// Weight of a statistic: the member with its name.
  double weight(PathStatistic statistic) const;
  /// Sets the weight, >= 0, of a statistic.
  void set_weight(PathStatistic statistic, double weight);
  bool operator==(const PathMetric&) const = default;  ///< Member by member.
};

/// The metric in which this statistic has weight 1 and all others weight 0.
PathMetric path_metric(PathStatistic statistic, double direct_weight = 1e6);
/// The statistic with this name(); nullopt if there is none.
std::optional<PathStatistic> path_statistic(std::string_view name);

/// r(.) of equation 1. Finite and above 0 for every path: hops are at least 1, delays at least
/// 1 ns, energies at least 1e-15 J, and the SNR is limited to +-100 dB.
/// @param is_destination  the next hop of the path is its destination.
double path_value(const PathMetric& metric, const PathStatistics& path, bool is_destination);

/// Draws a route by equation 1 of the same paper: P(n) = r(n)^beta / sum over all n' of r(n')^beta.
/// Packets and robots choose their next hop by it.
/// @param routes  of one destination, at least one.   @param beta  >= 1.
/// @param random  one number is drawn from it.
/// @return index into `routes`.
std::size_t draw_route(std::span<const Route> routes, const PathMetric& metric, double beta,
                       RandomStream& random);

}  // namespace hal
