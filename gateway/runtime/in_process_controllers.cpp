#include "gateway/runtime/in_process_controllers.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "gateway/runtime/controller_host.h"
#include "gateway/runtime/in_process_port.h"
#include "gateway/runtime/plugin.h"

namespace gateway::runtime {
namespace {

using hal::node::exchange::AgentOffer;

const AgentOffer& offer_of(const std::vector<AgentOffer>& offers, hal::AgentId agent) {
  // Offers are by address.
  return *std::ranges::lower_bound(offers, agent, {},
                                   [](const AgentOffer& offer) { return offer.session.agent; });
}

}  // namespace

hal::Result<void> connect_in_process(const InProcessControllers& controllers,
                                     const std::vector<AgentOffer>& offers,
                                     hal::node::exchange::AgentHost& host) {
  const auto kind = load_plugin(controllers.program, controller_folders());
  if (!kind) return tl::unexpected(kind.error());
  const hal::Wants& wants = (*kind)->wants;
  hal::node::exchange::Session session;
  session.server = "in process";
  session.run = 1;  // the only one of its server
  if (wants.names) session.directory = host.directory();
  for (const hal::AgentId agent : controllers.agents) {
    auto one = hal::node::exchange::session_for(offer_of(offers, agent), wants);
    if (!one) return tl::unexpected(one.error());
    session.agents.push_back(std::move(*one));
  }
  auto made = ControllerHost::create(**kind, session);
  if (!made) return tl::unexpected(made.error());
  host.connect(std::make_shared<InProcessPort>(controllers.process, std::move(*made)),
               controllers.agents, wants);
  return {};
}

}  // namespace gateway::runtime
