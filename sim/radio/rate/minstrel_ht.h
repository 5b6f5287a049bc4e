#pragma once

#include <array>
#include <map>
#include <vector>

#include "sim/radio/rate/minstrel.h"

namespace sim::radio {

/// Chooses modes with MCSs by measured success, as Linux's minstrel_ht does (F. Fietkau, 2010; the
/// algorithm as it is described there and by D. Smithies; nothing of it is copied). Modes form
/// groups by streams, width and guard interval. For each mode the share of MPDUs that were
/// acknowledged is averaged over intervals with exponentially decreasing weight. Its throughput is
/// that share, 0 if below 10 % and 90 % at most, divided by the time of an MPDU in an A-MPDU of
/// mean length with its overhead. Chain of a PPDU, whose next stage comes when nothing was
/// acknowledged:
///
///   stage of the PPDU     1         2             3
///   a normal one          best      second best   most reliable
///   a sample              sampled   best          most reliable
///
/// A sample is one attempt. Between two samples there are 16 PPDUs and twice the mean number of
/// MPDUs in an A-MPDU more, and an interval has 16 samples at most; a new link begins with four at
/// once. Groups take turns, and the modes of each in random order. Modes that nearly always succeed
/// (95 %) are not sampled, nor those that are slower than the second best, unless the latter had no
/// attempt for 20 intervals: then at most two in an interval.
///
/// Stations without MCSs are served by Minstrel.
class MinstrelHt final : public RateControl {
 public:
  MinstrelHt(const RateControlConfig& config, const RateLadders& ladders, hal::RandomStream random)
      : RateControl(ladders), config_(config), random_(random), legacy_(config, ladders, random) {}

  const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) override;
  const PhyMode& reliable_mode(hal::AgentId to, hal::Time now) override;
  void on_result(hal::AgentId to, bool is_success) override;
  void on_aggregate(hal::AgentId to, std::uint32_t received, std::uint32_t sent) override;

 private:
  struct Rate {
    const Rung* rung = nullptr;
    std::uint32_t attempts = 0, successes = 0;  ///< MPDUs in this interval.
    double success = 0;                         ///< Weighted mean of the previous intervals.
    bool is_known = false;
    double throughput = 0;                ///< MPDUs of average length a second.
    std::uint32_t tries = 0;              ///< Most attempts of one PPDU in one stage.
    std::uint32_t intervals_without = 0;  ///< Intervals since the last attempt.
  };
  struct Group {
    std::size_t first = 0, size = 0;  ///< Its part of Link::rates.
    std::vector<std::size_t> order;   ///< Sampling order; rates still to come.
  };
  struct Link {
    std::vector<Rate> rates;  ///< Group by group.
    std::vector<Group> groups;
    hal::Time interval_end{};
    std::size_t best = 0, second = 0, most_reliable = 0;
    std::uint32_t ppdus = 0, mpdus = 0;  ///< In this interval.
    double mean_mpdus = 1;               ///< Of a PPDU, weighted like success.
    std::size_t next_group = 0;          ///< To sample from.
    std::uint32_t wait = 0;              ///< PPDUs before the next sample.
    std::uint32_t looks = 0, slow_looks = 0, first_looks = 0;  ///< Samples left.
    std::array<std::size_t, 3> stages{};                       ///< Rates of the current PPDU.
    std::array<std::uint32_t, 2> tries{};                      ///< Attempts of the first stages.
    bool is_begun = false;                                     ///< The PPDU is not yet received.
    std::uint32_t failures = 0;                                ///< Attempts to send it.
    std::size_t used = 0;                                      ///< Rate of the attempt in progress.
  };

  Link& link(hal::AgentId to, hal::Time now);
  static void begin(Link& link, const std::vector<Ladder>& groups);
  void evaluate(Link& link) const;
  void average(Rate& rate) const;
  static void measure(Link& link, Rate& rate);
  static void rank(Link& link);
  void start_ppdu(Link& link);
  bool look_around(Link& link);
  static bool is_worth_a_look(Link& link, std::size_t rate);
  std::size_t next_in_order(Group& group);
  void note(Link& link, std::uint32_t received, std::uint32_t sent) const;

  RateControlConfig config_;
  hal::RandomStream random_;
  Minstrel legacy_;
  std::map<hal::AgentId, Link> links_;
};

}  // namespace sim::radio
