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

  /// So many more frames fit into the queue of the agent's station: after each frame that came in
  /// by its interface, and each that ended. On the run's thread.
  virtual void on_room(hal::AgentId agent, std::size_t frames) { (void)agent, (void)frames; }
};

}  // namespace sim::air
