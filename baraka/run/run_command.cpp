#include "baraka/run/run_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>

#include "baraka/run/check/check_scenario.h"
#include "baraka/run/check/program_pace.h"
#include "baraka/run/domain_range.h"
#include "baraka/run/forced_end.h"
#include "baraka/run/network/namespace_starter.h"
#include "baraka/run/network/network_of_run.h"
#include "baraka/run/output/finished_result.h"
#include "baraka/run/output/wait_for_lock.h"
#include "baraka/run/pace/interrupts.h"
#include "baraka/run/pace/wall_pace.h"
#include "baraka/run/results.h"
#include "baraka/run/run_ending.h"
#include "baraka/run/time_advance.h"
#include "baraka/run/topics/run_inspection.h"
#include "gateway/process/exit_status.h"
#include "hal/types/log.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/judge.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace baraka::run {
namespace {

using sim::agents::Outcome;
using sim::agents::Simulation;
using sim::scenario::Scenario;

/// @throws UsageError  the recorded run is in the folder to which the repetition would write.
void check_repeat(const RunOptions& options, const std::string& scenario) {
  if (options.repeat.empty()) return;
  std::error_code not_there;
  if (!std::filesystem::equivalent(options.repeat, results_path(options, scenario), not_there)) {
    return;
  }
  throw gateway::process::UsageError(
      fmt::format("--repeat: {} would be overwritten; give another --out", options.repeat));
}

/// The DDS domain; none: the first free one. @throws UsageError
std::optional<int> domain_of(const RunOptions& options) {
  const std::vector<int> domains = domains_for(options.domain, 1);
  if (domains.size() > 1) {
    throw gateway::process::UsageError(
        "--domain: a range is for --replications with --jobs; this run takes one");
  }
  return domains.empty() ? std::nullopt : std::optional(domains.front());
}

/// Runs to the end. An exception, mostly because of a full disk, makes the run a failed one.
Outcome play(const TimeAdvance& time_advance, Simulation& simulation, pace::WallPace& pace,
             network::NetworkOfRun* network) {
  try {
    return time_advance.play(simulation, pace, network);
  } catch (const std::exception& e) {
    return simulation.broken_off_by(e.what());
  }
}

/// To be called first, because it forks. @return null: the scenario has no networks, or this is a
/// repetition.
std::unique_ptr<network::NetworkOfRun> network_of(const std::string& file, const Scenario& scenario,
                                                  const TimeAdvance& time_advance,
                                                  const Results& results) {
  if (!network::has_network(scenario) || time_advance.is_repeated()) return nullptr;
  return std::make_unique<network::NetworkOfRun>(scenario, file,
                                                 check::program_time(time_advance.pace()),
                                                 [&results] { return results.folder().path(); });
}

/// Warns that a repetition with other settings replays the frames that were sent in the recorded
/// run, not those that programs would have sent.
void say_open_loop(const TimeAdvance& time_advance, Results& results) {
  if (time_advance.open_loop().empty()) return;
  fmt::print(stderr,
             "open loop: the programs of the recorded run saw another radio; what they would have "
             "sent over this one is not known\n");
  for (const std::string& line : time_advance.open_loop()) {
    hal::log::warning({}, "run", "open loop: {}", line);
  }
  results.add_open_loop(time_advance.open_loop());
}

template <class T>
T* pointer_to(std::optional<T>& one) {
  return one ? &*one : nullptr;
}

std::optional<int> first_of(std::optional<int> one, std::optional<int> other) {
  return one ? one : other;
}

/// The starter of controllers inside networks; none: there are no networks.
std::optional<network::NamespaceStarter> starter_in(network::NetworkOfRun* network) {
  if (network == nullptr) return std::nullopt;
  return std::optional<network::NamespaceStarter>(std::in_place, *network);
}

/// Default speed of a run that is shown in a browser, simulated seconds per second.
constexpr double kLookedAtSpeed = 1;

live::LiveView::Settings live_view_of(const RunOptions& options, const TimeAdvance& time_advance,
                                      topics::RunInspection& inspection, Results& results) {
  return {
      .options = options.view,
      .lockstep = !time_advance.factor(),
      .max_speed = std::isfinite(options.max_speed) ? options.max_speed : kLookedAtSpeed,
      .commit = [&results] { results.commit(); },
      .drive = [&inspection](hal::AgentId agent,
                             const hal::Twist2& twist) { return inspection.drive(agent, twist); }};
}

void start(live::LiveView& view, const RunOptions& options, const TimeAdvance& time_advance,
           const Results& results) {
  view.start(results.folder().path());
  if (time_advance.factor() || std::isfinite(options.max_speed)) return;
  fmt::print(stderr, "view: it plays at real time; --max-speed F, or the page, makes it faster\n");
}

/// Latest end of the run, by `--until` or by a time of the scenario; none: no time ends it.
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

/// @param view  may pause the run; null: there is no view.
pace::WallPace::Settings pace_of(const RunOptions& options, const Scenario& scenario,
                                 std::size_t processes, Results& results,
                                 const live::LiveView* view) {
  pace::WallPace::Settings settings{.max_speed = options.max_speed,
                                    .terminal = ::isatty(STDERR_FILENO) != 0,
                                    .processes = processes,
                                    .end = latest_end(options, scenario),
                                    .may_end_earlier = has_other_ends(scenario),
                                    .once_a_second = [&results] { results.commit(); }};
  // The view limits the speed itself, because its limit can be changed.
  if (view != nullptr) settings.max_speed = std::numeric_limits<double>::infinity();
  return settings;
}

/// What makes the run wait before an instant: the view's user, else TCP of the programs.
std::function<std::optional<hal::Duration>(hal::Time)> hold_by(live::LiveView* view,
                                                               network::NetworkOfRun* network) {
  return [view, network](hal::Time next) -> std::optional<hal::Duration> {
    if (view != nullptr) {
      if (const auto wait = view->control().hold(next)) return wait;
    }
    return network == nullptr ? std::nullopt : network->hold(next);
  };
}

/// @return the exit status.
int end_before_begin(Results& results, const std::string& what, bool failed) {
  results.say_not_started(what);
  hal::print_line(hal::Tone::kMistake, "error: " + hal::printable(what));
  return failed ? gateway::process::kRunFailed : gateway::process::kInterrupted;
}

int run(const RunOptions& options, const Scenario& scenario, const TimeAdvance& time_advance,
        topics::RunInspection& inspection, Results& results) {
  const std::optional<int> domain = domain_of(options);
  const auto network = network_of(options.scenario, scenario, time_advance, results);
  sim::scenario::Judge judge(scenario);
  Simulation simulation(scenario.simulation, {&judge, &inspection.observer()});
  network::open_programs_door(scenario, simulation);
  std::optional<pace::WallPace> pace;
  const ForcedEnd forced_end([&](const std::string& what, bool failed) -> int {
    if (!results.has_begun()) return end_before_begin(results, what, failed);
    pace->end();
    return conclude(
        results, judge, simulation,
        {simulation.broken_off_by(failed ? what : ""),
         failed ? std::vector<std::string>{} : std::vector{what}, pace->wall_seconds()});
  });
  std::optional<network::NamespaceStarter> inside = starter_in(network.get());
  controllers::ControllersOfRun controllers(scenario, simulation,
                                            {.from = options.controllers,
                                             .domain = domain,
                                             .logs = results.folder().path(),
                                             .inside = pointer_to(inside),
                                             .replies = time_advance.replies(),
                                             .repeats_lockstep = time_advance.repeats_lockstep()});
  inspection.start(first_of(controllers.domain(), domain), simulation);
  std::unique_ptr<live::LiveView> view;
  if (options.view.shown) {
    view = std::make_unique<live::LiveView>(
        scenario, simulation, live_view_of(options, time_advance, inspection, results));
  }
  auto settings = pace_of(options, scenario, controllers.processes(), results, view.get());
  settings.hold = hold_by(view.get(), network.get());
  pace.emplace(std::move(settings));
  results.begin(simulation);
  if (view) start(*view, options, time_advance, results);
  say_open_loop(time_advance, results);
  inspection.set_ledger(results.ledger());

  const Outcome outcome = play(time_advance, simulation, *pace, network.get());
  pace->end();
  RunEnding ending{.outcome = outcome,
                   .complaints = controllers.finish(outcome.kind != Outcome::Kind::kFailed,
                                                    results.folder().path()),
                   .wall_seconds = pace->wall_seconds()};
  if (network) end_network(*network, ending, time_advance, scenario, results);
  const auto status = conclude(results, judge, simulation, std::move(ending));
  if (view) view->end(outcome);
  return status;
}

/// Prints the result of a run that was not repeated because it was finished (`--once`).
int say_finished(const output::FinishedResult& finished, const std::filesystem::path& folder) {
  fmt::print(stderr, "the result is there already\n");
  fmt::print("{} {}\nfingerprint: {}\nframes_digest: {}\nresults: {}\n",
             hal::coloured_for(stdout, hal::Tone::kResult, "result:"),
             hal::printable(finished.result), hal::printable(finished.fingerprint),
             hal::printable(finished.frames_digest), folder.string());
  return finished.status;
}

}  // namespace

