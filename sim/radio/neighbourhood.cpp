#include "sim/radio/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

/// Of the reach. Smaller: more looks at moving stations; larger: more pairs out of reach to skip.
constexpr double kMarginShare = 0.1;

/// Along what links are kept over. More: fewer pairs out of reach are kept, cells change more
/// often.
constexpr int kCellsInReach = 4;

void take(AudibleLink& link, const AudibleLink& now) { link = now; }

void take(FaintLink& link, const AudibleLink& now) {
  link.power = now.arrival.power.value;
  link.delay = static_cast<std::uint32_t>(now.arrival.delay.count());
}

void take(DistantLink&, const AudibleLink&) {}

/// Of the strongest transmitter, m; above 0, so that there is a grid without stations, too.
double longest_reach(const Propagation& propagation,
                     const std::vector<Neighbourhood::Antenna>& antennas) {
  double reach = 1;
  double best_gain = 0;
  for (const auto& antenna : antennas) best_gain = std::max(best_gain, antenna.gain);
  for (const auto& antenna : antennas) {
    reach = std::max(reach, propagation.reach(best_gain * antenna.gain * antenna.tx_power));
  }
  return reach;
}

}  // namespace

Neighbourhood::Neighbourhood(EventQueue& events, const Positions& positions,
                             const Propagation& propagation, const std::vector<Antenna>& antennas)
    : events_(events),
      positions_(positions),
      propagation_(propagation),
      margin_(kMarginShare * longest_reach(propagation, antennas)),
      grid_((longest_reach(propagation, antennas) + 2 * margin_) / kCellsInReach) {
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
  anything_moves_ = anything_moves_ || station.max_speed > 0;
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
  outdate_around(index);
  grid_.put(index, position);
  outdate_around(index);
}

void Neighbourhood::outdate_around(StationIndex index) {
  stations_[index].is_out_of_date = true;
  for (const StationIndex other : grid_.around(index, kCellsInReach)) {
    stations_[other].is_out_of_date = true;
  }
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
  for (const StationIndex receiver : grid_.around(transmitter, kCellsInReach)) {
    put(links, link(transmitter, receiver),
        from.max_speed == 0 && stations_[receiver].max_speed == 0);
  }
  links.audible.shrink_to_fit();
  links.faint.shrink_to_fit();
  links.distant.shrink_to_fit();
}

/// Into the list where it belongs, unless it is out of reach for ever.
void Neighbourhood::put(Links& links, const AudibleLink& link, bool is_fixed) {
  const auto into = [&link](auto& list, const auto& entry) {
    // When links are collected they come by receiver: each is the last.
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
      if (!is_fixed) into(links.distant, DistantLink{link.receiver, link.moves});
  }
}

const Links& Neighbourhood::links_from(StationIndex transmitter) {
  Station& from = stations_[transmitter];
  refresh(from);
  if (from.is_out_of_date) collect(transmitter);
  if (anything_moves_) follow(transmitter);
  if (propagation_.changes_in_time()) follow_time(transmitter);
  return links_[transmitter];
}

/// Those of which an end has moved.
void Neighbourhood::follow(StationIndex transmitter) {
  Links& links = links_[transmitter];
  changed_.clear();
  follow(transmitter, links.audible, Propagation::Strength::kAudible);
  follow(transmitter, links.faint, Propagation::Strength::kFaint);
  follow(transmitter, links.distant, Propagation::Strength::kNothing);
  for (const AudibleLink& link : changed_) put(links, link, false);
}

template <class OneLink>
void Neighbourhood::follow(StationIndex from, std::vector<OneLink>& links,
                           Propagation::Strength strength) {
  std::erase_if(links, [&](OneLink& known) {
    Station& to = stations_[known.receiver];
    refresh(to);
    // Neither count ever falls: the same sum is the same two.
    const std::uint32_t moves = stations_[from].moves + to.moves;
    if (known.moves == moves) return false;
    known.moves = moves;
    const AudibleLink now = link(from, known.receiver);
    if (now.steady.strength == strength) {
      take(known, now);
      return false;
    }
    changed_.push_back(now);
    return true;
  });
}

/// Those whose ends may stand still.
void Neighbourhood::follow_time(StationIndex transmitter) {
  const Site& from = stations_[transmitter].site;
  for (AudibleLink& link : links_[transmitter].audible) {
    link.arrival =
        propagation_.arrival(link.steady, from, stations_[link.receiver].site, events_.now());
  }
}

void Neighbourhood::forget(StationIndex transmitter) {
  links_[transmitter] = {};
  stations_[transmitter].is_out_of_date = true;
}

}  // namespace sim::radio
