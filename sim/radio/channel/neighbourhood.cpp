#include "sim/radio/channel/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <type_traits>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

/// Share of the range. Smaller: moving stations are checked more often; larger: more pairs out of
/// range to skip.
constexpr double kMarginShare = 0.1;

/// Cells along the distance up to which links are kept. More: fewer pairs out of range are kept,
/// but stations change cells more often.
constexpr int kCellsInReach = 4;

void take(AudibleLink& link, const AudibleLink& now) { link = now; }

void take(FaintLink& link, const AudibleLink& now) {
  link.power = now.arrival.power.value;
  link.delay = static_cast<std::uint32_t>(now.arrival.delay.count());
}

/// Whether the link is certain not to have changed.
bool can_wait(const DistantLink& link, hal::Time now) { return now < link.out_of_reach_until; }
template <class OneLink>
bool can_wait(const OneLink&, hal::Time) {
  return false;
}

/// Range of the strongest transmitter [m]; above 0, so that there is a grid even without stations.
double longest_reach(const Propagation& propagation,
                     const std::vector<Neighbourhood::Antenna>& antennas) {
  double reach = 1;
  double best_gain = 0;
  for (const auto& antenna : antennas) best_gain = std::max(best_gain, antenna.gain);
  for (const auto& antenna : antennas) {
    const hal::Milliwatts most = std::max(antenna.tx_power, antenna.most_power);
    reach = std::max(reach, propagation.reach(best_gain * antenna.gain * most));
  }
  return reach;
}

}  // namespace

Neighbourhood::Neighbourhood(EventQueue& events, const Positions& positions,
                             const Propagation& propagation, const std::vector<Antenna>& antennas)
    : events_(events),
      positions_(positions),
      propagation_(propagation),
      reach_(longest_reach(propagation, antennas)),
      margin_(kMarginShare * reach_),
      grid_((reach_ + 2 * margin_) / kCellsInReach) {
  stations_.reserve(antennas.size());
  links_.reserve(antennas.size());
  for (const Antenna& antenna : antennas) add(antenna);
}

void Neighbourhood::add(const Antenna& antenna) {
  const hal::AgentId agent = antenna.agent;
  BARAKA_CHECK(stations_.empty() || stations_.back().site.agent < agent);
  const auto index = static_cast<StationIndex>(stations_.size());
  stations_.push_back(
      {.site = Site(positions_.position(agent, events_.now()), antenna.height, antenna.name, agent),
       .radiated = antenna.gain * antenna.tx_power,
       .gain = antenna.gain,
       .max_speed = positions_.max_speed(agent)});
  const Station& station = stations_.back();
  BARAKA_CHECK(std::isfinite(station.max_speed) && station.max_speed >= 0);
  grid_.put(index, {station.site.position.x, station.site.position.y});
  links_.emplace_back();
  if (station.max_speed > 0 && std::isfinite(margin_)) watch_cell(index);
}

void Neighbourhood::watch_cell(StationIndex index) {
  const Station& station = stations_[index];
  const hal::Duration safe = hal::from_seconds(std::min(margin_ / station.max_speed, 1e6));
  events_.schedule(events_.now() + safe, Rank::kRadio, station.site.agent, [this, index] {
    refresh(stations_[index]);
    change_cell(index);
    watch_cell(index);
  });
}

void Neighbourhood::change_cell(StationIndex index) {
  const hal::Vec3& at = stations_[index].site.position;
  const hal::Vec2 position{at.x, at.y};
  if (!grid_.would_move(index, position)) return;
  const std::vector<StationIndex> before = grid_.around(index, kCellsInReach);
  grid_.put(index, position);
  const std::vector<StationIndex> after = grid_.around(index, kCellsInReach);
  stations_[index].is_out_of_date = true;
  const auto without = [](const auto& all, const auto& some) {
    std::vector<StationIndex> rest;
    std::ranges::set_difference(all, some, std::back_inserter(rest));
    return rest;
  };
  for (const StationIndex other : without(before, after)) part(other, index);
  for (const StationIndex other : without(after, before)) meet(other, index);
}

/// Removes `to` from the links of `from`.
void Neighbourhood::part(StationIndex from, StationIndex to) {
  if (stations_[from].is_out_of_date) return;
  Links& links = links_[from];
  const auto is_it = [to](const auto& link) { return link.receiver == to; };
  std::erase_if(links.faint, is_it);
  std::erase_if(links.distant, is_it);
  if (std::erase_if(links.audible, is_it) > 0) sort_by_arrival(links);
}

