#pragma once

#include <map>
#include <vector>

#include "sim/radio/rate_control.h"

namespace sim::radio {

/// Chooses by measured success, as Linux's minstrel does (D. Smithies, F. Fietkau, 2005-2008; the
/// idea only): for each rate the share of attempts that were acknowledged, averaged over intervals
/// with exponentially falling weight. The best rate is that with the most frames in time; a share
/// of the frames begins with another one, drawn at random, so that better ones are found.
///
///   attempt     0, 1      2, 3           4, 5            from 6 on
///   mode        best      second best    most reliable   lowest
///
/// A drawn rate that takes longer than the best one is tried second, when the best one has failed:
/// it can hardly be better, and a link that is good pays nothing for asking.
class Minstrel final : public RateControl {
 public:
  Minstrel(const RateControlConfig& config, const RateLadders& ladders, hal::RandomStream random)
      : RateControl(ladders), config_(config), random_(random) {}

  const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) override;
  void on_result(hal::AgentId to, bool is_success) override;

 private:
  struct Rate {
    std::uint32_t attempts = 0, successes = 0;  ///< In this interval.
    double success = 0;                         ///< Of the intervals before.
    bool is_known = false;
  };
  struct Link {
    std::vector<Rate> rates;  ///< As the rungs of the ladder.
    hal::Time interval_end{};
    std::size_t best = 0, second = 0, most_reliable = 0;
    std::size_t drawn = 0;  ///< For this frame; `best`: none.
    std::size_t used = 0;   ///< In the attempt that is on its way.
  };

  Link& link(hal::AgentId to, hal::Time now);
  void evaluate(Link& link, const Ladder& ladder) const;
  void draw(Link& link);
  std::size_t choose(const Link& link, const Ladder& ladder, std::uint32_t attempt) const;

  RateControlConfig config_;
  hal::RandomStream random_;
  std::map<hal::AgentId, Link> links_;
};

}  // namespace sim::radio
