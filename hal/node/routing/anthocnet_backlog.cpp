#include "hal/node/routing/anthocnet_backlog.h"

#include <utility>

#include "hal/node/routing/message_end.h"

namespace hal::node::routing::anthocnet {

bool Backlog::keep(Transit transit) {
  const Target target{transit.data.header.topic, transit.data.header.destination};
  auto& queue = waiting_[target];
  if (queue.size() >= node_.config.buffer_limit) {
    if (queue.empty()) waiting_.erase(target);
    end_message(node_, transit, Verdict::kQueueFull);
    return false;
  }
  const std::uint64_t place = ++last_place_;
  const auto expiry = node_.timers.schedule(node_.now() + node_.config.buffer_age,
                                            [this, target, place] { on_expiry(target, place); });
  queue.emplace(place, Waiting{std::move(transit), expiry});
  return true;
}

std::vector<Transit> Backlog::release(const Target& target) {
  std::vector<Transit> released;
  auto queue = waiting_.extract(target);
  if (queue.empty()) return released;
  for (auto& [place, waiting] : queue.mapped()) {
    node_.timers.cancel(waiting.expiry);
    released.push_back(std::move(waiting.transit));
  }
  return released;
}

void Backlog::abandon(const Target& target, Verdict verdict) {
  for (const Transit& transit : release(target)) end_message(node_, transit, verdict);
}

void Backlog::on_expiry(const Target& target, std::uint64_t place) {
  const auto queue = waiting_.find(target);
  const auto expired = queue->second.extract(place);
  if (queue->second.empty()) waiting_.erase(queue);
  end_message(node_, expired.mapped().transit, Verdict::kExpired);
}

}  // namespace hal::node::routing::anthocnet
