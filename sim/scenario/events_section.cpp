#include "sim/scenario/events_section.h"

#include <algorithm>
#include <variant>

#include "sim/scenario/action_section.h"
#include "sim/scenario/agent_names.h"
#include "sim/scenario/condition_section.h"

namespace sim::scenario {
namespace {

using agents::AtTime;
using agents::Befall;
using agents::Fortune;
using agents::Periodically;
using agents::ScriptedAction;
using agents::ScriptedEvent;
using agents::Whenever;

constexpr Range kEventTime{0, hal::files::config::kLongestDuration};       // s
constexpr Range kEventPeriod{1e-3, hal::files::config::kLongestDuration};  // s

void keys_of(Fields& io, Periodically& c) {
  io.needed({"every", "Period with which the event repeats.", "30 s"}, kEventPeriod, c.every);
  if (!io.is_writing()) c.from = c.every;
  io.duration({"from", "With `every`: time of the first occurrence.", "10 s", "`every`"},
              kEventTime, c.from);
  const bool has_end = io.given(
      {"until", "With `every`: latest time of an occurrence.", "600 s", "the end of the run"},
      kEventTime, c.until);
  if (has_end && *c.until < c.from) io.mistake("until", "is before the first time");
  io.given_count({"count", "With `every`: largest number of occurrences.", "5", "no limit"}, 1,
                 1'000'000'000, c.count);
}

void keys_of(Fields& io, Whenever& c, Scenario& scenario) {
  io.inside({"when", "The event occurs at the instant at which this condition begins to hold."},
            [&](Fields& when) { keys_of(when, c.condition, scenario); });
  io.flag({"each_time",
           "With `when`: whether the event occurs each time the condition begins to hold, or only "
           "the first time.",
           "true"},
          c.each_time);
}

void when_keys(Fields& io, ScriptedEvent& event, Scenario& scenario) {
  constexpr const char* kOneOfThem = "must have either at or every or when";
  const auto at = [&](Fields& one) {
    one.needed({"at", "Time of the event; or give `every`, or `when`.", "60 s"}, kEventTime,
               as<AtTime>(event.when).at);
  };
  const auto every = [&](Fields& one) {
    keys_of(one, as<Periodically>(event.when));
    for (const char* other : {"at", "when"}) one.unused(other, kOneOfThem);
  };
  const auto when = [&](Fields& one) {
    keys_of(one, as<Whenever>(event.when), scenario);
    one.unused("at", kOneOfThem);
  };
  const bool is_said =
      io.first_of({{"every", std::holds_alternative<Periodically>(event.when), every},
                   {"when", std::holds_alternative<Whenever>(event.when), when},
                   {"at", std::holds_alternative<AtTime>(event.when), at}});
  if (is_said) return;
  for (const char* other : {"every", "when"}) io.reading()->has(other);
  at(io);
}

void keys_of(Fields& io, ScriptedEvent& event, Scenario& scenario) {
  if (io.reading() != nullptr) event.place = io.reading()->place();
  when_keys(io, event, scenario);
  io.list<ScriptedAction>(
      {"do", "What happens: actions in this order, all at the same instant.",
       "[{switch_off: NAME0}]", hal::files::config::kMustBeGiven},
      event.actions, [&](Fields& one, ScriptedAction& action) { keys_of(one, action, scenario); });
  if (event.actions.empty()) io.mistake("do", "must have at least one action");
}

bool adds(const ScriptedAction& action, hal::AgentId agent) {
  const auto* befall = std::get_if<Befall>(&action.what);
  return befall != nullptr && befall->fortune == Fortune::kAdd &&
         std::ranges::find(action.agents, agent) != action.agents.end();
}

void warn_of_never_added(Mapping& in, const Scenario& scenario) {
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.is_present) continue;
    const bool is_added = std::ranges::any_of(scenario.simulation.script, [&](const auto& event) {
      return std::ranges::any_of(event.actions,
                                 [&](const auto& action) { return adds(action, agent.id); });
    });
    if (!is_added) in.warn("events", agent.name + " is not present, and nothing adds it");
  }
}

}  // namespace

void event_keys(Fields& io, Scenario& scenario) {
  io.list_if_any<ScriptedEvent>({"events",
                                 "Scripted events: changes to agents and interference, which come "
                                 "from outside the simulated world.",
                                 "[{at: 60 s, do: [{switch_off: NAME0}]}]"},
                                scenario.simulation.script, [&](Fields& one, ScriptedEvent& event) {
                                  keys_of(one, event, scenario);
                                });
  if (io.reading() != nullptr) warn_of_never_added(*io.reading(), scenario);
}

}  // namespace sim::scenario
