#pragma once

#include <cstdint>
#include <string>

#include "hal/node/exchange/ports.h"

namespace gateway::exchange {

/// Replies that a link has dropped.
struct DroppedReplies {
  std::uint64_t stale = 0;      ///< Old or unknown sequence number, another run or process.
  std::uint64_t malformed = 0;  ///< See convert.h; the first is logged.
  std::uint64_t foreign = 0;    ///< From a participant that was not granted the agents.
  std::string first_foreign;    ///< The first such participant.
};

/// The server's end of the exchange with one controller process.
class ControllerLink : public hal::node::exchange::ControllerPort {
 public:
  virtual const DroppedReplies& dropped() const = 0;
  /// Wakes up poll() when the process dies; -1 if it runs on another host.
  virtual int death_descriptor() const = 0;
};

}  // namespace gateway::exchange
