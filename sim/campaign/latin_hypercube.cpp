#include "sim/campaign/latin_hypercube.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hal/config/value.h"
#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::campaign {
namespace {

/// 0 .. count-1 in random order (Fisher and Yates, by Durstenfeld, CACM 7(7), 1964).
std::vector<std::uint32_t> permutation(std::uint32_t count, hal::RandomStream& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  for (std::uint32_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

/// @param share  in [0, 1).
double number_at(const SampledRange& range, double share) {
  if (range.whole) {
    const double first = std::ceil(range.from), last = std::floor(range.to);
    return std::min(last, first + std::floor(share * (last - first + 1)));
  }
  if (range.logarithmic) {
    const double low = hal::math::log(range.from), high = hal::math::log(range.to);
    return hal::math::exp(low + share * (high - low));
  }
  return range.from + share * (range.to - range.from);
}

FactorValue value_at(const SampledRange& range, double share) {
  if (!range.choices.empty()) {
    const auto count = static_cast<double>(range.choices.size());
    const auto& chosen = range.choices[static_cast<std::size_t>(share * count)];
    return {range.key, chosen.text, chosen.yaml, chosen.place};
  }
  const double number = number_at(range, share);
  std::string text = range.whole ? fmt::format("{:.0f}", number) : fmt::format("{:.6g}", number);
  if (range.unit != "1") text += " " + range.unit;
  return {range.key, text, text, range.place};
}

}  // namespace

std::vector<DesignPoint> latin_hypercube(const std::vector<SampledRange>& ranges, int samples,
                                         std::uint64_t seed) {
  std::vector<DesignPoint> points(static_cast<std::size_t>(samples));
  for (const SampledRange& range : ranges) {
    hal::RandomStream random(seed, "campaign/latin_hypercube/" + range.key);
    const auto parts = permutation(static_cast<std::uint32_t>(samples), random);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].push_back(value_at(range, (parts[i] + random.uniform()) / samples));
    }
  }
  return points;
}

std::vector<DesignPoint> points_of(const CampaignFile& campaign, std::uint64_t seed) {
  if (campaign.design != Design::kLatinHypercube) return campaign.points;
  return latin_hypercube(campaign.ranges, campaign.samples, seed);
}

}  // namespace sim::campaign
