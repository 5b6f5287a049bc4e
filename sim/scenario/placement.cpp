#include "sim/scenario/placement.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "hal/description/names.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/layouts.h"

namespace sim::scenario {
namespace {

using Poses = std::vector<hal::Pose2>;

/// The layout that the group names; none: it has to list poses.
std::optional<std::pair<std::string, Poses>> read_layout(Mapping& in, std::uint64_t seed,
                                                         const std::string& group) {
  if (in.has("grid")) return {{"grid", read_grid(in.mapping({"grid", "Places them row by row."}))}};
  if (in.has("circle")) {
    return {{"circle", read_circle_layout(in.mapping(
                           {"circle", "Places them on a circle, the first one east."}))}};
  }
  if (in.has("line")) {
    return {{"line", read_line_layout(in.mapping({"line", "Places them on a straight line."}))}};
  }
  if (in.has("uniform")) {
    return {{"uniform",
             read_uniform(in.mapping({"uniform",
                                      "Places them at random in a rectangle, by the run's seed and "
                                      "the group's name."}),
                          seed, group + "/layout")}};
  }
  return std::nullopt;
}

}  // namespace

std::vector<hal::Pose2> read_poses(Mapping& in, std::uint64_t seed, const std::string& group,
                                   std::vector<std::string>& places) {
  if (auto layout = read_layout(in, seed, group)) {
    for (const std::string other : {"poses", "grid", "circle", "line", "uniform"}) {
      if (other != layout->first) in.refuse(other, "cannot stand beside " + layout->first);
    }
    places.assign(layout->second.size(), in.place(layout->first));
    return std::move(layout->second);
  }
  Poses poses;
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
  if (poses.empty())
    in.mistake("poses", "no agents: give poses, or a grid, circle, line or uniform");
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
