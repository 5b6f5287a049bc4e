#pragma once

#include <cstdint>
#include <limits>

namespace hal::rtps {

/// What the standard allows and a receiver cannot stand: how much one datagram may make it do.
struct Limits {
  /// Of a sample that comes in fragments, octets: receivers take the memory with the first one.
  std::uint32_t sample_size = 64U << 20U;
  /// Sequence numbers that one GAP declares missing: receivers go through them one by one.
  std::int64_t gap = 1 << 20;
  /// Of a sample, and of the first one that a HEARTBEAT tells of: receivers count up to it one by
  /// one from the last they know.
  std::int64_t sequence_number = std::numeric_limits<std::int64_t>::max() - 1;
  /// Whether discovery may tell of participants other than the one that sends it, as discovery
  /// servers do.
  bool relayed_discovery = true;
};

}  // namespace hal::rtps
