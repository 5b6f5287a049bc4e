#include "results/campaign/latin_hypercube.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "hal/files/config/errors.h"
#include "hal/files/config/value.h"
#include "hal/types/math.h"
#include "hal/types/random.h"

namespace results::campaign {
namespace {

/// 0 .. count-1 in random order (Fisher-Yates shuffle as by R. Durstenfeld, "Algorithm 235: Random
/// permutation", CACM 7(7), 1964).
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
    const std::size_t count = range.choices.size();
    // A share just below 1 may be rounded up to 1.
    const auto part = static_cast<std::size_t>(share * static_cast<double>(count));
    const auto& chosen = range.choices[std::min(part, count - 1)];
    return {range.key, chosen.text, chosen.yaml, chosen.place};
  }
  const double number = number_at(range, share);
  std::string text = range.whole ? fmt::format("{:.0f}", number) : fmt::format("{:.6g}", number);
  if (range.unit != "1") text += " " + range.unit;
  return {range.key, text, text, range.place};
}

/// Refuses equal points: their runs could not be told apart.
/// @throws hal::files::config::ConfigErrors
void refuse_equal(const std::vector<DesignPoint>& points) {
  std::map<std::vector<std::string>, std::size_t> numbers;
  for (const DesignPoint& point : points) {
    std::vector<std::string> texts;
    for (const FactorValue& value : point) texts.push_back(value.text);
    const std::size_t number = numbers.size() + 1;
    const auto [first, is_new] = numbers.emplace(std::move(texts), number);
    if (is_new) continue;
    throw hal::files::config::ConfigErrors(
        {fmt::format("{}: sample: point {} is the same as point {}: fewer points, or finer ranges",
                     point.front().place, number, first->second)});
  }
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
  std::vector<DesignPoint> points = latin_hypercube(campaign.ranges, campaign.samples, seed);
  refuse_equal(points);
  return points;
}

}  // namespace results::campaign
