// The links of Neighbourhood: collected when a neighbourhood has changed, and followed as stations
// move.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/radio/channel/neighbourhood.h"

namespace sim::radio {
namespace {

void take(AudibleLink& link, const AudibleLink& now) { link = now; }

void take(FaintLink& link, const AudibleLink& now) {
  link.power = now.arrival.power.value;
  link.delay = static_cast<std::uint32_t>(now.arrival.delay.count());
}

/// Not below the power [mW] despite its fewer digits.
float at_least(double power) { return static_cast<float>(power * (1 + 1e-6) + 1e-37); }

}  // namespace

AudibleLink Neighbourhood::link(StationIndex transmitter, StationIndex receiver) const {
  const Station& from = stations_[transmitter];
  const Station& to = stations_[receiver];
  const auto steady = propagation_.steady(to.gain * from.radiated, from.site, to.site);
  return {.receiver = receiver,
          .moves = from.moves + to.moves,
          .arrival = propagation_.arrival(steady, from.site, to.site, events_.now()),
          .steady = steady};
}

void Neighbourhood::collect(StationIndex transmitter) {
  Station& from = stations_[transmitter];
  from.is_out_of_date = false;
  Links& links = links_[transmitter];
  links = {};
  links.is_fixed = from.max_speed == 0;
  for (const StationIndex receiver : grid_.around(transmitter, kCellsInReach)) {
    links.is_fixed = links.is_fixed && stations_[receiver].max_speed == 0;
    // A link is certain for a time from now on, not from when its receiver was last looked at.
    if (stations_[receiver].is_asking) refresh(stations_[receiver]);
    put(transmitter, links, link(transmitter, receiver));
  }
  links.audible.shrink_to_fit();
  links.faint.shrink_to_fit();
  links.asked.shrink();
  links.distant.shrink();
  sort_by_arrival(links);
}

void Neighbourhood::sort_by_arrival(Links& links) {
  if (links.by_arrival.size() != links.audible.size()) {
    links.by_arrival.resize(links.audible.size());
    std::iota(links.by_arrival.begin(), links.by_arrival.end(), 0u);
  }
  // Of equal delays the lower receiver is first, as in `audible`.
  std::ranges::sort(links.by_arrival, {}, [&links](std::uint32_t one) {
    return std::pair(links.audible[one].arrival.delay, one);
  });
}

/// Time before which a link out of range cannot come into range. @pre one of the two stations can
/// move.
hal::Time Neighbourhood::out_of_reach_until(StationIndex transmitter,
                                            const AudibleLink& link) const {
  constexpr double kRounding = 1e-6;  // m
  constexpr double kLongest = 1e6;    // s
  const double speed = stations_[transmitter].max_speed + stations_[link.receiver].max_speed;
  const double apart = std::sqrt(link.steady.distance_squared) - reach_ - kRounding;
  if (!(apart > 0)) return events_.now();
  return events_.now() + hal::from_seconds(std::min(apart / speed, kLongest));
}

/// Inserts the link into the list where it belongs; drops it if it is out of range for ever.
void Neighbourhood::put(StationIndex from, Links& links, const AudibleLink& link) {
  const auto into = [&link](auto& list, const auto& entry) {
    // collect() passes links in order of receivers, so each is appended at the end.
    const auto place = std::ranges::lower_bound(list, link.receiver, {},
                                                [](const auto& other) { return other.receiver; });
    list.insert(place, entry);
  };
  switch (link.steady.strength) {
    case Propagation::Strength::kAudible:
      return into(links.audible, link);
    case Propagation::Strength::kFaint:
      if (stations_[link.receiver].is_asking) {
        const auto [most, until] = certainty(from, link);
        return links.asked.insert({link.receiver, most}, until);
      }
      return into(links.faint,
                  FaintLink{.power = link.arrival.power.value,
                            .receiver = link.receiver,
                            .moves = link.moves,
                            .delay = static_cast<std::uint32_t>(link.arrival.delay.count())});
    case Propagation::Strength::kNothing:
      if (stations_[from].max_speed == 0 && stations_[link.receiver].max_speed == 0) return;
      links.distant.insert({.receiver = link.receiver, .moves = link.moves}, Tick{0});
  }
}

const Links& Neighbourhood::links_from(StationIndex transmitter) {
  Station& from = stations_[transmitter];
  refresh(from);
  if (from.is_out_of_date) collect(transmitter);
  if (!links_[transmitter].is_fixed) follow(transmitter);
  if (propagation_.changes_in_time()) follow_time(transmitter);
  return links_[transmitter];
}

void Neighbourhood::prefetch_links(StationIndex transmitter) const {
  const Links& links = links_[transmitter];
  if (links.is_fixed) return;
  prefetch(transmitter);
  hal::prefetch(links.audible);
  hal::prefetch(links.by_arrival);
  hal::prefetch(links.asked.all());
  links.asked.prefetch();
  links.distant.prefetch();
}

/// Updates the links of which an end has moved.
void Neighbourhood::follow(StationIndex transmitter) {
  Links& links = links_[transmitter];
  for (const AudibleLink& link : links.audible) prefetch(link.receiver);
  links.asked.prefetch();
  links.distant.prefetch();
  changed_.clear();
  const std::size_t heard = links.audible.size();
  const bool moved = follow(transmitter, links.audible, Propagation::Strength::kAudible);
  follow(transmitter, links.faint, Propagation::Strength::kFaint);
  follow_asked(transmitter, links.asked);
  follow_distant(transmitter, links.distant);
  for (const AudibleLink& link : changed_) put(transmitter, links, link);
  if (moved || links.audible.size() != heard) sort_by_arrival(links);
}

template <class OneLink>
bool Neighbourhood::follow(StationIndex from, std::vector<OneLink>& links,
                           Propagation::Strength strength) {
  bool any = false;
  std::erase_if(links, [&](OneLink& known) {
    Station& to = stations_[known.receiver];
    refresh(to);
    // Neither count ever decreases, so an equal sum means that both are equal.
    const std::uint32_t moves = stations_[from].moves + to.moves;
    if (known.moves == moves) return false;
    any = true;
    known.moves = moves;
    const AudibleLink now = link(from, known.receiver);
    if (now.steady.strength != strength) {
      changed_.push_back(now);
      return true;
    }
    take(known, now);
    return false;
  });
  return any;
}

void Neighbourhood::follow_asked(StationIndex from, CertainLinks<AskedLink>& links) {
  links.renew(tick(events_.now()), [&](AskedLink& known, Tick& until) {
    refresh(stations_[known.receiver]);
    const AudibleLink now = link(from, known.receiver);
    if (now.steady.strength != Propagation::Strength::kFaint) {
      changed_.push_back(now);
      return false;
    }
    const Certainty next = certainty(from, now);
    known.most = next.most;
    until = next.until;
    return true;
  });
}

/// For how long a faint link certainly remains faint, and how much may arrive meanwhile. The longer
/// it is, the less the latter says.
Neighbourhood::Certainty Neighbourhood::certainty(StationIndex from, const AudibleLink& link) {
  constexpr double kRounding = 1e-6;  // m
  constexpr double kShortest = 0.01;  // m
  constexpr double kLongest = 1e6;    // s
  const Station& to = stations_[link.receiver];
  const double speed = stations_[from].max_speed + to.max_speed;
  if (speed == 0) return {at_least(link.steady.free.value), kForEver};
  const hal::Milliwatts sent = to.gain * stations_[from].radiated;
  const double distance = std::sqrt(link.steady.distance_squared);
  if (faint_.sent != sent) faint_ = propagation_.faint_range(sent);
  const double to_border = std::min(distance - faint_.nearest, faint_.farthest - distance);
  // The range is a law's estimate: it is tried.
  for (double way = std::min(distance / 3, to_border - kRounding); way > kShortest; way /= 4) {
    const auto near = propagation_.steady_at(sent, distance - way);
    const auto far = propagation_.steady_at(sent, distance + way);
    if (near.strength != link.steady.strength || far.strength != link.steady.strength) continue;
    const double time = std::min((way - kRounding) / speed, kLongest);
    return {at_least(near.free.value), tick(events_.now() + hal::from_seconds(time))};
  }
  return {at_least(link.steady.free.value), 0};
}

void Neighbourhood::follow_distant(StationIndex from, CertainLinks<DistantLink>& links) {
  links.renew(tick(events_.now()), [&](DistantLink& known, Tick& until) {
    Station& to = stations_[known.receiver];
    refresh(to);
    const std::uint32_t moves = stations_[from].moves + to.moves;
    if (known.moves == moves) return true;
    known.moves = moves;
    const AudibleLink now = link(from, known.receiver);
    if (now.steady.strength != Propagation::Strength::kNothing) {
      changed_.push_back(now);
      return false;
    }
    until = tick(out_of_reach_until(from, now));
    return true;
  });
}

/// Updates links for the current time, whether or not their ends have moved.
void Neighbourhood::follow_time(StationIndex transmitter) {
  const Site& from = stations_[transmitter].site;
  for (AudibleLink& link : links_[transmitter].audible) {
    link.arrival =
        propagation_.arrival(link.steady, from, stations_[link.receiver].site, events_.now());
  }
}

}  // namespace sim::radio
