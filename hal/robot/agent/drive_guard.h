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

/// Who may pull the emergency stop: somebody at the daemon, and whoever is on its topic.
enum class StopSource : unsigned { kOperator = 1, kTopic = 2 };

/// Stands between a controller and the wheels. It lets a command through only if
///   - no emergency stop is in force: it is latched, whoever commands, until it is released;
///   - the robot sees: none of the sensors the controller steers by is out of date;
/// scales it to the operator's limits and the motors', and stops the wheels when the controller has
/// been silent for the command timeout. The driver's own thread does that, too, by its own clock.
class DriveGuard final : public node::agent::Drive {
 public:
  struct Counts {
    std::uint64_t stopped = 0;        ///< Commands refused by the emergency stop …
    std::uint64_t blind = 0;          ///< … or because a sensor was out of date.
    std::uint64_t limited = 0;        ///< Commands that were scaled down.
    std::uint64_t silences = 0;       ///< Times the wheels were stopped for want of an answer.
    std::uint64_t not_connected = 0;  ///< Commands that the driver could not pass on.
    bool operator==(const Counts&) const = default;
  };

  /// @param wheels, loop  outlive the guard.  @param name  of the agent, for the log.
  /// @param command_timeout  > 0
  DriveGuard(drivers::WheelDriver& wheels, platform::EventLoop& loop, Duration command_timeout,
             std::string name);
  ~DriveGuard() override;
  DriveGuard(const DriveGuard&) = delete;
  DriveGuard& operator=(const DriveGuard&) = delete;

  /// @param as_of  when the command came in: not now, if anything lies in between.
  /// Errors: kNotAvailable (emergency stop; blind), kNotConnected.
  Result<void> drive(const Twist2& body, Time as_of) override;
  Result<void> drive_wheels(std::span<const double> speeds, Time as_of) override;

  /// The controller answered then: the command timeout begins anew.
  void feed(Time as_of);
  void halt() override;  ///< Wheels stop; the next command is welcome.
  /// @param because  which sensor that the controller steers by is silent; empty: none is.
  void set_blind(const std::string& because);

  /// Any thread: the wheels are told at once, whatever the loop is doing. In force until each
  /// source that stopped has released.
  void set_emergency_stop(bool stop, StopSource source = StopSource::kOperator);
  bool is_emergency_stopped() const { return stops_ != 0; }

  const Counts& counts() const { return counts_; }

 private:
  void watch();

  drivers::WheelDriver& wheels_;
  platform::EventLoop& loop_;
  Duration command_timeout_;
  std::string name_;
  std::atomic<unsigned> stops_ = 0;  ///< A bit for each source that stops.
  std::string blind_because_;        ///< Empty: it sees.
  bool turning_ = false;             ///< As commanded last.
  Time fed_{};
  platform::EventLoop::Handle timer_ = 0;
  Counts counts_;
};

}  // namespace hal::robot::agent
