#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "hal/files/description/names.h"
#include "hal/robot/agent/robot_file_sections.h"
#include "hal/types/math.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;
using files::config::Mapping;
using files::config::Option;

constexpr files::config::Range kCoordinate{-1e6, 1e6};  // m
constexpr files::config::Range kAngle{-10, 10};         // rad, more than a full turn either way

enum class Driver : std::uint8_t { kNone, kPoseTopic, kStatic };
constexpr std::array kDrivers = {Option<Driver>{"none", Driver::kNone},
                                 Option<Driver>{"pose_topic", Driver::kPoseTopic},
                                 Option<Driver>{"static", Driver::kStatic}};

Pose2 read_pose(Mapping in) {
  const Pose2 pose{in.number({"x", "World frame.", "5 m"}, "m", kCoordinate),
                   in.number({"y", "World frame.", "0 m"}, "m", kCoordinate),
                   math::wrap_angle(in.number({"yaw", "Heading, from x towards y.", "90 deg"},
                                              "rad", kAngle, 0))};
  in.finish();
  return pose;
}

void read_source(Mapping& in, LocalisationSettings& settings) {
  const Driver driver = in.choice({"driver",
                                   "How the agent knows where it is: from a DDS topic, from this "
                                   "file because it stands still, or not at all.",
                                   "static"},
                                  kDrivers, Driver::kNone);
  if (driver == Driver::kPoseTopic) {
    settings.source = PoseTopicSettings{
        .topic = in.text({"topic", "Of geometry_msgs/PoseStamped, as in ROS 2.", "/mocap/r0/pose"}),
        .stale_after =
            in.duration({"stale_after", "An older pose is none.", "500 ms"}, {1e-3, 60}, 500ms)};
  } else {
    in.refuse("topic", "only driver 'pose_topic' has one");
    in.refuse("stale_after", "only driver 'pose_topic' has one");
  }
  if (driver == Driver::kStatic) {
    settings.source = read_pose(in.mapping({"pose", "Where the agent stands."}));
  } else {
    in.refuse("pose", "only driver 'static' has one");
  }
}

void read_landmark(Mapping& in, LocalisationSettings& settings,
                   std::map<AgentId, std::string>& known) {
  Landmark landmark;
  landmark.name = in.text({"name", "Of the agent.", "m0"});
  landmark.agent = AgentId{static_cast<std::uint16_t>(
      in.integer({"address", "Its network address.", "1"}, 1, kLastAddress))};
  landmark.position = {in.number({"x", "World frame.", "5 m"}, "m", kCoordinate),
                       in.number({"y", "World frame.", "0 m"}, "m", kCoordinate)};
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
  settings.range = in.number({"range", "Agents of the map farther away are not reported.", "300 m"},
                             "m", {0, files::config::kUnlimited}, settings.range);
  std::map<AgentId, std::string> known;
  for (Mapping& landmark : in.mappings({"map", "Agents that are known to stand somewhere.",
                                        "[{name: m0, address: 1, x: 0 m, y: 0 m}]"}))
    read_landmark(landmark, settings, known);
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

}  // namespace hal::robot::agent
