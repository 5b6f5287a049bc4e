#pragma once

#include <cstdint>

namespace sim::scenario {

/// How much is recorded of something that may be frequent.
enum class Detail : std::uint8_t {
  kNone,    ///< Nothing.
  kCounts,  ///< Counts per agent, peer, class and verdict.
  /// Counts, and rows for some: of frames, and of messages to more than one agent, for the first
  /// ones of each simulated second; for all other messages.
  kSample,
  /// A row for each (about 1 us of run time): for frames besides the counts, for messages instead.
  kAll,
};

}  // namespace sim::scenario