std::filesystem::path results_path(const RunOptions& options, const std::string& scenario) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path("results") / scenario;
}

check::RunMode run_mode_of(const RunOptions& options) {
  return {.controllers = options.controllers,
          .has_domain = options.inspect_domain.has_value(),
          .is_repeated = !options.repeat.empty(),
          .time = options.pace.empty() ? std::nullopt
                                       : std::optional(check::program_time(options.pace))};
}

std::string until_words(const RunOptions& options) {
  return options.until ? fmt::format("{} s", *options.until) : "its end";
}

int run(const RunOptions& options) {
  const Scenario scenario =
      check::load_checked(options.scenario, options.overrides, run_mode_of(options));
  pace::catch_interrupts();
  const TimeAdvance time_advance(options, scenario);
  (void)domain_of(options);  // reports mistakes before anything is written
  topics::RunInspection inspection(scenario, {.shown = options.inspect,
                                              .domain = options.inspect_domain,
                                              .repeated = !options.repeat.empty()});
  check_repeat(options, scenario.name);
  std::unique_ptr<output::FolderLock> held;
  if (options.once) {
    const std::filesystem::path folder = results_path(options, scenario.name);
    held = output::wait_for_lock(folder);
    const auto finished = output::finished_result(folder, scenario.simulation.seed);
    if (finished) {
      output::require_result_of(folder, sim::scenario::resolved_yaml(scenario),
                                until_words(options));
      return say_finished(*finished, folder);
    }
  }
  Results results(scenario, options, time_advance.pace(), std::move(held));
  try {
    return run(options, scenario, time_advance, inspection, results);
  } catch (const std::exception& e) {
    results.say_not_started(e.what());
    throw;
  }
}

}  // namespace baraka::run
