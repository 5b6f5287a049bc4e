#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "hal/types/geometry.h"

namespace sim::maps {

/// How levels become occupancies: `mode` of a map file.
enum class Mode : std::uint8_t { kTrinary, kScale, kRaw };

/// The YAML file of a map, with the keys of nav2_map_server (Nav2).
struct MapFile {
  std::filesystem::path image;                  ///< Absolute.
  double resolution = 0;                        ///< m, edge of a cell
  hal::Vec2 origin;                             ///< m, world frame: corner of the lower left cell
  double yaw = 0;                               ///< rad, of the map's x axis, counter-clockwise
  bool negate = false;                          ///< Dark cells are free.
  double occupied_thresh = 0, free_thresh = 0;  ///< Shares of full darkness, 0 .. 1.
  Mode mode = Mode::kTrinary;
};

/// Reads the YAML file. Keys that nav2_map_server does not know are ignored, as by it.
/// @throws hal::files::config::ConfigErrors  with every mistake, "file:line:column: key: …"
MapFile read_map_file(const std::filesystem::path& file);

/// Cells as in nav_msgs/OccupancyGrid: rows from the map's lower edge up, each from the left; -1:
/// unknown, 0: free .. 100: occupied.
struct OccupancyGrid {
  std::size_t width = 0, height = 0;
  std::vector<std::int8_t> cells;
};

inline constexpr std::int8_t kUnknown = -1;
inline constexpr std::int8_t kOccupied = 100;

/// The cells of the map's image, by the rules of nav2_map_server (map_io.cpp, loadMapFromFile):
/// the mean of the colour channels, in mode trinary with the alpha channel if there is one, is a
/// cell's brightness; 1 minus it is its occupancy, or it with `negate`. Occupancies above
/// `occupied_thresh` are occupied, those below `free_thresh` free; those between are unknown or, in
/// mode scale, 0 .. 100 in proportion. In mode scale, pixels that are not opaque are unknown. In
/// mode raw the level of 0 .. 255 is the occupancy, if it is at most 100.
/// @throws std::runtime_error  the image cannot be read; with its name
OccupancyGrid read_cells(const MapFile& map);

}  // namespace sim::maps
