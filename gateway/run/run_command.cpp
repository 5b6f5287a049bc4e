#include "gateway/run/run_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>

#include "gateway/exit_status.h"
#include "gateway/run/course.h"
#include "gateway/run/domain_range.h"
#include "gateway/run/judge_controllers.h"
#include "gateway/run/last_resort.h"
#include "gateway/run/network_of_run.h"
#include "gateway/run/network_report.h"
#include "gateway/run/once.h"
#include "gateway/run/results.h"
#include "gateway/run/run_inspection.h"
#include "gateway/run/start_inside.h"
#include "gateway/run/wall_pace.h"
#include "hal/types/log.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/judge.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace gateway {
namespace {

using sim::agents::Outcome;
using sim::agents::Simulation;
using sim::scenario::Scenario;

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
    hal::print_line(hal::Tone::kWarning, "warning: overflow, lost for the controller of " + line);
  }
}

/// What went wrong without ending the run, for people.
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
    hal::print_line(
        hal::Tone::kWarning,
        fmt::format("warning: the physics engine complained {} times", outcome.ode_messages));
  }
  if (!outcome.error.empty()) {
    hal::print_line(hal::Tone::kMistake, "error: " + hal::printable_lines(outcome.error));
  }
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

/// @throws UsageError  the run that is repeated is in the folder that its result is for.
void check_repeat(const RunOptions& options, const std::string& scenario) {
  if (options.repeat.empty()) return;
  std::error_code not_there;
  if (!std::filesystem::equivalent(options.repeat, results_path(options, scenario), not_there)) {
    return;
  }
  throw UsageError(
      fmt::format("--repeat: {} would be overwritten; give another --out", options.repeat));
}

/// None: the first free one. @throws UsageError
std::optional<int> domain_of(const RunOptions& options) {
  const std::vector<int> domains = domains_for(options.domain, 1);
  if (domains.size() > 1) {
    throw UsageError("--domain: a range is for --replications with --jobs; this run takes one");
  }
  return domains.empty() ? std::nullopt : std::optional(domains.front());
}

/// To its end, which is a failure if it was broken off by an exception: a full disk, mostly.
Outcome play(const Course& course, Simulation& simulation, WallPace& pace, NetworkOfRun* network) {
  try {
    return course.play(simulation, pace, network);
  } catch (const std::exception& e) {
    return simulation.broken_off_by(e.what());
  }
}

/// A run that is over.
struct Ending {
  Outcome outcome;
  std::vector<std::string> complaints;  ///< Of its controllers.
  double wall_seconds = 0;
  std::optional<NetworkSummary> network = {};
};

/// First of all: it forks. @return null: the scenario has none, or this is a repetition.
std::unique_ptr<NetworkOfRun> network_of(const std::string& file, const Scenario& scenario,
                                         const Course& course, const Results& results) {
  if (!has_network(scenario) || course.is_repeated()) return nullptr;
  return std::make_unique<NetworkOfRun>(scenario, file, *course.factor(),
                                        [&results] { return results.folder().path(); });
}

/// Ends the programs, and adds to the complaints what speaks against the result.
void end_network(NetworkOfRun& network, Ending& ending, const Course& course,
                 const Scenario& scenario, Results& results) {
  ending.network = network.finish();
  if (!ending.outcome.real_time || !ending.outcome.real_time->air) return;
  const std::vector<std::string> lines =
      network_warnings(*ending.outcome.real_time->air, *ending.network, *course.factor(),
                       scenario.simulation.lateness_limit);
  if (lines.empty()) return;
  results.add_warnings(lines);
  ending.complaints.insert(ending.complaints.end(), lines.begin(), lines.end());
}

/// That what would have been sent then is not what was sent.
void say_open_loop(const Course& course, Results& results) {
  if (course.open_loop().empty()) return;
  fmt::print(stderr,
             "open loop: the programs of the recorded run saw another radio; what they would have "
             "sent over this one is not known\n");
  for (const std::string& line : course.open_loop()) {
    hal::log::warning({}, "run", "open loop: {}", line);
  }
  results.add_open_loop(course.open_loop());
}

