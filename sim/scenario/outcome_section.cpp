#include "sim/scenario/outcome_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "hal/files/config/suggest.h"
#include "sim/scenario/agent_names.h"
#include "sim/scenario/condition_section.h"

namespace sim::scenario {
namespace {

using agents::Condition;
using agents::EndCondition;

constexpr Range kEndTime{0, hal::files::config::kLongestDuration};  // s

void condition_key(Fields& io, const Key& key, std::optional<Condition>& value,
                   Scenario& scenario) {
  io.own(
      key, {.kind = hal::files::config::Form::Kind::kMapping},
      [&](Mapping& in) {
        if (!in.has(key.name)) return;
        (void)in.mapping(key);
        value = read_condition(in.within(key.name), scenario);
      },
      [&](Writer& out) {
        if (!value) return;
        out.open(key.name);
        write_condition(out, *value, scenario);
        out.close();
      });
}

void state_keys(Fields& io, EndCondition& c, Scenario& scenario) {
  std::string name = c.agent ? declared(*c.agent, scenario).name : "";
  const bool is_read = io.given_text(
      {"agent", "Ends the run when this agent's controller enters `state`.", "NAME0"}, name);
  if (is_read) c.agent = agent_named(*io.reading(), "agent", name, scenario);
  io.only(c.agent.has_value(), {"agent", {"there"}}, "needs agent", [&](Fields& of_agent) {
    of_agent.needed_text(
        {"state", "State that ends the run, by the name that the controller gives it.",
         "FULFILLED"},
        c.state);
  });
  if (is_read)
    scenario.awaited.push_back({io.reading()->place("state"), "end.state", {*c.agent}, c.state});
}

/// What the end waits for: a state, a condition or, without both, a time.
void end_keys(Fields& io, EndCondition& c, Scenario& scenario) {
  state_keys(io, c, scenario);
  io.only(!c.agent, {"agent", {"absent"}}, "cannot be combined with agent", [&](Fields& other) {
    condition_key(
        other,
        {"when",
         "Ends the run when this condition begins to hold; same keys as `when` of `events`.",
         kConditionExample},
        c.when, scenario);
    other.only(!c.when, {"when", {"absent"}}, "cannot be combined with when", [&](Fields& time) {
      time.needed({"at", "Ends the run at this simulated time.", "60 s"}, kEndTime, c.after);
    });
  });
  io.only(c.agent || c.when, {"at", {"absent"}}, "needs agent or when", [&](Fields& later) {
    later.duration({"after", "Time by which the end is delayed.", "1 s"}, kEndTime, c.after);
  });
  io.needed_text({"result", "Name of the result with which the run then ends.", "done"}, c.result);
}

/// Warns of an expected result that the run cannot end with.
void check_result(Mapping& in, const ExpectedResult& expected, const Scenario& scenario) {
  std::vector<std::string> results;
  for (const EndCondition& end : scenario.simulation.ends) results.push_back(end.result);
  for (const Group& group : scenario.groups) {
    for (const Program& program : group.programs) {
      if (program.on_exit == OnExit::kEnd) results.push_back(program.name);
    }
  }
  if (std::ranges::count(results, expected.result) > 0) return;
  in.warn("result", fmt::format("no end condition has the result '{}'{}", expected.result,
                                hal::files::config::suggestion(expected.result, results)));
}

void result_key(Fields& io, Expectation& c, const Scenario& scenario) {
  const auto* const old = std::get_if<ExpectedResult>(&c.condition);
  ExpectedResult expected = old == nullptr ? ExpectedResult{} : *old;
  if (!io.given_text({"result", "Result with which the run must end.", "done"}, expected.result))
    return;
  c.condition = expected;
  check_result(*io.reading(), expected, scenario);
}

/// The first of the two agents: a name or, with `entered`, a pattern.
void find_whose(Mapping& in, const Scenario& scenario, ExpectedDistance& expected) {
  const std::string& whose = expected.whose;
  expected.which = agents_like(whose, scenario);
  const bool is_pattern = whose.find_first_of("*?") != std::string::npos;
  if (!is_pattern) {
    expected.which = {agent_named(in, "distance", whose, scenario)};
  } else if (expected.entered.empty()) {
    in.mistake("distance", fmt::format("'{}' is a pattern: 'entered: STATE' must say which of its "
                                       "agents is meant, the last one to enter that state",
                                       whose));
  } else if (expected.which.empty()) {
    in.mistake("distance", fmt::format("'{}' matches no agent", whose));
  }
}

/// Finds the agents of an expectation after its keys have been read.
void find_agents(Mapping& in, const std::vector<std::string>& names, ExpectedDistance& expected,
                 Scenario& scenario) {
  if (names.size() != 2)
    return in.mistake("distance", fmt::format("must name two agents, not {}", names.size()));
  expected.whose = names[0];
  find_whose(in, scenario, expected);
  expected.to = agent_named(in, "distance", names[1], scenario);
  if (!expected.entered.empty() && !expected.which.empty())
    scenario.awaited.push_back({in.place(), "expect.entered", expected.which, expected.entered});
}

void distance_keys(Fields& io, Expectation& c, Scenario& scenario) {
  const auto* const old = std::get_if<ExpectedDistance>(&c.condition);
  ExpectedDistance expected = old == nullptr ? ExpectedDistance{} : *old;
  std::vector<std::string> names;
  if (old != nullptr) names = {old->whose, declared(old->to, scenario).name};
  Mapping* const in = io.reading();
  const bool is_there = in != nullptr ? in->has("distance") : old != nullptr;
  io.written_if(is_there, [&](Fields& written) {
    written.texts({"distance", "Two agents whose true distance at the end of the run is checked.",
                   "[NAME0, NAME1]"},
                  names);
  });
  io.only(is_there, {"distance", {"there"}}, "needs distance", [&](Fields& of_distance) {
    of_distance.needed({"below", "The distance must be less than this.", "10 m"}, "m", {0, 1e9},
                       expected.below.value);
    of_distance.given_text({"entered",
                            "If a name in `distance` is a pattern, it means the agent that was the "
                            "last to enter this state.",
                            "FULFILLED"},
                           expected.entered);
  });
  if (in == nullptr || !is_there) return;
  find_agents(*in, names, expected, scenario);
  c.condition = expected;
}

void asked_key(Fields& io, bool at_some_time, Expectation& c, Scenario& scenario) {
  std::vector<Condition>& asked = scenario.simulation.asked;
  const auto* const old = std::get_if<ExpectedCondition>(&c.condition);
  std::optional<Condition> condition;
  if (old != nullptr && old->at_some_time == at_some_time) condition = asked[old->asked];
  condition_key(
      io,
      {at_some_time ? "held" : "holds",
       at_some_time
           ? "Condition that must have held at some time of the run; same keys as `when` of "
             "`events`."
           : "Condition that must hold at the end of the run; same keys as `when` of `events`.",
       kConditionExample},
      condition, scenario);
  if (io.reading() == nullptr || !condition) return;
  c.condition = ExpectedCondition{asked.size(), at_some_time};
  asked.push_back(std::move(*condition));
}

/// An expectation has exactly one subject.
void check_subject(Mapping& in) {
  constexpr std::array<const char*, 4> kSubjects{"result", "distance", "holds", "held"};
  const std::vector<std::string> keys = in.keys();
  const auto is_there = [&](const char* subject) { return std::ranges::count(keys, subject) > 0; };
  if (std::ranges::count_if(kSubjects, is_there) != 1)
    in.mistake("", "must have one of result, distance, holds, held");
}

void expectation_keys(Fields& io, Expectation& c, Scenario& scenario) {
  if (io.reading() != nullptr) {
    c.place = io.reading()->place();
    check_subject(*io.reading());
  }
  result_key(io, c, scenario);
  distance_keys(io, c, scenario);
  for (const bool at_some_time : {false, true}) asked_key(io, at_some_time, c, scenario);
}

}  // namespace

void outcome_keys(Fields& io, Scenario& scenario) {
  io.list<EndCondition>(
      {"end", "Conditions that end the run; the first one that is met counts. At least one.",
       "[{at: 60 s, result: done}]", hal::files::config::kMustBeGiven},
      scenario.simulation.ends,
      [&](Fields& one, EndCondition& end) { end_keys(one, end, scenario); });
  if (scenario.simulation.ends.empty())
    io.mistake("end", "must have at least one condition, e.g. {at: 60 s, result: timeout}");
  io.list<Expectation>(
      {"expect", "What must be true at the end of the run; otherwise the exit status is 3.",
       "[{result: done}]"},
      scenario.expectations,
      [&](Fields& one, Expectation& expectation) { expectation_keys(one, expectation, scenario); });
}

}  // namespace sim::scenario
