#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "hal/types/time.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/channel/station_index.h"

namespace sim::radio {

/// Received power and delay of one station's frames at another, valid while neither of them moves.
struct AudibleLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;  ///< Sum of both stations' `moves` when this was computed.
  Propagation::Arrival arrival;
  Propagation::Steady steady;  ///< Basis from which `arrival` was last evaluated.
};

/// A link whose frames are only interference.
struct FaintLink {
  double power = 0;  ///< mW
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
  std::uint32_t delay = 0;  ///< ns
};

/// Links whose frames are only interference, to receivers that ask for the power when they need it
/// (FaintFrames). In order of receivers.
class AskedLinks {
 public:
  struct Link {
    StationIndex receiver = 0;
    float most = 0;  ///< mW; no more will arrive as long as the link is certain.
  };
  /// Simulated time in steps of 2^20 ns, which a link needs to know no better.
  using Tick = std::uint32_t;
  static constexpr Tick kForEver = std::numeric_limits<Tick>::max();
  static Tick tick(hal::Time time);

  const std::vector<Link>& all() const { return links_; }
  /// Before this tick all links are faint, wherever their ends go, so far as they can.
  Tick certain_until() const { return earliest_; }

  /// @param until  the link is certain to remain faint before this tick.
  void insert(const Link& link, Tick until);
  void erase(StationIndex receiver);
  void shrink();

  /// Looks at the links that are no longer certain at `now`. @param renew  gets a receiver and a
  /// Link and a Tick to set; returns whether it is still faint. The others are removed.
  template <class Renew>
  void renew(Tick now, Renew&& renew);

 private:
  std::vector<Link> links_;
  std::vector<Tick> until_;  ///< Of each.
  Tick earliest_ = kForEver;
};

/// A pair that is out of range, but close enough to come into range before a cell changes.
struct DistantLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
  hal::Time out_of_reach_until{};  ///< Whatever the movement of the two.
};

/// Links from one station to all stations that its frames can affect, each list in order of
/// receivers.
struct Links {
  std::vector<AudibleLink> audible;
  std::vector<FaintLink> faint;
  AskedLinks asked;
  std::vector<DistantLink> distant;
  std::vector<std::uint32_t> by_arrival;  ///< Indices into `audible`, ordered by (delay, receiver).
  hal::Time out_of_reach_until{};         ///< All distant ones are.
  bool is_fixed = true;                   ///< The transmitter and all stations in range never move.
};

template <class Renew>
void AskedLinks::renew(Tick now, Renew&& renew) {
  if (now < earliest_) return;
  std::size_t kept = 0;
  earliest_ = kForEver;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link link = links_[i];
    Tick until = until_[i];
    if (until <= now && !renew(link, until)) continue;
    links_[kept] = link;
    until_[kept++] = until;
    earliest_ = until < earliest_ ? until : earliest_;
  }
  links_.resize(kept);
  until_.resize(kept);
}

}  // namespace sim::radio
