#include "sim/scenario/outcome_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "hal/config/suggest.h"
#include "hal/types/check.h"
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
    end.agent = agent_named(in, "agent", in.text("agent"), scenario);
    end.state = in.text("state");
    end.after = in.duration("after", kTime, hal::Duration{});
    in.refuse("at", "cannot stand beside agent");
  } else {
    end.after = in.duration("at", kTime);
  }
  end.result = in.text("result");
  in.finish();
  return end;
}

/// Two different agents from a list of two names.
ExpectedDistance read_distance(Mapping& in, const Scenario& scenario) {
  ExpectedDistance expected;
  const std::vector<hal::config::Scalar> names = in.texts("distance");
  if (names.size() == 2) {
    expected.from = agent_named(in, "distance", names[0].text, scenario);
    expected.to = agent_named(in, "distance", names[1].text, scenario);
  } else {
    in.mistake("distance", fmt::format("must name two agents, not {}", names.size()));
  }
  expected.below = hal::Metres{in.number("below", "m", {0, 1e9})};
  return expected;
}

Expectation read_expectation(Mapping& in, const Scenario& scenario) {
  Expectation expectation{ExpectedResult{}, in.place()};
  const bool distance = in.has("distance");
  if (distance == in.has("result")) {
    in.mistake("", "must have either result or distance");
    in.has("below");
  } else if (distance) {
    expectation.condition = read_distance(in, scenario);
  } else {
    expectation.condition = ExpectedResult{in.text("result")};
  }
  in.finish();
  return expectation;
}

}  // namespace

void read_ends(Mapping& in, Scenario& scenario) {
  for (Mapping& end : in.mappings("end")) {
    scenario.simulation.ends.push_back(read_end(end, scenario));
  }
  if (scenario.simulation.ends.empty()) {
    in.mistake("end", "must have at least one condition, e.g. {at: 60 s, result: timeout}");
  }
}

void read_expectations(Mapping& in, Scenario& scenario) {
  for (Mapping& one : in.mappings("expect")) {
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
      out.texts("distance",
                {declared_name(distance->from, scenario), declared_name(distance->to, scenario)});
      out.number("below", distance->below.value, "m");
    } else {
      out.text("result", std::get<ExpectedResult>(expectation.condition).result);
    }
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
