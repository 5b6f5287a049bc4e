#include "sim/radio/cell_grid.h"

#include <algorithm>
#include <cmath>

namespace sim::radio {

CellGrid::Cell CellGrid::cell_at(const hal::Vec3& position) const {
  if (!std::isfinite(size_)) return {0, 0};
  return {static_cast<std::int64_t>(std::floor(position.x / size_)),
          static_cast<std::int64_t>(std::floor(position.y / size_))};
}

void CellGrid::add(StationIndex station, const hal::Vec3& position) {
  const Cell cell = cell_at(position);
  cells_[cell].push_back(station);
  where_[station] = cell;
}

bool CellGrid::move(StationIndex station, const hal::Vec3& position) {
  const Cell to = cell_at(position);
  const Cell from = where_.at(station);
  if (to == from) return false;
  std::erase(cells_[from], station);
  if (cells_[from].empty()) cells_.erase(from);
  add(station, position);
  return true;
}

std::vector<StationIndex> CellGrid::around(StationIndex station) const {
  const Cell centre = where_.at(station);
  std::vector<StationIndex> found;
  for (std::int64_t x = centre.first - 1; x <= centre.first + 1; ++x) {
    for (std::int64_t y = centre.second - 1; y <= centre.second + 1; ++y) {
      const auto cell = cells_.find({x, y});
      if (cell == cells_.end()) continue;
      found.insert(found.end(), cell->second.begin(), cell->second.end());
    }
  }
  std::erase(found, station);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace sim::radio
