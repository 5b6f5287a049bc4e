#include "sim/maps/rectangles.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hal/types/check.h"
#include "sim/maps/independent_set.h"

namespace sim::maps {
namespace {

/// Flags of a cell.
enum : std::uint8_t { kSolid = 1, kCutRight = 2, kCutAbove = 4, kDone = 8 };

/// A cut between two concave corners, from the lower left one; corners are numbered as the cells to
/// their upper right.
struct Chord {
  std::uint32_t x = 0, y = 0, length = 0;
};

/// Beyond this number the chords along x are taken, all of them, as finding the largest set could
/// take minutes. Floors have some thousands, noise has more.
constexpr std::size_t kMostConflicts = 1'000'000;

/// The cells with an empty border around them, and the cuts.
class Partition {
 public:
  explicit Partition(const SolidCells& cells)
      : width_(cells.width + 2),
        height_(cells.height + 2),
        flags_(width_ * height_, std::uint8_t{0}) {
    for (std::size_t y = 0; y < cells.height; ++y)
      for (std::size_t x = 0; x < cells.width; ++x)
        flags_[(y + 1) * width_ + x + 1] = cells.solid[y * cells.width + x] != 0 ? kSolid : 0;
  }

  void cut() {
    const std::vector<Chord> level = level_chords();
    const std::vector<Chord> upright = upright_chords();
    const Chosen chosen = choose(level, upright);
    for (std::size_t i = 0; i < level.size(); ++i)
      if (chosen.left[i]) take(level[i], 1, 0);
    for (std::size_t i = 0; i < upright.size(); ++i)
      if (chosen.right[i]) take(upright[i], 0, 1);
    for (std::size_t y = 1; y < height_; ++y)
      for (std::size_t x = 1; x < width_; ++x)
        if (is_concave(x, y) && !has_level_cut(x, y) && !has_upright_cut(x, y)) cut_level(x, y);
  }

  std::vector<CellRectangle> pieces() {
    std::vector<CellRectangle> found;
    for (std::size_t y = 1; y + 1 < height_; ++y)
      for (std::size_t x = 1; x + 1 < width_; ++x)
        if ((at(x, y) & (kSolid | kDone)) == kSolid) found.push_back(piece(x, y));
    return found;
  }

 private:
  std::uint8_t& at(std::size_t x, std::size_t y) { return flags_[y * width_ + x]; }
  bool is_solid(std::size_t x, std::size_t y) { return (at(x, y) & kSolid) != 0; }

  /// Of a corner: three of the four cells around it are solid.
  bool is_concave(std::size_t x, std::size_t y) {
    const std::uint8_t* const above = &flags_[y * width_ + x];
    const std::uint8_t* const below = above - width_;
    return (above[0] & kSolid) + (above[-1] & kSolid) + (below[0] & kSolid) +
               (below[-1] & kSolid) ==
           3;
  }
  /// Whether the edge from a corner to the next one on its right is between solid cells.
  bool is_inner_level(std::size_t x, std::size_t y) { return is_solid(x, y) && is_solid(x, y - 1); }
  bool is_inner_upright(std::size_t x, std::size_t y) {
    return is_solid(x, y) && is_solid(x - 1, y);
  }
  bool has_level_cut(std::size_t x, std::size_t y) {
    return ((at(x, y - 1) | at(x - 1, y - 1)) & kCutAbove) != 0;
  }
  bool has_upright_cut(std::size_t x, std::size_t y) {
    return ((at(x - 1, y) | at(x - 1, y - 1)) & kCutRight) != 0;
  }

