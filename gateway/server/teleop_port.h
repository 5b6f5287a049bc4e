#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gateway/inspection/twist_reader.h"
#include "hal/node/exchange/ports.h"

namespace gateway::server {

/// Name of the controller, in a scenario's `program:`, that is built in: it hands on the velocities
/// that come on `rt/<agent>/cmd_vel`, from ROS 2's teleop_twist_keyboard for example.
inline constexpr const char* kTeleop = "teleop";

/// Drives one robot as it is told from outside: at each control event the last velocity since the
/// event before becomes an action. If none came in time for another control event within the
/// command timeout, in simulated time, it stops the robot; so it needs a run in real time. After a
/// pause between control events that is longer than that, what came before or during it is not
/// obeyed: the computer of a real robot may have slept. Nor is what comes within another command
/// timeout, as some of it may have waited in between.
class TeleopPort final : public hal::node::exchange::ControllerPort {
 public:
  /// The last velocity that came, and its number; none so far.
  using LastCommand = std::function<std::optional<inspection::TwistReader::Command>()>;

  /// @param last  asked at each control event, on the thread that calls begin().
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
  std::uint64_t obeyed_ = 0;  ///< Number of the last command.
  hal::Time obeyed_at_{};
  hal::Time last_event_{}, deaf_until_{};
  bool driving_ = false;
  hal::node::exchange::Reply reply_;
};

}  // namespace gateway::server
