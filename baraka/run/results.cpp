#include "baraka/run/results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <stdexcept>

#include "hal/types/log.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"
#include "results/record/agent_use_log.h"
#include "results/record/air_log.h"
#include "results/record/body_log.h"
#include "results/record/controller_log.h"
#include "results/record/interface_counts.h"
#include "results/record/observables.h"
#include "results/record/schema.h"
#include "sim/core/log_sink.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/resolved.h"

namespace baraka::run {
namespace {

namespace fs = std::filesystem;

using sim::agents::Outcome;
using sim::scenario::Scenario;

constexpr const char* kLog = "run.log";
constexpr const char* kScenario = "scenario.resolved.yaml";
/// Disk space that is reserved and freed when the run ends, so that its end can be recorded even on
/// a full disk: twice the hundred pages of 4 KiB to which the write-ahead log grows, plus the size
/// of a transaction.
constexpr const char* kReserve = ".reserve";
constexpr off_t kReservedBytes = off_t{1} << 20;

/// Every file that a run may write into its folder.
std::vector<std::string> files_of(const Scenario& scenario) {
  std::set<std::string> files = {kLog, kScenario, kReserve};
  for (const char* part : {"", "-wal", "-shm", "-journal"}) {
    files.insert(std::string(results::record::kResultsFile) + part);
  }
  for (const auto& plan : sim::scenario::plan_processes(scenario)) {
    files.insert(plan.process + ".log");
  }
  for (const auto& program : sim::scenario::plan_programs(scenario)) files.insert(program.log);
  if (network::has_network(scenario)) files.insert(programs::netns::kStateFile);
  if (!scenario.record.air.empty()) files.insert(scenario.record.air);
  return {files.begin(), files.end()};
}

void reserve_room(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  const int error = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, kReservedBytes);
  if (descriptor >= 0) ::close(descriptor);
  if (error == 0) return;
  throw std::runtime_error(fmt::format("{}: {}; a run needs {} MB there to begin with",
                                       file.parent_path().parent_path().string(),
                                       std::strerror(error), kReservedBytes >> 20));
}

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

std::vector<std::pair<std::string, std::string>> settings_of(const Scenario& scenario,
                                                             const RunOptions& options,
                                                             const std::string& pace) {
  auto settings = sim::scenario::resolved_values(scenario);
  settings.emplace_back("--pace", pace);
  settings.emplace_back("--until", until_words(options));
  return settings;
}

/// Warns of topics of which nothing arrived, in the log and thereby on standard error.
void warn_of_unheard_topics(results::record::Recorder& recorder, hal::Time at) {
  constexpr std::size_t kMostLines = 10;
  const auto unheard = recorder.unheard_topics();
  const std::size_t lines = std::min(kMostLines, unheard.size());
  for (std::size_t i = 0; i < lines; ++i) {
    hal::log::warning(at, "run", "{}", results::record::to_line(unheard[i]));
  }
  if (lines < unheard.size()) {
    hal::log::warning(at, "run", "{} more topics of which nothing arrived: see the table messages",
                      unheard.size() - lines);
  }
}

}  // namespace

Results::Results(const Scenario& scenario, const RunOptions& options, const std::string& pace,
                 std::unique_ptr<output::FolderLock> held)
    : scenario_(scenario),
      pace_(pace),
      settings_(settings_of(scenario, options, pace)),
      folder_(results_path(options, scenario.name),
              {.files = files_of(scenario), .overwrite = options.overwrite}, std::move(held)),
      fingerprint_([this](const sim::Fingerprint::Row& row) { recorder_->add(row); }),
      unused_priorities_(scenario.simulation.routing.priorities) {
  sim::log_to_file((folder_.path() / kLog).string(), *hal::log::level_called(options.log));
  write_file(folder_.path() / kScenario, sim::scenario::resolved_yaml(scenario));
  reserve_room(folder_.path() / kReserve);
}

void Results::record(const fs::path& folder) {
  recorder_.emplace(folder / results::record::kResultsFile, scenario_.simulation,
                    results::record::RecorderOptions{.pose_period = scenario_.record.pose_period,
                                                     .frames = scenario_.record.frames,
                                                     .messages = scenario_.record.messages,
                                                     .samples = scenario_.record.samples,
                                                     .routes = scenario_.record.routes,
                                                     .readings = scenario_.record.readings});
  recorder_->add_countable(scenario_.record.declared);
  recorder_->add_settings(settings_);
  recorder_->find<results::record::ControllerLog>()->add_units(scenario_.record.recorded_units);
  // Frees half a kilobyte per agent that is no longer needed.
  std::vector<std::pair<std::string, std::string>>().swap(settings_);
  recorder_->set("run_id", folder_.run_id());
  recorder_->set("scenario", scenario_.name);
  recorder_->set("version", BARAKA_VERSION);
  recorder_->set("pace", pace_);
  recorder_->commit();
}

void Results::begin(sim::agents::Simulation& simulation) {
  folder_.begin();
  if (folder_.kept()) {
    fmt::print(stderr, "the earlier result is kept: {}\n", folder_.kept()->string());
  }
  record(folder_.path());
  simulation.add_observer(*recorder_);
  recorder_->look_at(simulation);
  simulation.add_observer(fingerprint_);
  if (!scenario_.simulation.routing.priorities.empty()) simulation.add_observer(unused_priorities_);
  if (!scenario_.record.air.empty()) capture(simulation);
  if (!scenario_.record.observables.empty()) observe(simulation);
}

