#pragma once

#include <string>

namespace controllers {

/// Checks a ROS 2 namespace without slashes at its ends, "r0" or "fleet/r0"; it may be empty.
/// @param parameter  its name, for the message. @throws std::invalid_argument
std::string ros_namespace(const std::string& parameter, const std::string& text);

/// ROS_DOMAIN_ID. @throws std::invalid_argument  it is not an integer.
int ros_domain(double number);

/// "rt/r0/cmd_vel", or "rt/cmd_vel" without a namespace (ROS 2 design, "Topic and Service name
/// mapping to DDS").
std::string ros_topic(const std::string& name_space, const std::string& name);

/// The same of a name that may be absolute: "/tf" gives "rt/tf" in every namespace.
/// @throws std::invalid_argument  it is no name of a topic.
std::string ros_topic_name(const std::string& name_space, const std::string& name);

/// Error message of a controller that needs RealWorldObject::air_interface() and has none.
inline constexpr const char* kNoAirInterface =
    "there is no network interface for it: a scenario gives it one by `network:` of its group and "
    "`controller: {inside: true}`, an agent's file by `controller: {air_interface: NAME}`";

}  // namespace controllers
