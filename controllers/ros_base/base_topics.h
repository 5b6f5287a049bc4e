#pragma once

#include <fastdds/dds/topic/Topic.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/ros/ros_participant.h"

namespace controllers {

/// A topic that a base writes.
struct BaseTopic {
  std::string_view key;   ///< In the parameter `topics`: "tf".
  std::string_view name;  ///< In ROS 2, in the namespace or absolute: "/tf".
  RosQos qos;             ///< As Humble's drivers have it; the parameter best_effort_topics decides
                          ///< on the reliability.
  /// Channel without which the robot does not offer it; empty: none.
  std::string_view channel;
  /// Makes it in the DDS participant under a DDS name, such as "rt/tf".
  eprosima::fastdds::dds::Topic* (RosParticipant::*make)(const std::string&);
};

/// All of them, in the order in which their writers are made.
std::span<const BaseTopic> base_topics();

/// The topic of commands, which it reads.
inline constexpr std::string_view kCommandTopic = "cmd_vel";

/// Keys of base_topics(); those of the default are all but "clock".
std::vector<std::string> topic_keys();
std::vector<std::string> default_topics();

}  // namespace controllers
