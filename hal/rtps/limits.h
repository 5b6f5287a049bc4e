#pragma once

#include <cstdint>
#include <limits>

namespace hal::rtps {

/// Limits on the work that one datagram may cause in a receiver, where the standard sets none.
struct Limits {
  /// Size of a fragmented sample, octets: receivers allocate it with the first fragment.
  std::uint32_t sample_size = 64U << 20U;
  /// Sequence numbers that one GAP declares missing: receivers process them one by one.
  std::int64_t gap = 1 << 20;
  /// Sequence number of a sample, and the first one in a HEARTBEAT: receivers count up to it one by
  /// one from the last one they know.
  std::int64_t sequence_number = std::numeric_limits<std::int64_t>::max() - 1;
  /// Whether discovery may describe participants other than its sender, as discovery servers do.
  bool relayed_discovery = true;
};

}  // namespace hal::rtps
