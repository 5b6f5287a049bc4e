#include "sim/maps/rectangles.h"

#include <gtest/gtest.h>

#include <string>

#include "hal/types/random.h"

namespace sim::maps::test {
namespace {

/// @param rows  the uppermost first; '#' is solid
SolidCells drawing(const std::vector<std::string>& rows) {
  SolidCells cells{rows.front().size(), rows.size(), {}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char c : *row) cells.solid.push_back(c == '#' ? 1 : 0);
  return cells;
}

SolidCells noise(std::size_t width, std::size_t height, double share, hal::RandomStream& random) {
  SolidCells cells{width, height, {}};
  for (std::size_t i = 0; i < width * height; ++i)
    cells.solid.push_back(random.uniform() < share ? 1 : 0);
  return cells;
}

/// How often each cell is covered.
std::vector<int> cover(const SolidCells& cells, const std::vector<CellRectangle>& pieces) {
  std::vector<int> times(cells.solid.size());
  for (const CellRectangle& piece : pieces)
    for (std::size_t y = piece.y; y < piece.y + piece.height; ++y)
      for (std::size_t x = piece.x; x < piece.x + piece.width; ++x) ++times.at(y * cells.width + x);
  return times;
}

/// Rectangles of equal stretches in rows above each other: what cuts along x alone give.
std::size_t merged_rows(const SolidCells& cells) {
  const auto solid = [&](std::size_t x, std::size_t y) {
    return x < cells.width && y < cells.height && cells.solid[y * cells.width + x] != 0;
  };
  std::size_t count = 0;
  for (std::size_t y = 0; y < cells.height; ++y) {
    for (std::size_t x = 0; x < cells.width; ++x) {
      if (!solid(x, y) || (x > 0 && solid(x - 1, y))) continue;
      bool is_same = y > 0 && !(x > 0 && solid(x - 1, y - 1));
      std::size_t end = x;
      for (; solid(end, y); ++end) is_same = is_same && solid(end, y - 1);
      if (!is_same || solid(end, y - 1)) ++count;
    }
  }
  return count;
}

SolidCells transposed(const SolidCells& cells) {
  SolidCells result{cells.height, cells.width, std::vector<std::uint8_t>(cells.solid.size())};
  for (std::size_t y = 0; y < cells.height; ++y)
    for (std::size_t x = 0; x < cells.width; ++x)
      result.solid[x * cells.height + y] = cells.solid[y * cells.width + x];
  return result;
}

TEST(Rectangles, OfSimpleFiguresAreTheFewestPossible) {
  EXPECT_EQ(rectangles(drawing({"...", "..."})).size(), 0U);
  EXPECT_EQ(rectangles(drawing({"###", "###"})), (std::vector<CellRectangle>{{0, 0, 3, 2}}));
  EXPECT_EQ(rectangles(drawing({"#..", "###"})).size(), 2U);
  EXPECT_EQ(rectangles(drawing({".#.", "###", ".#."})).size(), 3U);
  EXPECT_EQ(rectangles(drawing({"#####", "#...#", "#...#", "#####"})).size(), 4U);
  EXPECT_EQ(rectangles(drawing({"#.", ".#"})).size(), 2U);
  // a comb lying and standing: one for the back and one for each tooth
  EXPECT_EQ(rectangles(drawing({"#.#.#", "#####"})).size(), 4U);
  EXPECT_EQ(rectangles(transposed(drawing({"#.#.#", "#####"}))).size(), 4U);
}

TEST(Rectangles, RoughSidesOfWallsCostOneEach) {
  // A wall along x and one along y with three bumps each: cuts along x alone would make 2 of each
  // bump on the upright wall.
  const SolidCells walls =
      drawing({"..#..#..#.#.", "############", ".........#..", ".........##.", ".........#..",
               ".........##.", ".........#..", ".........##.", ".........#.."});
  EXPECT_EQ(rectangles(walls).size(), 2U + 4U + 3U);
  EXPECT_EQ(merged_rows(walls), 1U + 4U + 7U);
}

TEST(Rectangles, CoverEachSolidCellOnceAndNothingElse) {
  hal::RandomStream random(1, "noise");
  for (int k = 0; k < 300; ++k) {
    const auto side = [&] { return static_cast<std::size_t>(1 + 30 * random.uniform()); };
    const SolidCells cells = noise(side(), side(), random.uniform(), random);
    const std::vector<CellRectangle> pieces = rectangles(cells);
    EXPECT_EQ(cover(cells, pieces), std::vector<int>(cells.solid.begin(), cells.solid.end()));
    EXPECT_EQ(rectangles(cells), pieces);
  }
}

TEST(Rectangles, AreNoMoreThanMergedRowsOrColumns) {
  hal::RandomStream random(2, "noise");
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const SolidCells cells = noise(200, 200, share, random);
    const std::size_t count = rectangles(cells).size();
    EXPECT_LE(count, merged_rows(cells));
    EXPECT_LE(count, merged_rows(transposed(cells)));
  }
}

/// The fewest rectangles by trying all: each choice for the first cell that is left.
std::size_t fewest(SolidCells cells, std::size_t most) {
  const auto first = std::find(cells.solid.begin(), cells.solid.end(), 1);
  if (first == cells.solid.end()) return 0;
  if (most == 0) return 1;
  const auto at = static_cast<std::size_t>(first - cells.solid.begin());
  const std::size_t x = at % cells.width, y = at / cells.width;
  std::size_t best = most + 1;
  for (std::size_t right = x; right < cells.width && cells.solid[y * cells.width + right];
       ++right) {
    SolidCells left = cells;
    for (std::size_t top = y; top < cells.height; ++top) {
      const auto row = left.solid.begin() + static_cast<std::ptrdiff_t>(top * cells.width);
      if (std::find(row + static_cast<std::ptrdiff_t>(x),
                    row + static_cast<std::ptrdiff_t>(right + 1),
                    0) != row + static_cast<std::ptrdiff_t>(right + 1))
        break;
      std::fill(row + static_cast<std::ptrdiff_t>(x), row + static_cast<std::ptrdiff_t>(right + 1),
                std::uint8_t{0});
      if (best > 1) best = std::min(best, 1 + fewest(left, best - 2));
    }
  }
  return best;
}

TEST(Rectangles, AreTheFewestPossible) {
  hal::RandomStream random(4, "noise");
  for (int k = 0; k < 500; ++k) {
    const SolidCells cells = noise(6, 5, 0.5 + 0.5 * random.uniform(), random);
    const std::size_t count = rectangles(cells).size();
    EXPECT_EQ(fewest(cells, count), count);
  }
}

TEST(Specks, AreDroppedBySizeAndTouchAtCorners) {
  SolidCells cells =
      drawing({"#...##...#..", ".........#..", "..#.......#.", "...#.....#..", "............"});
  EXPECT_EQ(drop_specks(cells, 1), 0U);  // nothing is shorter than a cell
  EXPECT_EQ(drop_specks(cells, 2), 1U);
  EXPECT_EQ(cells.solid, drawing({"....##...#..", ".........#..", "..#.......#.", "...#.....#..",
                                  "............"})
                             .solid);
  EXPECT_EQ(drop_specks(cells, 3), 2U);  // two side by side, two at a corner; not four in a row
  EXPECT_EQ(cells.solid, drawing({".........#..", ".........#..", "..........#.", ".........#..",
                                  "............"})
                             .solid);
}

TEST(Specks, AreWhatAFloodFillFinds) {
  hal::RandomStream random(3, "noise");
  for (int k = 0; k < 100; ++k) {
    const SolidCells before = noise(25, 20, 0.25, random);
    SolidCells after = before;
    drop_specks(after, 4);
    std::vector<int> seen(before.solid.size());
    for (std::size_t start = 0; start < seen.size(); ++start) {
      if (before.solid[start] == 0 || seen[start] != 0) continue;
      std::vector<std::size_t> group{start};
      seen[start] = 1;
      std::size_t left = 25, right = 0, low = 20, high = 0;
      for (std::size_t i = 0; i < group.size(); ++i) {
        const std::size_t x = group[i] % 25, y = group[i] / 25;
        left = std::min(left, x), right = std::max(right, x);
        low = std::min(low, y), high = std::max(high, y);
        for (std::size_t v = y == 0 ? 0 : y - 1; v <= std::min<std::size_t>(y + 1, 19); ++v) {
          for (std::size_t u = x == 0 ? 0 : x - 1; u <= std::min<std::size_t>(x + 1, 24); ++u) {
            const std::size_t next = v * 25 + u;
            if (before.solid[next] == 0 || seen[next] != 0) continue;
            seen[next] = 1;
            group.push_back(next);
          }
        }
      }
      const bool is_speck = right - left + 1 < 4 && high - low + 1 < 4;
      for (const std::size_t cell : group) EXPECT_EQ(after.solid[cell], is_speck ? 0 : 1);
    }
  }
}

}  // namespace
}  // namespace sim::maps::test
