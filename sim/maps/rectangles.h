#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sim::maps {

/// Which cells are solid: rows from the lower edge up, each from the left.
struct SolidCells {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> solid;  ///< 0: no, 1: yes.
};

/// A rectangle of cells.
struct CellRectangle {
  std::size_t x = 0, y = 0;           ///< Its lower left cell.
  std::size_t width = 0, height = 0;  ///< Cells.
  bool operator==(const CellRectangle&) const = default;
};

/// Divides the solid cells into the fewest rectangles that do not overlap, ordered by row and
/// column; equal for equal cells.
///
/// Each concave corner of an outline needs a cut. A cut that joins two concave corners serves both;
/// of such cuts, those that meet exclude each other, and the fewest rectangles come from the
/// largest set of them that do not meet (W. Lipski, E. Lodi, F. Luccio, C. Mugnai, L. Pagli, "On
/// two-dimensional data organization II", Fundamenta Informaticae 2, 1979). The other concave
/// corners get cuts along x. In noise with more than a million meetings it takes all those along x
/// instead, which is not the fewest.
std::vector<CellRectangle> rectangles(const SolidCells& cells);

/// Empties groups of solid cells that touch each other along edges or at corners, if both sides of
/// the rectangle around them are shorter than `cells` cells. @return how many groups
std::size_t drop_specks(SolidCells& cells, double shortest);

}  // namespace sim::maps
