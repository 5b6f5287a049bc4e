#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "sim/radio/rate_control.h"

namespace sim::radio {

/// Chooses by measured success, as Linux's minstrel does (D. Smithies, F. Fietkau; the algorithm of
/// net/mac80211/rc80211_minstrel.c of 2013-2014, reimplemented). For each rate it averages the
/// ratio of acknowledged attempts over intervals with exponentially decreasing weight; the best
/// rate is that with the most frames per time on the air. A share of the frames samples another
/// rate, each rate in turn in an order drawn at random.
///
///   stage of the frame       1          2             3               4
///   a normal one             best       second best   most reliable   lowest
///   samples a faster rate    that one   best          most reliable   lowest
///   samples a slower rate    best       that one      most reliable   lowest
///
/// A good link therefore pays nothing for sampling slower rates; after 20 intervals without an
/// attempt a slower rate is nevertheless tried first. In each of the first three stages a frame is
/// tried as often as fits into 6 ms, and at most twice if the rate nearly always (95 %) or hardly
/// ever (10 %) succeeds: such a rate is sampled in at most 4 frames of an interval.
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
    std::uint32_t tries = 0;               ///< Of one frame in one stage.
    std::optional<std::uint32_t> looks{};  ///< Left in this interval; none: as many as come.
    std::uint32_t intervals_without = 0;   ///< Since it was tried last.
  };
  struct Link {
    std::vector<Rate> rates;  ///< As the rungs of the ladder.
    hal::Time interval_end{};
    std::size_t best = 0, second = 0, most_reliable = 0;
    std::vector<std::size_t> order;        ///< In which rates are looked at; those to come.
    std::uint32_t frames = 0, looked = 0;  ///< So many of them looked around.
    std::array<std::size_t, 4> stages{};   ///< Of this frame.
    bool is_begun = false;                 ///< No result of this frame has come yet.
    std::size_t used = 0;                  ///< In the attempt that is on its way.
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
