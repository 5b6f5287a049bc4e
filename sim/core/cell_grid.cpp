#include "sim/core/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sim {

CellGrid::Number CellGrid::number_at(double coordinate) const {
  if (!std::isfinite(size_)) return 0;
  // Farther out than any body gets, and well within the range of Number.
  constexpr double kLast = 1e15;
  return static_cast<Number>(std::clamp(std::floor(coordinate / size_), -kLast, kLast));
}

bool CellGrid::put(Member member, hal::Vec2 position) {
  if (member >= where_.size()) {
    where_.resize(member + 1u);
    is_there_.resize(member + 1u, false);
  }
  const Cell cell = cell_at(position);
  if (is_there_[member]) {
    if (where_[member] == cell) return false;
    take_out(member, where_[member]);
  }
  is_there_[member] = true;
  where_[member] = cell;
  cells_[cell].push_back(member);
  return true;
}

bool CellGrid::would_move(Member member, hal::Vec2 position) const {
  return where_[member] != cell_at(position);
}

void CellGrid::take_out(Member member, const Cell& cell) {
  const auto found = cells_.find(cell);
  std::erase(found->second, member);
  if (found->second.empty()) cells_.erase(found);
}

/// Appends the members of the cells of one column, from row `first` to row `last`.
void CellGrid::append(Number column, Number first, Number last, std::vector<Member>& found) const {
  for (auto cell = cells_.lower_bound({column, first});
       cell != cells_.end() && cell->first.first == column && cell->first.second <= last; ++cell) {
    found.insert(found.end(), cell->second.begin(), cell->second.end());
  }
}

void CellGrid::within(hal::Vec2 low, hal::Vec2 high, std::vector<Member>& found) const {
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  const Number first = number_at(low.y), last = number_at(high.y);
  const Number end = number_at(high.x);
  // Skips columns without members: a box may be far larger than the area that they occupy.
  for (Number column = number_at(low.x); column <= end;) {
    const auto next = cells_.lower_bound({column, first});
    if (next == cells_.end() || next->first.first > end) break;
    if (next->first.first > column) {
      column = next->first.first;
      continue;
    }
    append(column++, first, last, found);
  }
  std::sort(found.begin() + begin, found.end());
}

std::vector<CellGrid::Member> CellGrid::around(Member member, int cells) const {
  const auto [centre_column, centre_row] = where_[member];
  std::vector<Member> found;
  for (Number column = -cells - 1; column <= cells + 1; ++column) {
    // A column at distance n is separated from the centre column by n - 1 cells.
    const Number gap = std::max<Number>(std::abs(column) - 1, 0);
    Number rows = cells + 1;
    while (rows > 1 && gap * gap + (rows - 1) * (rows - 1) > Number{cells} * cells) --rows;
    append(centre_column + column, centre_row - rows, centre_row + rows, found);
  }
  std::erase(found, member);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace sim
