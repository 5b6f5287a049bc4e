#include "sim/radio/infrastructure/distribution_system.h"

#include <memory>

namespace sim::radio {

void DistributionSystem::associate(hal::AgentId station, hal::AgentId access_point) {
  const auto [entry, is_new] = with_.try_emplace(station, access_point);
  if (is_new || entry->second == access_point) return;
  DistributionPort& before = *ports_.at(entry->second);
  entry->second = access_point;
  before.on_moved(station);
}

void DistributionSystem::release(hal::AgentId station, hal::AgentId access_point) {
  const auto entry = with_.find(station);
  if (entry != with_.end() && entry->second == access_point) with_.erase(entry);
}

bool DistributionSystem::carry(const Distributed& distributed, hal::AgentId from) {
  const hal::AgentId destination = distributed.request.destination;
  if (destination == hal::kEveryone) {
    for (const auto& [address, port] : ports_) {
      if (address != from) hand_over(distributed, address);
    }
    return true;
  }
  const auto station = with_.find(destination);
  const hal::AgentId to = station == with_.end() ? destination : station->second;
  if (to == from || !ports_.contains(to)) return false;
  hand_over(distributed, to);
  return true;
}

void DistributionSystem::hand_over(const Distributed& distributed, hal::AgentId to) {
  auto shared = std::make_shared<const Distributed>(distributed);
  DistributionPort* const port = ports_.at(to);
  events_.schedule(events_.now() + delay_, Rank::kRadio, to,
                   [port, shared] { port->on_distributed(*shared); });
}

}  // namespace sim::radio
