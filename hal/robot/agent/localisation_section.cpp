#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "hal/robot/agent/robot_file_sections.h"
#include "hal/types/math.h"

namespace hal::robot::agent {
namespace {

using namespace std::chrono_literals;
using files::config::Option;
using files::description::as;
using files::description::Fields;

constexpr files::config::Range kCoordinate{-1e6, 1e6};  // m
constexpr files::config::Range kAngle{-10, 10};  // rad, more than a full turn in either direction

// in the order of LocalisationSettings::source
enum class Driver : std::uint8_t { kNone, kPoseTopic, kStatic };
constexpr std::array kDrivers = {Option<Driver>{"none", Driver::kNone},
                                 Option<Driver>{"pose_topic", Driver::kPoseTopic},
                                 Option<Driver>{"static", Driver::kStatic}};

void pose_keys(Fields& io, Pose2& c) {
  io.needed({"x", "x coordinate, world frame.", "5 m"}, "m", kCoordinate, c.x);
  io.needed({"y", "y coordinate, world frame.", "0 m"}, "m", kCoordinate, c.y);
  io.number({"yaw", "Heading, counter-clockwise from the x axis.", "90 deg"}, "rad", kAngle,
            c.theta);
  c.theta = math::wrap_angle(c.theta);
}

void topic_keys(Fields& io, PoseTopicSettings& c) {
  io.needed_text({"topic", "DDS topic of type geometry_msgs/PoseStamped, named as in ROS 2.",
                  "/mocap/r0/pose"},
                 c.topic);
  c.stale_after = 500ms;
  io.duration({"stale_after", "Age after which a pose is no longer used.", "500 ms"}, {1e-3, 60},
              c.stale_after);
}

void source_keys(Fields& io, LocalisationSettings& c) {
  auto driver = static_cast<Driver>(c.source.index());
  io.choice({"driver",
             "How the agent knows its own pose. pose_topic: from a DDS topic; static: from this "
             "file, because it stands still; none: it does not.",
             "static"},
            kDrivers, driver, [&](Fields& keys) {
              if (driver == Driver::kPoseTopic) {
                topic_keys(keys, as<PoseTopicSettings>(c.source));
              } else {
                keys.unused("topic", "only driver 'pose_topic' has one");
                keys.unused("stale_after", "only driver 'pose_topic' has one");
              }
              if (driver != Driver::kStatic)
                return keys.unused("pose", "only driver 'static' has one");
              keys.inside({"pose", "Pose of the agent."},
                          [&](Fields& pose) { pose_keys(pose, as<Pose2>(c.source)); });
            });
}

void landmark_keys(Fields& io, Landmark& c) {
  io.needed_text({"name", "Name of the agent.", "m0"}, c.name);
  io.needed_count({"address", "Network address of the agent.", "1"}, 1, kLastAddress,
                  c.agent.value);
  io.needed({"x", "x coordinate, world frame.", "5 m"}, "m", kCoordinate, c.position.x);
  io.needed({"y", "y coordinate, world frame.", "0 m"}, "m", kCoordinate, c.position.y);
}

void map_key(Fields& io, LocalisationSettings& c, const RobotFile& file) {
  std::map<AgentId, std::string> known;
  io.list<Landmark>({"map", "Agents at known positions, which do not move.",
                     "[{name: m0, address: 1, x: 0 m, y: 0 m}]"},
                    c.map, [&](Fields& one, Landmark& landmark) {
                      landmark_keys(one, landmark);
                      const auto [taken, is_new] = known.emplace(landmark.agent, landmark.name);
                      if (!is_new)
                        one.mistake("address", fmt::format("the address {} is taken by '{}'",
                                                           landmark.agent.value, taken->second));
                    });
  const auto self = known.find(file.address);
  if (self != known.end() && self->second != file.name) {
    io.mistake("map", fmt::format("gives the address {} of this agent to '{}'", file.address.value,
                                  self->second));
  }
  std::ranges::sort(c.map, {}, &Landmark::agent);
}

}  // namespace

void localisation_keys(Fields& io, LocalisationSettings& c, const RobotFile& file) {
  source_keys(io, c);
  io.number({"range", "Largest distance at which agents of the map are reported; none: no limit.",
             "300 m"},
            "m", {0, files::config::kUnlimited}, c.range);
  map_key(io, c, file);
}

}  // namespace hal::robot::agent
