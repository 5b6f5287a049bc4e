#include "baraka/run/run_ending.h"

#include <fmt/format.h>

#include "baraka/run/network/network_report.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace baraka::run {
namespace {

using sim::agents::Outcome;
using sim::agents::Simulation;

std::vector<std::string> unmet(const sim::scenario::Judge& judge, const Outcome& outcome,
                               const Simulation& simulation) {
  if (outcome.kind != Outcome::Kind::kEnded) return {};
  const auto position = [&](hal::AgentId agent) {
    const sim::agents::BodyState body = simulation.body(agent);
    return hal::Vec2{body.x, body.y};
  };
  return judge.unmet(outcome.result, position, [&](std::size_t asked, bool at_some_time) {
    return at_some_time ? simulation.has_held(asked) : simulation.holds(asked);
  });
}

void print_outcome(const Outcome& outcome, Results& results, double wall_seconds) {
  const double simulated = hal::to_seconds(outcome.ended_at);
  fmt::print("{} {}\nfingerprint: {}\n", hal::coloured_for(stdout, hal::Tone::kResult, "result:"),
             outcome.result, sim::to_hex(results.fingerprint().fingerprint().total()));
  fmt::print("frames_digest: {}\n", sim::to_hex(results.frames_digest()));
  fmt::print("simulated_s: {:.9f}\nwall_s: {:.3f}\n", simulated, wall_seconds);
  fmt::print("real_time_factor: {:.1f}\n", wall_seconds > 0 ? simulated / wall_seconds : 0.0);
  fmt::print("events: {}\nexchanges: {}\n", outcome.events, outcome.exchanges);
  fmt::print("results: {}\n", results.folder().path().string());
}

void print_real_time(const sim::agents::RealTimeSummary& summary) {
  fmt::print("overruns: {}\nmissed_cycles: {}\n", summary.overruns, summary.missed_cycles);
  fmt::print("command_timeouts: {}\nlost_events: {}\n", summary.command_timeouts,
             summary.lost_events);
  fmt::print("control_jitter_median_s: {:.6f}\n", hal::to_seconds(summary.jitter_median));
  fmt::print("control_jitter_p99_s: {:.6f}\n", hal::to_seconds(summary.jitter_p99));
  fmt::print("control_jitter_max_s: {:.6f}\n", hal::to_seconds(summary.jitter_max));
  for (const std::string& line : summary.overflow) {
    hal::print_line(hal::Tone::kWarning,
                    "warning: overflow, events lost for the controller of " + line);
  }
}

/// Problems that did not end the run, for display.
void print_complaints(const Outcome& outcome, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    hal::print_line(hal::Tone::kWarning, "warning: " + hal::printable(line));
  }
  if (outcome.refused_actions > 0) {
    hal::print_line(
        hal::Tone::kWarning,
        fmt::format("warning: {} actions refused; run.log names them", outcome.refused_actions));
  }
  for (const std::string& line : outcome.bodies_lost) {
    hal::print_line(hal::Tone::kWarning, "warning: " + line);
  }
  if (outcome.ode_messages > 0) {
    hal::print_line(hal::Tone::kWarning, fmt::format("warning: the physics engine gave {} warnings",
                                                     outcome.ode_messages));
  }
  if (!outcome.error.empty()) {
    hal::print_line(hal::Tone::kMistake, "error: " + hal::printable_lines(outcome.error));
  }
}

gateway::process::ExitStatus exit_status(const Outcome& outcome,
                                         const std::vector<std::string>& unmet_expectations) {
  switch (outcome.kind) {
    case Outcome::Kind::kFailed:
      return gateway::process::kRunFailed;
    case Outcome::Kind::kInterrupted:
      return gateway::process::kInterrupted;
    case Outcome::Kind::kUntil:
    case Outcome::Kind::kEnded:
      break;
  }
  return unmet_expectations.empty() ? gateway::process::kDone
                                    : gateway::process::kExpectationNotMet;
}

/// Null: no programs used the interfaces.
const sim::agents::AirSummary* air_of(const Outcome& outcome) {
  if (outcome.held_air) return &*outcome.held_air;
  return outcome.real_time && outcome.real_time->air ? &*outcome.real_time->air : nullptr;
}

}  // namespace

void end_network(network::NetworkOfRun& network, RunEnding& ending, const TimeAdvance& time_advance,
                 const sim::scenario::Scenario& scenario, Results& results) {
  ending.network = network.finish(ending.outcome.kind != Outcome::Kind::kFailed);
  const sim::agents::AirSummary* const air = air_of(ending.outcome);
  if (air == nullptr) return;
  const std::vector<std::string> lines =
      ending.network->lockstep
          ? network::held_network_warnings(*air, *ending.network)
          : network::network_warnings(*air, *ending.network, *time_advance.factor(),
                                      scenario.simulation.lateness_limit);
  if (lines.empty()) return;
  results.add_warnings(lines);
  ending.complaints.insert(ending.complaints.end(), lines.begin(), lines.end());
}

gateway::process::ExitStatus conclude(Results& results, const sim::scenario::Judge& judge,
                                      const Simulation& simulation, RunEnding&& ending) {
  auto& [outcome, complaints, wall_seconds, network] = ending;
  const auto expectations = unmet(judge, outcome, simulation);
  if (network) results.add(*network);
  const gateway::process::ExitStatus status =
      results.finish(simulation, outcome, exit_status(outcome, expectations), wall_seconds);

  print_complaints(outcome, complaints);
  for (const std::string& line : expectations) {
    hal::print_line(hal::Tone::kMistake, "not met: " + line);
  }
  if (outcome.real_time) print_real_time(*outcome.real_time);
  const sim::agents::AirSummary* const air = air_of(outcome);
  if (air != nullptr && network) network::print_network(*air, *network);
  print_outcome(outcome, results, wall_seconds);
  return status;
}

}  // namespace baraka::run
