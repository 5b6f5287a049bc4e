#include "baraka/run/network/network_of_run.h"

#include <fmt/core.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "baraka/run/network/neighbour_tables.h"
#include "hal/types/log.h"
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

/// Gives this thread a real-time priority, if the system permits: frames wait for it, and it needs
/// little processor time. Child processes keep the normal priority.
void go_before_others(bool before) {
  sched_param parameters{};
  parameters.sched_priority = before ? ::sched_get_priority_min(SCHED_RR) : 0;
  (void)::sched_setscheduler(0, (before ? SCHED_RR : SCHED_OTHER) | SCHED_RESET_ON_FORK,
                             &parameters);
}

programs::netns::Settings settings_of(const sim::scenario::Scenario& scenario, double factor,
                                      const std::filesystem::path& folder) {
  programs::netns::Settings settings;
  settings.factor = factor;
  settings.state_folder = folder;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!agent.network) continue;
    settings.agents.push_back({.agent = agent.name,
                               .id = agent.id.value,
                               .address = agent.network->address,
                               .prefix = agent.network->prefix,
                               .mtu = agent.network->mtu});
  }
  return settings;
}

}  // namespace

bool has_network(const sim::scenario::Scenario& scenario) {
  return std::ranges::any_of(scenario.simulation.agents,
                             [](const auto& agent) { return agent.network.has_value(); });
}

NetworkOfRun::NetworkOfRun(const sim::scenario::Scenario& scenario,
                           const std::filesystem::path& file, double factor,
                           std::function<std::filesystem::path()> results)
    : scenario_(scenario),
      results_(std::move(results)),
      programs_(
          scenario, [this](const ProgramsOfRun::Start& one) { return start(one); },
          [this](std::vector<std::uint8_t> end) {
            simulation_->outside().put(kProgramsDoor, std::move(end));
          }) {
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.network) agents_.push_back(agent.id);
  }
  programs::netns::Settings settings = settings_of(scenario, factor, results_());
  settings.shown = {std::filesystem::absolute(file).parent_path()};
  namespaces_.emplace(settings);
  const std::string& why = namespaces_->why_only_user_0();
  if (why.empty()) return;
  fmt::print(stderr,
             "hint: programs have no user but 0, and those that change to another fail: {}\n", why);
}

NetworkOfRun::~NetworkOfRun() = default;

void NetworkOfRun::connect(sim::agents::Simulation& simulation, pace::RealTimeClock& clock) {
  simulation_ = &simulation;
  wall_ = &clock.wall();
  ::prctl(PR_SET_TIMERSLACK, kTimerSlack, 0, 0, 0);
  go_before_others(true);
  std::vector<TapBridge::Tap> taps;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    taps.push_back({agents_[i], namespaces_->tap(i), &namespaces_->room(i)});
  }
  bridge_.emplace(taps, clock);
  simulation.connect_air(*bridge_, *bridge_);
  clock.attend_to(*this);
  begun_at_ = clock.wall().now();
  overflows_before_ = neighbour_table_overflows();
  cpu_before_ = cpu_seconds();
  programs_cpu_before_ = namespaces_->program_cpu_seconds();
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

void NetworkOfRun::take_ended(hal::Time now) {
  for (const programs::netns::Ended& one : namespaces_->take_ended()) {
    programs_.on_end(now, agents_.at(one.agent), one.program, one.status);
  }
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
  command.log = std::filesystem::absolute(start.folder / planned.log);
  return namespaces_->start(*index_of(planned.agent), command);
}

void NetworkOfRun::sum_up(NetworkSummary& summary) const {
  const double wall = bridge_ ? hal::to_seconds(wall_->now() - begun_at_) : 0;
  if (wall > 0) {
    summary.frames_not_taken = bridge_->not_taken();
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

NetworkSummary NetworkOfRun::finish() {
  go_before_others(false);
  NetworkSummary summary;
  try {
    sum_up(summary);
  } catch (const std::runtime_error& e) {
    hal::log::warning({}, "run", "{}", e.what());  // the namespaces are gone
  }
  summary.programs = programs_.rows();
  namespaces_.reset();
  return summary;
}

}  // namespace baraka::run::network
