#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/random.h"

namespace sim::maps::test {

/// An image of a floor, the uppermost row first: '\0' occupied, '\xFE' free, '\xCD' unknown.
using Image = std::vector<std::string>;

/// Offices on both sides of corridors, drawn by chance: outer walls of 6 cells, inner ones of 3,
/// a door of 20 cells in each room, desks, shelves, and specks of one cell where chairs have
/// legs. Around the building nothing is known.
class OfficeFloor {
 public:
  OfficeFloor(std::size_t side, std::uint64_t seed)
      : side_(side), random_(seed, "floor"), image_(side, std::string(side, '\xCD')) {
    const std::size_t edge = side / 40;
    fill(edge, edge, side - edge, side - edge, '\0');
    fill(edge + 6, edge + 6, side - edge - 6, side - edge - 6, '\xFE');
    const std::size_t end = side - edge - 6;
    for (std::size_t y = edge + 6; y + 260 <= end; y += 260) {
      row_of_rooms(edge + 6, end, y, true);
      row_of_rooms(edge + 6, end, y + 160, false);  // with a corridor of 60 cells between them
    }
  }

  const Image& image() const { return image_; }

 private:
  std::size_t between(std::size_t low, std::size_t high) {
    return low + static_cast<std::size_t>(random_.uniform() * static_cast<double>(high - low));
  }
  void fill(std::size_t x0, std::size_t y0, std::size_t x1, std::size_t y1, char level) {
    for (std::size_t y = y0; y < y1; ++y)
      for (std::size_t x = x0; x < x1; ++x) image_[y][x] = level;
  }
  /// Rooms of 100 cells from y on. @param is_below  the corridor is behind them
  void row_of_rooms(std::size_t from, std::size_t to, std::size_t y, bool is_below) {
    const std::size_t wall = is_below ? y + 97 : y;
    fill(from, wall, to, wall + 3, '\0');
    if (!is_below) fill(from, y + 97, to, y + 100, '\0');  // to the next rooms
    for (std::size_t x = from; x + 60 < to;) {
      const std::size_t width = std::min(between(70, 140), to - x);
      room(x, x + width, y, wall);
      x += width;
    }
  }
  void room(std::size_t x0, std::size_t x1, std::size_t y, std::size_t wall) {
    fill(x1 - 3, y, x1, y + 100, '\0');
    const std::size_t door = between(x0 + 4, x1 - 30);
    fill(door, wall, door + 20, wall + 3, '\xFE');
    const std::size_t desk = between(x0 + 4, x1 - 44);
    fill(desk, y + 30, desk + 32, y + 46, '\0');
    fill(x0 + 4, y + 60, x0 + 12, y + 80, '\0');
    for (int leg = 0; leg < 5; ++leg) {
      const std::size_t x = between(x0 + 15, x1 - 8), at = between(y + 50, y + 90);
      fill(x, at, x + 1, at + 1, '\0');
    }
  }

  std::size_t side_;
  hal::RandomStream random_;
  Image image_;
};

}  // namespace sim::maps::test
