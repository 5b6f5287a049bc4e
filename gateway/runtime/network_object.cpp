#include "gateway/runtime/network_object.h"

namespace gateway::runtime {

std::vector<hal::Route> NetworkObject::routes(std::string_view topic,
                                              hal::AgentId destination) const {
  context_.guard.check("routes");
  return context_.routes.routes(topic, destination);
}

const std::vector<hal::Neighbour>& NetworkObject::neighbours() const {
  context_.guard.check("neighbours");
  return context_.routes.neighbours();
}

hal::Result<void> NetworkObject::invalidate(std::string_view topic, hal::AgentId destination) {
  context_.guard.check("invalidate");
  context_.outbox.add(
      hal::node::exchange::Invalidate{.destination = destination, .topic = std::string(topic)});
  if (auto good = context_.judge_last(); !good) return good;
  // Removed at once, so that the controller does not find the route that it has just invalidated;
  // the agent's own table follows when the action takes effect.
  context_.routes.forget(topic, destination);
  return {};
}

}  // namespace gateway::runtime