void Results::observe(sim::agents::Simulation& simulation) {
  const auto unit_of = [this](hal::AgentId id, const std::string& name) {
    const auto& agents = scenario_.simulation.agents;
    const auto agent = std::ranges::find(agents, id, &sim::agents::AgentConfig::id);
    const auto& units = scenario_.record.recorded_units;
    const auto unit = units.find({agent->program, name});
    return unit == units.end() ? std::string() : unit->second;
  };
  results::record::Observables& observables =
      recorder_->observe(scenario_.record.observables, scenario_.simulation, simulation, unit_of);
  simulation.add_observer(observables);
  simulation.set_sampler(observables);
}

void Results::capture(sim::agents::Simulation& simulation) {
  std::string name = "air";
  results::record::AirCapture::Air air{scenario_.simulation.radio, {}};
  for (const auto& agent : scenario_.simulation.agents) {
    if (agent.id == scenario_.record.air_heard_by) name = agent.name;
    if (agent.radio.channel) air.others[agent.id] = *agent.radio.channel;
  }
  capture_.emplace(folder_.path() / scenario_.record.air, air, scenario_.record.air_heard_by, name);
  simulation.add_observer(*capture_);
}

void Results::commit() {
  recorder_->commit();
  if (capture_) capture_->flush();
  sim::flush_log();
}

const sim::air::Ledger* Results::ledger() const {
  const auto* const air = recorder_->find<results::record::AirLog>();
  return air != nullptr ? &air->ledger() : nullptr;
}

void Results::say_not_started(const std::string& error) {
  try {
    fs::remove(folder_.path() / kReserve);
    if (!recorder_) record(folder_.path());
    Outcome outcome;
    outcome.kind = Outcome::Kind::kFailed;
    outcome.result = "not started";
    outcome.error = error;
    recorder_->give_up(outcome);
    recorder_.reset();
    fmt::print(stderr, "not started; its files are in {}\n", folder_.path().string());
  } catch (const std::exception& e) {
    hal::print_line(hal::Tone::kWarning, "warning: " + hal::printable(e.what()));
  }
  sim::flush_log();
}

gateway::process::ExitStatus Results::finish(const sim::agents::Simulation& simulation,
                                             Outcome& outcome, gateway::process::ExitStatus status,
                                             double wall_seconds) {
  fs::remove(folder_.path() / kReserve);
  try {
    auto& bodies = *recorder_->find<results::record::BodyLog>();
    auto& uses = *recorder_->find<results::record::AgentUseLog>();
    for (const auto& agent : scenario_.simulation.agents) {
      bodies.add_contacts(agent.id, simulation.contacts(agent.id));
      uses.add(agent.id, simulation.use(agent.id));
    }
    if (capture_) capture_->finish(outcome.ended_at);
    fingerprint_.finish();
    recorder_->set("wall_s", wall_seconds);
    recorder_->set("exit_status", std::uint64_t{status});
    recorder_->finish(outcome, fingerprint_.fingerprint());
    warn_of_unheard_topics(*recorder_, outcome.ended_at);
    for (const std::string& line : unused_priorities_.lines()) {
      hal::log::warning(outcome.ended_at, "run", "{}", line);
    }
  } catch (const std::exception& e) {
    outcome.kind = Outcome::Kind::kFailed;
    outcome.result = "failed";
    if (outcome.error.empty()) outcome.error = e.what();
    status = gateway::process::kRunFailed;
    give_up(outcome, status);
  }
  sim::flush_log();
  return status;
}

void Results::add(const network::NetworkSummary& network) {
  recorder_->set("frames_dropped", network.frames_dropped);
  recorder_->set("frames_not_taken", network.frames_not_taken);
  std::uint64_t icmp_not_sent = 0;
  for (const auto& [agent, count] : network.icmp_not_sent) icmp_not_sent += count;
  recorder_->set("icmp_not_sent", icmp_not_sent);
  recorder_->set("cpu_load", network.cpu_load);
  recorder_->set("cpu_load_programs", network.cpu_load_programs);
  if (network.lockstep) {
    recorder_->set("program_turns", network.lockstep->counts.turns);
    recorder_->set("program_waits_ended", network.lockstep->counts.expired);
    recorder_->set("program_spins", network.lockstep->spins);
    recorder_->set("program_unknown_waits", network.lockstep->counts.unknown);
  }
  auto& interfaces = *recorder_->find<results::record::InterfaceCounts>();
  for (const results::record::ProgramRow& program : network.programs) interfaces.add(program);
}

void Results::add_warnings(const std::vector<std::string>& lines) {
  recorder_->set("warnings", fmt::format("{}", fmt::join(lines, "\n")));
}

void Results::add_open_loop(const std::vector<std::string>& lines) {
  recorder_->set("open_loop", fmt::format("{}", fmt::join(lines, "\n")));
}

void Results::give_up(const Outcome& outcome, gateway::process::ExitStatus status) {
  try {
    recorder_->give_up(outcome);
    recorder_->set("exit_status", std::uint64_t{status});
  } catch (const std::exception& e) {
    hal::log::warning(outcome.ended_at, "record", "the result does not say how it ended: {}",
                      e.what());
  }
}

}  // namespace baraka::run
