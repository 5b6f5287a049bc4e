#include "baraka/run/time_advance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

#include "baraka/run/check/program_pace.h"
#include "baraka/run/controllers/inside_controllers.h"
#include "baraka/run/pace/real_time_clock.h"
#include "gateway/process/exit_status.h"
#include "sim/agents/air_door.h"
#include "sim/scenario/resolved.h"

namespace baraka::run {
namespace {

/// Programs that follow the wall clock cannot run faster than it.
std::string pace_of(const RunOptions& options, const sim::scenario::Scenario& scenario) {
  if (!options.repeat.empty()) return "repeated";
  std::string pace = options.pace.empty() ? check::kDefaultPace : options.pace;
  if (!network::has_network(scenario)) return pace;
  const std::optional<double> factor = check::real_time_factor(pace);
  if (!factor) return pace;
  if (std::isfinite(options.max_speed)) {
    throw gateway::process::UsageError(
        "--max-speed: runs with networks keep real time; --pace realtime:F slows the run and its "
        "programs down");
  }
  check::require_pace_for_programs(pace);
  return pace;
}

/// Keys below "agents.<group>." that set the places of stations.
constexpr std::array<std::string_view, 2> kPlacing{"poses.", "station."};

/// Whether a recorded run with programs can be repeated with another value of the key: keys of the
/// radio and of the places of stations. These do not change the inputs from outside.
bool may_differ(const std::string& key, const sim::scenario::Scenario& scenario) {
  constexpr std::string_view kAgents = "agents.", kRadio = "radio.";
  if (key.starts_with(kRadio)) return true;
  if (!key.starts_with(kAgents)) return false;
  for (const sim::scenario::Group& group : scenario.groups) {
    const std::string own = std::string(kAgents) + group.name + ".";
    if (!key.starts_with(own)) continue;
    const std::string_view rest = std::string_view(key).substr(own.size());
    const auto agent = std::ranges::find(scenario.simulation.agents, group.agents.front(),
                                         &sim::agents::AgentConfig::id);
    return rest.starts_with(kRadio) ||
           (!has_body(*agent) && std::ranges::any_of(kPlacing, [&](std::string_view placing) {
             return rest.starts_with(placing);
           }));
  }
  return false;
}

using Values = std::map<std::string, std::string>;

/// One line for each key: "radio.data_rate: 11 Mb/s instead of 2 Mb/s".
std::vector<std::string> differences(const Values& now, const Values& then,
                                     const std::vector<std::string>& keys) {
  std::vector<std::string> lines;
  lines.reserve(keys.size());
  const auto value = [](const Values& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string("nothing") : found->second;
  };
  for (const std::string& key : keys) {
    lines.push_back(fmt::format("{}: {} instead of {}", key, value(now, key), value(then, key)));
  }
  return lines;
}

/// The keys in which the scenario differs from the recorded one.
/// @throws UsageError  a key must not differ.
std::vector<std::string> open_loop_of(const std::filesystem::path& folder,
                                      const sim::scenario::Scenario& scenario) {
  const auto file = folder / "scenario.resolved.yaml";
  std::ifstream resolved(file);
  if (!resolved) {
    throw gateway::process::UsageError(fmt::format("--repeat: '{}' holds no result: there is no {}",
                                                   folder.string(), file.string()));
  }
  const std::string text{std::istreambuf_iterator<char>(resolved), {}};
  if (text == sim::scenario::resolved_yaml(scenario)) return {};
  const auto listed = sim::scenario::resolved_values(scenario);
  const Values now(listed.begin(), listed.end());
  Values then;
  if (network::has_network(scenario)) then = results::record::read_settings(folder);
  std::vector<std::string> keys;
  for (const auto& [key, value] : now) {
    if (!then.contains(key) || then.at(key) != value) keys.push_back(key);
  }
  for (const auto& [key, value] : then) {
    if (!now.contains(key) && !key.starts_with("--")) keys.push_back(key);
  }
  const auto wrong = std::ranges::find_if(
      keys, [&](const std::string& key) { return !may_differ(key, scenario); });
  if (!then.empty() && wrong == keys.end()) return differences(now, then, keys);
  const std::string first =
      then.empty() ? "" : fmt::format(" ({})", differences(now, then, {*wrong}).front());
  throw gateway::process::UsageError(
      fmt::format("--repeat: {} is not of this scenario with these settings{}: see {}",
                  folder.string(), first, file.string()));
}

/// Takes out of a record in lock-step what came from programs, which acted in events of the run.
std::vector<sim::OutsideArrival> take_of_programs(std::vector<sim::OutsideArrival>& arrivals) {
  std::vector<sim::OutsideArrival> of_programs, others;
  for (sim::OutsideArrival& one : arrivals) {
    const bool is_of_programs = one.door == network::kProgramsDoor ||
                                sim::agents::is_air_door(one.door) || controllers::is_reply(one);
    (is_of_programs ? of_programs : others).push_back(std::move(one));
  }
  arrivals = std::move(others);
  return of_programs;
}

}  // namespace

TimeAdvance::TimeAdvance(const RunOptions& options, const sim::scenario::Scenario& scenario)
    : pace_(pace_of(options, scenario)) {
  if (options.repeat.empty()) factor_ = check::real_time_factor(pace_);
  if (options.until) until_ = hal::Time{hal::from_seconds(*options.until)};
  if (options.repeat.empty()) return;
  open_loop_ = open_loop_of(options.repeat, scenario);
  record_ = results::record::read_replay_log(options.repeat);
  if (record_->in_real_time) {
    replies_ = controllers::take_replies(record_->arrivals);
  } else {
    std::ranges::copy_if(record_->arrivals, std::back_inserter(replies_), controllers::is_reply);
  }
  until_ = std::min(until_.value_or(record_->ended_at), record_->ended_at);
}

sim::agents::Outcome TimeAdvance::play(sim::agents::Simulation& simulation, pace::WallPace& pace,
                                       network::NetworkOfRun* network) const {
  if (record_) {
    if (record_->in_real_time) {
      simulation.outside().replay(record_->arrivals);
      return simulation.repeat(until_, record_->turns, pace, !open_loop_.empty());
    }
    std::vector<sim::OutsideArrival> others = record_->arrivals;
    simulation.repeat_arrivals(take_of_programs(others));
    simulation.outside().replay(std::move(others));
    return simulation.run(until_, pace);
  }
  if (!factor_) {
    if (network != nullptr) network->connect(simulation, pace);
    return simulation.run(until_, pace);
  }
  pace::RealTimeClock clock(*factor_, pace);
  if (network != nullptr) network->connect(simulation, clock);
  return simulation.follow(until_, clock);
}

}  // namespace baraka::run
