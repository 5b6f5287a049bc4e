#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "results/coverage/coverage.h"

namespace results::coverage {

/// What a map of coverage shows.
enum class Layer { kRssi, kSnr, kBest, kRate };

struct NamedLayer {
  std::string_view name;
  Layer layer;
};
inline constexpr NamedLayer kLayers[] = {
    {"rssi", Layer::kRssi}, {"snr", Layer::kSnr}, {"best", Layer::kBest}, {"rate", Layer::kRate}};

/// The classes of values of a layer, each with a colour; spots that are not covered have none.
struct Classes {
  struct One {
    std::string label;   ///< "-70 to -65 dBm"
    std::string colour;  ///< "#rrggbb"
  };
  std::string title;  ///< "RSSI"
  std::vector<One> all;
  /// Index of the class of a spot; all.size(): not covered.
  std::function<std::size_t(const Spot&)> of;
};

/// Colours from dark to light that differ in luminance: S. van der Walt, N. Smith, "viridis", 2015,
/// by linear interpolation between nine of its colours. Of the best transmitter: report::colour_of.
Classes classes_of(const Coverage& map, Layer layer);

/// Share of all spots in each class, and last of those that are not covered.
std::vector<double> shares_of(const Coverage& map, const Classes& classes);

}  // namespace results::coverage
