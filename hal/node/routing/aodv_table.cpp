#include "hal/node/routing/aodv_table.h"

#include <algorithm>

#include "hal/node/routing/route_table.h"

namespace hal::node::routing {
namespace {

Route route_of(std::string_view topic, AgentId destination, const AodvEntry& entry) {
  return {.topic = std::string(topic),
          .destination = destination,
          .next_hop = entry.next_hop,
          .path = {.hops = static_cast<std::uint16_t>(entry.hops)}};
}

bool is_better(const AodvOffer& offer, const AodvEntry& known, bool is_active) {
  // For a neighbour that was only heard no number is known: a longer route is never better.
  if (!known.sequence) return !is_active || offer.hops <= known.hops;
  if (!offer.sequence) return false;
  if (is_newer(*offer.sequence, *known.sequence)) return true;
  if (*offer.sequence != *known.sequence) return false;
  return !is_active || offer.hops < known.hops;
}

}  // namespace

const AodvEntry* AodvTable::find(AgentId destination) const {
  const auto found = entries_.find(destination);
  return found == entries_.end() ? nullptr : &found->second;
}

const AodvEntry* AodvTable::active(AgentId destination) const {
  const AodvEntry* const entry = find(destination);
  return entry != nullptr && is_active(*entry) ? entry : nullptr;
}

bool AodvTable::offer(const AodvOffer& offer) {
  const auto [place, is_new] = entries_.try_emplace(offer.destination);
  AodvEntry& entry = place->second;
  if (!is_new && !is_better(offer, entry, is_active(entry))) return false;
  const bool was_active = is_active(entry);
  const bool is_same = was_active && entry.next_hop == offer.next_hop && entry.hops == offer.hops;
  if (was_active && entry.next_hop != offer.next_hop) tell(offer.destination, entry, true);
  const bool stays = was_active && entry.expires > offer.expires;
  entry.expires = stays ? entry.expires : offer.expires;
  entry.next_hop = offer.next_hop;
  entry.hops = offer.hops;
  entry.sequence = offer.sequence;
  entry.is_valid = true;
  entry.is_in_use = true;
  entry.is_in_repair = false;
  if (!is_same) tell(offer.destination, entry, false);
  wait_for(entry.expires);
  return true;
}

/// Section 6.5: notes the neighbour without a sequence number. A known number is kept, because the
/// neighbour itself, which issued it, is the next hop.
void AodvTable::note_neighbour(AgentId neighbour, Time until) {
  AodvEntry& entry = entries_[neighbour];
  const bool was_active = is_active(entry);
  const bool is_direct = was_active && entry.next_hop == neighbour;
  if (was_active && !is_direct) tell(neighbour, entry, true);
  entry.expires = was_active ? std::max(entry.expires, until) : until;
  if (!was_active) entry.is_in_use = false;
  entry.next_hop = neighbour;
  entry.hops = 1;
  entry.is_valid = true;
  entry.is_in_repair = false;
  if (!is_direct) tell(neighbour, entry, false);
  wait_for(entry.expires);
}

void AodvTable::use(AgentId destination, Time until) {
  const auto found = entries_.find(destination);
  if (found == entries_.end() || !is_active(found->second)) return;
  found->second.is_in_use = true;
  found->second.expires = std::max(found->second.expires, until);
}

void AodvTable::add_precursor(AgentId destination, AgentId neighbour) {
  const auto found = entries_.find(destination);
  if (found != entries_.end()) found->second.precursors.insert(neighbour);
}

const AodvEntry* AodvTable::invalidate(AgentId destination, std::optional<AodvSequence> newest) {
  const auto found = entries_.find(destination);
  if (found == entries_.end() || !found->second.is_valid) return nullptr;
  AodvEntry& entry = found->second;
  // If no other node can have learnt of the route from this one, the number need not increase; and
  // it must not become greater than that of a neighbour that is only heard now and then.
  if (entry.sequence && entry.is_in_use) {
    const bool is_told = newest && is_newer(*newest, *entry.sequence);
    entry.sequence = is_told ? *newest : *entry.sequence + 1;
  }
  entry.is_valid = false;
  entry.expires = node_.now() + node_.config.aodv.delete_period();
  wait_for(entry.expires);
  tell(destination, entry, true);
  return &entry;
}

void AodvTable::forget_precursors(AgentId destination) {
  const auto found = entries_.find(destination);
  if (found != entries_.end()) found->second.precursors.clear();
}

bool AodvTable::is_in_use(AgentId destination) const {
  const AodvEntry* const entry = active(destination);
  return entry != nullptr && entry->is_in_use;
}

void AodvTable::set_in_use(AgentId destination, bool in_use) {
  const auto found = entries_.find(destination);
  if (found != entries_.end()) found->second.is_in_use = in_use;
}

void AodvTable::set_in_repair(AgentId destination, bool in_repair) {
  const auto found = entries_.find(destination);
  if (found != entries_.end()) found->second.is_in_repair = in_repair;
}

std::vector<AgentId> AodvTable::via(AgentId neighbour) const {
  std::vector<AgentId> destinations;
  for (const auto& [destination, entry] : entries_) {
    if (entry.is_valid && entry.next_hop == neighbour) destinations.push_back(destination);
  }
  return destinations;
}

bool AodvTable::is_on_active_route() const {
  return std::ranges::any_of(entries_, [this](const auto& known) {
    return known.second.is_in_use && is_active(known.second);
  });
}

void AodvTable::note_class(std::string_view topic) {
  if (classes_.contains(topic) || classes_.size() >= RouteTable::kMostClasses) return;
  classes_.emplace(topic);
  for (const Route& route : routes()) {
    if (route.topic == topic) {
      node_.ports.observer.on_route_change({.route = route, .removed = false});
    }
  }
}

std::vector<Route> AodvTable::routes(std::string_view topic, AgentId destination) const {
  const AodvEntry* const entry = active(destination);
  if (entry == nullptr) return {};
  return {route_of(topic, destination, *entry)};
}

std::vector<Route> AodvTable::routes() const {
  std::vector<Route> all;
  for (const std::string& topic : classes_) {
    for (const auto& [destination, entry] : entries_) {
      if (is_active(entry)) all.push_back(route_of(topic, destination, entry));
    }
  }
  return all;
}

void AodvTable::tell(AgentId destination, const AodvEntry& entry, bool removed) const {
  for (const std::string& topic : classes_) {
    Route route = route_of(topic, destination, entry);
    if (removed) route.path = {};
    node_.ports.observer.on_route_change({.route = std::move(route), .removed = removed});
  }
}

/// Uses one timer for all entries, set to the first expiry. Entries extended meanwhile are
/// rescheduled.
void AodvTable::wait_for(Time expiry) {
  if (wake_at_ && *wake_at_ <= expiry) return;
  if (wake_at_) node_.timers.cancel(timer_);
  wake_at_ = expiry;
  timer_ = node_.timers.schedule(std::max(expiry, node_.now()), [this] { on_expiry(); });
}

void AodvTable::on_expiry() {
  wake_at_.reset();
  std::vector<AgentId> expired;
  for (const auto& [destination, entry] : entries_) {
    if (entry.expires <= node_.now()) expired.push_back(destination);
  }
  for (const AgentId destination : expired) {
    if (invalidate(destination, std::nullopt) == nullptr) entries_.erase(destination);
  }
  const auto first = std::ranges::min_element(
      entries_, {}, [](const auto& known) { return known.second.expires; });
  if (first != entries_.end()) wait_for(first->second.expires);
}

}  // namespace hal::node::routing
