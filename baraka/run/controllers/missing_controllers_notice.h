#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gateway/process/waiting.h"
#include "hal/node/exchange/ports.h"
#include "hal/types/clock.h"
#include "hal/types/time.h"
#include "sim/scenario/plan.h"

namespace baraka::run::controllers {

/// For users who start controllers by hand: which ones a run waits for, and the commands to type.
class MissingControllersNotice {
 public:
  /// @param plans  controller processes of the scenario.
  /// @param offers  the agents that the run offers.
  /// @param domain  DDS domain.
  /// @param wait  time that the run waits for the next controller before it gives up.
  /// @param clock  must outlive the notice.
  MissingControllersNotice(std::vector<sim::scenario::ProcessPlan> plans,
                           const std::vector<hal::node::exchange::AgentOffer>& offers, int domain,
                           hal::Duration wait,
                           const hal::Clock& clock = gateway::process::wall_clock());

  /// Prints the notice on standard error, at the first call and then every 5 s; nothing if no
  /// controller is missing.
  void say(const std::vector<hal::AgentId>& missing);

  /// One command for each process to start for these agents: "/…/help_mote --domain 7 --agents
  /// 'm*'".
  std::vector<std::string> commands(const std::vector<hal::AgentId>& missing) const;

 private:
  struct Agent {
    hal::AgentId id;
    std::string name;
  };
  std::string agents_option(const std::vector<std::string>& wanted) const;

  std::vector<sim::scenario::ProcessPlan> plans_;
  std::vector<Agent> agents_;
  int domain_;
  hal::Duration wait_;
  const hal::Clock& clock_;
  std::optional<hal::Time> said_;
};

}  // namespace baraka::run::controllers
