#include "hal/runtime/network_object.h"

namespace hal::runtime {

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
  exchange::Action& action = context_.outbox.add(exchange::ActionKind::kInvalidate);
  action.topic = topic;
  action.destination = destination;
  if (auto good = context_.judge_last(); !good) return good;
  // At once, so that the controller does not find again what it has just thrown away; the agent's
  // own table follows when the action takes effect.
  context_.routes.forget(topic, destination);
  return {};
}

}  // namespace hal::runtime
