#pragma once

#include "gateway/runtime/agent_context.h"
#include "hal/api/real_world_object.h"

namespace gateway::runtime {

/// The Network of one agent.
class NetworkObject : public hal::Network {
 public:
  explicit NetworkObject(AgentContext& context) : context_(context) {}

  std::vector<hal::Route> routes(std::string_view topic, hal::AgentId destination) const override;
  const std::vector<hal::Neighbour>& neighbours() const override;
  hal::Result<void> invalidate(std::string_view topic, hal::AgentId destination) override;

 private:
  AgentContext& context_;
};

}  // namespace gateway::runtime
