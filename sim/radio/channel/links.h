#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "hal/types/prefetch.h"
#include "hal/types/time.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/channel/station_index.h"

namespace sim::radio {

/// Simulated time in steps of 2^20 ns, which a link needs to know no better.
using Tick = std::int32_t;
constexpr Tick kForEver = std::numeric_limits<Tick>::max();
/// Never later than `time`.
Tick tick(hal::Time time);

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

/// Links that remain what they are for some time, wherever their ends go, so far as they can. In
/// order of receivers.
/// @tparam Link  has a `receiver`.
template <class Link>
class CertainLinks {
 public:
  const std::vector<Link>& all() const { return links_; }

  /// @param until  the link is certain before this tick.
  void insert(const Link& link, Tick until);
  void erase(StationIndex receiver);
  void shrink();

  /// Prefetches the memory that renew() will read.
  void prefetch() const { hal::prefetch(until_); }

  /// Looks at the links that are no longer certain at `now`. @param renew  gets a Link and a Tick
  /// to set; returns whether it is still what it was. The others are removed.
  template <class Renew>
  void renew(Tick now, Renew&& renew);

 private:
  /// So many ticks are compared at once, before one is looked at: most are not due.
  static constexpr std::size_t kAtOnce = 16;

  Tick earliest_of(std::size_t first, std::size_t last) const;
  template <class Renew>
  Tick renew_some(std::size_t first, std::size_t last, Tick now, Renew& renew);
  /// @return an iterator of links_.
  auto place_of(StationIndex receiver) const {
    return std::ranges::lower_bound(links_, receiver, {}, &Link::receiver);
  }
  void erase_at(std::ptrdiff_t place) {
    until_.erase(until_.begin() + place);
    links_.erase(links_.begin() + place);
  }

  std::vector<Link> links_;
  std::vector<Tick> until_;  ///< Of each.
  Tick earliest_ = kForEver;
};

/// A link whose frames are only interference, to a receiver that asks for the power when it needs
/// it (FaintFrames).
struct AskedLink {
  StationIndex receiver = 0;
  float most = 0;  ///< mW; no more will arrive as long as the link is certain.
};

/// A pair that is out of range, but close enough to come into range before a cell changes.
struct DistantLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
};

/// Links from one station to all stations that its frames can affect, each list in order of
/// receivers.
struct Links {
  std::vector<AudibleLink> audible;
  std::vector<FaintLink> faint;
  CertainLinks<AskedLink> asked;
  CertainLinks<DistantLink> distant;
  std::vector<std::uint32_t> by_arrival;  ///< Indices into `audible`, ordered by (delay, receiver).
  bool is_fixed = true;                   ///< The transmitter and all stations in range never move.
};

template <class Link>
void CertainLinks<Link>::insert(const Link& link, Tick until) {
  const auto place = place_of(link.receiver);
  until_.insert(until_.begin() + (place - links_.begin()), until);
  links_.insert(place, link);
  earliest_ = std::min(earliest_, until);
}

template <class Link>
void CertainLinks<Link>::erase(StationIndex receiver) {
  const auto place = place_of(receiver);
  if (place != links_.end() && place->receiver == receiver) erase_at(place - links_.begin());
}

template <class Link>
void CertainLinks<Link>::shrink() {
  links_.shrink_to_fit();
  until_.shrink_to_fit();
}

template <class Link>
template <class Renew>
void CertainLinks<Link>::renew(Tick now, Renew&& renew) {
  if (now < earliest_) return;
  earliest_ = kForEver;
  for (std::size_t first = 0; first < until_.size(); first += kAtOnce) {
    const std::size_t last = std::min(first + kAtOnce, until_.size());
    Tick earliest = earliest_of(first, last);
    if (earliest <= now) earliest = renew_some(first, last, now, renew);
    earliest_ = std::min(earliest_, earliest);
  }
}

template <class Link>
Tick CertainLinks<Link>::earliest_of(std::size_t first, std::size_t last) const {
  const Tick* const until = until_.data() + first;
  Tick earliest = kForEver;
  if (last - first == kAtOnce) {  // known when compiled, so that several are compared at once
    for (std::size_t i = 0; i < kAtOnce; ++i) earliest = until[i] < earliest ? until[i] : earliest;
    return earliest;
  }
  for (std::size_t i = 0; i < last - first; ++i) earliest = std::min(earliest, until[i]);
  return earliest;
}

template <class Link>
template <class Renew>
Tick CertainLinks<Link>::renew_some(std::size_t first, std::size_t last, Tick now, Renew& renew) {
  Tick earliest = kForEver;
  for (std::size_t i = first; i < std::min(last, until_.size());) {
    if (until_[i] <= now && !renew(links_[i], until_[i])) {
      erase_at(static_cast<std::ptrdiff_t>(i));
      continue;
    }
    earliest = std::min(earliest, until_[i++]);
  }
  return earliest;
}

}  // namespace sim::radio
