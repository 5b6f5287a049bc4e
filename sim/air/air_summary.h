#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/air/ledger.h"

namespace sim::air {

/// Figures of a topic of programs so far, for tools.
struct TopicUse {
  /// Empty: not announced. Valid as long as the ledger, until the name becomes known.
  std::string_view topic;
  std::uint64_t samples = 0, delivered = 0, first_try = 0;  ///< Settled; times receiving agents.
  hal::Duration latency_median{}, latency_p99{};            ///< Lower edges of their bins.
  hal::Duration airtime{};
  double share = 0;  ///< Of the total air time.
};

/// By number of the topic.
std::vector<TopicUse> topics_of(const Ledger& ledger);

/// All transmitters and topics together; `kind` without its topic.
struct KindUse {
  AirKind kind;
  std::uint64_t frames = 0, retries = 0, submessages = 0, bits = 0;
  hal::Duration airtime{};
  double share = 0;
};

/// In the order of AirKind.
std::vector<KindUse> kinds_of(const Ledger& ledger);

}  // namespace sim::air
