#include "sim/radio/channel/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

/// Share of the range. Smaller: moving stations are checked more often; larger: more pairs out of
/// range to skip.
constexpr double kMarginShare = 0.1;

/// Where it is best.
double most_gain(const Neighbourhood::Antenna& antenna) {
  return antenna.pattern == nullptr ? antenna.gain : antenna.gain * antenna.pattern->most();
}

/// Range of the strongest transmitter [m]; above 0, so that there is a grid even without stations.
double longest_reach(const Propagation& propagation,
                     const std::vector<Neighbourhood::Antenna>& antennas) {
  double reach = 1;
  double best_gain = 0;
  for (const auto& antenna : antennas) best_gain = std::max(best_gain, most_gain(antenna));
  for (const auto& antenna : antennas) {
    const hal::Milliwatts most = std::max(antenna.tx_power, antenna.most_power);
    reach = std::max(reach, propagation.reach(best_gain * most_gain(antenna) * most));
  }
  return reach;
}

/// Of a frame that is noticed. A receiver is at most that late.
hal::Duration delay_at(const Propagation& propagation, double reach) {
  constexpr double kFarthest = 1e8;  // m
  const double distance = std::min(reach, kFarthest) + 1;
  return propagation.mean_arrival({.distance_squared = distance * distance}).delay;
}

}  // namespace

Neighbourhood::Neighbourhood(EventQueue& events, const Positions& positions,
                             const Propagation& propagation, const std::vector<Antenna>& antennas)
    : events_(events),
      positions_(positions),
      propagation_(propagation),
      reach_(longest_reach(propagation, antennas)),
      margin_(kMarginShare * reach_),
      may_ask_(
          propagation.falls_with_distance() &&
          std::ranges::all_of(antennas, [](const auto& one) { return one.pattern == nullptr; })),
      longest_delay_(delay_at(propagation, reach_)),
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
  Station& station = stations_.back();
  // Where a station stands, its links hardly change: then it costs less to add their frames.
  station.is_asking = may_ask_ && station.max_speed > 0 && positions_.remembers(agent);
  if (antenna.pattern != nullptr) {
    station.directed = std::make_unique<DirectedAntenna>(*antenna.pattern,
                                                         positions_.attitude(agent, events_.now()));
    station.site.directed = station.directed.get();
  }
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
  links.asked.erase(to);
  links.distant.erase(to);
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
  const bool has_turned = station.directed != nullptr &&
                          station.directed->turn(positions_.attitude(station.site.agent, now));
  if (position == station.site.position && !has_turned) return;
  station.site.position = position;
  ++station.moves;
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

Propagation::Arrival Neighbourhood::mean_arrival(const Departure& frame,
                                                 StationIndex receiver) const {
  const Station& station = stations_[receiver];
  const hal::Milliwatts sent = station.gain * frame.radiated;
  if (station.max_speed == 0) return propagation_.quick_arrival(sent, frame.site, station.site);
  const hal::AgentId agent = station.site.agent;
  const Site then(positions_.position(agent, frame.at), station.site.height, station.site.name,
                  agent);
  return propagation_.quick_arrival(sent, frame.site, then);
}

Neighbourhood::Circle Neighbourhood::around(StationIndex receiver) const {
  constexpr double kLongestFrame = 1;  // s
  const Station& station = stations_[receiver];
  // The position that is known of a moving station is not older than its way through the margin.
  const double way = station.max_speed > 0 ? margin_ + kLongestFrame * station.max_speed : 0;
  return {station.site.position.x, station.site.position.y, reach_ + way + 1};
}

void Neighbourhood::forget(StationIndex transmitter) {
  links_[transmitter] = {};
  stations_[transmitter].is_out_of_date = true;
}

}  // namespace sim::radio
