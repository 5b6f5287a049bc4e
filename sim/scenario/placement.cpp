#include "sim/scenario/placement.h"

#include <fmt/format.h>

#include "hal/description/names.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

constexpr std::int64_t kMaxSide = 10'000;

/// Row by row from the origin: x first, then y.
std::vector<hal::Pose2> read_grid(Mapping in) {
  const std::int64_t columns = in.integer("columns", 1, kMaxSide);
  const std::int64_t rows = in.integer("rows", 1, kMaxSide);
  const hal::Vec2 spacing = in.vec2("spacing", "m", {0, kCoordinate.high});
  const hal::Vec2 origin = in.vec2("origin", "m", kCoordinate, {});
  const double yaw = in.number("yaw", "rad", kAngle, 0);
  in.finish();
  std::vector<hal::Pose2> poses;
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      poses.push_back({origin.x + spacing.x * static_cast<double>(column),
                       origin.y + spacing.y * static_cast<double>(row), yaw});
    }
  }
  return poses;
}

}  // namespace

std::vector<hal::Pose2> read_poses(Mapping& in) {
  std::vector<hal::Pose2> poses;
  if (in.has("grid")) {
    in.refuse("poses", "cannot stand beside grid");
    return read_grid(in.mapping("grid"));
  }
  for (Mapping& pose : in.mappings("poses")) {
    poses.push_back({pose.number("x", "m", kCoordinate), pose.number("y", "m", kCoordinate),
                     pose.number("yaw", "rad", kAngle, 0)});
    pose.finish();
  }
  if (poses.empty()) in.mistake("poses", "no agents: give poses or a grid");
  return poses;
}

std::vector<std::string> read_names(Mapping& in, const std::string& group, std::size_t count) {
  const std::string pattern = in.text("name", group + "{}");
  const std::size_t hole = pattern.find("{}");
  std::string letters = pattern;
  if (hole != std::string::npos) letters.erase(hole, 2);
  if (!hal::description::may_be_named(letters)) {
    in.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-' after a letter, with "
                                   "{{}} for a number",
                                   pattern));
  } else if (hole == std::string::npos && count > 1) {
    in.mistake("name", fmt::format("'{}' must contain {{}}: it names {} agents", pattern, count));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    std::string name = pattern;
    if (hole != std::string::npos) name.replace(hole, 2, std::to_string(i));
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace sim::scenario