  /// Ordered by row.
  std::vector<Chord> level_chords() {
    std::vector<Chord> chords;
    for (std::size_t y = 1; y < height_; ++y) {
      std::size_t from = 0;  // 0: none
      for (std::size_t x = 1; x < width_; ++x) {
        const bool is_end = is_concave(x, y);
        if (is_end && from != 0) chords.push_back(chord(from, y, x - from));
        if (is_end) from = x;
        if (!is_inner_level(x, y)) from = 0;
      }
    }
    return chords;
  }
  /// Ordered by upper end, in the order of memory: `from` is that of each column.
  std::vector<Chord> upright_chords() {
    std::vector<Chord> chords;
    std::vector<std::size_t> from(width_, 0);
    for (std::size_t y = 1; y < height_; ++y) {
      for (std::size_t x = 1; x < width_; ++x) {
        const bool is_end = is_concave(x, y);
        if (is_end && from[x] != 0) chords.push_back(chord(x, from[x], y - from[x]));
        if (is_end) from[x] = y;
        if (!is_inner_upright(x, y)) from[x] = 0;
      }
    }
    return chords;
  }
  static Chord chord(std::size_t x, std::size_t y, std::size_t length) {
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
            static_cast<std::uint32_t>(length)};
  }

  /// The largest set of chords that do not meet.
  Chosen choose(const std::vector<Chord>& level, const std::vector<Chord>& upright) const {
    const Conflicts conflicts{level.size(), upright.size(), meetings(level, upright)};
    if (conflicts.pairs.size() <= kMostConflicts) return independent_set(conflicts);
    return {std::vector<bool>(level.size(), true), std::vector<bool>(upright.size(), false)};
  }

  /// Level and upright chords that meet, up to one more than kMostConflicts. Sweeps upwards;
  /// through a corner goes at most one upright chord.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings(
      const std::vector<Chord>& level, const std::vector<Chord>& upright) const {
    std::vector<std::uint32_t> by_lower_end(upright.size());
    std::iota(by_lower_end.begin(), by_lower_end.end(), 0U);
    std::ranges::stable_sort(by_lower_end, {}, [&](std::uint32_t i) { return upright[i].y; });
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> last(width_, kNone);  // by column: the last one that began
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    std::size_t begun = 0;
    for (std::uint32_t i = 0; i < level.size() && found.size() <= kMostConflicts; ++i) {
      const auto& [x, y, length] = level[i];
      for (; begun < upright.size() && upright[by_lower_end[begun]].y <= y; ++begun)
        last[upright[by_lower_end[begun]].x] = by_lower_end[begun];
      for (std::uint32_t at = x; at <= x + length; ++at) {
        const std::uint32_t one = last[at];
        if (one != kNone && y <= upright[one].y + upright[one].length) found.emplace_back(i, one);
      }
    }
    return found;
  }

  void take(const Chord& chord, std::uint32_t along_x, std::uint32_t along_y) {
    for (std::uint32_t i = 0; i < chord.length; ++i) {
      std::uint8_t& cell = at(chord.x + along_x * i - along_y, chord.y + along_y * i - along_x);
      cell |= along_x != 0 ? kCutAbove : kCutRight;
    }
  }

  /// From a concave corner to the outline or to a cut across.
  void cut_level(std::size_t x, std::size_t y) {
    if (is_inner_level(x, y)) {
      do at(x++, y - 1) |= kCutAbove;
      while (is_inner_level(x, y) && !has_upright_cut(x, y));
    } else {
      do at(--x, y - 1) |= kCutAbove;
      while (is_inner_level(x - 1, y) && !has_upright_cut(x, y));
    }
  }

  CellRectangle piece(std::size_t x, std::size_t y) {
    CellRectangle piece{x - 1, y - 1, 1, 1};
    while ((at(x + piece.width - 1, y) & kCutRight) == 0 && is_solid(x + piece.width, y))
      ++piece.width;
    while ((at(x, y + piece.height - 1) & kCutAbove) == 0 && is_solid(x, y + piece.height))
      ++piece.height;
    for (std::size_t row = y; row < y + piece.height; ++row) {
      for (std::size_t column = x; column < x + piece.width; ++column) {
        std::uint8_t& cell = at(column, row);
        BARAKA_CHECK((cell & (kSolid | kDone)) == kSolid);
        cell |= kDone;
      }
    }
    return piece;
  }

  std::size_t width_, height_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace

std::vector<CellRectangle> rectangles(const SolidCells& cells) {
  Partition partition(cells);
  partition.cut();
  return partition.pieces();
}

}  // namespace sim::maps
