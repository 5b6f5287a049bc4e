#include "sim/scenario/placement.h"

#include <fmt/format.h>

#include "hal/description/names.h"
#include "hal/types/agent_id.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

constexpr std::int64_t kMostAgents = hal::kLastAddress;

/// Row by row from the origin: x first, then y.
std::vector<hal::Pose2> read_grid(Mapping in) {
  const std::int64_t columns =
      in.integer({"columns", "Agents side by side along x.", "5"}, 1, kMostAgents);
  const std::int64_t rows =
      in.integer({"rows", "Agents side by side along y.", "5"}, 1, kMostAgents);
  const hal::Vec2 spacing =
      in.vec2({"spacing", "Between neighbours along x and y.", "[125 m, 125 m]"}, "m",
              {0, kCoordinate.high});
  const hal::Vec2 origin = in.vec2(
      {"origin", "Where the first one stands, world frame.", "[0 m, 0 m]"}, "m", kCoordinate, {});
  const double yaw = in.number({"yaw", "Heading of all of them.", "90 deg"}, "rad", kAngle, 0);
  in.finish();
  std::vector<hal::Pose2> poses;
  if (columns * rows > kMostAgents) {
    in.mistake("", fmt::format("{} x {} are {} agents; network addresses have 16 bits, which is "
                               "enough for {}",
                               columns, rows, columns * rows, kMostAgents));
    return poses;
  }
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      poses.push_back({origin.x + spacing.x * static_cast<double>(column),
                       origin.y + spacing.y * static_cast<double>(row), yaw});
    }
  }
  return poses;
}

}  // namespace

std::vector<hal::Pose2> read_poses(Mapping& in, std::vector<std::string>& places) {
  std::vector<hal::Pose2> poses;
  if (in.has("grid")) {
    in.refuse("poses", "cannot stand beside grid");
    poses = read_grid(in.mapping({"grid", "Places them row by row."}));
    places.assign(poses.size(), in.place("grid"));
    return poses;
  }
  for (Mapping& pose :
       in.mappings({"poses", "Places them one by one.", "[{x: 0 m, y: 0 m}, {x: 100 m, y: 0 m}]",
                    hal::config::kMustBeGiven})) {
    poses.push_back(
        {pose.number({"x", "World frame.", "8 m"}, "m", kCoordinate),
         pose.number({"y", "World frame.", "8 m"}, "m", kCoordinate),
         pose.number({"yaw", "Heading, from x towards y.", "20 deg"}, "rad", kAngle, 0)});
    places.push_back(pose.place());
    pose.finish();
  }
  if (poses.empty()) in.mistake("poses", "no agents: give poses or a grid");
  return poses;
}

std::vector<std::string> read_names(Mapping& in, const std::string& group, std::size_t count) {
  const std::string pattern = in.text({"name",
                                       "Of the agents: letters, digits, '_' and '-' after a "
                                       "letter, with {} for their numbers from 0.",
                                       "'m{}'", "the group's with {} behind it"},
                                      group + "{}");
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
