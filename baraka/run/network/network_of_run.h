#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baraka/run/network/programs_of_run.h"
#include "baraka/run/network/tap_bridge.h"
#include "baraka/run/pace/background_work.h"
#include "baraka/run/pace/real_time_clock.h"
#include "programs/netns/namespaces.h"
#include "results/record/interface_counts.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::network {

/// Whether an agent has a network.
bool has_network(const sim::scenario::Scenario& scenario);

/// How the programs' side of a run was.
struct NetworkSummary {
  using ByAgent = std::vector<std::pair<std::string, std::uint64_t>>;
  std::uint64_t frames_dropped = 0;    ///< By the kernel, before the run could read them.
  std::uint64_t frames_not_taken = 0;  ///< Off the air, by interfaces that were shut down.
  /// Packets of programs of any run on this computer for which the kernel found no neighbour's
  /// place while this one went on.
  std::uint64_t neighbours_without_room = 0;
  /// Messages of ICMP, echo replies among them, that the kernel did not send, by agent; of those
  /// with any.
  ByAgent icmp_not_sent;
  double cpu_load = 0;  ///< Processor time of this process over wall time.
  double cpu_load_programs = 0;
  std::vector<results::record::ProgramRow> programs;
};

/// The namespaces, interfaces and programs of a run. One thread.
///
///   NetworkOfRun network(scenario, factor, folder);      // before other threads, and the run
///   network.connect(simulation, clock);
///   simulation.follow(until, clock);
///   network.finish();
class NetworkOfRun final : private pace::BackgroundWork {
 public:
  /// Makes the namespaces; says on standard error what programs will miss there.
  /// @param file  of the scenario: its folder is shown to programs. @param factor  of the clock.
  /// @param results  tells where the folder of the results is now.
  /// @throws std::runtime_error  as netns::Namespaces.
  NetworkOfRun(const sim::scenario::Scenario& scenario, const std::filesystem::path& file,
               double factor, std::function<std::filesystem::path()> results);
  ~NetworkOfRun() override;

  /// The simulation uses the interfaces, and the clock attends to the programs. Both outlive the
  /// calls of this object until finish().
  void connect(sim::agents::Simulation& simulation, pace::RealTimeClock& clock);

  /// To start something else inside. @pre not finished.
  programs::netns::Namespaces& namespaces() { return *namespaces_; }
  /// Index of an agent there; none: it has no network.
  std::optional<std::size_t> index_of(hal::AgentId agent) const;

  /// The run is over: ends what still runs inside. Once.
  NetworkSummary finish();

 private:
  int descriptor() const override;
  void attend(hal::Time now) override;
  std::optional<hal::Time> next() const override { return programs_.next(); }
  hal::Duration longest_wait() const override;
  hal::Duration spin() const override;
  void before_wait() override { bridge_->before_wait(); }
  void after_wait() override { bridge_->after_wait(); }

  std::uint32_t start(const ProgramsOfRun::Start& start);
  void take_ended(hal::Time now);
  void sum_up(NetworkSummary& summary) const;

  const sim::scenario::Scenario& scenario_;
  std::function<std::filesystem::path()> results_;
  std::vector<hal::AgentId> agents_;  ///< In the order of the namespaces.
  std::optional<programs::netns::Namespaces> namespaces_;
  ProgramsOfRun programs_;
  sim::agents::Simulation* simulation_ = nullptr;
  hal::Clock* wall_ = nullptr;
  std::optional<TapBridge> bridge_;
  hal::Time begun_at_{};  ///< Wall.
  std::optional<std::uint64_t> overflows_before_;
  double cpu_before_ = 0, programs_cpu_before_ = 0;  ///< s
};

}  // namespace baraka::run::network
