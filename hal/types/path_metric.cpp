#include "hal/types/path_metric.h"

#include <algorithm>

#include "hal/types/check.h"
#include "hal/types/enum_names.h"
#include "hal/types/math.h"

namespace hal {
namespace {

constexpr double kLeastEnergy = 1e-15;  // J
constexpr double kMostSnr = 100;        // dB, either way
/// Upper bound of one factor; the lower bound is its inverse. Keeps the product of all factors
/// within the range of a double, whatever the weights.
constexpr double kMostFactor = 1e75;

constexpr std::string_view name_of(PathStatistic statistic) {
  switch (statistic) {
    case PathStatistic::kHops:
      return "hops";
    case PathStatistic::kDelay:
      return "delay";
    case PathStatistic::kMinSnr:
      return "min_snr";
    case PathStatistic::kEnergy:
      return "energy";
  }
  return {};
}
static_assert(names_exactly<PathStatistic, int{kPathStatistics.size()}>([](PathStatistic s) {
  return name_of(s);
}));

constexpr double PathMetric::*weight_of(PathStatistic statistic) {
  switch (statistic) {
    case PathStatistic::kHops:
      return &PathMetric::hops;
    case PathStatistic::kDelay:
      return &PathMetric::delay;
    case PathStatistic::kMinSnr:
      return &PathMetric::min_snr;
    case PathStatistic::kEnergy:
      return &PathMetric::energy;
  }
  BARAKA_CHECK(false);
}

/// Shannon capacity per bandwidth [bit/s per Hz] of a channel with this signal-to-noise ratio.
double capacity(double snr_db) {
  const double snr = math::pow(10.0, std::clamp(snr_db, -kMostSnr, kMostSnr) / 10);
  return math::log(1 + snr) / math::log(2.0);
}

double value(PathStatistic statistic, const PathStatistics& path) {
  switch (statistic) {
    case PathStatistic::kHops:
      return 1.0 / std::max<int>(1, path.hops);
    case PathStatistic::kDelay:
      return 1.0 / to_seconds(std::max(Duration{1}, path.delay));
    case PathStatistic::kMinSnr:
      return capacity(path.min_snr_db);
    case PathStatistic::kEnergy:
      return 1.0 / std::max(kLeastEnergy, path.energy);
  }
  return 1;
}

/// Unnormalised probabilities, relative to the best route so that no power overflows.
std::vector<double> relative_weights(std::span<const Route> routes, const PathMetric& metric,
                                     double beta) {
  std::vector<double> result;
  result.reserve(routes.size());
  for (const Route& route : routes) {
    result.push_back(path_value(metric, route.path, route.next_hop == route.destination));
  }
  const double best = *std::ranges::max_element(result);
  for (double& weight : result) weight = math::pow(weight / best, beta);
  return result;
}

}  // namespace

std::string_view name(PathStatistic statistic) { return name_of(statistic); }

std::optional<PathStatistic> path_statistic(std::string_view name) {
  const auto* const found =
      std::ranges::find(kPathStatistics, name, [](PathStatistic s) { return name_of(s); });
  return found == kPathStatistics.end() ? std::nullopt : std::optional(*found);
}

double PathMetric::weight(PathStatistic statistic) const { return this->*weight_of(statistic); }

void PathMetric::set_weight(PathStatistic statistic, double weight) {
  this->*weight_of(statistic) = weight;
}

PathMetric path_metric(PathStatistic statistic, double direct_weight) {
  PathMetric metric{.hops = 0, .direct_weight = direct_weight};
  metric.set_weight(statistic, 1);
  return metric;
}

double path_value(const PathMetric& metric, const PathStatistics& path, bool is_destination) {
  if (is_destination && metric.direct_weight > 0) return metric.direct_weight;
  double product = 1;
  for (const PathStatistic statistic : kPathStatistics) {
    const double weight = metric.weight(statistic);
    if (weight == 0) continue;
    const double r = value(statistic, path);
    const double factor = weight == 1 ? r : math::pow(r, weight);
    product *= std::clamp(factor, 1 / kMostFactor, kMostFactor);
  }
  return product;
}

std::size_t draw_route(std::span<const Route> routes, const PathMetric& metric, double beta,
                       RandomStream& random) {
  BARAKA_CHECK(!routes.empty());
  const std::vector<double> weights = relative_weights(routes, metric, beta);
  double total = 0;
  for (const double weight : weights) total += weight;
  double left = random.uniform() * total;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    left -= weights[i];
    if (left < 0) return i;
  }
  return weights.size() - 1;  // rounding left a remainder
}

}  // namespace hal
