#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "sim/agents/simulation.h"
#include "sim/core/outside_input.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::controllers {

/// Moves the answers of controllers inside their agents' networks out of the recorded arrivals.
std::vector<sim::OutsideArrival> take_replies(std::vector<sim::OutsideArrival>& arrivals);

/// Whether an arrival is such an answer.
bool is_reply(const sim::OutsideArrival& arrival);

/// The controllers of a run that are inside their agents' networks. They can communicate there with
/// other programs, so their answers are recorded; a repetition replays these and starts none of the
/// controllers.
class InsideControllers {
 public:
  /// @param plans  of all controller processes; those outside networks are ignored.
  /// @param simulation  must outlive this object.
  /// @param recorded  result of take_replies(); null: this is not a repetition.
  /// @param was_in_lockstep  whether the recorded run was.
  /// @throws std::runtime_error  the record is damaged, or the plug-in that declares a controller's
  ///   requirements is missing.
  InsideControllers(const std::vector<sim::scenario::ProcessPlan>& plans,
                    const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
                    const std::vector<sim::OutsideArrival>* recorded, bool was_in_lockstep);

  /// Whether the answers of an agent's controller come from a record.
  bool is_repeated(hal::AgentId agent) const { return repeated_.contains(agent); }

  /// Wraps the port of a controller inside a network so that its answers are recorded. Returns the
  /// port of any other controller unchanged.
  std::shared_ptr<hal::node::exchange::ControllerPort> recorded(
      std::shared_ptr<hal::node::exchange::ControllerPort> port, hal::AgentId agent) const;

  /// In a repetition, connects the replayed controllers of agents with lower addresses, because all
  /// controllers are connected in the order of their agents.
  void connect_before(hal::AgentId agent);

 private:
  struct Repeated {
    std::shared_ptr<hal::node::exchange::ControllerPort> port;
    hal::Wants wants;
    bool is_connected = false;
  };

  sim::agents::Simulation& simulation_;
  std::map<hal::AgentId, std::string> inside_;  ///< Name under which answers are recorded.
  std::map<hal::AgentId, Repeated> repeated_;
};

}  // namespace baraka::run::controllers
