#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/types/geometry.h"

namespace controllers {

/// An operator of robots that communicates with ROS 2 nodes (Humble): writes velocity commands,
/// geometry_msgs/Twist on `rt/<robot>/cmd_vel`, and counts the odometry received on
/// `rt/<robot>/odom`, on one network interface only.
///
/// All functions are called from one thread and do not block.
class OperatorNode {
 public:
  struct Settings {
    std::string interface;            ///< E.g. "wlan0"; its first IPv4 address is used.
    int domain = 0;                   ///< ROS_DOMAIN_ID, 0..232.
    std::vector<std::string> robots;  ///< Namespaces; an empty one gives `rt/cmd_vel`.
  };

  /// @throws std::runtime_error  the interface does not exist or has no address, or DDS fails to
  ///   open.
  explicit OperatorNode(const Settings& settings);
  ~OperatorNode();
  OperatorNode(const OperatorNode&) = delete;
  OperatorNode& operator=(const OperatorNode&) = delete;

  /// Commands every robot. Never blocks on the network. @param twist  body frame, m/s and rad/s.
  void command(const hal::Twist2& twist);
  /// Total number of odometry messages received from all robots.
  std::uint64_t heard() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace controllers
