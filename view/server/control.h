#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "hal/types/result.h"

namespace view::server {

/// Commands of the page to a running simulation. Agents are addresses, times are simulated ns.
struct Pause {};
struct Resume {};

/// Resumes, and pauses again after `count` events of this kind.
struct Steps {
  enum class Of : std::uint8_t { kCycle, kFrame, kEvent };
  Of of = Of::kCycle;
  std::int64_t count = 1;              ///< 1 .. 1e6
  std::optional<std::uint16_t> agent;  ///< Only events of this agent; none: of any agent.
};

/// Limits the speed to a number of simulated seconds per second.
struct Speed {
  double factor = 0;  ///< 0: as fast as possible.
};

/// A breakpoint: pauses the run whenever this happens.
struct Break {
  enum class On : std::uint8_t { kState, kMessage, kLoss, kCollision, kContact, kTime };
  On on = On::kTime;
  std::optional<std::uint16_t> agent;  ///< None: any agent.
  std::string state;                   ///< For kState; empty: any state.
  std::string topic;                   ///< For kMessage; empty: any topic.
  std::int64_t at = 0;                 ///< For kTime: ns, simulated.
};

/// Removes a breakpoint. @see RunControl::act()
struct Clear {
  std::int64_t id = 0;
};

/// Drives a robot that has no other controller.
struct DriveByHand {
  std::uint16_t agent = 0;
  double vx = 0, vy = 0;  ///< m/s, body frame
  double omega = 0;       ///< rad/s
};

using Command = std::variant<Pause, Resume, Steps, Speed, Break, Clear, DriveByHand>;

/// Receives the commands to a run. Called from the server's threads, several at a time.
class RunControl {
 public:
  virtual ~RunControl() = default;
  /// @return id of a new breakpoint; 0 for other commands. An error is a message for the user: what
  /// the run cannot do, and why.
  virtual hal::Result<std::int64_t> act(const Command& command) = 0;
};

/// Tells the progress of a run. Called from the server's threads, several at a time.
class Clock {
 public:
  struct Now {
    std::int64_t now = 0;    ///< ns, simulated
    std::int64_t until = 0;  ///< ns: the record is complete up to here.
    bool can_hold = true;    ///< In lock-step: the run can be paused, stepped and slowed down.
    bool paused = false;
    double speed = 0;  ///< Simulated seconds per second; 0: as fast as possible.
    std::optional<std::string> stopped_by{};  ///< The breakpoint that paused it, for display.
    bool ended = false;
    std::string result{};  ///< Empty until it has ended.
  };
  virtual ~Clock() = default;
  virtual Now now() const = 0;
  /// Called about once a second while a page is open, visible or not, until it is closed.
  virtual void keep() const = 0;
};

}  // namespace view::server
