#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/agents/condition_watch.h"
#include "sim/agents/scripted_event.h"
#include "sim/core/event_queue.h"

namespace sim::agents {

/// Runs the scripted events of a scenario when they are due, each in an event of the queue that
/// precedes all others of its time. Scripted events of the same time run in the order of the
/// scenario, or in the order in which their conditions began to hold.
class Script {
 public:
  /// @param act  performs one action now. @param event  index of the scripted event.
  using Act = std::function<void(const ScriptedAction& action, std::size_t event)>;

  /// Adds the conditions of the events to the watch. @param events,queue,watch  outlive the script.
  Script(const std::vector<ScriptedEvent>& events, EventQueue& queue, ConditionWatch& watch,
         Act act);
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// Call before the first event of the run.
  void start();

 private:
  void on_condition(std::size_t event);
  void repeat(std::size_t event);
  void happen(std::size_t event);

  const std::vector<ScriptedEvent>& events_;
  EventQueue& queue_;
  Act act_;
  /// Number of times that each has happened, including a pending one.
  std::vector<std::int64_t> times_;
};

}  // namespace sim::agents
