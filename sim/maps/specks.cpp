#include <algorithm>

#include "sim/maps/rectangles.h"

namespace sim::maps {
namespace {

/// Solid cells side by side in one row.
struct Stretch {
  std::uint32_t row = 0, from = 0, to = 0;  ///< `to`: the cell behind the last.
};

/// A group of stretches that touch each other; the one with index `parent` stands for it.
struct Cluster {
  std::uint32_t parent = 0;
  std::uint32_t left = 0, right = 0, low = 0, high = 0;  ///< `right`, `high`: behind the last.

  bool is_shorter_than(double cells) const {
    return static_cast<double>(right - left) < cells && static_cast<double>(high - low) < cells;
  }
};

/// Finds groups by their stretches (R. Sedgewick, K. Wayne, "Algorithms", 4th ed. 2011, 1.5).
class Clusters {
 public:
  explicit Clusters(const SolidCells& cells) {
    std::size_t before = 0;  // the first stretch of the row before
    for (std::size_t y = 0; y < cells.height; ++y) {
      const std::size_t first = stretches_.size();
      add_row(cells, y);
      join_rows(before, first);
      before = first;
    }
  }

  std::size_t drop(SolidCells& cells, double shortest) {
    std::size_t dropped = 0;
    for (std::uint32_t i = 0; i < stretches_.size(); ++i) {
      if (!clusters_[root(i)].is_shorter_than(shortest)) continue;
      if (root(i) == i) ++dropped;
      const auto row =
          cells.solid.begin() + static_cast<std::ptrdiff_t>(stretches_[i].row * cells.width);
      std::fill(row + stretches_[i].from, row + stretches_[i].to, std::uint8_t{0});
    }
    return dropped;
  }

 private:
  void add_row(const SolidCells& cells, std::size_t y) {
    const std::uint8_t* const row = &cells.solid[y * cells.width];
    const auto number = static_cast<std::uint32_t>(y);
    for (std::size_t x = 0; x < cells.width; ++x) {
      if (row[x] == 0) continue;
      const auto from = static_cast<std::uint32_t>(x);
      while (x < cells.width && row[x] != 0) ++x;
      const auto to = static_cast<std::uint32_t>(x);
      clusters_.push_back(
          {static_cast<std::uint32_t>(stretches_.size()), from, to, number, number + 1});
      stretches_.push_back({number, from, to});
    }
  }

  /// Joins what touches, at corners too. @param first  of the upper row
  void join_rows(std::size_t before, std::size_t first) {
    std::size_t lower = before;
    for (std::size_t upper = first; upper < stretches_.size(); ++upper) {
      while (lower < first && stretches_[lower].to < stretches_[upper].from) ++lower;
      for (std::size_t i = lower; i < first && stretches_[i].from <= stretches_[upper].to; ++i)
        join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(upper));
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    Cluster& kept = clusters_[a];
    const Cluster& other = clusters_[b];
    kept.left = std::min(kept.left, other.left);
    kept.right = std::max(kept.right, other.right);
    kept.low = std::min(kept.low, other.low);
    kept.high = std::max(kept.high, other.high);
    clusters_[b].parent = a;
  }

  std::uint32_t root(std::uint32_t i) {
    while (clusters_[i].parent != i)
      i = clusters_[i].parent = clusters_[clusters_[i].parent].parent;
    return i;
  }

  std::vector<Stretch> stretches_;
  std::vector<Cluster> clusters_;
};

}  // namespace

std::size_t drop_specks(SolidCells& cells, double shortest) {
  if (shortest <= 1) return 0;
  return Clusters(cells).drop(cells, shortest);
}

}  // namespace sim::maps
