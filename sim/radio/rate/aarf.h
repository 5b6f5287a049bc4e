#pragma once

#include <map>

#include "sim/radio/rate/rate_control.h"

namespace sim::radio {

/// Adaptive auto rate fallback (M. Lacage, M. H. Manshaei, T. Turletti, "IEEE 802.11 Rate
/// Adaptation: A Practical Approach", MSWiM 2004). It begins with the lowest rate.
///
///   threshold successes in a row, or timeout transmissions at one rate: probe the next higher rate
///   the probe fails: return at once to the lower rate and double the threshold, up to its maximum
///   otherwise, two failures in a row: next lower rate, and the threshold gets its initial value
///
/// The timeout grows with the threshold: otherwise a station at its best rate would continue to
/// probe in vain at the old pace.
class Aarf final : public RateControl {
 public:
  Aarf(const RateControlConfig& config, const RateLadders& ladders)
      : RateControl(ladders), config_(config) {}

  const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) override;
  void on_result(hal::AgentId to, bool is_success) override;

 private:
  struct Link {
    std::size_t rung = 0;
    std::uint32_t threshold = 0;
    std::uint32_t sent = 0;                     ///< Transmissions at this rate.
    std::uint32_t successes = 0, failures = 0;  ///< Numbers in a row.
    bool probing = false;                       ///< The rate has just been raised.
  };

  Link& link(hal::AgentId to);
  void on_success(Link& link, std::size_t top) const;
  void on_failure(Link& link) const;
  static void move(Link& link, std::size_t rung);

  RateControlConfig config_;
  std::map<hal::AgentId, Link> links_;
};

}  // namespace sim::radio
