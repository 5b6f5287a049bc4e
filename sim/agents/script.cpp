#include "sim/agents/script.h"

#include <utility>
#include <variant>

namespace sim::agents {

std::string_view name(Fortune fortune) {
  switch (fortune) {
    case Fortune::kKill:
      return "kill";
    case Fortune::kRestart:
      return "restart";
    case Fortune::kSwitchOff:
      return "switch_off";
    case Fortune::kSwitchOn:
      return "switch_on";
    case Fortune::kAdd:
      return "add";
    case Fortune::kRemove:
      return "remove";
  }
  return {};
}

std::string_view name(const ScriptedAction& action) {
  if (const auto* befall = std::get_if<Befall>(&action.what)) return name(befall->fortune);
  if (std::holds_alternative<MoveTo>(action.what)) return "move";
  if (std::holds_alternative<Retune>(action.what)) return "set";
  if (std::holds_alternative<Drain>(action.what)) return "drain";
  return "jam";
}

Script::Script(const std::vector<ScriptedEvent>& events, EventQueue& queue, ConditionWatch& watch,
               Act act)
    : events_(events), queue_(queue), act_(std::move(act)), times_(events.size(), 0) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (const auto* whenever = std::get_if<Whenever>(&events[i].when)) {
      watch.add(whenever->condition, [this, i] { on_condition(i); });
    }
  }
}

void Script::start() {
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (const auto* at = std::get_if<AtTime>(&events_[i].when)) {
      queue_.schedule(hal::Time{} + at->at, Rank::kScenario, kWorld, [this, i] { happen(i); });
    } else if (const auto* often = std::get_if<Periodically>(&events_[i].when)) {
      if (often->until && often->from > *often->until) continue;
      queue_.schedule(hal::Time{} + often->from, Rank::kScenario, kWorld, [this, i] { repeat(i); });
    }
  }
}

void Script::on_condition(std::size_t event) {
  if (times_[event] > 0 && !std::get<Whenever>(events_[event].when).each_time) return;
  ++times_[event];
  queue_.schedule(queue_.now(), Rank::kScenario, kWorld, [this, event] { happen(event); });
}

void Script::repeat(std::size_t event) {
  const auto& often = std::get<Periodically>(events_[event].when);
  ++times_[event];
  happen(event);
  const hal::Time next = queue_.now() + often.every;
  if (often.until && next > hal::Time{} + *often.until) return;
  if (often.count && times_[event] >= *often.count) return;
  queue_.schedule(next, Rank::kScenario, kWorld, [this, event] { repeat(event); });
}

void Script::happen(std::size_t event) {
  for (const ScriptedAction& action : events_[event].actions) act_(action, event);
}

}  // namespace sim::agents
