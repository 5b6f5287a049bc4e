#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "hal/types/result.h"

namespace view::server {

/// What the page may ask of a run that goes on. Agents are addresses, times simulated ns.
struct Pause {};
struct Resume {};

/// Goes on until so many more of these have been, then pauses.
struct Steps {
  enum class Of : std::uint8_t { kCycle, kFrame, kEvent };
  Of of = Of::kCycle;
  std::int64_t count = 1;              ///< 1 .. 1e6
  std::optional<std::uint16_t> agent;  ///< Only this one's; none: anyone's.
};

/// At most so many simulated seconds per second.
struct Speed {
  double factor = 0;  ///< 0: as fast as possible.
};

/// Pauses whenever this happens.
struct Break {
  enum class On : std::uint8_t { kState, kMessage, kLoss, kCollision, kContact, kTime };
  On on = On::kTime;
  std::optional<std::uint16_t> agent;  ///< None: anybody.
  std::string state;                   ///< Of kState; empty: any.
  std::string topic;                   ///< Of kMessage; empty: any.
  std::int64_t at = 0;                 ///< Of kTime.
};

/// Forgets a break. @see RunControl::act()
struct Clear {
  std::int64_t id = 0;
};

/// Drives a robot that nobody else does.
struct DriveByHand {
  std::uint16_t agent = 0;
  double vx = 0, vy = 0;  ///< m/s, body frame
  double omega = 0;       ///< rad/s
};

using Command = std::variant<Pause, Resume, Steps, Speed, Break, Clear, DriveByHand>;

/// What commands a run. Called from the server's threads, several at a time.
class RunControl {
 public:
  virtual ~RunControl() = default;
  /// @return id of a break; else 0. An error is for people: what the run cannot do, and why.
  virtual hal::Result<std::int64_t> act(const Command& command) = 0;
};

/// How far a run is. Of the server's threads, several at a time.
class Clock {
 public:
  struct Now {
    std::int64_t now = 0;    ///< ns, simulated
    std::int64_t until = 0;  ///< ns: up to here the record can be read.
    bool can_hold = true;    ///< In lock-step: it may be paused, stepped and slowed.
    bool paused = false;
    double speed = 0;  ///< Simulated seconds per second; 0: as fast as possible.
    std::optional<std::string> stopped_by{};  ///< Which break paused it, for people.
    bool ended = false;
    std::string result{};  ///< Once it has ended.
  };
  virtual ~Clock() = default;
  virtual Now now() const = 0;
  /// A page is open, whether somebody sees it or not: it says so once a second until it is closed.
  virtual void keep() const = 0;
};

}  // namespace view::server
