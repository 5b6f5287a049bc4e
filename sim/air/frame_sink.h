#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

/// Who takes what comes off the air for the agents' interfaces.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// An Ethernet II frame, destination address first, without preamble and check sequence, whose
  /// reception by this agent ended at `at`, now. On the run's thread.
  virtual void on_frame(hal::AgentId agent, hal::Time at,
                        std::span<const std::uint8_t> ethernet) = 0;

  /// Room in the queue of the agent's station, frames: whenever frames from its programs have come
  /// in or ended, and now and then. What FrameSource::read() has handed over until now is counted
  /// as if it were there. On the run's thread.
  struct Room {
    std::size_t free = 0;
    std::size_t capacity = 0;  ///< When the queue is empty.
  };
  virtual void on_room(hal::AgentId agent, const Room& room) = 0;
};

}  // namespace sim::air
