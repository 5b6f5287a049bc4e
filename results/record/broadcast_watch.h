#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/frame.h"

namespace results::record {

/// Finds out why a broadcast message of a controller reached nobody. The network cannot tell,
/// because broadcasts are not acknowledged, but the receptions can. It watches the one frame by
/// which the message leaves its sender: if no radio receives that, nobody can relay the message.
class BroadcastWatch {
 public:
  /// Called for a message that no radio received, with the most frequent verdict among the radios
  /// that sensed its frame (ties go to the verdict that comes first in Verdict), or
  /// kBelowSensitivity if no radio sensed it.
  using Unheard = std::function<void(hal::AgentId, hal::MessageId, hal::Verdict)>;

  explicit BroadcastWatch(Unheard unheard) : unheard_(std::move(unheard)) {}

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame);
  void on_reception(const sim::radio::Frame& frame, hal::Verdict verdict);

  /// Decides the last broadcast of each sender if its frame has ended by `ended_at`. Earlier
  /// broadcasts were decided when the next one began.
  void finish(hal::Time ended_at);

 private:
  struct OnAir {
    std::uint64_t frame = 0;
    hal::MessageId message = 0;
    hal::Time end{};
    bool heard = false;
    std::array<std::uint32_t, hal::kVerdictCount> losses{};  ///< By verdict.
  };

  void settle(hal::AgentId sender, const OnAir& broadcast) const;

  Unheard unheard_;
  std::vector<std::optional<OnAir>> last_;  ///< By address of the sender.
};

}  // namespace results::record
