#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "sim/radio/rate/rate_control.h"

namespace sim::radio {

/// Chooses rates by measured success, as Linux's minstrel does (D. Smithies, F. Fietkau; the
/// algorithm of net/mac80211/rc80211_minstrel.c of 2013-2014, reimplemented). For each rate it
/// averages the ratio of acknowledged attempts over intervals with exponentially decreasing weight;
/// the best rate is the one with the most frames per airtime. A share of the frames samples another
/// rate; rates are sampled in turn, in random order.
///
///   stage of the frame       1          2             3               4
///   a normal frame           best       second best   most reliable   lowest
///   samples a faster rate    sampled    best          most reliable   lowest
///   samples a slower rate    best       sampled       most reliable   lowest
///
/// Sampling slower rates therefore costs nothing on a good link; but a slower rate that had no
/// attempt for 20 intervals is tried first. In each of the first three stages a frame is tried as
/// often as fits into 6 ms, and at most twice if the rate nearly always (95 %) or hardly ever
/// (10 %) succeeds; such a rate is sampled in at most 4 frames of an interval.
class Minstrel final : public RateControl {
 public:
  Minstrel(const RateControlConfig& config, const RateLadders& ladders, hal::RandomStream random)
      : RateControl(ladders), config_(config), random_(random) {}

  const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) override;
  const PhyMode& reliable_mode(hal::AgentId to, hal::Time now) override;
  void on_result(hal::AgentId to, bool is_success) override;

 private:
  struct Rate {
    std::uint32_t attempts = 0, successes = 0;  ///< In this interval.
    double success = 0;                         ///< Weighted mean of the previous intervals.
    bool is_known = false;
    std::uint32_t tries = 0;               ///< Most attempts of one frame in one stage.
    std::optional<std::uint32_t> looks{};  ///< Samples left in this interval; nullopt: unlimited.
    std::uint32_t intervals_without = 0;   ///< Intervals since the last attempt.
  };
  struct Link {
    std::vector<Rate> rates;  ///< One per rung of the ladder.
    hal::Time interval_end{};
    std::size_t best = 0, second = 0, most_reliable = 0;
    std::vector<std::size_t> order;        ///< Sampling order; rates still to come.
    std::uint32_t frames = 0, looked = 0;  ///< `looked`: the frames that sampled another rate.
    std::array<std::size_t, 4> stages{};   ///< Rates of the current frame.
    bool is_begun = false;                 ///< The current frame has no result yet.
    std::size_t used = 0;                  ///< Rate of the attempt in progress.
  };

  Link& link(hal::AgentId to, hal::Time now);
  void begin(Link& link, const Ladder& ladder) const;
  void evaluate(Link& link, const Ladder& ladder) const;
  static void rank(Link& link, const Ladder& ladder);
  void start_frame(Link& link, const Ladder& ladder);
  bool is_to_look(Link& link) const;
  void look_around(Link& link, const Ladder& ladder);
  std::size_t next_in_order(Link& link);

  RateControlConfig config_;
  hal::RandomStream random_;
  std::map<hal::AgentId, Link> links_;
};

}  // namespace sim::radio
