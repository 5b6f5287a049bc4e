#include "sim/scenario/map_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "hal/files/config/errors.h"
#include "hal/types/math.h"
#include "sim/maps/occupancy.h"
#include "sim/maps/rectangles.h"
#include "sim/scenario/given_file.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/world_section.h"

namespace sim::scenario {
namespace {

using physics::StaticBox;

constexpr double kSeam = 1e-9;  // m
constexpr std::array kUnknowns{Option<UnknownCells>{"free", UnknownCells::kFree},
                               Option<UnknownCells>{"occupied", UnknownCells::kOccupied}};

maps::SolidCells solid_cells(maps::OccupancyGrid grid, const WorldMap& map) {
  maps::SolidCells cells{grid.width, grid.height, std::vector<std::uint8_t>(grid.cells.size())};
  const bool counts_unknown = map.unknown == UnknownCells::kOccupied;
  std::ranges::transform(grid.cells, cells.solid.begin(), [&](std::int8_t cell) {
    const bool is_solid = cell == maps::kUnknown ? counts_unknown : cell >= map.occupied_from;
    return static_cast<std::uint8_t>(is_solid);
  });
  return cells;
}

/// Places rectangles of a map in the world.
class MapPlacement {
 public:
  MapPlacement(const maps::MapFile& file, const WorldMap& map, const Ground& ground)
      : file_(file),
        map_(map),
        ground_(ground),
        axis_{hal::math::cos(file.yaw), hal::math::sin(file.yaw)} {}

  StaticBox wall(const maps::CellRectangle& cells) const {
    const double edge = file_.resolution;
    const hal::Vec2 in_map{
        edge * (static_cast<double>(cells.x) + 0.5 * static_cast<double>(cells.width)),
        edge * (static_cast<double>(cells.y) + 0.5 * static_cast<double>(cells.height))};
    const hal::Vec2 at{file_.origin.x + axis_.x * in_map.x - axis_.y * in_map.y,
                       file_.origin.y + axis_.y * in_map.x + axis_.x * in_map.y};
    StaticBox box = map_.wall;
    box.size.x = edge * static_cast<double>(cells.width) + 2 * kSeam;
    box.size.y = edge * static_cast<double>(cells.height) + 2 * kSeam;
    box.centre = {at.x, at.y, ground_.height(at) + map_.elevation + box.size.z / 2};
    box.yaw = file_.yaw;
    return box;
  }

 private:
  const maps::MapFile& file_;
  const WorldMap& map_;
  const Ground& ground_;
  hal::Vec2 axis_;
};

void keys_of(Fields& io, WorldMap& map, std::span<const Material> materials) {
  file_key(io,
           {"file",
            "The map's YAML file, as nav2_map_server reads it; its image is PGM or PNG. Relative "
            "to this file's folder, or to the shared one.",
            "maps/office.yaml"},
           map.file);
  if (io.reading() != nullptr) map.wall.name = map.file.stem().string();
  io.text({"name", "First part of the walls' names, before their numbers.", "office",
           "the file's name without extension"},
          map.wall.name);
  io.number({"height", "Height of the walls.", "2.5 m"}, "m", {1e-3, 1000}, map.wall.size.z);
  io.number({"elevation",
             "Height of the floor above the ground. Bodies stand on the ground; antennas may be on "
             "other floors.",
             "3 m"},
            "m", {-1000, 1000}, map.elevation);
  io.choice({"unknown", "What cells are of which the map says nothing.", "occupied"}, kUnknowns,
            map.unknown);
  io.count({"occupied_from",
            "Least occupancy of a wall's cells, for the modes scale and raw (lethal_threshold of "
            "Nav2's static layer).",
            "65"},
           1, 100, map.occupied_from);
  io.number(
      {"drop_below",
       "Occupied cells that touch each other, but nothing else, are left out if both sides of the "
       "rectangle around them are shorter; 0: none are.",
       "20 cm"},
      "m", {0, 1000}, map.drop_below);
  surface_keys(io, materials, map.wall);
}

void take(Fields& io, WorldMap& map, agents::SimulationConfig& config) {
  if (map.file.empty()) {
    if (!io.reading()->has("file"))
      io.mistake("file", "is missing: the map's YAML file, e.g. maps/office.yaml");
    return;
  }
  try {
    const std::vector<StaticBox> walls = walls_of(map, *config.world.ground);
    if (walls.empty()) io.reading()->warn("file", "the map has no occupied cells");
    config.walls.insert(config.walls.end(), walls.begin(), walls.end());
  } catch (const hal::files::config::ConfigErrors& e) {
    for (const std::string& message : e.messages()) io.mistake("file", message);
  } catch (const std::runtime_error& e) {
    io.mistake("file", e.what());
  }
}

}  // namespace

std::vector<StaticBox> walls_of(WorldMap& map, const Ground& ground) {
  const maps::MapFile file = maps::read_map_file(map.file);
  map.image = file.image;
  maps::SolidCells cells = solid_cells(maps::read_cells(file), map);
  // Sides are whole numbers of cells: without rounding, 10 cm is twice 5 cm.
  maps::drop_specks(cells, map.drop_below / file.resolution - 1e-6);
  const std::vector<maps::CellRectangle> pieces = maps::rectangles(cells);
  if (pieces.size() > kMostMapWalls) {
    throw std::runtime_error(
        fmt::format("the map's occupied cells are {} boxes, at most {} allowed; a larger "
                    "drop_below leaves out more specks",
                    pieces.size(), kMostMapWalls));
  }
  const MapPlacement placement(file, map, ground);
  std::vector<StaticBox> walls;
  walls.reserve(pieces.size());
  for (const maps::CellRectangle& piece : pieces) {
    walls.push_back(placement.wall(piece));
    walls.back().name = fmt::format("{}{}", map.wall.name, walls.size() - 1);
  }
  map.walls = walls.size();
  return walls;
}

void map_keys(Fields& io, std::vector<WorldMap>& maps, agents::SimulationConfig& config) {
  const Key key{"map",
                "Maps of floors, whose occupied cells are walls. One map may stand there without a "
                "list: {file: maps/office.yaml}.",
                "[{file: maps/office.yaml}]"};
  const auto one = [&](Fields& each, WorldMap& map) {
    keys_of(each, map, config.materials);
    if (each.reading() != nullptr) take(each, map, config);
  };
  if (io.reading() != nullptr && io.reading()->has_mapping(key.name)) {
    maps.assign(1, {});
    io.inside(key, [&](Fields& each) { one(each, maps.front()); });
  } else {
    io.list_if_any<WorldMap>(key, maps, one);
  }
}

void drop_map_walls(Scenario& scenario) {
  std::size_t count = 0;
  for (const WorldMap& map : scenario.maps) count += map.walls;
  scenario.simulation.walls.resize(scenario.simulation.walls.size() - count);
}

}  // namespace sim::scenario