/// Adds `to` to the links of `from`.
void Neighbourhood::meet(StationIndex from, StationIndex to) {
  if (stations_[from].is_out_of_date) return;
  Links& links = links_[from];
  links.is_fixed = false;
  refresh(stations_[from]);
  const std::size_t heard = links.audible.size();
  put(from, links, link(from, to));
  if (links.audible.size() != heard) sort_by_arrival(links);
}

void Neighbourhood::refresh(Station& station) {
  const hal::Time now = events_.now();
  if (now < station.valid_until) return;
  const hal::Vec3 position = positions_.position(station.site.agent, now);
  station.valid_until = positions_.valid_until(station.site.agent, now);
  if (position == station.site.position) return;
  station.site.position = position;
  ++station.moves;
}

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
    put(transmitter, links, link(transmitter, receiver));
  }
  links.audible.shrink_to_fit();
  links.faint.shrink_to_fit();
  links.distant.shrink_to_fit();
  sort_by_arrival(links);
}

void Neighbourhood::sort_by_arrival(Links& links) {
  links.by_arrival.resize(links.audible.size());
  std::iota(links.by_arrival.begin(), links.by_arrival.end(), 0u);
  // Already ordered by receiver; the stable sort keeps that order among equal delays.
  std::ranges::stable_sort(links.by_arrival, {}, [&links](std::uint32_t one) {
    return links.audible[one].arrival.delay;
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
      return into(links.faint,
                  FaintLink{.power = link.arrival.power.value,
                            .receiver = link.receiver,
                            .moves = link.moves,
                            .delay = static_cast<std::uint32_t>(link.arrival.delay.count())});
    case Propagation::Strength::kNothing:
      if (stations_[from].max_speed == 0 && stations_[link.receiver].max_speed == 0) return;
      into(links.distant, DistantLink{.receiver = link.receiver, .moves = link.moves});
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

/// Updates the links of which an end has moved.
void Neighbourhood::follow(StationIndex transmitter) {
  Links& links = links_[transmitter];
  changed_.clear();
  const std::size_t heard = links.audible.size();
  const bool moved = follow(transmitter, links.audible, Propagation::Strength::kAudible);
  follow(transmitter, links.faint, Propagation::Strength::kFaint);
  follow(transmitter, links.distant, Propagation::Strength::kNothing);
  for (const AudibleLink& link : changed_) put(transmitter, links, link);
  if (moved || links.audible.size() != heard) sort_by_arrival(links);
}

template <class OneLink>
bool Neighbourhood::follow(StationIndex from, std::vector<OneLink>& links,
                           Propagation::Strength strength) {
  bool any = false;
  const hal::Time instant = events_.now();
  std::erase_if(links, [&](OneLink& known) {
    if (can_wait(known, instant)) return false;
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
    if constexpr (std::is_same_v<OneLink, DistantLink>) {
      known.out_of_reach_until = out_of_reach_until(from, now);
    } else {
      take(known, now);
    }
    return false;
  });
  return any;
}

/// Updates links for the current time, whether or not their ends have moved.
void Neighbourhood::follow_time(StationIndex transmitter) {
  const Site& from = stations_[transmitter].site;
  for (AudibleLink& link : links_[transmitter].audible) {
    link.arrival =
        propagation_.arrival(link.steady, from, stations_[link.receiver].site, events_.now());
  }
}

void Neighbourhood::displace(StationIndex index) {
  Station& station = stations_[index];
  station.valid_until = {};
  refresh(station);
  grid_.put(index, {station.site.position.x, station.site.position.y});
  // Any station may have had it in range, or may have it in range now.
  for (Station& other : stations_) other.is_out_of_date = true;
}

void Neighbourhood::set_tx_power(StationIndex station, hal::Milliwatts power) {
  stations_[station].radiated = stations_[station].gain * power;
  stations_[station].is_out_of_date = true;
}

Propagation::Arrival Neighbourhood::arrival(hal::Milliwatts sent, const Site& from,
                                            StationIndex to) {
  Station& station = stations_[to];
  refresh(station);
  return propagation_.mean_arrival(propagation_.steady(station.gain * sent, from, station.site));
}

void Neighbourhood::forget(StationIndex transmitter) {
  links_[transmitter] = {};
  stations_[transmitter].is_out_of_date = true;
}

}  // namespace sim::radio
