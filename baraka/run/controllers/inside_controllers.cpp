#include "baraka/run/controllers/inside_controllers.h"

#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "gateway/exchange/reply_bytes.h"
#include "gateway/runtime/plugin.h"
#include "gateway/server/inside_port.h"

namespace baraka::run::controllers {
namespace {

using sim::OutsideArrival;

constexpr std::string_view kRepliesOf = "controller of ";

/// The recorded answers of one controller. @throws std::runtime_error  one is damaged
std::deque<gateway::server::RecordedReply> replies_in(const std::vector<OutsideArrival>& recorded,
                                                      const std::string& name) {
  std::deque<gateway::server::RecordedReply> replies;
  for (const OutsideArrival& arrival : recorded) {
    if (arrival.door != name) continue;
    auto reply = gateway::exchange::reply_of(arrival.bytes);
    if (!reply) {
      throw std::runtime_error(fmt::format("the record: answer {} of the {}: {}",
                                           replies.size() + 1, name, reply.error().message));
    }
    replies.push_back({arrival.at, std::move(*reply)});
  }
  return replies;
}

gateway::server::ReplyRecord record_in(sim::agents::Simulation& simulation,
                                       const std::string& name) {
  return [&simulation, name](const hal::node::exchange::Reply& reply) {
    simulation.note_arrival(name, gateway::exchange::bytes_of(reply));
  };
}

gateway::server::RepeatedTime time_of(sim::agents::Simulation& simulation) {
  return {.now = [&simulation] { return simulation.now(); },
          .stop_at = [&simulation](hal::Time at) { simulation.stop_at(at); }};
}

}  // namespace

bool is_reply(const OutsideArrival& arrival) { return arrival.door.starts_with(kRepliesOf); }

std::vector<OutsideArrival> take_replies(std::vector<OutsideArrival>& arrivals) {
  const auto first = std::stable_partition(
      arrivals.begin(), arrivals.end(), [](const OutsideArrival& one) { return !is_reply(one); });
  std::vector<OutsideArrival> replies(std::make_move_iterator(first),
                                      std::make_move_iterator(arrivals.end()));
  arrivals.erase(first, arrivals.end());
  return replies;
}

InsideControllers::InsideControllers(const std::vector<sim::scenario::ProcessPlan>& plans,
                                     const sim::scenario::Scenario& scenario,
                                     sim::agents::Simulation& simulation,
                                     const std::vector<OutsideArrival>* recorded,
                                     bool was_in_lockstep)
    : simulation_(simulation) {
  for (const sim::scenario::ProcessPlan& plan : plans) {
    if (!plan.inside) continue;
    const hal::AgentId agent = plan.agents.front();
    const auto config = std::ranges::lower_bound(scenario.simulation.agents, agent, {},
                                                 &sim::agents::AgentConfig::id);  // by address
    const std::string name = std::string(kRepliesOf) + config->name;
    inside_[agent] = name;
    if (recorded == nullptr) continue;
    const auto kind =
        gateway::runtime::load_plugin(plan.program, gateway::runtime::controller_folders());
    if (!kind) throw std::runtime_error(kind.error().message);
    repeated_[agent] = {std::make_shared<gateway::server::RepeatedPort>(
                            plan.process, replies_in(*recorded, name), record_in(simulation, name),
                            was_in_lockstep ? std::optional(time_of(simulation)) : std::nullopt),
                        (*kind)->wants};
  }
}

std::shared_ptr<hal::node::exchange::ControllerPort> InsideControllers::recorded(
    std::shared_ptr<hal::node::exchange::ControllerPort> port, hal::AgentId agent) const {
  const auto inside = inside_.find(agent);
  if (inside == inside_.end()) return port;
  return std::make_shared<gateway::server::RecordedPort>(std::move(port),
                                                         record_in(simulation_, inside->second));
}

void InsideControllers::connect_before(hal::AgentId agent) {
  for (auto& [id, repeated] : repeated_) {
    if (repeated.is_connected || !(id < agent)) continue;
    repeated.is_connected = true;
    simulation_.connect(repeated.port, {id}, repeated.wants);
  }
}

}  // namespace baraka::run::controllers
