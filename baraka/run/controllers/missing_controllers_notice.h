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

/// Tells who starts controllers by hand which ones a run waits for, and the commands to type.
class MissingControllersNotice {
 public:
  /// @param plans   the processes that the scenario has in mind.  @param offers  of the run.
  /// @param domain  of DDS.  @param wait  for the next controller, until the run gives up.
  /// @param clock   outlives the notice.
  MissingControllersNotice(std::vector<sim::scenario::ProcessPlan> plans,
                           const std::vector<hal::node::exchange::AgentOffer>& offers, int domain,
                           hal::Duration wait,
                           const hal::Clock& clock = gateway::process::wall_clock());

  /// On standard error, the first time and then every 5 s; nothing if nobody is missing.
  void say(const std::vector<hal::AgentId>& missing);

  /// One command per process that has to be started for these agents: "/…/help_mote --domain 7
  /// --agents 'm*'".
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
