#pragma once

#include <cstdint>

namespace sim::scenario {

/// What is written of something that there may be much of.
enum class Detail : std::uint8_t {
  kNone,    ///< Nothing.
  kCounts,  ///< Counts per agent, peer, class and verdict.
  kSample,  ///< Of frames: counts, and rows for the first ones of each simulated second.
  kAll,  ///< A row for each, about 1 us: of frames beside the counts, of messages in their place.
};

}  // namespace sim::scenario
