#include "results/report/mcap_topics.h"

#include <fmt/format.h>

#include <stdexcept>

#include "idl/ros/schemas.h"

namespace results::report {
namespace {

constexpr std::size_t kMostTopics = 65'534;

/// QoS in the form that rosbag2 writes and reads when it plays the file: reliable, keep last ten,
/// transient local if latched, otherwise volatile (rmw/types.h of ROS 2: keep last 1, reliable 1,
/// transient local 1, volatile 2, automatic 1).
std::string offered_qos(McapTopics::Latched latched) {
  const bool kept = latched == McapTopics::Latched::kYes;
  const std::string never = "    sec: 9223372036\n    nsec: 854775807\n";
  return fmt::format(
      "- history: 1\n  depth: 10\n  reliability: 1\n  durability: {}\n  deadline:\n{}"
      "  lifespan:\n{}  liveliness: 1\n  liveliness_lease_duration:\n{}"
      "  avoid_ros_namespace_conventions: false\n",
      kept ? 1 : 2, never, never, never);
}

}  // namespace

std::uint16_t McapTopics::channel_of(const std::string& topic, std::string_view type,
                                     Latched latched) {
  const auto found = channels_.find(topic);
  return found == channels_.end() ? channel(topic, type, latched) : found->second;
}

std::uint16_t McapTopics::channel(const std::string& topic, std::string_view type,
                                  Latched latched) {
  if (channels_.size() == kMostTopics) {
    throw std::runtime_error(fmt::format("an MCAP file has at most {} topics", kMostTopics));
  }
  auto schema = schemas_.find(type);
  if (schema == schemas_.end()) {
    const std::uint16_t number = file_.add_schema(type, "ros2msg", idl::ros::schema(type));
    schema = schemas_.emplace(type, number).first;
  }
  const std::uint16_t number = file_.add_channel(schema->second, topic, "cdr",
                                                 {{"offered_qos_profiles", offered_qos(latched)}});
  channels_.emplace(topic, number);
  return number;
}

}  // namespace results::report
