#include "sim/radio/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

/// Of the reach. Smaller: more looks at moving stations; larger: more pairs out of reach to skip.
constexpr double kMarginShare = 0.1;

}  // namespace

Neighbourhood::Neighbourhood(EventQueue& events, const Positions& positions,
                             const Propagation& propagation,
                             const std::vector<hal::AgentId>& agents)
    : events_(events),
      positions_(positions),
      propagation_(propagation),
      margin_(kMarginShare * propagation.reach().value),
      grid_(propagation.reach().value + 2 * margin_) {
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
  grid_.add(index, station.position);
  if (station.max_speed > 0 && std::isfinite(margin_)) watch_cell(index);
}

void Neighbourhood::watch_cell(StationIndex index) {
  const Station& station = stations_[index];
  const hal::Duration safe = hal::from_seconds(std::min(margin_ / station.max_speed, 1e6));
  events_.schedule(events_.now() + safe, Rank::kRadio, station.agent, [this, index] {
    refresh(stations_[index]);
    if (grid_.move(index, stations_[index].position)) ++cell_changes_;
    watch_cell(index);
  });
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
  from.cells_seen = cell_changes_;
  from.links.clear();
  for (const StationIndex receiver : grid_.around(transmitter)) {
    const Station& to = stations_[receiver];
    Link link{.receiver = receiver,
              .from_move = from.moves,
              .to_move = to.moves,
              .arrival = propagation_.arrival(from.position, to.position)};
    const bool is_fixed = from.max_speed == 0 && to.max_speed == 0;
    if (!is_fixed || link.matters(propagation_)) from.links.push_back(link);
  }
}

const std::vector<Link>& Neighbourhood::links_from(StationIndex transmitter) {
  Station& from = stations_[transmitter];
  refresh(from);
  if (from.cells_seen != cell_changes_) collect(transmitter);
  for (Link& link : from.links) {
    Station& to = stations_[link.receiver];
    refresh(to);
    if (link.from_move == from.moves && link.to_move == to.moves) continue;
    link.from_move = from.moves;
    link.to_move = to.moves;
    link.arrival = propagation_.arrival(from.position, to.position);
  }
  return from.links;
}

}  // namespace sim::radio
