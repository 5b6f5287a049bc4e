#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "hal/description/names.h"
#include "hal/hardware/robot_file_sections.h"
#include "hal/types/math.h"

namespace hal::hardware {
namespace {

using namespace std::chrono_literals;
using config::Mapping;
using config::Option;

constexpr config::Range kCoordinate{-1e6, 1e6};  // m
constexpr config::Range kAngle{-10, 10};         // rad, more than a full turn either way

enum class Driver : std::uint8_t { kNone, kPoseTopic, kStatic };
constexpr std::array kDrivers = {Option<Driver>{"none", Driver::kNone},
                                 Option<Driver>{"pose_topic", Driver::kPoseTopic},
                                 Option<Driver>{"static", Driver::kStatic}};

Pose2 read_pose(Mapping in) {
  const Pose2 pose{in.number("x", "m", kCoordinate), in.number("y", "m", kCoordinate),
                   math::wrap_angle(in.number("yaw", "rad", kAngle, 0))};
  in.finish();
  return pose;
}

void read_source(Mapping& in, LocalisationSettings& settings) {
  const Driver driver = in.choice("driver", kDrivers, Driver::kNone);
  if (driver == Driver::kPoseTopic) {
    settings.source = PoseTopicSettings{
        .topic = in.text("topic"), .stale_after = in.duration("stale_after", {1e-3, 60}, 500ms)};
  } else {
    in.refuse("topic", "only driver 'pose_topic' has one");
    in.refuse("stale_after", "only driver 'pose_topic' has one");
  }
  if (driver == Driver::kStatic) {
    settings.source = read_pose(in.mapping("pose"));
  } else {
    in.refuse("pose", "only driver 'static' has one");
  }
}

void read_landmark(Mapping& in, LocalisationSettings& settings,
                   std::map<AgentId, std::string>& known) {
  Landmark landmark;
  landmark.name = in.text("name");
  landmark.agent = AgentId{static_cast<std::uint16_t>(in.integer("address", 1, 0xfffe))};
  landmark.position = {in.number("x", "m", kCoordinate), in.number("y", "m", kCoordinate)};
  const auto [taken, is_new] = known.emplace(landmark.agent, landmark.name);
  if (!is_new) {
    in.mistake("address",
               fmt::format("the address {} is taken by '{}'", landmark.agent.value, taken->second));
  }
  in.finish();
  settings.map.push_back(std::move(landmark));
}

}  // namespace

LocalisationSettings read_localisation(Mapping in, const RobotFile& file) {
  LocalisationSettings settings;
  read_source(in, settings);
  settings.range = in.number("range", "m", {0, config::kUnlimited}, settings.range);
  std::map<AgentId, std::string> known;
  for (Mapping& landmark : in.mappings("map")) read_landmark(landmark, settings, known);
  const auto self = known.find(file.address);
  if (self != known.end() && self->second != file.name) {
    in.mistake("map", fmt::format("gives the address {} of this agent to '{}'", file.address.value,
                                  self->second));
  }
  std::sort(settings.map.begin(), settings.map.end(),
            [](const Landmark& a, const Landmark& b) { return a.agent < b.agent; });
  in.finish();
  return settings;
}

}  // namespace hal::hardware
