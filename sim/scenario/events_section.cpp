#include "sim/scenario/events_section.h"

#include <algorithm>
#include <variant>

#include "sim/scenario/action_section.h"
#include "sim/scenario/agent_names.h"
#include "sim/scenario/condition_section.h"
#include "sim/scenario/given_keys.h"

namespace sim::scenario {
namespace {

using agents::AtTime;
using agents::Befall;
using agents::Fortune;
using agents::Periodically;
using agents::ScriptedAction;
using agents::ScriptedEvent;
using agents::Whenever;

constexpr Range kEventTime{0, hal::config::kLongestDuration};       // s
constexpr Range kEventPeriod{1e-3, hal::config::kLongestDuration};  // s

Periodically read_period(Mapping& in) {
  Periodically often;
  often.every =
      in.duration({"every", "It happens again and again, with this period.", "30 s"}, kEventPeriod);
  often.from = in.duration({"from", "With `every`: the first time.", "10 s", "`every`"}, kEventTime,
                           often.every);
  if (GivenKeys(in).has("until")) {
    often.until =
        in.duration({"until", "With `every`: not after this time.", "600 s", "the end of the run"},
                    kEventTime, hal::Duration{});
    if (*often.until < often.from) in.mistake("until", "is before the first time");
  }
  if (GivenKeys(in).has("count")) {
    often.count = in.integer({"count", "With `every`: at most so often.", "5", "no limit"}, 1,
                             1'000'000'000, 1);
  }
  GivenKeys(in).offer(in, {"until", "count"});
  return often;
}

Whenever read_whenever(Mapping& in, Scenario& scenario) {
  Whenever whenever;
  whenever.condition = read_condition(
      in.mapping({"when", "It happens at the instant at which this condition begins to hold."}),
      scenario);
  whenever.each_time = in.flag(
      {"each_time",
       "With `when`: whether it happens each time that the condition begins to hold, or only once.",
       "true"},
      false);
  return whenever;
}

void read_when(Mapping& in, Scenario& scenario, ScriptedEvent& event) {
  constexpr const char* kOneOfThem = "must have either at or every or when";
  const GivenKeys keys(in);
  if (keys.has("every")) event.when = read_period(in);
  if (keys.has("when") && (!keys.has("every") || keys.is_survey()))
    event.when = read_whenever(in, scenario);
  const bool is_otherwise = keys.has("every") || keys.has("when");
  if (!is_otherwise) keys.offer(in, {"every", "when"});
  if (!is_otherwise || keys.is_survey()) {
    event.when =
        AtTime{in.duration({"at", "When it happens; or `every`, or `when`.", "60 s"}, kEventTime)};
  } else {
    in.refuse("at", kOneOfThem);
    if (keys.has("every")) in.refuse("when", kOneOfThem);
  }
}

ScriptedEvent read_event(Mapping in, Scenario& scenario) {
  ScriptedEvent event;
  event.place = in.place();
  read_when(in, scenario, event);
  for (Mapping& action : in.mappings({"do", "What happens, in this order, all at that instant.",
                                      "[{switch_off: NAME0}]", hal::config::kMustBeGiven})) {
    event.actions.push_back(read_action(action, scenario));
  }
  if (event.actions.empty()) in.mistake("do", "must have at least one action");
  in.finish();
  return event;
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

/// Writes when an event happens.
struct WriteWhen {
  Writer& out;
  const Scenario& scenario;

  void operator()(const AtTime& at) const { out.duration("at", at.at); }
  void operator()(const Periodically& often) const {
    out.duration("every", often.every);
    out.duration("from", often.from);
    if (often.until) out.duration("until", *often.until);
    if (often.count) out.integer("count", *often.count);
  }
  void operator()(const Whenever& whenever) const {
    out.open("when");
    write_condition(out, whenever.condition, scenario);
    out.close();
    out.flag("each_time", whenever.each_time);
  }
};

}  // namespace

void read_events(Mapping& in, Scenario& scenario) {
  for (Mapping& event :
       in.mappings({"events",
                    "What happens to agents and to the air, and comes from nobody in "
                    "the world.",
                    "[{at: 60 s, do: [{switch_off: NAME0}]}]"})) {
    scenario.simulation.script.push_back(read_event(event, scenario));
  }
  warn_of_never_added(in, scenario);
}

void write_events(Writer& out, const Scenario& scenario) {
  if (scenario.simulation.script.empty()) return;
  out.open_list("events");
  for (const ScriptedEvent& event : scenario.simulation.script) {
    out.open_item();
    std::visit(WriteWhen{out, scenario}, event.when);
    out.open_list("do");
    for (const ScriptedAction& action : event.actions) {
      out.open_item();
      write_action(out, action);
      out.close();
    }
    out.close();
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
