#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/agents/condition_watch.h"
#include "sim/agents/scripted_event.h"
#include "sim/core/event_queue.h"

namespace sim::agents {

/// Lets the events of a scenario happen when they are due: each in an event of its own, before all
/// else of its instant. Those of one instant happen in their order in the scenario, or as their
/// conditions came to hold.
class Script {
 public:
  /// @param act  does one action now. @param event  index of the event that it is of.
  using Act = std::function<void(const ScriptedAction& action, std::size_t event)>;

  /// Adds the conditions of the events to the watch. @param events  outlive the script, as does
  /// what is in `queue`.
  Script(const std::vector<ScriptedEvent>& events, EventQueue& queue, ConditionWatch& watch,
         Act act);
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// Before the first event of the run.
  void start();

 private:
  void on_condition(std::size_t event);
  void repeat(std::size_t event);
  void happen(std::size_t event);

  const std::vector<ScriptedEvent>& events_;
  EventQueue& queue_;
  Act act_;
  std::vector<std::int64_t> times_;  ///< How often each has happened, or is about to.
};

}  // namespace sim::agents
