#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "hal/types/geometry.h"

namespace sim::radio {

/// Number of a station in the order of addresses: 0, 1, 2, …
using StationIndex = std::uint32_t;

/// Square cells over the plane, each listing the stations in it, so that a transmitter looks at
/// nine cells instead of at everybody. z is ignored: it can only add distance.
class CellGrid {
 public:
  /// @param size  edge of a cell [m], > 0; infinite: one cell for all.
  explicit CellGrid(double size) : size_(size) {}

  void add(StationIndex station, const hal::Vec3& position);

  /// @return whether the station's cell changed.
  bool move(StationIndex station, const hal::Vec3& position);

  /// Stations of the cell of `station` and its eight neighbours, `station` itself not among them,
  /// in order.
  std::vector<StationIndex> around(StationIndex station) const;

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell_at(const hal::Vec3& position) const;

  double size_;
  std::map<Cell, std::vector<StationIndex>> cells_;
  std::map<StationIndex, Cell> where_;
};

}  // namespace sim::radio
