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
/// `rt/<agent>/cmd_vel`, body frame, m/s and rad/s. Components that a planar robot lacks are
/// ignored; a command with any value that is not finite is dropped and counted.
class TwistReader {
 public:
  struct Command {
    hal::Twist2 twist;
    /// Number of the valid command, from 1: distinguishes a repeated command from no new one.
    std::uint64_t number = 0;
  };

  /// @param on_command  called on a thread of DDS with each valid command; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  TwistReader(InspectionParticipant& participant, const std::string& agent,
              std::function<void(const Command&)> on_command = {});
  ~TwistReader();
  TwistReader(const TwistReader&) = delete;
  TwistReader& operator=(const TwistReader&) = delete;

  std::optional<Command> last() const;  ///< Any thread.
  std::uint64_t dropped() const;        ///< Number of dropped commands. Any thread.
  int writers() const;                  ///< Writers matched now. Any thread.

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
