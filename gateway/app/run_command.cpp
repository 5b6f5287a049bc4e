#include "gateway/app/run_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "gateway/app/course.h"
#include "gateway/app/exit_status.h"
#include "gateway/app/judge_controllers.h"
#include "gateway/app/results_folder.h"
#include "gateway/app/run_inspection.h"
#include "gateway/app/wall_pace.h"
#include "hal/types/log.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/simulation.h"
#include "sim/core/log_sink.h"
#include "sim/record/recorder.h"
#include "sim/scenario/judge.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace gateway::app {
namespace {

using sim::agents::Outcome;
using sim::agents::Simulation;
using sim::scenario::Scenario;

/// The results that are written, and the observers that write them.
struct Results {
  Results(const Scenario& scenario, const std::filesystem::path& out)
      : folder(out),
        recorder(folder.path() / "run.sqlite", scenario.simulation,
                 {.pose_period = scenario.record.pose_period,
                  .all_frames = scenario.record.frames == sim::scenario::FrameRecord::kAll}) {
    recorder.add_settings(sim::scenario::resolved_values(scenario));
    recorder.set("scenario", scenario.name);
    recorder.set("version", BARAKA_VERSION);
    sim::log_to_file((folder.path() / "run.log").string());
    std::ofstream(folder.path() / "scenario.resolved.yaml")
        << sim::scenario::resolved_yaml(scenario);
  }

  /// In one transaction: a result either says how the run ended, or that it did not.
  void finish(const Scenario& scenario, const Simulation& simulation, const Outcome& outcome,
              ExitStatus status, double wall_seconds) {
    for (const auto& agent : scenario.simulation.agents) {
      recorder.add_contacts(agent.id, simulation.contacts(agent.id));
    }
    recorder.set("wall_s", wall_seconds);
    recorder.set("exit_status", std::uint64_t{status});
    recorder.finish(outcome, fingerprint.fingerprint());
    sim::flush_log();
  }

  ResultsFolder folder;
  sim::record::Recorder recorder;
  sim::agents::FingerprintFeed fingerprint;
};

std::vector<std::string> unmet(const Scenario& scenario, const Outcome& outcome,
                               const Simulation& simulation) {
  if (outcome.kind != Outcome::Kind::kEnded) return {};
  return sim::scenario::unmet_expectations(scenario, outcome.result, [&](hal::AgentId agent) {
    const sim::agents::BodyState body = simulation.body(agent);
    return hal::Vec2{body.x, body.y};
  });
}

void print_outcome(const Outcome& outcome, std::uint64_t fingerprint, double wall_seconds) {
  const double simulated = hal::to_seconds(outcome.ended_at);
  fmt::print("result: {}\nfingerprint: {}\n", outcome.result, sim::to_hex(fingerprint));
  fmt::print("simulated_s: {:.9f}\nwall_s: {:.3f}\n", simulated, wall_seconds);
  fmt::print("real_time_factor: {:.1f}\n", wall_seconds > 0 ? simulated / wall_seconds : 0.0);
  fmt::print("events: {}\nexchanges: {}\n", outcome.events, outcome.exchanges);
}

void print_real_time(const sim::agents::RealTimeSummary& summary) {
  fmt::print("overruns: {}\nmissed_cycles: {}\n", summary.overruns, summary.missed_cycles);
  fmt::print("command_timeouts: {}\nlost_events: {}\n", summary.command_timeouts,
             summary.lost_events);
  fmt::print("control_jitter_median_s: {:.6f}\n", hal::to_seconds(summary.jitter_median));
  fmt::print("control_jitter_p99_s: {:.6f}\n", hal::to_seconds(summary.jitter_p99));
  fmt::print("control_jitter_max_s: {:.6f}\n", hal::to_seconds(summary.jitter_max));
  for (const std::string& line : summary.overflow) {
    fmt::print(stderr, "warning: overflow, lost for the controller of {}\n", line);
  }
}

/// What went wrong without ending the run, for people.
void print_complaints(const Outcome& outcome, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) fmt::print(stderr, "warning: {}\n", line);
  if (outcome.refused_actions > 0) {
    fmt::print(stderr, "warning: {} actions refused; run.log names them\n",
               outcome.refused_actions);
  }
  for (const std::string& line : outcome.bodies_lost) fmt::print(stderr, "warning: {}\n", line);
  if (outcome.ode_messages > 0) {
    fmt::print(stderr, "warning: the physics engine complained {} times\n", outcome.ode_messages);
  }
  if (!outcome.error.empty()) fmt::print(stderr, "error: {}\n", outcome.error);
}

ExitStatus exit_status(const Outcome& outcome, const std::vector<std::string>& unmet_expectations) {
  switch (outcome.kind) {
    case Outcome::Kind::kFailed:
      return kRunFailed;
    case Outcome::Kind::kInterrupted:
      return kInterrupted;
    case Outcome::Kind::kUntil:
    case Outcome::Kind::kEnded:
      break;
  }
  return unmet_expectations.empty() ? kDone : kExpectationNotMet;
}

}  // namespace

std::filesystem::path results_path(const RunOptions& options, const std::string& scenario) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path("results") / scenario;
}

int run(const RunOptions& options) {
  const Scenario scenario = load_judged(options.scenario, options.overrides);
  catch_interrupts();
  const Course course(options, scenario);
  RunInspection inspection(scenario, {.shown = options.inspect,
                                      .domain = options.inspect_domain,
                                      .repeated = !options.repeat.empty()});
  const std::filesystem::path out = results_path(options, scenario.name);
  std::error_code not_there;
  if (!options.repeat.empty() && std::filesystem::equivalent(options.repeat, out, not_there)) {
    throw UsageError(
        fmt::format("--repeat: {} would be overwritten; give another --out", options.repeat));
  }
  Results results(scenario, out);
  Simulation simulation(scenario.simulation,
                        {&results.recorder, &results.fingerprint, &inspection.observer()});
  ControllersOfRun controllers(
      scenario, simulation,
      {.from = options.controllers, .domain = options.domain, .logs = results.folder.path()});
  inspection.start(controllers.domain() ? controllers.domain() : options.domain, simulation);
  WallPace pace({.max_speed = options.max_speed,
                 .terminal = ::isatty(STDERR_FILENO) != 0,
                 .processes = controllers.processes(),
                 .once_a_second = [&results] { results.recorder.commit(); }});
  results.recorder.set("pace", options.repeat.empty() ? options.pace : "repeated");

  const Outcome outcome = course.play(simulation, pace);
  pace.end();
  const auto complaints = controllers.finish(outcome.kind != Outcome::Kind::kFailed);
  const auto expectations = unmet(scenario, outcome, simulation);
  const ExitStatus status = exit_status(outcome, expectations);
  results.finish(scenario, simulation, outcome, status, pace.wall_seconds());

  print_complaints(outcome, complaints);
  for (const std::string& line : expectations) fmt::print(stderr, "not met: {}\n", line);
  if (outcome.real_time) print_real_time(*outcome.real_time);
  print_outcome(outcome, results.fingerprint.fingerprint().total(), pace.wall_seconds());
  return status;
}

int check(const std::string& path, const std::vector<std::string>& overrides) {
  load_judged(path, overrides);
  fmt::print("{}: ok\n", path);
  return kDone;
}

}  // namespace gateway::app
