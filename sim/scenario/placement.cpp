#include "sim/scenario/placement.h"

#include <fmt/format.h>

#include <utility>

#include "hal/files/description/names.h"
#include "sim/scenario/layouts.h"

namespace sim::scenario {

namespace {

void pose_keys(Fields& io, Placement& placement, std::vector<std::string>& places) {
  auto* const poses = std::get_if<std::vector<hal::Pose2>>(&placement);
  io.list<hal::Pose2>(
      {"poses", "Places the agents one by one.", "[{x: 0 m, y: 0 m}, {x: 100 m, y: 0 m}]",
       hal::files::config::kMustBeGiven},
      *poses, [&](Fields& one, hal::Pose2& pose) {
        one.needed({"x", "x coordinate, world frame.", "8 m"}, "m", kCoordinate, pose.x);
        one.needed({"y", "y coordinate, world frame.", "8 m"}, "m", kCoordinate, pose.y);
        one.number({"yaw", "Heading, counter-clockwise from the x axis.", "20 deg"}, "rad", kAngle,
                   pose.theta);
        if (one.reading() != nullptr) places.push_back(one.reading()->place());
      });
  if (poses->empty())
    io.mistake("poses", "no agents: give poses, or a grid, circle, line or uniform");
}

}  // namespace

void placement_keys(Fields& io, Placement& placement, std::vector<std::string>& places) {
  const bool is_layout =
      layout_keys(io, placement, [&](Fields& listed) { pose_keys(listed, placement, places); });
  if (is_layout) io.unused("poses", "cannot be combined with " + name_of(placement));
}

std::vector<hal::Pose2> poses_of(Mapping& in, const Placement& placement, std::uint64_t seed,
                                 const std::string& group, std::vector<std::string>& places) {
  LayoutMistake mistake;
  std::vector<hal::Pose2> poses = poses_of(placement, seed, group + "/layout", mistake);
  if (std::holds_alternative<std::vector<hal::Pose2>>(placement)) return poses;
  const std::string layout = name_of(placement);
  if (!mistake.text.empty()) in.within(layout).mistake(mistake.key, mistake.text);
  places.assign(poses.size(), in.place(layout));
  return poses;
}

void name_key(Fields& io, std::string& pattern) {
  io.text({"name",
           "Names of the agents: letters, digits, '_' and '-' after a letter, with {} for the "
           "agent's number in the group, from 0.",
           "'m{}'", "the group's name followed by {}"},
          pattern);
}

std::vector<std::string> names_of(Mapping& in, const std::string& pattern, std::size_t count) {
  const std::size_t hole = pattern.find("{}");
  std::string letters = pattern;
  if (hole != std::string::npos) letters.erase(hole, 2);
  if (!hal::files::description::may_be_named(letters)) {
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
