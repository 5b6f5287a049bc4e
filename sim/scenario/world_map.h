#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/physics/world.h"

namespace sim::scenario {

/// What unknown cells of a map are.
enum class UnknownCells : std::uint8_t { kFree, kOccupied };

/// A map of a floor, whose occupied cells are walls: one entry of `world.map`.
struct WorldMap {
  std::filesystem::path file;   ///< The YAML file, absolute.
  std::filesystem::path image;  ///< What it names, absolute.
  double elevation = 0;         ///< m, of the floor above the ground
  double drop_below = 0.1;      ///< m; smaller groups of occupied cells are left out
  int occupied_from = 100;      ///< Occupancy from which a cell is occupied, 1 .. 100.
  UnknownCells unknown = UnknownCells::kFree;
  /// What all walls have in common: name (they add numbers), height, friction and radio's loss.
  physics::StaticBox wall{.name = {}, .centre = {}, .size = {0, 0, 2.5}};
  std::size_t walls = 0;  ///< How many walls it became.
};

}  // namespace sim::scenario
