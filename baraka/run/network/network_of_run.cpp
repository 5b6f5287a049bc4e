#include "baraka/run/network/network_of_run.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "baraka/run/network/kernel_routes.h"
#include "baraka/run/network/neighbour_tables.h"
#include "baraka/run/network/priority.h"
#include "baraka/run/network/topic_plan.h"
#include "baraka/run/pace/interrupts.h"
#include "gateway/process/waiting.h"
#include "hal/types/log.h"
#include "programs/lockstep/kernel_needs.h"
#include "programs/netns/holder.h"
#include "sim/scenario/plan.h"

namespace baraka::run::network {
namespace {

using namespace std::chrono_literals;

/// While a program is between two steps of sending: see netns::RoomPage::publish().
constexpr hal::Duration kWhileOneSends = 1ms;
constexpr hal::Duration kOtherwise = 50ms;
/// Typical wake-up latency of an otherwise idle computer.
constexpr hal::Duration kSpin = 50us;
/// The kernel may delay the end of a wait by this time to combine it with others.
constexpr unsigned long kTimerSlack = 1;  // ns

/// User plus system time of this process, s.
double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

programs::netns::Settings settings_of(const sim::scenario::Scenario& scenario,
                                      const programs::netns::ProgramTime& time,
                                      const std::filesystem::path& folder) {
  programs::netns::Settings settings;
  settings.time = time;
  settings.seed = scenario.simulation.seed;
  settings.state_folder = folder;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!agent.network) continue;
    settings.agents.push_back({.agent = agent.name,
                               .id = agent.id.value,
                               .address = agent.network->address,
                               .prefix = agent.network->prefix,
                               .mtu = agent.network->mtu,
                               .routes = kernel_routes(agent, scenario.simulation.agents),
                               .forwards = agent.network->forwards});
  }
  return settings;
}

}  // namespace

bool has_network(const sim::scenario::Scenario& scenario) {
  return std::ranges::any_of(scenario.simulation.agents,
                             [](const auto& agent) { return agent.network.has_value(); });
}

NetworkOfRun::NetworkOfRun(const sim::scenario::Scenario& scenario,
                           const std::filesystem::path& file,
                           const programs::netns::ProgramTime& time,
                           std::function<std::filesystem::path()> results)
    : scenario_(scenario),
      results_(std::move(results)),
      programs_(
          time.is_held ? sim::scenario::plan_held_programs(scenario)
                       : sim::scenario::plan_programs(scenario),
          [this](const ProgramsOfRun::Start& one) { return start(one); },
          [this](std::vector<std::uint8_t> end) {
            if (lockstep_) return simulation_->arrive(kProgramsDoor, end);
            simulation_->outside().put(kProgramsDoor, std::move(end));
          }) {
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!agent.network) continue;
    agents_.push_back(agent.id);
    names_.push_back(agent.name);
  }
  programs::netns::Settings settings = settings_of(scenario, time, results_());
  settings.shown = {std::filesystem::absolute(file).parent_path()};
  if (time.is_held) {
    programs::lockstep::require_kernel();
    use_of_processor_.emplace(processor_.emplace());
  }
  namespaces_.emplace(settings);
  use_of_processor_.reset();
  if (time.is_held) hold_programs();
  const std::string& why = namespaces_->why_only_user_0();
  if (why.empty()) return;
  fmt::print(stderr,
             "hint: programs have no user but 0, and those that change to another fail: {}\n", why);
}

NetworkOfRun::~NetworkOfRun() {
  if (lockstep_ && namespaces_) lockstep_->let_go();
}

void NetworkOfRun::connect(sim::agents::Simulation& simulation, pace::RealTimeClock& clock) {
  simulation_ = &simulation;
  ::prctl(PR_SET_TIMERSLACK, kTimerSlack, 0, 0, 0);
  go_before_others(true);
  std::vector<TapBridge::Tap> taps;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    taps.push_back({agents_[i], namespaces_->tap(i), &namespaces_->room(i)});
  }
  bridge_.emplace(taps, clock);
  simulation.connect_air(*bridge_, *bridge_);
  clock.attend_to(*this);
  note_begin(clock.wall());
}

