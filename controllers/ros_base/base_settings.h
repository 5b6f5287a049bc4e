#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/api/parameters.h"

namespace controllers {

/// How a base presents itself to ROS 2: the parameters of `ros_base`.
struct BaseSettings {
  int domain = 0;          ///< ROS_DOMAIN_ID, 0..232.
  std::string name_space;  ///< "r0" gives `rt/r0/cmd_vel`; empty: `rt/cmd_vel`.
  std::string odom_frame = "odom", base_frame = "base_footprint";
  std::string frame_prefix;                   ///< In front of every frame: "r0/".
  std::set<std::string> topics;               ///< Keys of base_topics().
  std::set<std::string> best_effort_topics;   ///< Those among them that are not reliable.
  std::map<std::string, std::string> remaps;  ///< Name of a topic, and its name in its place.
  bool best_effort_commands = false;          ///< Lost commands are not retransmitted.
  bool use_stamped_vel = false;               ///< Commands are TwistStamped, otherwise Twist.
  bool use_sim_time = false;  ///< Stamps are hal time, otherwise the clock of the process.
  /// Variances x, y, z [m^2], roll, pitch, yaw [rad^2], and of the twist by second; 0: not known.
  std::array<double, 6> pose_variances{}, twist_variances{};
};

/// @throws std::invalid_argument  a parameter that a range cannot check.
BaseSettings base_settings(const hal::Parameters& parameters);

/// The settings of one agent: "{}" in the namespace and in the prefix of frames is its name.
/// @throws std::invalid_argument  its name cannot be part of a namespace.
BaseSettings settings_of_agent(BaseSettings settings, std::string_view agent);

}  // namespace controllers