/// Writes and prints how the run ended.
ExitStatus conclude(Results& results, const sim::scenario::Judge& judge,
                    const Simulation& simulation, Ending&& ending) {
  auto& [outcome, complaints, wall_seconds, network] = ending;
  const auto expectations = unmet(judge, outcome, simulation);
  if (network) results.add(*network);
  const ExitStatus status =
      results.finish(simulation, outcome, exit_status(outcome, expectations), wall_seconds);

  print_complaints(outcome, complaints);
  for (const std::string& line : expectations) {
    hal::print_line(hal::Tone::kMistake, "not met: " + line);
  }
  if (outcome.real_time) print_real_time(*outcome.real_time);
  if (outcome.real_time && outcome.real_time->air && network) {
    print_network(*outcome.real_time->air, *network);
  }
  print_outcome(outcome, results, wall_seconds);
  return status;
}

template <class T>
T* pointer_to(std::optional<T>& one) {
  return one ? &*one : nullptr;
}

std::optional<int> first_of(std::optional<int> one, std::optional<int> other) {
  return one ? one : other;
}

/// Of controllers inside; none: there are no networks.
std::optional<StartInside> starter_in(NetworkOfRun* network) {
  if (network == nullptr) return std::nullopt;
  return std::optional<StartInside>(std::in_place, *network);
}

/// Simulated seconds per second of a run that somebody looks at, unless they say otherwise.
constexpr double kLookedAtSpeed = 1;

LiveView::Settings live_view_of(const RunOptions& options, const Course& course,
                                RunInspection& inspection, Results& results) {
  return {
      .options = options.view,
      .lockstep = !course.factor(),
      .max_speed = std::isfinite(options.max_speed) ? options.max_speed : kLookedAtSpeed,
      .commit = [&results] { results.commit(); },
      .drive = [&inspection](hal::AgentId agent,
                             const hal::Twist2& twist) { return inspection.drive(agent, twist); }};
}

void start(LiveView& view, const RunOptions& options, const Course& course,
           const Results& results) {
  view.start(results.folder().path());
  if (course.factor() || std::isfinite(options.max_speed)) return;
  fmt::print(stderr, "view: it plays at real time; --max-speed F, or the page, makes it faster\n");
}

/// When it ends at the latest, by `--until` or by a time of the scenario; none: no time ends it.
std::optional<hal::Time> latest_end(const RunOptions& options, const Scenario& scenario) {
  std::optional<hal::Time> end;
  if (options.until) end = hal::Time{hal::from_seconds(*options.until)};
  for (const auto& condition : scenario.simulation.ends) {
    if (condition.agent || condition.when) continue;
    const hal::Time at{condition.after};
    end = std::min(end.value_or(at), at);
  }
  return end;
}

bool has_other_ends(const Scenario& scenario) {
  return std::ranges::any_of(scenario.simulation.ends, [](const auto& condition) {
    return condition.agent.has_value() || condition.when.has_value();
  });
}

/// @param view  holds the run; null: nothing does.
WallPace::Settings pace_of(const RunOptions& options, const Scenario& scenario,
                           std::size_t processes, Results& results, LiveView* view) {
  WallPace::Settings settings{.max_speed = options.max_speed,
                              .terminal = ::isatty(STDERR_FILENO) != 0,
                              .processes = processes,
                              .end = latest_end(options, scenario),
                              .may_end_earlier = has_other_ends(scenario),
                              .once_a_second = [&results] { results.commit(); }};
  if (view == nullptr) return settings;
  settings.max_speed = std::numeric_limits<double>::infinity();  // the view's own can be changed
  settings.hold = [&control = view->control()](hal::Time next) { return control.hold(next); };
  return settings;
}

