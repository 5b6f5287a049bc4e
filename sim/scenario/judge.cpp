#include "sim/scenario/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sim::scenario {
namespace {

std::string name_of(hal::AgentId id, const Scenario& scenario) {
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.id == id) return agent.name;
  }
  return fmt::format("{}", id.value);
}

}  // namespace

Judge::Judge(const Scenario& scenario) : scenario_(scenario) {
  for (const Expectation& expectation : scenario.expectations) {
    const auto* distance = std::get_if<ExpectedDistance>(&expectation.condition);
    const bool is_fixed = distance != nullptr && distance->entered.empty();
    who_.push_back(is_fixed ? std::optional(distance->which.front()) : std::nullopt);
  }
}

void Judge::on_state(hal::Time, hal::AgentId agent, std::string_view state) {
  for (std::size_t i = 0; i < who_.size(); ++i) {
    const auto* distance = std::get_if<ExpectedDistance>(&scenario_.expectations[i].condition);
    if (distance == nullptr || distance->entered != state) continue;
    if (std::ranges::find(distance->which, agent) != distance->which.end()) who_[i] = agent;
  }
}

std::vector<std::string> Judge::unmet(std::string_view result, const TruePosition& position,
                                      const TrueCondition& condition) const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < who_.size(); ++i) {
    const Expectation& expectation = scenario_.expectations[i];
    std::optional<std::string> line;
    if (const auto* distance = std::get_if<ExpectedDistance>(&expectation.condition)) {
      line = unmet(*distance, who_[i], position);
    } else if (const auto* asked = std::get_if<ExpectedCondition>(&expectation.condition)) {
      line = unmet(*asked, condition);
    } else {
      line = unmet(std::get<ExpectedResult>(expectation.condition), result);
    }
    if (line) lines.push_back(fmt::format("{}: expect: {}", expectation.place, *line));
  }
  return lines;
}

std::optional<std::string> Judge::unmet(const ExpectedResult& expected,
                                        std::string_view result) const {
  if (expected.result == result) return std::nullopt;
  return fmt::format("the result is '{}', expected '{}'", result, expected.result);
}

std::optional<std::string> Judge::unmet(const ExpectedCondition& expected,
                                        const TrueCondition& condition) const {
  if (condition(expected.asked, expected.at_some_time)) return std::nullopt;
  std::vector<std::pair<hal::AgentId, std::string>> names;
  for (const agents::AgentConfig& agent : scenario_.simulation.agents)
    names.emplace_back(agent.id, agent.name);
  return fmt::format("{}: {}",
                     expected.at_some_time ? "never held in the run" : "does not hold at the end",
                     to_text(scenario_.simulation.asked[expected.asked], names));
}

std::optional<std::string> Judge::unmet(const ExpectedDistance& expected,
                                        std::optional<hal::AgentId> who,
                                        const TruePosition& position) const {
  const std::string wanted = fmt::format("expected below {} m", expected.below.value);
  if (!who) {
    return fmt::format("no agent of '{}' has entered {}, {} from {}", expected.whose,
                       expected.entered, wanted, name_of(expected.to, scenario_));
  }
  const hal::Vec2 apart = position(expected.to) - position(*who);
  const double distance = std::sqrt(hal::dot(apart, apart));
  if (distance < expected.below.value) return std::nullopt;
  return fmt::format("{} is {:.3f} m from {}, {}", name_of(*who, scenario_), distance,
                     name_of(expected.to, scenario_), wanted);
}

}  // namespace sim::scenario
