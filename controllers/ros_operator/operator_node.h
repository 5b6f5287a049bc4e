#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/types/geometry.h"

namespace controllers {

/// An operator of robots among the nodes of ROS 2 (Humble): writes velocity commands,
/// geometry_msgs/Twist on `rt/<robot>/cmd_vel`, and counts the odometry that comes back on
/// `rt/<robot>/odom`, on one network interface and no other.
///
/// Everything is called by one thread and waits for no other.
class OperatorNode {
 public:
  struct Settings {
    std::string interface;            ///< E.g. "wlan0"; its first IPv4 address is used.
    int domain = 0;                   ///< ROS_DOMAIN_ID, 0..232.
    std::vector<std::string> robots;  ///< Namespaces; an empty one is `rt/cmd_vel`.
  };

  /// @throws std::runtime_error  the interface is not there or has no address, DDS cannot be
  /// opened.
  explicit OperatorNode(const Settings& settings);
  ~OperatorNode();
  OperatorNode(const OperatorNode&) = delete;
  OperatorNode& operator=(const OperatorNode&) = delete;

  /// Commands every robot. Never waits for the network. @param twist  body frame, m/s and rad/s.
  void command(const hal::Twist2& twist);
  /// Messages of odometry that have come so far, of all robots.
  std::uint64_t heard() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace controllers
