#include "sim/scenario/outcome_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "hal/config/suggest.h"
#include "hal/types/check.h"
#include "hal/types/pattern.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using agents::EndCondition;
using hal::AgentId;

constexpr Range kTime{0, hal::config::kLongestDuration};  // s

AgentId agent_named(Mapping& in, const std::string& key, const std::string& name,
                    const Scenario& scenario) {
  std::vector<std::string> names;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.name == name) return agent.id;
    names.push_back(agent.name);
  }
  if (!name.empty()) {
    in.mistake(key,
               fmt::format("unknown agent '{}'{}", name, hal::config::suggestion(name, names)));
  }
  return AgentId{};
}

const std::string& declared_name(AgentId id, const Scenario& scenario) {
  const auto& all = scenario.simulation.agents;
  const auto found = std::find_if(
      all.begin(), all.end(), [id](const agents::AgentConfig& agent) { return agent.id == id; });
  BARAKA_CHECK(found != all.end());
  return found->name;
}

EndCondition read_end(Mapping& in, const Scenario& scenario) {
  EndCondition end;
  if (in.has("agent")) {
    end.agent = agent_named(
        in, "agent",
        in.text({"agent", "The run ends when this agent's controller enters a state.", "NAME0"}),
        scenario);
    end.state = in.text({"state", "That state, as the controller calls it.", "FULFILLED"});
    end.after = in.duration({"after", "So much later.", "1 s"}, kTime, hal::Duration{});
    in.refuse("at", "cannot stand beside agent");
  } else {
    end.after = in.duration({"at", "The run ends at this time.", "60 s"}, kTime);
  }
  end.result = in.text({"result", "What the run is then called.", "done"});
  in.finish();
  return end;
}

/// A result that the run can end with: no other is ever judged.
ExpectedResult read_result(Mapping& in, const Scenario& scenario) {
  ExpectedResult expected{in.text({"result", "The run must end with this result.", "done"})};
  std::vector<std::string> results;
  for (const EndCondition& end : scenario.simulation.ends) results.push_back(end.result);
  for (const Group& group : scenario.groups) {
    for (const Program& program : group.programs) {
      if (program.on_exit == OnExit::kEnd) results.push_back(program.name);
    }
  }
  if (std::find(results.begin(), results.end(), expected.result) == results.end()) {
    in.warn("result", fmt::format("no end condition has the result '{}'{}", expected.result,
                                  hal::config::suggestion(expected.result, results)));
  }
  return expected;
}

std::vector<AgentId> agents_like(const std::string& pattern, const Scenario& scenario) {
  std::vector<AgentId> matching;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (hal::matches(pattern, agent.name)) matching.push_back(agent.id);
  }
  return matching;
}

/// The first of the two: a name or, with `entered`, a pattern.
void read_whose(Mapping& in, const std::string& whose, const Scenario& scenario,
                ExpectedDistance& expected) {
  expected.whose = whose;
  expected.which = agents_like(whose, scenario);
  const bool is_pattern = whose.find_first_of("*?") != std::string::npos;
  if (!is_pattern) {
    expected.which = {agent_named(in, "distance", whose, scenario)};
  } else if (expected.entered.empty()) {
    in.mistake("distance",
               fmt::format("'{}' is a pattern: 'entered: STATE' must say which of its agents is "
                           "meant, the last one to enter that state",
                           whose));
  } else if (expected.which.empty()) {
    in.mistake("distance", fmt::format("'{}' matches no agent", whose));
  }
}

/// Two agents from a list of two names.
ExpectedDistance read_distance(Mapping& in, const Scenario& scenario) {
  ExpectedDistance expected;
  if (in.has("entered")) {
    expected.entered = in.text(
        {"entered", "Of the agents of a pattern, the last one to enter this state is meant.",
         "FULFILLED"});
  }
  const std::vector<hal::config::Scalar> names =
      in.texts({"distance", "Two agents whose true distance at the end is judged.",
                "[NAME0, NAME1]", hal::config::kMustBeGiven});
  if (names.size() == 2) {
    read_whose(in, names[0].text, scenario, expected);
    expected.to = agent_named(in, "distance", names[1].text, scenario);
  } else {
    in.mistake("distance", fmt::format("must name two agents, not {}", names.size()));
  }
  expected.below =
      hal::Metres{in.number({"below", "The distance must be smaller.", "10 m"}, "m", {0, 1e9})};
  return expected;
}

Expectation read_expectation(Mapping& in, const Scenario& scenario) {
  Expectation expectation{ExpectedResult{}, in.place()};
  const bool distance = in.has("distance");
  if (distance == in.has("result")) {
    in.mistake("", "must have either result or distance");
    for (const char* key : {"below", "entered"}) in.has(key);
  } else if (distance) {
    expectation.condition = read_distance(in, scenario);
  } else {
    expectation.condition = read_result(in, scenario);
  }
  in.finish();
  return expectation;
}

}  // namespace

void read_ends(Mapping& in, Scenario& scenario) {
  for (Mapping& end : in.mappings(
           {"end", "When the run ends; the first condition that is met counts. At least one.",
            "[{at: 60 s, result: done}]", hal::config::kMustBeGiven})) {
    scenario.simulation.ends.push_back(read_end(end, scenario));
    const bool waits = scenario.simulation.ends.back().agent.has_value();
    scenario.state_places.push_back(waits ? end.place("state") : std::string{});
  }
  if (scenario.simulation.ends.empty()) {
    in.mistake("end", "must have at least one condition, e.g. {at: 60 s, result: timeout}");
  }
}

void read_expectations(Mapping& in, Scenario& scenario) {
  for (Mapping& one :
       in.mappings({"expect", "What must hold at the end, else the exit status is 3.",
                    "[{result: done}]"})) {
    scenario.expectations.push_back(read_expectation(one, scenario));
  }
}

void write_ends(Writer& out, const Scenario& scenario) {
  out.open_list("end");
  for (const EndCondition& end : scenario.simulation.ends) {
    out.open_item();
    if (end.agent) {
      out.text("agent", declared_name(*end.agent, scenario));
      out.text("state", end.state);
      out.duration("after", end.after);
    } else {
      out.duration("at", end.after);
    }
    out.text("result", end.result);
    out.close();
  }
  out.close();
}

void write_expectations(Writer& out, const Scenario& scenario) {
  out.open_list("expect");
  for (const Expectation& expectation : scenario.expectations) {
    out.open_item();
    if (const auto* distance = std::get_if<ExpectedDistance>(&expectation.condition)) {
      out.texts("distance", {distance->whose, declared_name(distance->to, scenario)});
      out.number("below", distance->below.value, "m");
      if (!distance->entered.empty()) out.text("entered", distance->entered);
    } else {
      out.text("result", std::get<ExpectedResult>(expectation.condition).result);
    }
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
