#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gateway/inspection/inspection_participant.h"
#include "hal/types/geometry.h"

namespace gateway::inspection {

/// Reads velocity commands for one agent: geometry_msgs/Twist (ROS 2 Humble) on
/// `rt/<agent>/cmd_vel`, body frame, m/s and rad/s. Components a planar robot does not have are
/// dropped; a command with a value that is not finite is dropped as a whole and counted.
class TwistReader {
 public:
  struct Command {
    hal::Twist2 twist;
    std::uint64_t number = 0;  ///< 1, 2, 3, … of the good ones: tells a repeated command from none.
  };

  /// @param on_command  called on a thread of DDS with each good command; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  TwistReader(InspectionParticipant& participant, const std::string& agent,
              std::function<void(const Command&)> on_command = {});
  ~TwistReader();
  TwistReader(const TwistReader&) = delete;
  TwistReader& operator=(const TwistReader&) = delete;

  std::optional<Command> last() const;  ///< Any thread.
  std::uint64_t dropped() const;        ///< Any thread.
  int writers() const;                  ///< In sight now. Any thread.

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
