// What stands and moves, for an MCAP file: poses, transforms, bodies and walls.
#include <algorithm>
#include <utility>

#include "sim/report/mcap_streams.h"
#include "sim/report/ros_messages.h"

namespace sim::report {
namespace {

constexpr const char* kTransforms = "tf2_msgs/msg/TFMessage";
constexpr const char* kMarkers = "visualization_msgs/msg/MarkerArray";

/// What moved at one instant.
struct Moved {
  std::vector<RosTransform> transforms;
  std::vector<RosMarker> markers;
};

void add_markers(std::vector<RosMarker>& markers, std::int64_t at, const std::string& name,
                 const hal::DrawnBody& body, const hal::Pose2& pose) {
  for (const hal::Solid& solid : body.solids) {
    markers.push_back({.at_ns = at,
                       .name = name,
                       .id = static_cast<std::int32_t>(&solid - body.solids.data()),
                       .solid = solid,
                       .pose = pose,
                       .colour = hal::colour_of(body.kind)});
  }
}

/// A sensor named "pose" has that topic, in a run under way, too.
std::string topic_of_pose(const std::string& name, const ExportedAgent* agent) {
  const bool is_taken =
      agent != nullptr &&
      std::ranges::find(agent->channels, "pose", &hal::Channel::name) != agent->channels.end();
  return "/" + name + (is_taken ? "/true_pose" : "/pose");
}

void on_pose(const McapParts& parts, Moved& moved, std::int64_t at, const record::Statement& row) {
  const std::int64_t agent = row.integer(1);
  const std::string name = parts.name(agent);
  const hal::Pose2 pose{row.real(2), row.real(3), row.real(4)};
  const auto found = parts.scene.agents.find(agent);
  const ExportedAgent* const known = found == parts.scene.agents.end() ? nullptr : &found->second;
  if (row.text(5) != "mote") {
    parts.topics.publish(at, topic_of_pose(name, known), "geometry_msgs/msg/PoseStamped",
                         pose_stamped({at, "world"}, pose));
  }
  moved.transforms.push_back({{at, "world"}, name + "/base_link", {pose.x, pose.y, 0}, pose.theta});
  if (known != nullptr) add_markers(moved.markers, at, name, known->body, pose);
}

void add_mounts(std::vector<RosTransform>& all, const std::string& name,
                const ExportedAgent& agent) {
  const std::string base = name + "/base_link";
  if (agent.drives) {
    all.push_back(
        {{0, "world"}, name + "/odom", {agent.start.x, agent.start.y, 0}, agent.start.theta});
  }
  for (std::size_t i = 0; i < agent.ranges.size(); ++i) {
    all.push_back({{0, base},
                   name + "/infrared_" + std::to_string(i),
                   agent.ranges[i].position,
                   agent.ranges[i].heading});
  }
  for (const hal::Channel& channel : agent.channels) {
    if (channel.frame != channel.name) continue;  // no frame of its own
    all.push_back({{0, base}, name + "/" + channel.frame, channel.position, channel.heading});
  }
}

}  // namespace

void add_pose_streams(const McapParts& parts, McapStreams& streams) {
  const auto moved = std::make_shared<Moved>();
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT p.at_ns, p.agent, p.x_m, p.y_m, p.theta_rad, a.kind FROM poses p"
      " JOIN agents a USING (agent) ORDER BY p.at_ns, p.agent",
      [parts, moved](std::int64_t at, const record::Statement& row) {
        on_pose(parts, *moved, at, row);
      },
      [parts, moved](std::int64_t at) {
        parts.topics.publish(at, "/tf", kTransforms, tf_message(moved->transforms));
        parts.topics.publish(at, "/markers", kMarkers, marker_array(moved->markers),
                             McapTopics::Latched::kYes);
        *moved = {};
      }));
}

void publish_static_transforms(const McapParts& parts) {
  std::vector<RosTransform> all;
  for (const auto& [agent, of] : parts.scene.agents) add_mounts(all, parts.name(agent), of);
  parts.topics.publish(0, "/tf_static", kTransforms, tf_message(all), McapTopics::Latched::kYes);
}

void publish_walls(const McapParts& parts) {
  std::vector<RosMarker> markers;
  for (const hal::DrawnBody& wall : parts.scene.walls) {
    add_markers(markers, 0, "walls/" + wall.name, wall, {});
  }
  parts.topics.publish(0, "/markers", kMarkers, marker_array(markers), McapTopics::Latched::kYes);
}

}  // namespace sim::report
