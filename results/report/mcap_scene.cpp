// The scene for an MCAP file: poses, transforms, bodies and walls.
#include <algorithm>
#include <utility>

#include "idl/ros/markers.h"
#include "idl/ros/values.h"
#include "results/report/mcap_streams.h"

namespace results::report {
namespace {

using geometry_msgs::msg::dds_::TransformStamped_;
using idl::ros::transform_between;

/// Transforms and markers of the bodies that moved at one instant.
struct Moved {
  tf2_msgs::msg::dds_::TFMessage_ transforms;
  visualization_msgs::msg::dds_::MarkerArray_ markers;
};

/// A sensor named "pose" takes the topic "pose", as in a running simulation.
std::string topic_of_pose(const std::string& name, const ExportedAgent* agent) {
  const bool is_taken =
      agent != nullptr &&
      std::ranges::find(agent->channels, "pose", &hal::Channel::name) != agent->channels.end();
  return "/" + name + (is_taken ? "/true_pose" : "/pose");
}

void on_pose(const McapParts& parts, Moved& moved, std::int64_t at, const record::Statement& row) {
  const std::int64_t agent = row.integer(1);
  const std::string name = parts.name(agent);
  const auto stamp = idl::ros::to_ros(hal::time_from_ns(at));
  const hal::Pose2 pose{row.real(2), row.real(3), row.real(4)};
  const auto found = parts.scene.agents.find(agent);
  const ExportedAgent* const known = found == parts.scene.agents.end() ? nullptr : &found->second;
  if (row.text(5) != "mote") {
    geometry_msgs::msg::dds_::PoseStamped_ message;
    message.header().stamp(stamp);
    message.header().frame_id("world");
    message.pose(idl::ros::to_ros(pose));
    parts.topics.publish(at, topic_of_pose(name, known), message);
  }
  TransformStamped_& moving = moved.transforms.transforms().emplace_back(
      transform_between("world", name + "/base_link", {pose.x, pose.y, 0}, pose.theta));
  moving.header().stamp(stamp);
  if (known != nullptr) {
    idl::ros::add_markers(moved.markers.markers(), hal::time_from_ns(at), name,
                          {known->body, pose});
  }
}

void add_mounts(std::vector<TransformStamped_>& all, const std::string& name,
                const ExportedAgent& agent) {
  const std::string base = name + "/base_link";
  all.reserve(all.size() + 1 + agent.ranges.size() + agent.channels.size());
  if (agent.drives) {
    const hal::Pose2& start = agent.start;
    all.push_back(transform_between("world", name + "/odom", {start.x, start.y, 0}, start.theta));
  }
  for (std::size_t i = 0; i < agent.ranges.size(); ++i) {
    const ExportedRange& range = agent.ranges[i];
    all.push_back(transform_between(base, name + "/infrared_" + std::to_string(i), range.position,
                                    range.heading));
  }
  for (const hal::Channel& channel : agent.channels) {
    if (channel.frame != channel.name) continue;  // no frame of its own
    all.push_back(
        transform_between(base, name + "/" + channel.frame, channel.position, channel.heading));
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
        parts.topics.publish(at, "/tf", moved->transforms);
        parts.topics.publish(at, "/markers", moved->markers, McapTopics::Latched::kYes);
        moved->transforms.transforms().clear();
        moved->markers.markers().clear();
      }));
}

void publish_static_transforms(const McapParts& parts) {
  tf2_msgs::msg::dds_::TFMessage_ all;
  for (const auto& [agent, of] : parts.scene.agents) {
    add_mounts(all.transforms(), parts.name(agent), of);
  }
  parts.topics.publish(0, "/tf_static", all, McapTopics::Latched::kYes);
}

void publish_walls(const McapParts& parts) {
  visualization_msgs::msg::dds_::MarkerArray_ walls;
  for (const hal::DrawnBody& wall : parts.scene.walls) {
    idl::ros::add_markers(walls.markers(), hal::Time{}, "walls/" + wall.name, {wall, {}});
  }
  parts.topics.publish(0, "/markers", walls, McapTopics::Latched::kYes);
}

}  // namespace results::report
