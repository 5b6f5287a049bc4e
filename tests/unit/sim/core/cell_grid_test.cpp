#include "sim/core/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hal/types/random.h"

namespace sim {
namespace {

/// 200 members at random places, half of which are moved once.
class CellGridTest : public testing::Test {
 protected:
  CellGridTest() {
    hal::RandomStream random(1, "places");
    const auto anywhere = [&random] {
      return hal::Vec2{20 * random.uniform() - 10, 20 * random.uniform() - 10};
    };
    for (CellGrid::Member i = 0; i < 200; ++i) places_.push_back(anywhere());
    for (CellGrid::Member i = 0; i < 200; ++i) grid_.put(i, places_[i]);
    for (CellGrid::Member i = 0; i < 200; i += 2) grid_.put(i, places_[i] = anywhere());
  }

  hal::Vec2 cell_of(CellGrid::Member member) const {
    return {std::floor(places_[member].x / kSize), std::floor(places_[member].y / kSize)};
  }

  static constexpr double kSize = 1.5;
  CellGrid grid_{kSize};
  std::vector<hal::Vec2> places_;
};

TEST_F(CellGridTest, FindsAllInABoxAndOnlyThoseOfItsCells) {
  const hal::Vec2 low{-4.1, 0.2}, high{2.9, 6.5};
  std::vector<CellGrid::Member> found;
  grid_.within(low, high, found);
  EXPECT_TRUE(std::ranges::is_sorted(found));
  for (CellGrid::Member i = 0; i < 200; ++i) {
    const hal::Vec2 cell = cell_of(i);
    const bool meets = cell.x >= std::floor(low.x / kSize) &&
                       cell.x <= std::floor(high.x / kSize) &&
                       cell.y >= std::floor(low.y / kSize) && cell.y <= std::floor(high.y / kSize);
    EXPECT_EQ(std::ranges::count(found, i), meets ? 1 : 0) << i;
  }
}

TEST_F(CellGridTest, FindsThoseWhoseCellsAreNearer) {
  for (const int cells : {1, 4}) {
    for (CellGrid::Member i = 0; i < 200; ++i) {
      const auto found = grid_.around(i, cells);
      for (CellGrid::Member j = 0; j < 200; ++j) {
        const hal::Vec2 apart = cell_of(j) - cell_of(i);
        const double x = std::max(std::abs(apart.x) - 1, 0.0),
                     y = std::max(std::abs(apart.y) - 1, 0.0);
        const bool is_near = x * x + y * y <= cells * cells;
        ASSERT_EQ(std::ranges::count(found, j), is_near && i != j ? 1 : 0) << i << " " << j;
      }
    }
  }
}

TEST_F(CellGridTest, SaysWhetherAMemberChangesItsCell) {
  const hal::Vec2 corner{0.1, 0.1};
  grid_.put(0, corner);
  EXPECT_FALSE(grid_.would_move(0, {1.4, 1.4}));
  EXPECT_FALSE(grid_.put(0, {1.4, 1.4}));
  EXPECT_TRUE(grid_.would_move(0, {1.6, 1.4}));
  EXPECT_TRUE(grid_.put(0, {1.6, 1.4}));
}

TEST(CellGrid, AnInfiniteCellHoldsAll) {
  CellGrid grid(std::numeric_limits<double>::infinity());
  grid.put(0, {0, 0});
  grid.put(1, {1e12, -1e12});
  EXPECT_EQ(grid.around(0, 4), std::vector<CellGrid::Member>{1});
}

TEST(CellGrid, ABoxMayBeFarLargerThanWhereMembersAre) {
  CellGrid grid(0.5);
  grid.put(0, {3, 4});
  std::vector<CellGrid::Member> found;
  grid.within({-1e12, -1e12}, {1e12, 1e12}, found);
  EXPECT_EQ(found, std::vector<CellGrid::Member>{0});
}

}  // namespace
}  // namespace sim
