#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "controllers/ros_base/base_settings.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace controllers {

/// The node of a base among ROS 2 nodes (Humble): reads velocity commands, Twist or TwistStamped on
/// `cmd_vel`, and writes the topics of base_topics(), on one network interface only, over UDP, with
/// the discovery of ROS 2's middleware.
///
/// Threads of DDS only store commands, which take_commands() returns. All functions are called from
/// one thread and do not block.
class RosNode {
 public:
  static constexpr const char* kName = "ros_base";
  using Stamp = builtin_interfaces::msg::dds_::Time_;

  /// Commands since the previous call.
  struct Commands {
    std::optional<hal::Twist2> last;  ///< Body frame.
    std::uint64_t count = 0;          ///< With finite components.
    std::uint64_t senseless = 0;      ///< Dropped because a component was not finite.
  };

  /// @param interface  e.g. "wlan0"; its first IPv4 address is used.
  /// @param settings  whose `topics` are those that the robot can offer.
  /// @throws std::runtime_error  the interface does not exist or has no address, or DDS fails to
  ///   open.
  RosNode(const std::string& interface, const BaseSettings& settings);
  ~RosNode();
  RosNode(const RosNode&) = delete;
  RosNode& operator=(const RosNode&) = delete;

  Commands take_commands();

  bool offers(std::string_view topic) const;

  /// Writes a message of the topic's type, if the topic is offered. Never blocks on the network.
  /// Without readers nothing is sent, but a topic for late readers keeps it.
  /// @param topic  a key of base_topics().
  template <class Message>
  void write(std::string_view topic, Message& message) {
    write_raw(topic, &message);
  }

  /// Stamp of a message: of the clock of the process, like those of any node, or with use_sim_time
  /// `now`.
  Stamp stamp(hal::Time now) const;

 private:
  void write_raw(std::string_view topic, void* message);

  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace controllers
