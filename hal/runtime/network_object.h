#pragma once

#include "hal/api/real_world_object.h"
#include "hal/runtime/agent_context.h"

namespace hal::runtime {

/// The Network of one agent.
class NetworkObject : public Network {
 public:
  explicit NetworkObject(AgentContext& context) : context_(context) {}

  std::vector<Route> routes(std::string_view topic, AgentId destination) const override;
  const std::vector<Neighbour>& neighbours() const override;
  Result<void> invalidate(std::string_view topic, AgentId destination) override;

 private:
  AgentContext& context_;
};

}  // namespace hal::runtime
