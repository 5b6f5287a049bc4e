#include "hal/node/routing/discovery.h"

namespace hal::node::routing {

void Discovery::wait(Transit transit) {
  const Target target{transit.data.header.topic, transit.data.header.destination};
  auto& queue = waiting_[target];
  if (queue.size() >= node_.config.buffer_limit) {
    abandon_(transit, Verdict::kQueueFull);
    return;
  }
  const Sequence place = ++last_place_;
  const auto expiry = node_.timers.schedule(node_.now() + node_.config.buffer_age,
                                            [this, target, place] { on_expiry(target, place); });
  queue.emplace(place, Waiting{std::move(transit), expiry});
  if (!searches_.contains(target)) begin(target);
}

void Discovery::begin(const Target& target) {
  Search& search = searches_[target];
  search.started = node_.now();
  search.first_sequence = node_.last_sequence + 1;
  try_once(target, search);
}

void Discovery::try_once(const Target& target, Search& search) {
  ++search.tries;
  const auto& [topic, destination] = target;
  const ForwardAnt ant{.header = {topic, node_.self, destination, node_.next_sequence()},
                       .started = node_.now(),
                       .path = {node_.self},
                       .way = {}};
  search.retry = node_.timers.schedule(node_.now() + wait_after(search.tries),
                                       [this, target] { on_retry(target); });
  node_.count(ProtocolEvent::kForwardAntSent);
  outbox_.send_control(kEveryone, ant);
}

/// Time until the next try or, after the last one, until the search is given up.
Duration Discovery::wait_after(int tries) {
  const Duration period = node_.config.retry_period;
  const double share = node_.config.retry_jitter;
  if (share <= 0 || tries >= node_.config.retries) return period;
  const double early = share * static_cast<double>(period.count());
  return period - Duration{static_cast<std::int64_t>(node_.retry_random.uniform() * early)};
}

void Discovery::on_retry(const Target& target) {
  Search& search = searches_.at(target);
  if (search.tries < node_.config.retries) {
    try_once(target, search);
  } else {
    give_up(target);
  }
}

void Discovery::give_up(const Target& target) {
  const auto search = searches_.extract(target);
  const auto& [topic, destination] = target;
  node_.ports.observer.on_discovery(topic, destination, node_.now() - search.mapped().started,
                                    false);
  for (const Transit& transit : release(topic, destination)) {
    abandon_(transit, Verdict::kNoRoute);
  }
}

void Discovery::on_answer(const std::string& topic, AgentId destination, Sequence sequence) {
  const auto found = searches_.find({topic, destination});
  if (found == searches_.end() || sequence < found->second.first_sequence) return;
  const Search search = found->second;
  searches_.erase(found);
  node_.timers.cancel(search.retry);
  node_.ports.observer.on_discovery(topic, destination, node_.now() - search.started, true);
}

std::vector<Transit> Discovery::release(const std::string& topic, AgentId destination) {
  std::vector<Transit> released;
  auto queue = waiting_.extract({topic, destination});
  if (queue.empty()) return released;
  for (auto& [place, waiting] : queue.mapped()) {
    node_.timers.cancel(waiting.expiry);
    released.push_back(std::move(waiting.transit));
  }
  return released;
}

void Discovery::on_expiry(const Target& target, Sequence place) {
  auto expired = waiting_.at(target).extract(place);
  abandon_(expired.mapped().transit, Verdict::kExpired);
}

}  // namespace hal::node::routing
