#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "results/record/scalars.h"

namespace results::record {

/// How often a value was where, in bins of one width.
class ValueHistogram {
 public:
  /// Numbers after which an automatic range is chosen. Until then they are kept.
  static constexpr std::size_t kKept = 1000;

  /// @param bins  at least 2; with an automatic range rounded up to an even number.
  /// @param range  from, and below; values outside are counted as below and above it. None:
  ///   automatic: that of the first kKept values; later ones outside double the width of the bins,
  ///   two becoming one, until they are inside.
  ValueHistogram(std::size_t bins, std::optional<std::pair<double, double>> range);

  /// @param value  finite.
  void add(double value);

  /// By lower bound; below and above the range only if there are any.
  std::vector<Bins::Bin> bins();

 private:
  void choose_range();
  void count(double value);
  void widen_down();
  void widen_up();

  bool is_automatic_;
  bool has_range_ = false;
  double low_ = 0, width_ = 0;
  std::vector<double> kept_;
  std::vector<std::uint64_t> counts_;
  std::uint64_t below_ = 0, above_ = 0;
};

}  // namespace results::record
