#include "hal/runtime/network_object.h"

#include <fmt/core.h>

#include "hal/types/message.h"

namespace hal::runtime {

std::string mistake_in_topic(std::string_view topic) {
  if (topic.find('\0') != std::string_view::npos) return "topic has a zero byte";
  if (!topic.empty() && topic.size() <= kMaxTopic) return {};
  return fmt::format("topic '{}' has {} bytes, 1 to {} are allowed", topic, topic.size(),
                     kMaxTopic);
}

std::vector<Route> NetworkObject::routes(std::string_view topic, AgentId destination) const {
  context_.guard.check("routes");
  return context_.routes.routes(topic, destination);
}

const std::vector<Neighbour>& NetworkObject::neighbours() const {
  context_.guard.check("neighbours");
  return context_.routes.neighbours();
}

Result<void> NetworkObject::invalidate(std::string_view topic, AgentId destination) {
  context_.guard.check("invalidate");
  const std::string mistake = mistake_in_topic(topic);
  if (!mistake.empty()) return context_.refuse("invalidate", mistake);
  exchange::Action& action = context_.outbox.add(exchange::ActionKind::kInvalidate);
  action.topic = topic;
  action.destination = destination;
  // At once, so that the controller does not find again what it has just thrown away; the agent's
  // own table follows when the action takes effect.
  context_.routes.forget(topic, destination);
  return {};
}

}  // namespace hal::runtime
