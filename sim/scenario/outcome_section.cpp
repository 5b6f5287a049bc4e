#include "sim/scenario/outcome_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hal/config/suggest.h"
#include "sim/scenario/agent_names.h"
#include "sim/scenario/condition_section.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/given_keys.h"

namespace sim::scenario {
namespace {

using agents::EndCondition;
using hal::AgentId;

constexpr Range kEndTime{0, hal::config::kLongestDuration};  // s

EndCondition read_end(Mapping& in, Scenario& scenario) {
  EndCondition end;
  if (in.has("agent")) {
    end.agent = agent_named(
        in, "agent",
        in.text({"agent", "The run ends when this agent's controller enters a state.", "NAME0"}),
        scenario);
    end.state = in.text({"state", "That state, as the controller calls it.", "FULFILLED"});
    end.after = in.duration({"after", "So much later.", "1 s"}, kEndTime, hal::Duration{});
    in.refuse("at", "cannot stand beside agent");
    in.refuse("when", "cannot stand beside agent");
    scenario.awaited.push_back({in.place("state"), "end.state", {*end.agent}, end.state});
  } else if (in.has("when")) {
    (void)in.mapping({"when",
                      "The run ends when this condition begins to hold: as `when` of `events`.",
                      kConditionExample});
    end.when = read_condition(in.within("when"), scenario);
    end.after = in.duration({"after", "So much later.", "1 s"}, kEndTime, hal::Duration{});
    in.refuse("at", "cannot stand beside when");
  } else {
    end.after = in.duration({"at", "The run ends at this time.", "60 s"}, kEndTime);
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

/// What an expectation is about: one of them.
constexpr std::array<const char*, 4> kExpected{"result", "distance", "holds", "held"};

/// Two agents from a list of two names.
ExpectedDistance read_expected_distance(Mapping& in, Scenario& scenario) {
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
  expected.below = hal::Metres{
      in.number({"below", "With `distance`: it must be smaller.", "10 m"}, "m", {0, 1e9})};
  if (!expected.entered.empty() && !expected.which.empty())
    scenario.awaited.push_back({in.place(), "expect.entered", expected.which, expected.entered});
  return expected;
}

ExpectedCondition read_expected_condition(Mapping& in, const std::string& key, Scenario& scenario) {
  const bool at_some_time = key == "held";
  (void)in.mapping({key,
                    at_some_time ? "This condition must have held at some time of the run: as "
                                   "`when` of `events`."
                                 : "This condition must hold at the end of the run: as `when` of "
                                   "`events`.",
                    kConditionExample});
  scenario.simulation.asked.push_back(read_condition(in.within(key), scenario));
  return {scenario.simulation.asked.size() - 1, at_some_time};
}

Expectation read_expectation(Mapping& in, Scenario& scenario) {
  Expectation expectation{ExpectedResult{}, in.place()};
  const GivenKeys keys(in);
  const auto given =
      std::ranges::count_if(kExpected, [&](const char* key) { return keys.has(key); });
  if (given != 1 && !keys.is_survey()) {
    in.mistake("", "must have one of result, distance, holds, held");
    for (const char* key : kExpected) in.has(key);
    for (const char* key : {"below", "entered"}) in.has(key);
    in.finish();
    return expectation;
  }
  if (keys.has("distance")) expectation.condition = read_expected_distance(in, scenario);
  if (keys.has("result")) expectation.condition = read_result(in, scenario);
  for (const char* key : {"holds", "held"}) {
    if (keys.has(key)) expectation.condition = read_expected_condition(in, key, scenario);
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
      out.text("agent", declared(*end.agent, scenario).name);
      out.text("state", end.state);
      out.duration("after", end.after);
    } else if (end.when) {
      out.open("when");
      write_condition(out, *end.when, scenario);
      out.close();
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
      out.texts("distance", {distance->whose, declared(distance->to, scenario).name});
      out.number("below", distance->below.value, "m");
      if (!distance->entered.empty()) out.text("entered", distance->entered);
    } else if (const auto* asked = std::get_if<ExpectedCondition>(&expectation.condition)) {
      out.open(asked->at_some_time ? "held" : "holds");
      write_condition(out, scenario.simulation.asked[asked->asked], scenario);
      out.close();
    } else {
      out.text("result", std::get<ExpectedResult>(expectation.condition).result);
    }
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
