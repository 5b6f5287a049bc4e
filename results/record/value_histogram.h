#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "results/record/scalars.h"

namespace results::record {

/// A histogram with bins of equal width.
class ValueHistogram {
 public:
  /// Number of values after which an automatic range is chosen. Until then the values are kept.
  static constexpr std::size_t kKept = 1000;

  /// @param bins  at least 2; with an automatic range rounded up to an even number.
  /// @param range  lower bound (inclusive) and upper bound (exclusive); values outside are counted
  /// as below or above. None: automatic, the range of the first kKept values; for a later value
  /// outside, pairs of bins are joined, so that the width doubles, until the value is inside.
  ValueHistogram(std::size_t bins, std::optional<std::pair<double, double>> range);

  /// @param value  finite.
  void add(double value);

  /// Sorted by lower bound. The bins below and above the range are there only if they are not
  /// empty.
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
