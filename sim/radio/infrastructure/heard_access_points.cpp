#include "sim/radio/infrastructure/heard_access_points.h"

namespace sim::radio {

void HeardAccessPoints::on_beacon(hal::AgentId access_point, hal::Dbm rssi, hal::Duration interval,
                                  hal::Time now) {
  const auto [known, is_new] = heard_.try_emplace(access_point, Heard{rssi.value, now, interval});
  Heard& heard = known->second;
  if (!is_new) heard.mean_dbm += config_.beacon_weight * (rssi.value - heard.mean_dbm);
  heard.last = now;
  heard.interval = interval;
}

hal::Time HeardAccessPoints::lost_at(hal::AgentId access_point) const {
  const Heard& heard = heard_.at(access_point);
  return heard.last + config_.beacon_loss * heard.interval;
}

std::optional<hal::AgentId> HeardAccessPoints::strongest(hal::Time now) const {
  const Heard* best = nullptr;
  std::optional<hal::AgentId> which;
  for (const auto& [access_point, heard] : heard_) {
    if (now >= lost_at(access_point)) continue;
    if (best != nullptr && heard.mean_dbm <= best->mean_dbm) continue;
    best = &heard;
    which = access_point;
  }
  return which;
}

std::optional<hal::AgentId> HeardAccessPoints::better_than(hal::AgentId current,
                                                           hal::Time now) const {
  const auto best = strongest(now);
  if (!best || *best == current) return std::nullopt;
  const double lead = heard_.at(*best).mean_dbm - heard_.at(current).mean_dbm;
  return lead > config_.hysteresis.value ? best : std::nullopt;
}

}  // namespace sim::radio
