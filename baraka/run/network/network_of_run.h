#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baraka/run/network/lockstep_bridge.h"
#include "baraka/run/network/processor.h"
#include "baraka/run/network/programs_of_run.h"
#include "baraka/run/network/tap_bridge.h"
#include "baraka/run/pace/background_work.h"
#include "baraka/run/pace/real_time_clock.h"
#include "programs/netns/namespaces.h"
#include "results/record/interface_counts.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/topic_parts.h"

namespace baraka::run::network {

/// Whether any agent of the scenario has a network.
bool has_network(const sim::scenario::Scenario& scenario);

/// What it took to hold the programs of a run in lock-step.
struct LockstepSummary {
  programs::lockstep::AgentWaits::Counts counts;
  std::uint64_t spins = 0;  ///< Times that a thread which only looked at the clock had to sleep.
};

/// Counts and loads of the programs and their networks in a run.
struct NetworkSummary {
  using ByAgent = std::vector<std::pair<std::string, std::uint64_t>>;
  std::uint64_t frames_dropped = 0;  ///< Dropped by the kernel before the run could read them.
  /// Received frames not accepted by an interface, because it was shut down.
  std::uint64_t frames_not_taken = 0;
  /// Packets lost during this run because the kernel's neighbour table was full; those of other
  /// runs on this computer are included.
  std::uint64_t neighbours_without_room = 0;
  /// Number of ICMP messages (including echo replies) that the kernel suppressed, by agent; only
  /// agents with any.
  ByAgent icmp_not_sent;
  std::optional<LockstepSummary> lockstep;
  /// In lock-step: programs had the wall time to end in turns, or were not asked to.
  bool ends_in_turns = true;
  double cpu_load = 0;  ///< Processor time of this process / wall time.
  double cpu_load_programs = 0;
  std::vector<results::record::ProgramRow> programs;
};

/// The namespaces, interfaces and programs of a run. One thread.
///
///   NetworkOfRun network(scenario, file, time, folder);      // before other threads, and the run
///   network.connect(simulation, clock);
///   simulation.follow(until, clock);
///   network.finish(true);
class NetworkOfRun final : private pace::BackgroundWork {
 public:
  /// Creates the namespaces; prints on standard error what programs will lack there.
  /// @param file  of the scenario; programs can see its folder.
  /// @param time  how time passes for the programs.
  /// @param results  returns the current path of the folder of results.
  /// @throws std::runtime_error  as netns::Namespaces.
  NetworkOfRun(const sim::scenario::Scenario& scenario, const std::filesystem::path& file,
               const programs::netns::ProgramTime& time,
               std::function<std::filesystem::path()> results);
  ~NetworkOfRun() override;

  /// Connects the simulation to the interfaces, and the clock to the programs. Both must exist
  /// until finish() returns.
  void connect(sim::agents::Simulation& simulation, pace::RealTimeClock& clock);

  /// The same in lock-step, before simulation.run().
  void connect(sim::agents::Simulation& simulation, pace::WallPace& pace);

  /// In lock-step: how long the run has to wait before it goes to `next`; none: it may go on.
  std::optional<hal::Duration> hold(hal::Time next);

  /// Starts a program inside an agent, in lock-step held. Returns its number.
  /// @pre the agent has a network. @throws std::runtime_error  as Namespaces::start().
  std::uint32_t launch(hal::AgentId agent, programs::netns::Command command);

  /// Whether programs are held in lock-step.
  bool holds_programs() const { return lockstep_.has_value(); }
  /// In lock-step, also before connect(): lets the programs of an agent go on at this simulated
  /// time until all wait. @param may_go_on  asked now and then; once false, they do not any more.
  void give_turns(hal::AgentId agent, hal::Time now, const std::function<bool()>& may_go_on);

  /// For starting other programs inside. @pre finish() has not been called.
  programs::netns::Namespaces& namespaces() { return *namespaces_; }
  /// Index of an agent among the namespaces; none: the agent has no network.
  std::optional<std::size_t> index_of(hal::AgentId agent) const;

  /// Ends all programs that still run inside: SIGTERM, after 10 s SIGKILL. To be called once, when
  /// the run is over.
  /// @param in_turns  in lock-step, whether they end in it, in virtual time: else all at once.
  NetworkSummary finish(bool in_turns);

 private:
  int descriptor() const override;
  void attend(hal::Time now) override;
  std::optional<hal::Time> next() const override { return programs_.next(); }
  hal::Duration longest_wait() const override;
  hal::Duration spin() const override;
  void before_wait() override { bridge_->before_wait(); }
  void after_wait() override { bridge_->after_wait(); }

  std::uint32_t start(const ProgramsOfRun::Start& start);
  std::size_t take_ended(hal::Time now);
  void await_ended(hal::Time now, std::size_t count);
  LockstepBridge::Station station(std::size_t i);
  void hold_programs();
  void note_begin(hal::Clock& wall);
  void sum_up(NetworkSummary& summary) const;
  bool end_in_turns();

  const sim::scenario::Scenario& scenario_;
  std::function<std::filesystem::path()> results_;
  sim::scenario::Recordings recordings_;  ///< Of `topics:`.
  std::vector<hal::AgentId> agents_;      ///< In the order of the namespaces.
  std::vector<std::string> names_;        ///< Of the agents.
  std::optional<Processor> processor_;    ///< In lock-step.
  std::optional<Processor::Use> use_of_processor_;
  std::optional<programs::netns::Namespaces> namespaces_;
  ProgramsOfRun programs_;
  sim::agents::Simulation* simulation_ = nullptr;
  hal::Clock* wall_ = nullptr;
  std::optional<TapBridge> bridge_;
  std::optional<LockstepBridge> lockstep_;  ///< In place of bridge_.
  std::function<bool()> is_broken_off_;     ///< In lock-step: whether the run was interrupted.
  std::function<bool()> may_go_on_;         ///< Of give_turns(), during it.
  hal::Time begun_at_{};                    ///< Wall time of the start.
  std::optional<std::uint64_t> overflows_before_;
  double cpu_before_ = 0, programs_cpu_before_ = 0;  ///< s
};

}  // namespace baraka::run::network
