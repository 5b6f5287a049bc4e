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

/// Takes the answers of controllers inside their agents' networks out of what came from outside.
std::vector<sim::OutsideArrival> take_replies(std::vector<sim::OutsideArrival>& arrivals);

/// The controllers of a run that are inside their agents' networks. They hear others there, so what
/// they answer is recorded; a repetition has their answers from the record and starts none of them.
class InsideControllers {
 public:
  /// @param plans  of the run; those of others are left out.   @param simulation  outlives this.
  /// @param recorded  of a repetition: as take_replies(); null: this is none.
  /// @throws std::runtime_error  the record is damaged, or a plug-in, which says what its
  /// controller
  ///   asks for, is not there.
  InsideControllers(const std::vector<sim::scenario::ProcessPlan>& plans,
                    const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
                    const std::vector<sim::OutsideArrival>* recorded);

  /// Whether the answers of an agent's controller come from a record.
  bool is_repeated(hal::AgentId agent) const { return repeated_.contains(agent); }

  /// The port of such a controller, as the simulation is to have it; of another one as it is.
  std::shared_ptr<hal::node::exchange::ControllerPort> recorded(
      std::shared_ptr<hal::node::exchange::ControllerPort> port, hal::AgentId agent) const;

  /// Connects those of a repetition whose agents have lower addresses: all are connected in the
  /// order of their agents.
  void connect_before(hal::AgentId agent);

 private:
  struct Repeated {
    std::shared_ptr<hal::node::exchange::ControllerPort> port;
    hal::Wants wants;
    bool is_connected = false;
  };

  sim::agents::Simulation& simulation_;
  std::map<hal::AgentId, std::string> inside_;  ///< The name by which answers are recorded.
  std::map<hal::AgentId, Repeated> repeated_;
};

}  // namespace baraka::run::controllers
