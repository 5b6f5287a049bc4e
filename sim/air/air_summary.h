#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/air/ledger.h"

namespace sim::air {

/// Counts of one topic of programs up to now, for tools.
struct TopicUse {
  /// Empty if not announced. Valid as long as the ledger, until the name becomes known.
  std::string_view topic;
  /// Settled samples, counted once for each receiving agent.
  std::uint64_t samples = 0, delivered = 0, first_try = 0;
  hal::Duration latency_median{}, latency_p99{};  ///< Lower edges of their bins.
  hal::Duration airtime{};
  double share = 0;  ///< Share of the total air time.
};

/// The topics, by number.
std::vector<TopicUse> topics_of(const Ledger& ledger);

/// Sums over all transmitters and topics; the topic of `kind` is not set.
struct KindUse {
  AirKind kind;
  std::uint64_t frames = 0, retries = 0, submessages = 0, bits = 0;
  hal::Duration airtime{};
  double share = 0;
};

/// The kinds, in the order of AirKind.
std::vector<KindUse> kinds_of(const Ledger& ledger);

}  // namespace sim::air
