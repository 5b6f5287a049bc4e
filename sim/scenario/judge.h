#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/agents/observer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// True position of an agent at the end of the run [m, world frame].
using TruePosition = std::function<hal::Vec2(hal::AgentId)>;

/// Whether a condition of SimulationConfig::asked holds at the end of the run, or has held at any
/// time of the run.
using TrueCondition = std::function<bool(std::size_t asked, bool at_some_time)>;

/// Judges a run by the expectations of its scenario. It is an observer because the end of a run
/// does not show which states the agents' controllers have entered.
///
///   Judge judge(scenario);
///   Simulation simulation(scenario.simulation, {&judge, …});
///   …run…
///   const auto lines = judge.unmet(outcome.result, position, condition);
class Judge final : public agents::Observer {
 public:
  /// @param scenario  outlives the judge.
  explicit Judge(const Scenario& scenario);

  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;

  /// The expectations that are not met, one line each: "place: expect: what was seen and what was
  /// expected". Empty: all are met.
  /// @param condition  may be empty if no expectation has a condition.
  std::vector<std::string> unmet(std::string_view result, const TruePosition& position,
                                 const TrueCondition& condition = {}) const;

 private:
  std::optional<std::string> unmet(const ExpectedResult& expected, std::string_view result) const;
  std::optional<std::string> unmet(const ExpectedDistance& expected,
                                   std::optional<hal::AgentId> who,
                                   const TruePosition& position) const;

  std::optional<std::string> unmet(const ExpectedCondition& expected,
                                   const TrueCondition& condition) const;

  const Scenario& scenario_;
  /// For each expectation the agent that it is about. With `entered`, nullopt until an agent has
  /// entered that state.
  std::vector<std::optional<hal::AgentId>> who_;
};

}  // namespace sim::scenario
