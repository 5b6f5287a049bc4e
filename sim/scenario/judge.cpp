#include "sim/scenario/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sim::scenario {
namespace {

std::string name_of(hal::AgentId id, const Scenario& scenario) {
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.id == id) return agent.name;
  }
  return fmt::format("{}", id.value);
}

std::optional<std::string> unmet(const ExpectedResult& expected, std::string_view result) {
  if (expected.result == result) return std::nullopt;
  return fmt::format("the result is '{}', expected '{}'", result, expected.result);
}

std::optional<std::string> unmet(const ExpectedDistance& expected, const Scenario& scenario,
                                 const TruePosition& position) {
  const hal::Vec2 apart = position(expected.to) - position(expected.from);
  const double distance = std::sqrt(dot(apart, apart));
  if (distance < expected.below.value) return std::nullopt;
  return fmt::format("{} is {:.3f} m from {}, expected below {} m",
                     name_of(expected.from, scenario), distance, name_of(expected.to, scenario),
                     expected.below.value);
}

}  // namespace

std::vector<std::string> unmet_expectations(const Scenario& scenario, std::string_view result,
                                            const TruePosition& position) {
  std::vector<std::string> lines;
  for (const Expectation& expectation : scenario.expectations) {
    const auto* distance = std::get_if<ExpectedDistance>(&expectation.condition);
    const auto line = distance != nullptr
                          ? unmet(*distance, scenario, position)
                          : unmet(std::get<ExpectedResult>(expectation.condition), result);
    if (line) lines.push_back(fmt::format("{}: expect: {}", expectation.place, *line));
  }
  return lines;
}

}  // namespace sim::scenario
