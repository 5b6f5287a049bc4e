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

}  // namespace

Neighbourhood::Neighbourhood(EventQueue& events, const Positions& positions,
                             const Propagation& propagation,
                             const std::vector<hal::AgentId>& agents)
    : events_(events),
      positions_(positions),
      propagation_(propagation),
      margin_(kMarginShare * propagation.reach().value),
      grid_((propagation.reach().value + 2 * margin_) / kCellsInReach) {
  for (const hal::AgentId agent : agents) add(agent);
}

void Neighbourhood::add(hal::AgentId agent) {
  BARAKA_CHECK(stations_.empty() || stations_.back().agent < agent);
  const auto index = static_cast<StationIndex>(stations_.size());
  Station& station = stations_.emplace_back();
  station.agent = agent;
  station.max_speed = positions_.max_speed(agent);
  BARAKA_CHECK(std::isfinite(station.max_speed) && station.max_speed >= 0);
  station.position = positions_.position(agent, events_.now());
  grid_.put(index, {station.position.x, station.position.y});
  links_.emplace_back();
  if (station.max_speed > 0 && std::isfinite(margin_)) watch_cell(index);
}

void Neighbourhood::watch_cell(StationIndex index) {
  const Station& station = stations_[index];
  const hal::Duration safe = hal::from_seconds(std::min(margin_ / station.max_speed, 1e6));
  events_.schedule(events_.now() + safe, Rank::kRadio, station.agent, [this, index] {
    refresh(stations_[index]);
    change_cell(index);
    watch_cell(index);
  });
}

void Neighbourhood::change_cell(StationIndex index) {
  const hal::Vec2 position{stations_[index].position.x, stations_[index].position.y};
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
  const hal::Vec3 position = positions_.position(station.agent, now);
  station.valid_until = positions_.valid_until(station.agent, now);
  if (position == station.position) return;
  station.position = position;
  ++station.moves;
}

void Neighbourhood::collect(StationIndex transmitter) {
  Station& from = stations_[transmitter];
  from.is_out_of_date = false;
  const std::vector<StationIndex> near = grid_.around(transmitter, kCellsInReach);
  Links& links = links_[transmitter];
  links = {};
  for (const StationIndex receiver : near) {
    const Station& to = stations_[receiver];
    const Link link{.receiver = receiver,
                    .moves = from.moves + to.moves,
                    .arrival = propagation_.arrival(from.position, to.position)};
    const bool is_fixed = from.max_speed == 0 && to.max_speed == 0;
    if (link.matters(propagation_)) {
      links.known.push_back(link);
    } else if (!is_fixed) {
      links.distant.push_back({receiver, link.moves});
    }
  }
  links.known.shrink_to_fit();
  links.distant.shrink_to_fit();
}

const std::vector<Link>& Neighbourhood::links_from(StationIndex transmitter) {
  Station& from = stations_[transmitter];
  refresh(from);
  if (from.is_out_of_date) collect(transmitter);
  take_in_distant(transmitter);
  for (Link& link : links_[transmitter].known) {
    Station& to = stations_[link.receiver];
    refresh(to);
    // Neither count ever falls: the same sum is the same two.
    const std::uint32_t moves = from.moves + to.moves;
    if (link.moves == moves) continue;
    link.moves = moves;
    link.arrival = propagation_.arrival(from.position, to.position);
  }
  return links_[transmitter].known;
}

/// Those that have come into reach.
void Neighbourhood::take_in_distant(StationIndex transmitter) {
  const Station& from = stations_[transmitter];
  Links& links = links_[transmitter];
  std::erase_if(links.distant, [&](Distant& pair) {
    Station& to = stations_[pair.receiver];
    refresh(to);
    const std::uint32_t moves = from.moves + to.moves;
    if (pair.moves == moves) return false;
    pair.moves = moves;
    const Link link{.receiver = pair.receiver,
                    .moves = moves,
                    .arrival = propagation_.arrival(from.position, to.position)};
    if (!link.matters(propagation_)) return false;
    const auto place = std::ranges::lower_bound(links.known, link.receiver, {}, &Link::receiver);
    links.known.insert(place, link);
    return true;
  });
}

void Neighbourhood::forget(StationIndex transmitter) {
  links_[transmitter] = {};
  stations_[transmitter].is_out_of_date = true;
}

}  // namespace sim::radio
