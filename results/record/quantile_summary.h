#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace results::record {

/// Quantiles of a stream of numbers in bounded memory. Up to kExact numbers they are exact, of type
/// 7 (Hyndman and Fan, 1996; see scalar_kinds.cpp). Beyond that, the rank of each quantile is wrong
/// by at most kError times the count: M. Greenwald and S. Khanna, "Space-Efficient Online
/// Computation of Quantile Summaries", SIGMOD 2001. No random numbers are used: equal numbers in
/// equal order give equal quantiles.
class QuantileSummary {
 public:
  static constexpr std::size_t kExact = 10'000;
  static constexpr double kError = 1e-3;  ///< Greatest error of a rank, as a share of the count.

  /// @param value  finite.
  void add(double value);

  std::uint64_t count() const { return merged_ + fresh_.size(); }
  double error() const { return entries_.empty() ? 0 : kError; }

  /// @param p  0 .. 1. @pre count() > 0.
  double quantile(double p);

 private:
  /// `value` stands for `covered` numbers: itself and those between it and the entry before. Its
  /// rank is at least the sum of `covered` up to this entry, and at most that plus `slack`.
  struct Entry {
    double value = 0;
    std::uint64_t covered = 0;
    std::uint64_t slack = 0;
  };

  void merge();
  void compress();
  double exact(double p);
  double estimate(double p) const;

  std::vector<double> fresh_;  ///< Not merged into entries_ yet.
  std::vector<Entry> entries_;
  std::uint64_t merged_ = 0;
};

}  // namespace results::record
