#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gateway/inspection/twist_reader.h"
#include "hal/node/exchange/ports.h"

namespace gateway::server {

/// Name of the built-in controller, for a scenario's `program:`. It passes on the velocities that
/// arrive on `rt/<agent>/cmd_vel`, for example from ROS 2's teleop_twist_keyboard.
inline constexpr const char* kTeleop = "teleop";

/// Drives one robot by commands from outside. At each control event, the latest velocity that
/// arrived since the previous event becomes an action. If no velocity arrives within the command
/// timeout (in simulated time), it stops the robot at the last control event before the timeout
/// ends; so it needs a run in real time. After a pause between control events that is longer than
/// the timeout and than two control periods, commands from before or during the pause are not
/// obeyed, because the computer of a real robot may have slept; nor are those that arrive within
/// another command timeout, because some of them may have waited.
class TeleopPort final : public hal::node::exchange::ControllerPort {
 public:
  /// The latest velocity that arrived, and its number; none if there was none yet.
  using LastCommand = std::function<std::optional<inspection::TwistReader::Command>()>;

  /// @param last  called at each control event, on the thread that calls begin().
  TeleopPort(const std::string& agent, LastCommand last, hal::Duration command_timeout,
             hal::Duration control_period);

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;  ///< Never fails.
  hal::Result<hal::node::exchange::Reply> finish() override;                ///< Never fails.
  hal::Result<void> check_alive() override { return {}; }

 private:
  void answer(const hal::node::exchange::Event& event, std::uint32_t index);

  std::string name_;
  hal::Duration command_timeout_, control_period_;
  LastCommand last_;
  std::uint64_t obeyed_ = 0;  ///< Number of the last command that was obeyed.
  hal::Time obeyed_at_{};
  hal::Time last_event_{}, deaf_until_{};
  bool driving_ = false;
  hal::node::exchange::Reply reply_;
};

}  // namespace gateway::server
