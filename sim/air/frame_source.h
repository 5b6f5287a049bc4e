#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

/// A frame that a program sent by its agent's interface.
struct SentFrame {
  hal::AgentId agent;
  hal::Time since{};  ///< Simulated time before which it was not there: what is known of it.
  std::vector<std::uint8_t> ethernet;
};

/// The interfaces of a run in real time, as the programs write to them. On the run's thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Readable while frames are there.
  virtual int descriptor() const = 0;

  /// Takes frames that are available, up to the given number, without waiting.
  /// @throws std::runtime_error  an interface was removed.
  virtual void read(std::size_t most, const std::function<void(SentFrame)>& take) = 0;
};

}  // namespace sim::air
