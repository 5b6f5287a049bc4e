#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace results::report {

/// Numbers of times in bins of equal width on a logarithmic scale. Zeros, which such a scale lacks,
/// and times beyond its ends are counted separately.
struct LogHistogram {
  static constexpr int kBins = 40;
  static constexpr double kLow = 1e-4;  ///< s, lower edge of the first bin.
  static constexpr double kHigh = 1e2;  ///< s, upper edge of the last bin, included in it.

  std::array<std::uint64_t, kBins> bins{};
  std::uint64_t zeros = 0;
  std::uint64_t below = 0;  ///< Above 0 and below kLow.
  std::uint64_t above = 0;  ///< Above kHigh.
};

/// @param times  s, each >= 0.
LogHistogram log_histogram(const std::vector<double>& times);

}  // namespace results::report
