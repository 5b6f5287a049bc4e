#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hal/api/robot.h"
#include "hal/types/geometry.h"

namespace controllers {

/// A robot among the nodes of ROS 2 (Humble): reads velocity commands, geometry_msgs/Twist on
/// `rt/cmd_vel`, and writes its odometry on `rt/odom` and `rt/tf`, on one network interface and no
/// other, by UDP, with discovery as ROS 2's middleware has it. Messages are stamped with the clock
/// of the process, as those of any node.
///
/// Threads of DDS only put commands into a box, which take_commands() empties; everything here is
/// called by one thread and waits for no other.
class RosNode {
 public:
  struct Settings {
    std::string interface;   ///< E.g. "wlan0"; its first IPv4 address is used.
    int domain = 0;          ///< ROS_DOMAIN_ID, 0..232.
    std::string name_space;  ///< "r0" makes it `rt/r0/cmd_vel`; empty: `rt/cmd_vel`.
    std::string odom_frame = "odom", base_frame = "base_link";
    /// Commands are read as they come, once; else also those that were lost, by and by.
    bool best_effort = false;
  };

  /// Commands since the last time.
  struct Commands {
    std::optional<hal::Twist2> last;  ///< Body frame.
    std::uint64_t count = 0;          ///< With a value in each component.
    std::uint64_t senseless = 0;      ///< With one that is not finite: dropped.
  };

  /// @throws std::runtime_error  the interface is not there or has no address, DDS cannot be
  /// opened.
  explicit RosNode(const Settings& settings);
  ~RosNode();
  RosNode(const RosNode&) = delete;
  RosNode& operator=(const RosNode&) = delete;

  Commands take_commands();
  /// Never waits for the network. Without readers nothing is sent.
  void publish(const hal::Odometry& odometry);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace controllers