int run(const RunOptions& options, const Scenario& scenario, const Course& course,
        RunInspection& inspection, Results& results) {
  const std::optional<int> domain = domain_of(options);
  const auto network = network_of(options.scenario, scenario, course, results);
  sim::scenario::Judge judge(scenario);
  Simulation simulation(scenario.simulation, {&judge, &inspection.observer()});
  open_programs_door(scenario, simulation);
  std::optional<WallPace> pace;
  const LastResort last_resort([&](const std::string& what, bool failed) -> int {
    if (!results.has_begun()) {
      results.say_not_started(what);
      hal::print_line(hal::Tone::kMistake, "error: " + hal::printable(what));
      return failed ? kRunFailed : kInterrupted;
    }
    pace->end();
    return conclude(
        results, judge, simulation,
        {simulation.broken_off_by(failed ? what : ""),
         failed ? std::vector<std::string>{} : std::vector{what}, pace->wall_seconds()});
  });
  std::optional<StartInside> inside = starter_in(network.get());
  ControllersOfRun controllers(scenario, simulation,
                               {.from = options.controllers,
                                .domain = domain,
                                .logs = results.folder().path(),
                                .inside = pointer_to(inside),
                                .replies = course.replies()});
  inspection.start(first_of(controllers.domain(), domain), simulation);
  std::unique_ptr<LiveView> view;
  if (options.view.shown) {
    view = std::make_unique<LiveView>(scenario, simulation,
                                      live_view_of(options, course, inspection, results));
  }
  pace.emplace(pace_of(options, scenario, controllers.processes(), results, view.get()));
  results.begin(simulation);
  if (view) start(*view, options, course, results);
  say_open_loop(course, results);
  inspection.set_ledger(results.ledger());

  const Outcome outcome = play(course, simulation, *pace, network.get());
  pace->end();
  Ending ending{.outcome = outcome,
                .complaints = controllers.finish(outcome.kind != Outcome::Kind::kFailed,
                                                 results.folder().path()),
                .wall_seconds = pace->wall_seconds()};
  if (network) end_network(*network, ending, course, scenario, results);
  const ExitStatus status = conclude(results, judge, simulation, std::move(ending));
  if (view) view->end(outcome);
  return status;
}

/// Of a run that was not needed.
int say_finished(const FinishedResult& finished, const std::filesystem::path& folder) {
  fmt::print(stderr, "the result is there already\n");
  fmt::print("{} {}\nfingerprint: {}\nresults: {}\n",
             hal::coloured_for(stdout, hal::Tone::kResult, "result:"),
             hal::printable(finished.result), hal::printable(finished.fingerprint),
             folder.string());
  return finished.status;
}

}  // namespace

std::filesystem::path results_path(const RunOptions& options, const std::string& scenario) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path("results") / scenario;
}

RunWay way_of(const RunOptions& options) {
  return {.controllers = options.controllers,
          .has_domain = options.inspect_domain.has_value(),
          .is_repeated = !options.repeat.empty(),
          .factor = factor_of_programs(options.pace)};
}

std::string until_words(const RunOptions& options) {
  return options.until ? fmt::format("{} s", *options.until) : "its end";
}

int run(const RunOptions& options) {
  const Scenario scenario = load_judged(options.scenario, options.overrides, way_of(options));
  catch_interrupts();
  const Course course(options, scenario);
  (void)domain_of(options);  // before anything is written
  RunInspection inspection(scenario, {.shown = options.inspect,
                                      .domain = options.inspect_domain,
                                      .repeated = !options.repeat.empty()});
  check_repeat(options, scenario.name);
  std::unique_ptr<FolderLock> held;
  if (options.once) {
    const std::filesystem::path folder = results_path(options, scenario.name);
    held = hold_when_free(folder);
    const auto finished = finished_result(folder, scenario.simulation.seed);
    if (finished) {
      require_result_of(folder, sim::scenario::resolved_yaml(scenario), until_words(options));
      return say_finished(*finished, folder);
    }
  }
  Results results(scenario, options, course.pace(), std::move(held));
  try {
    return run(options, scenario, course, inspection, results);
  } catch (const std::exception& e) {
    results.say_not_started(e.what());
    throw;
  }
}

}  // namespace gateway
