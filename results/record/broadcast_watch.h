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
#include "sim/radio/frame.h"

namespace results::record {

/// Finds out why a broadcast of a controller reached nobody: the network cannot tell, because
/// nobody acknowledges it, but the air can. Looks at the one frame by which the message leaves its
/// sender; if no radio receives that, there is nothing to relay.
class BroadcastWatch {
 public:
  /// Told of a message that no radio received: why most radios that noticed its frame lost it (of
  /// equals, the first in Verdict), kBelowSensitivity if none noticed it.
  using Unheard = std::function<void(hal::AgentId, hal::MessageId, hal::Verdict)>;

  explicit BroadcastWatch(Unheard unheard) : unheard_(std::move(unheard)) {}

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame);
  void on_reception(const sim::radio::Frame& frame, hal::Verdict verdict);

  /// Speaks of the last broadcast of each sender, if it has left the air by `ended_at`. The earlier
  /// ones were spoken of when the next one began.
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
