#include "sim/maps/occupancy.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "hal/files/config/document.h"
#include "sim/maps/image.h"

namespace sim::maps {
namespace {

using hal::files::config::Document;
using hal::files::config::Key;
using hal::files::config::Mapping;
using hal::files::config::Range;

constexpr double kBrightest = 65535;

/// What YAML means by false and true; nav2_map_server takes numbers, too.
bool read_negate(Mapping& in) {
  const std::vector<std::string> words{"0",     "1",    "false", "true", "False", "True",
                                       "FALSE", "TRUE", "no",    "yes",  "off",   "on"};
  const Key key{"negate", "Whether dark cells are free, 0 or 1.", "0"};
  return in.choice(key, words).value_or(0) % 2 == 1;
}

std::filesystem::path read_image_name(Mapping& in, const std::filesystem::path& folder) {
  const std::string name = in.text({"image", "Image of the cells, PGM or PNG.", "office.png"});
  if (name.empty()) return {};
  std::filesystem::path image = (folder / name).lexically_normal();
  std::error_code error;
  if (!std::filesystem::is_regular_file(image, error))
    in.mistake("image", fmt::format("there is no file '{}'", image.string()));
  return image;
}

MapFile read_keys(Mapping& in, const std::filesystem::path& folder) {
  constexpr Range kShare{0, 1};
  constexpr Range kFar{-1e6, 1e6};
  MapFile map;
  map.image = read_image_name(in, folder);
  map.resolution = in.number({"resolution", "Edge of a cell, m.", "0.05"}, "1", {1e-4, 100});
  const hal::Vec3 origin =
      in.vec3({"origin", "Lower left corner, m, and yaw, rad.", "[-10.0, -5.0, 0.0]"}, "1", kFar);
  map.origin = {origin.x, origin.y};
  map.yaw = origin.z;
  map.negate = read_negate(in);
  map.occupied_thresh =
      in.number({"occupied_thresh", "Above it a cell is occupied.", "0.65"}, "1", kShare);
  map.free_thresh = in.number({"free_thresh", "Below it a cell is free.", "0.25"}, "1", kShare);
  const bool is_read = map.occupied_thresh > 0;  // 0 stands for a mistake, too
  if (is_read && map.free_thresh > map.occupied_thresh)
    in.mistake("free_thresh", fmt::format("{} is above occupied_thresh, {}", map.free_thresh,
                                          map.occupied_thresh));
  map.mode = static_cast<Mode>(in.choice({"mode", "How levels become occupancies.", "trinary"},
                                         {"trinary", "scale", "raw"}, 0));
  return map;
}

class Cells {
 public:
  Cells(const MapFile& map, bool has_alpha)
      : map_(map), counts_alpha_(map.mode == Mode::kTrinary && has_alpha) {}

  std::int8_t cell(const Pixel& pixel) const {
    const int colours = pixel.red + pixel.green + pixel.blue;
    const double mean = counts_alpha_ ? (colours + pixel.alpha) / 4.0 : colours / 3.0;
    const double shade = mean / kBrightest;
    if (map_.mode == Mode::kRaw) return raw(shade);
    if (map_.mode == Mode::kScale && pixel.alpha != kBrightest) return kUnknown;
    const double occupancy = map_.negate ? shade : 1 - shade;
    if (map_.occupied_thresh < occupancy) return kOccupied;
    if (occupancy < map_.free_thresh) return 0;
    return map_.mode == Mode::kScale ? scaled(occupancy) : kUnknown;
  }

 private:
  static std::int8_t raw(double shade) {
    const double level = std::round(shade * 255);
    return level <= kOccupied ? static_cast<std::int8_t>(level) : kUnknown;
  }
  std::int8_t scaled(double occupancy) const {
    const double between = map_.occupied_thresh - map_.free_thresh;
    if (between <= 0) return 0;  // the thresholds are equal, and so is the occupancy
    return static_cast<std::int8_t>(std::rint((occupancy - map_.free_thresh) / between * 100.0));
  }

  const MapFile& map_;
  bool counts_alpha_;
};

bool is_same(const Pixel& a, const Pixel& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
}

}  // namespace

MapFile read_map_file(const std::filesystem::path& file) {
  Document document = Document::load(file);
  Mapping root = document.root();
  std::error_code error;
  MapFile map = read_keys(root, std::filesystem::weakly_canonical(file, error).parent_path());
  document.finish();
  return map;
}

OccupancyGrid read_cells(const MapFile& map) {
  OccupancyGrid grid;
  bool has_alpha = false;
  const auto begin = [&](const ImageSize& size) {
    grid.width = size.width;
    grid.height = size.height;
    grid.cells.resize(size.width * size.height);
    has_alpha = size.has_alpha;
  };
  const auto row = [&](std::size_t number, std::span<const Pixel> pixels) {
    const Cells cells(map, has_alpha);
    std::int8_t* to = &grid.cells[(grid.height - 1 - number) * grid.width];
    for (std::size_t i = 0; i < pixels.size(); ++i)
      to[i] = i > 0 && is_same(pixels[i], pixels[i - 1]) ? to[i - 1] : cells.cell(pixels[i]);
  };
  try {
    read_image(map.image, {begin, row});
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(fmt::format("{}: {}", map.image.string(), e.what()));
  }
  return grid;
}

}  // namespace sim::maps
