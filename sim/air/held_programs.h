#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

/// The unmodified programs of a run in lock-step: they go on only when the run says so, until all
/// of them wait. On the run's thread.
class HeldPrograms {
 public:
  virtual ~HeldPrograms() = default;

  /// Virtual time of the next program that is to be started; none: all were.
  virtual std::optional<hal::Time> next_start() const = 0;
  /// Starts it, and holds it. @return its agent. @throws std::runtime_error  it cannot be started.
  virtual hal::AgentId start_next(hal::Time now) = 0;

  /// Ends the waits of an agent's programs whose deadline has come, and lets the programs go on
  /// until all wait. They see `now`. Hands over the Ethernet frames that they have sent, in order.
  /// @return false: the run is to be broken off.
  /// @throws std::runtime_error  a program cannot be held.
  virtual bool go_on(hal::AgentId agent, hal::Time now,
                     const std::function<void(std::span<const std::uint8_t>)>& take) = 0;

  /// Calls this for each agent of which a program has begun or gone on since its last turn, without
  /// a frame: `baraka exec` started it, or somebody types at it.
  virtual void find_changed(const std::function<void(hal::AgentId)>& found) = 0;

  /// To be asked while the run waits before its next instant. Calls this for each agent whose
  /// kernel or programs do something at a time of the wall clock, with the virtual time that this
  /// is; there are such only while the programs make the run keep to wall time.
  virtual void find_due(const std::function<void(hal::AgentId, hal::Time)>& found) = 0;

  /// Whether one of them waits for room in the queue of the agent's station.
  virtual bool waits_for_room(hal::AgentId agent) const = 0;
  /// Whether the last FrameSink::on_room() has made one of them want to go on.
  virtual bool has_woken(hal::AgentId agent) const = 0;

  /// The earliest deadline of their waits; none: they wait for others only.
  virtual std::optional<hal::Time> deadline(hal::AgentId agent) const = 0;
};

}  // namespace sim::air
