#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

/// A frame that a program sent through its agent's interface.
struct SentFrame {
  hal::AgentId agent;
  hal::Time since{};  ///< Lower bound of the simulated time at which it was sent.
  std::vector<std::uint8_t> ethernet;
};

/// The source of frames that programs write to their interfaces, in a real-time run. On the run's
/// thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// File descriptor that is readable while frames are available.
  virtual int descriptor() const = 0;

  /// Takes available frames, at most `most`, without waiting.
  /// @throws std::runtime_error  an interface was removed.
  virtual void read(std::size_t most, const std::function<void(SentFrame)>& take) = 0;
};

}  // namespace sim::air
