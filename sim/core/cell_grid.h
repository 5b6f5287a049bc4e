#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "hal/types/geometry.h"

namespace sim {

/// Square cells over the plane, each listing the members in it, so that a search for neighbours
/// visits the surrounding cells only. Radio, localisation and sensing use it. Members are numbers
/// from 0. Results depend on the members' positions, not on their history.
class CellGrid {
 public:
  using Member = std::uint32_t;

  /// @param size  edge of a cell [m], > 0; infinite: one cell for all.
  explicit CellGrid(double size) : size_(size) {}

  /// Adds a member, or moves it. @return whether it was not in that cell before.
  bool put(Member member, hal::Vec2 position);

  /// Whether put() would move the member to another cell. @pre the member is there.
  bool would_move(Member member, hal::Vec2 position) const;

  /// Appends the members of all cells that intersect a box, in order. @param low,high  corners [m].
  void within(hal::Vec2 low, hal::Vec2 high, std::vector<Member>& found) const;

  /// Members of all cells that have a point nearer than `cells` edges to some point of the cell of
  /// `member`, in order, without `member` itself.
  std::vector<Member> around(Member member, int cells) const;

 private:
  using Number = std::int64_t;
  using Cell = std::pair<Number, Number>;  ///< Column and row.
  Number number_at(double coordinate) const;
  Cell cell_at(hal::Vec2 at) const { return {number_at(at.x), number_at(at.y)}; }
  void take_out(Member member, const Cell& cell);
  void append(Number column, Number first, Number last, std::vector<Member>& found) const;

  double size_;
  std::map<Cell, std::vector<Member>> cells_;
  std::vector<Cell> where_;     ///< Cell of each member.
  std::vector<bool> is_there_;  ///< Whether each member was put.
};

}  // namespace sim
