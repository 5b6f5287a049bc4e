#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace results::record {

/// Quantiles of a stream of numbers in bounded memory: exact up to kExact of them, of type 7;
/// above, each p-quantile is a value whose rank is wrong by at most kError of their number, by M.
/// Greenwald and S. Khanna, "Space-Efficient Online Computation of Quantile Summaries", SIGMOD
/// 2001. Nothing is drawn: equal numbers in equal order give equal quantiles.
class QuantileSummary {
 public:
  static constexpr std::size_t kExact = 10'000;
  static constexpr double kError = 1e-3;  ///< Of the rank, as a share.

  /// @param value  finite.
  void add(double value);

  std::uint64_t count() const { return merged_ + fresh_.size(); }
  double error() const { return entries_.empty() ? 0 : kError; }

  /// @param p  0 .. 1. @pre count() > 0.
  double quantile(double p);

 private:
  /// `value` stands for `covered` values: it and those between it and the entry before. Its rank is
  /// that of the first of them at least, and at most `slack` more than that of the last.
  struct Entry {
    double value = 0;
    std::uint64_t covered = 0;
    std::uint64_t slack = 0;
  };

  void merge();
  void compress();
  double exact(double p);
  double estimate(double p) const;

  std::vector<double> fresh_;  ///< Not merged yet.
  std::vector<Entry> entries_;
  std::uint64_t merged_ = 0;
};

}  // namespace results::record
