#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hal/api/robot.h"
#include "hal/types/geometry.h"

namespace controllers {

/// A robot that communicates with ROS 2 nodes (Humble): reads velocity commands,
/// geometry_msgs/Twist on `rt/cmd_vel`, and writes its odometry on `rt/odom` and `rt/tf`, on one
/// network interface only, over UDP, with the discovery of ROS 2's middleware. Messages are stamped
/// with the clock of the process, like those of any node.
///
/// Threads of DDS only store commands, which take_commands() returns. All functions are called from
/// one thread and do not block.
class RosNode {
 public:
  struct Settings {
    std::string interface;   ///< E.g. "wlan0"; its first IPv4 address is used.
    int domain = 0;          ///< ROS_DOMAIN_ID, 0..232.
    std::string name_space;  ///< "r0" gives `rt/r0/cmd_vel`; empty: `rt/cmd_vel`.
    std::string odom_frame = "odom", base_frame = "base_link";
    /// Lost commands are not retransmitted; false: they are.
    bool best_effort = false;
  };

  /// Commands since the previous call.
  struct Commands {
    std::optional<hal::Twist2> last;  ///< Body frame.
    std::uint64_t count = 0;          ///< With finite components.
    std::uint64_t senseless = 0;      ///< Dropped because a component was not finite.
  };

  /// @throws std::runtime_error  the interface does not exist or has no address, or DDS fails to
  ///   open.
  explicit RosNode(const Settings& settings);
  ~RosNode();
  RosNode(const RosNode&) = delete;
  RosNode& operator=(const RosNode&) = delete;

  Commands take_commands();
  /// Never blocks on the network. Without readers nothing is sent.
  void publish(const hal::Odometry& odometry);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace controllers
