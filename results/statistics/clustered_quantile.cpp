#include "results/statistics/clustered_quantile.h"

#include <algorithm>
#include <vector>

#include "results/statistics/quantile.h"

namespace results::statistics {
namespace {

using Clusters = std::span<const std::span<const double>>;

std::vector<double> sorted_together(Clusters clusters) {
  std::vector<double> all;
  for (const auto& cluster : clusters) all.insert(all.end(), cluster.begin(), cluster.end());
  std::ranges::sort(all);
  return all;
}

double share_up_to(std::span<const double> sorted, double limit) {
  const auto above = std::ranges::upper_bound(sorted, limit);
  return static_cast<double>(above - sorted.begin()) / static_cast<double>(sorted.size());
}

/// Values with the mean p whose variance is that of the share up to a limit.
std::vector<double> linearised_shares(Clusters clusters, std::span<const double> all, double limit,
                                      double p) {
  std::vector<double> values;
  const double mean = share_up_to(all, limit);
  for (const auto& cluster : clusters) {
    if (cluster.empty()) continue;
    const double weight = static_cast<double>(cluster.size()) / static_cast<double>(all.size());
    values.push_back(weight * (share_up_to(cluster, limit) - mean));
  }
  for (double& value : values) value = p + static_cast<double>(values.size()) * value;
  return values;
}

}  // namespace

std::optional<ClusteredQuantile> clustered_quantile(Clusters clusters, double p, double level) {
  const std::vector<double> all = sorted_together(clusters);
  if (all.empty()) return std::nullopt;
  ClusteredQuantile found;
  found.value = quantile_of_sorted(all, p);
  const std::vector<double> shares = linearised_shares(clusters, all, found.value, p);
  found.clusters = shares.size();
  const Support support{Support::Kind::kShare, static_cast<double>(all.size())};
  if (const auto order = mean_interval(shares, support, level)) {
    const auto at = [&all](double share) {
      return quantile_of_sorted(all, std::clamp(share, 0.0, 1.0));
    };
    found.interval = Interval{at(order->low), at(order->high)};
  }
  return found;
}

}  // namespace results::statistics