void NetworkOfRun::note_begin(hal::Clock& wall) {
  wall_ = &wall;
  begun_at_ = wall.now();
  overflows_before_ = neighbour_table_overflows();
  cpu_before_ = cpu_seconds();
  programs_cpu_before_ = namespaces_->program_cpu_seconds();
}

LockstepBridge::Station NetworkOfRun::station(std::size_t i) {
  const std::string& name = names_[i];
  const auto& agents = scenario_.simulation.agents;
  const auto agent = std::ranges::find(agents, agents_[i], &sim::agents::AgentConfig::id);
  return {.agent = agents_[i],
          .tap = namespaces_->tap(i),
          .room = &namespaces_->room(i),
          .waits = &namespaces_->waits(i),
          .settings = {
              .agent = name,
              .processes = namespaces_->processes(i),
              .allow_unknown = agent->network->unknown_waits == sim::air::UnknownWaits::kAllow,
              .per_wake = agent->network->per_wake.count(),
              .may_go_on = [this] { return !is_broken_off_() && (!may_go_on_ || may_go_on_()); },
              .warn = [](const std::string& what) { hal::log::warning({}, "run", "{}", what); }}};
}

/// Controllers inside are held from their start on, which is before the run.
void NetworkOfRun::hold_programs() {
  is_broken_off_ = pace::interrupted;
  std::vector<LockstepBridge::Station> stations;
  stations.reserve(agents_.size());
  for (std::size_t i = 0; i < agents_.size(); ++i) stations.push_back(station(i));
  const auto start_next = [this](hal::Time now) {
    const hal::AgentId agent = *programs_.next_agent();
    programs_.start_next(now, results_());
    return agent;
  };
  const auto has_tcp_timer = [this] {
    std::size_t i = 0;
    while (i < agents_.size() && !namespaces_->has_tcp_timer(i)) ++i;
    return i < agents_.size();
  };
  lockstep_.emplace(
      std::move(stations),
      LockstepBridge::Programs{.next_start = [this] { return programs_.next(); },
                               .start_next = start_next,
                               .on_ended = [this](hal::AgentId, hal::Time now,
                                                  std::size_t count) { await_ended(now, count); },
                               .has_tcp_timer = has_tcp_timer},
      gateway::process::wall_clock());
}

void NetworkOfRun::connect(sim::agents::Simulation& simulation, pace::WallPace& pace) {
  simulation_ = &simulation;
  is_broken_off_ = [&pace] { return pace.is_broken_off(); };
  simulation.connect_air(*lockstep_, *lockstep_);
  use_of_processor_.emplace(*processor_);
  ::prctl(PR_SET_TIMERSLACK, kTimerSlack, 0, 0, 0);
  let_others_finish();
  note_begin(pace.clock());
}

std::optional<hal::Duration> NetworkOfRun::hold(hal::Time next) {
  return lockstep_ ? lockstep_->hold(next) : std::nullopt;
}

void NetworkOfRun::give_turns(hal::AgentId agent, hal::Time now,
                              const std::function<bool()>& may_go_on) {
  may_go_on_ = may_go_on;
  lockstep_->settle(agent, now);
  may_go_on_ = nullptr;
}

/// The end of a process is seen before the namespaces tell of it.
void NetworkOfRun::await_ended(hal::Time now, std::size_t count) {
  constexpr int kLongest = 1000;  // ms
  pollfd ended{.fd = namespaces_->descriptor(), .events = POLLIN, .revents = 0};
  for (std::size_t seen = 0; seen<count&& ::poll(&ended, 1, kLongest)> 0;) seen += take_ended(now);
}

std::optional<std::size_t> NetworkOfRun::index_of(hal::AgentId agent) const {
  const auto found = std::ranges::find(agents_, agent);
  if (found == agents_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - agents_.begin());
}

int NetworkOfRun::descriptor() const { return namespaces_->descriptor(); }

hal::Duration NetworkOfRun::longest_wait() const {
  return bridge_->is_one_sending() ? kWhileOneSends : kOtherwise;
}

hal::Duration NetworkOfRun::spin() const { return kSpin; }

void NetworkOfRun::attend(hal::Time now) {
  pollfd ended{.fd = namespaces_->descriptor(), .events = POLLIN, .revents = 0};
  if (::poll(&ended, 1, 0) > 0) take_ended(now);
  if (programs_.next() && *programs_.next() <= now) programs_.start_next(now, results_());
}

