#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>

#include "hal/node/agent/ports.h"
#include "hal/robot/drivers/wheels.h"
#include "hal/robot/platform/event_loop.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"

namespace hal::robot::agent {

/// Sources of an emergency stop: an operator at the daemon, and any participant on its topic.
enum class StopSource : unsigned { kOperator = 1, kTopic = 2 };

/// Checks commands between a controller and the wheels. It forwards a command that moves the robot
/// only if
///   - no emergency stop is in force: it is latched for all controllers until it is released;
///   - none of the sensors that the controller requires is out of date;
/// scales the command to the limits of the operator and the motors, and stops the wheels when the
/// controller has not answered for the command timeout. The driver's own thread also does the
/// latter, by its own clock.
class DriveGuard final : public node::agent::Drive {
 public:
  struct Counts {
    std::uint64_t stopped = 0;  ///< Commands refused because of the emergency stop.
    std::uint64_t blind = 0;    ///< Commands refused because a sensor was out of date.
    std::uint64_t limited = 0;  ///< Commands that were scaled down.
    /// Times the wheels were stopped because the controller did not answer.
    std::uint64_t silences = 0;
    std::uint64_t not_connected = 0;  ///< Commands that the driver could not forward.
    bool operator==(const Counts&) const = default;
  };

  /// @param wheels, loop  outlive the guard.  @param name  of the agent, for the log.
  /// @param command_timeout  > 0
  DriveGuard(drivers::WheelDriver& wheels, platform::EventLoop& loop, Duration command_timeout,
             std::string name);
  ~DriveGuard() override;
  DriveGuard(const DriveGuard&) = delete;
  DriveGuard& operator=(const DriveGuard&) = delete;

  /// @param as_of  when the command arrived; earlier than now if it had to wait.
  /// Errors: kNotAvailable (emergency stop; blind), kNotConnected.
  Result<void> drive(const Twist2& body, Time as_of) override;
  Result<void> drive_wheels(std::span<const double> speeds, Time as_of) override;

  /// The controller answered at that time: the command timeout starts again.
  void feed(Time as_of);
  void halt() override;  ///< Stops the wheels; later commands are accepted.
  /// @param because  the silent sensor that the controller requires; empty: none is
  ///   silent.
  void set_blind(const std::string& because);

  /// Any thread: the wheels are stopped at once, even if the loop is busy. The stop is in force
  /// until each source that requested it has released it.
  void set_emergency_stop(bool stop, StopSource source = StopSource::kOperator);
  bool is_emergency_stopped() const { return stops_ != 0; }

  const Counts& counts() const { return counts_; }

 private:
  void watch();

  drivers::WheelDriver& wheels_;
  platform::EventLoop& loop_;
  Duration command_timeout_;
  std::string name_;
  std::atomic<unsigned> stops_ = 0;  ///< One bit for each source that requests a stop.
  std::string blind_because_;        ///< Empty: no sensor is silent.
  bool turning_ = false;             ///< The last command moves the robot.
  Time fed_{};
  platform::EventLoop::Handle timer_ = 0;
  Counts counts_;
};

}  // namespace hal::robot::agent
