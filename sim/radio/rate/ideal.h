#pragma once

#include <map>
#include <vector>

#include "sim/radio/rate/rate_control.h"

namespace sim::radio {

/// Knows what no sender can: the SINR that the receiver had during the last PPDU which it answered,
/// the lowest over that PPDU. It uses the fastest mode, for a frame of average length, that would
/// lose at most a share RateControlConfig::ideal_loss of those frames at this SINR, converted to
/// the mode's width for equal power and noise proportional to the width. It begins with the slowest
/// mode, and returns to it after 7 attempts in a row without an answer (dot11ShortRetryLimit).
class Ideal final : public RateControl {
 public:
  Ideal(const RateControlConfig& config, const RateLadders& ladders)
      : RateControl(ladders), config_(config) {}

  const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) override;
  void on_result(hal::AgentId to, bool is_success) override;
  void on_answer(hal::AgentId to, hal::Decibels snr, std::uint16_t width) override;

 private:
  /// A mode, and the lowest SINR at which it loses no more than it may.
  struct Step {
    const PhyMode* mode = nullptr;
    double time = 0;    ///< s, of a frame of average length; with MCSs without what precedes it.
    double needed = 0;  ///< A ratio, in the mode's width.
  };
  struct Link {
    std::vector<Step> steps;    ///< The faster first; the last is the slowest.
    double snr_per_width = -1;  ///< Ratio times MHz; negative: unknown.
    std::uint32_t failures = 0;
  };

  Link& link(hal::AgentId to);
  std::vector<Step> steps_to(hal::AgentId to) const;
  double needed_by(const Rung& rung) const;

  RateControlConfig config_;
  std::map<hal::AgentId, Link> links_;
};

}  // namespace sim::radio