std::size_t NetworkOfRun::take_ended(hal::Time now) {
  const std::vector<programs::netns::Ended> all = namespaces_->take_ended();
  for (const programs::netns::Ended& one : all) {
    programs_.on_end(now, agents_.at(one.agent), one.program, one.status);
  }
  return all.size();
}

std::uint32_t NetworkOfRun::start(const ProgramsOfRun::Start& start) {
  const sim::scenario::PlannedProgram& planned = start.program;
  const sim::scenario::ProgramWords words =
      sim::scenario::words_of(planned, scenario_, start.folder);
  programs::netns::Command command;
  for (const std::string& word : planned.program->command) {
    command.arguments.push_back(sim::scenario::filled_in(word, words));
  }
  for (const auto& [name, value] : planned.program->environment) {
    command.environment.emplace_back(name, sim::scenario::filled_in(value, words));
  }
  for (const std::string& path : planned.program->shown) {
    command.shown.emplace_back(sim::scenario::filled_in(path, words));
  }
  if (planned.program->is_shipped) {
    command.arguments.front() =
        programs::netns::installed_file({}, command.arguments.front().c_str()).string();
    write_topic_plan(planned, scenario_, start.folder, recordings_);
  }
  command.log = std::filesystem::absolute(start.folder / planned.log);
  return launch(planned.agent, std::move(command));
}

std::uint32_t NetworkOfRun::launch(hal::AgentId agent, programs::netns::Command command) {
  const std::size_t index = *index_of(agent);
  if (!lockstep_) return namespaces_->start(index, command).program;
  programs::lockstep::AgentWaits& waits = lockstep_->waits(agent);
  command.slot = waits.reserve();
  try {
    const programs::netns::Started started = namespaces_->start(index, command);
    waits.started(*command.slot, started.process);
    return started.program;
  } catch (...) {
    waits.not_started(*command.slot);
    throw;
  }
}

void NetworkOfRun::sum_up(NetworkSummary& summary) const {
  const bool is_connected = bridge_ || lockstep_;
  const double wall = is_connected ? hal::to_seconds(wall_->now() - begun_at_) : 0;
  if (lockstep_) summary.lockstep = {lockstep_->counts(), lockstep_->spins()};
  if (wall > 0) {
    summary.frames_not_taken = bridge_ ? bridge_->not_taken() : lockstep_->not_taken();
    summary.cpu_load = (cpu_seconds() - cpu_before_) / wall;
    summary.cpu_load_programs = (namespaces_->program_cpu_seconds() - programs_cpu_before_) / wall;
  }
  if (const auto overflows = neighbour_table_overflows(); overflows && overflows_before_) {
    summary.neighbours_without_room = *overflows - *overflows_before_;
  }
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    summary.frames_dropped += namespaces_->tx_dropped(i);
  }
  summary.icmp_not_sent = namespaces_->icmp_not_sent();
}

/// Else what they write as they end would come in another order each time.
/// @return false: the wall time was over before all had ended. After Ctrl-C true in any case.
bool NetworkOfRun::end_in_turns() {
  constexpr std::chrono::seconds kGrace{10}, kOfSomebodyWhoWaits{2};
  const auto longest = pace::interrupted() ? kOfSomebodyWhoWaits : kGrace;  // of wall time
  is_broken_off_ = [this, last = wall_->now() + longest] { return wall_->now() > last; };
  try {
    lockstep_->end_programs(simulation_->now(), kGrace);
  } catch (const std::runtime_error& e) {
    hal::log::warning({}, "run", "the end of programs: {}", e.what());
  }
  return pace::interrupted() || !is_broken_off_();
}

NetworkSummary NetworkOfRun::finish(bool in_turns) {
  go_before_others(false);
  NetworkSummary summary;
  try {
    sum_up(summary);
  } catch (const std::runtime_error& e) {
    hal::log::warning({}, "run", "{}", e.what());  // the namespaces are gone
  }
  summary.programs = programs_.rows();
  use_of_processor_.reset();
  is_broken_off_ = [] { return false; };  // of a pace that may be gone
  if (lockstep_ && in_turns) summary.ends_in_turns = end_in_turns();
  if (lockstep_) lockstep_->let_go();
  namespaces_.reset();
  return summary;
}

}  // namespace baraka::run::network
