#include "hal/node/routing/aodv_search.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing {

AodvSearch::AodvSearch(Node& node, AodvTable& table, Outbox& outbox, Calls calls)
    : node_(node),
      table_(table),
      outbox_(outbox),
      calls_(std::move(calls)),
      own_sequence_(node.config.first_sequence),
      last_id_(node.config.first_sequence),
      rate_(node.config.aodv.rreq_ratelimit) {}

void AodvSearch::wait(Transit transit) {
  const AgentId destination = transit.data.header.destination;
  const std::string topic = transit.data.header.topic;
  auto& queue = waiting_[destination];
  if (queue.size() >= node_.config.buffer_limit) {
    calls_.abandon(transit, Verdict::kQueueFull);
    return;
  }
  const Sequence place = ++last_place_;
  const auto expiry =
      node_.timers.schedule(node_.now() + node_.config.buffer_age,
                            [this, destination, place] { on_expiry(destination, place); });
  queue.emplace(place, Waiting{std::move(transit), expiry});
  if (!searches_.contains(destination)) begin(destination, topic);
}

void AodvSearch::begin(AgentId destination, const std::string& topic) {
  searches_[destination] = {.topic = topic, .started = node_.now(), .ttl = first_ttl(destination)};
  try_once(destination);
}

bool AodvSearch::repair(AgentId destination, int ttl) {
  if (searches_.contains(destination)) return false;
  searches_[destination] = {
      .topic = {}, .started = node_.now(), .ttl = std::clamp(ttl, 1, 255), .is_repair = true};
  try_once(destination);
  return true;
}

/// Section 6.4: the first ring is based on the last known distance of the destination.
int AodvSearch::first_ttl(AgentId destination) const {
  const AodvConfig& config = node_.config.aodv;
  const AodvEntry* const known = table_.find(destination);
  const int ttl = known != nullptr ? known->hops + config.ttl_increment : config.ttl_start;
  return ttl > config.ttl_threshold ? config.net_diameter : std::min(ttl, config.net_diameter);
}

/// Sends a request, or waits if the rate limit is reached.
void AodvSearch::try_once(AgentId destination) {
  Search& search = searches_.at(destination);
  const Time earliest = std::max(rate_.next(node_.now()), held_until_);
  if (earliest > node_.now()) {
    node_.count(ProtocolEvent::kRreqDelayed);
    search.timer = node_.timers.schedule(earliest, [this, destination] { try_once(destination); });
    return;
  }
  rate_.note(node_.now());
  request(destination, search);
  search.timer = node_.timers.schedule(node_.now() + wait_after(search),
                                       [this, destination] { on_timeout(destination); });
}

void AodvSearch::request(AgentId destination, Search& search) {
  if (search.ttl >= node_.config.aodv.net_diameter) ++search.whole;
  const AodvEntry* const known = table_.find(destination);
  const Rreq rreq{.gratuitous = node_.config.aodv.gratuitous_reply,
                  .destination_only = node_.config.aodv.destination_only,
                  .hops = 0,
                  .id = ++last_id_,
                  .destination = destination,
                  .destination_sequence = known != nullptr ? known->sequence : std::nullopt,
                  .originator = node_.self,
                  .originator_sequence = ++own_sequence_};
  const AodvPacket packet{.ttl = static_cast<std::uint8_t>(search.ttl), .message = rreq};
  node_.count(ProtocolEvent::kRreqSent);
  outbox_.send_control(kEveryone, Control{ControlOf::kAodv, encode(packet)});
}

/// Time within which the answer must arrive.
Duration AodvSearch::wait_after(const Search& search) const {
  constexpr int kMostDoublings = 10;
  const AodvConfig& config = node_.config.aodv;
  if (search.whole == 0) return config.ring_traversal_time(search.ttl);
  return config.net_traversal_time() * (1 << std::min(search.whole - 1, kMostDoublings));
}

void AodvSearch::on_timeout(AgentId destination) {
  const AodvConfig& config = node_.config.aodv;
  Search& search = searches_.at(destination);
  if (search.is_repair) return give_up(destination);
  if (search.whole > config.rreq_retries) return give_up(destination);
  const int wider = search.ttl + config.ttl_increment;
  search.ttl =
      wider > config.ttl_threshold ? config.net_diameter : std::min(wider, config.net_diameter);
  try_once(destination);
}

void AodvSearch::give_up(AgentId destination) {
  const Search search = searches_.extract(destination).mapped();
  if (search.is_repair) {
    calls_.repair_failed(destination);
    return search_for_own(destination);
  }
  node_.ports.observer.on_discovery(search.topic, destination, node_.now() - search.started, false);
  for (const Transit& transit : release(destination)) {
    calls_.abandon(transit, Verdict::kNoRoute);
  }
}

/// After a failed repair, searches for a route for this node's own messages, as any source does.
void AodvSearch::search_for_own(AgentId destination) {
  const auto queue = waiting_.find(destination);
  if (queue == waiting_.end()) return;
  std::vector<Transit> of_others;
  std::erase_if(queue->second, [&](const auto& place) {
    const Waiting& waiting = place.second;
    if (!waiting.transit.came_from) return false;
    node_.timers.cancel(waiting.expiry);
    of_others.push_back(waiting.transit);
    return true;
  });
  if (queue->second.empty()) {
    waiting_.erase(queue);
  } else {
    begin(destination, queue->second.begin()->second.transit.data.header.topic);
  }
  for (const Transit& transit : of_others) calls_.abandon(transit, Verdict::kNoRoute);
}

std::vector<Transit> AodvSearch::on_route(AgentId destination) {
  const auto found = searches_.extract(destination);
  if (!found.empty()) {
    const Search& search = found.mapped();
    node_.timers.cancel(search.timer);
    if (search.is_repair) {
      node_.count(ProtocolEvent::kLocalRepairDone);
    } else {
      node_.ports.observer.on_discovery(search.topic, destination, node_.now() - search.started,
                                        true);
    }
  }
  return release(destination);
}

std::vector<Transit> AodvSearch::release(AgentId destination) {
  std::vector<Transit> released;
  auto queue = waiting_.extract(destination);
  if (queue.empty()) return released;
  for (auto& [place, waiting] : queue.mapped()) {
    node_.timers.cancel(waiting.expiry);
    released.push_back(std::move(waiting.transit));
  }
  return released;
}

void AodvSearch::on_expiry(AgentId destination, Sequence place) {
  auto expired = waiting_.at(destination).extract(place);
  calls_.abandon(expired.mapped().transit, Verdict::kExpired);
}

void AodvSearch::raise_own_sequence(AodvSequence at_least) {
  if (is_newer(at_least, own_sequence_)) own_sequence_ = at_least;
}

}  // namespace hal::node::routing
