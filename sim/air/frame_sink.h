#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

/// Receives the frames for agents' interfaces.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// Called with an Ethernet II frame, destination address first, without preamble and check
  /// sequence, whose reception by this agent ended at `at`, which is now. On the run's thread.
  virtual void on_frame(hal::AgentId agent, hal::Time at,
                        std::span<const std::uint8_t> ethernet) = 0;

  /// Free places in the queue of the agent's station, in frames. Reported whenever frames of its
  /// programs have arrived or ended, and at other times. Frames that FrameSource::read() has
  /// returned so far count as queued. On the run's thread.
  struct Room {
    std::size_t free = 0;
    std::size_t capacity = 0;  ///< Places in the empty queue.
  };
  virtual void on_room(hal::AgentId agent, const Room& room) = 0;
};

}  // namespace sim::air
