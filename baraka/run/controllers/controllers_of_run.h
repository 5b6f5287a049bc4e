#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baraka/run/controllers/inside_controllers.h"
#include "gateway/process/spawn.h"
#include "gateway/server/inside_starter.h"
#include "gateway/server/server.h"
#include "hal/types/result.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::controllers {

enum class ControllersFrom { kSpawn, kExternal, kInProcess };

/// The controllers of one run: in this process, in processes started for the run, or in processes
/// started by hand. They end with this object.
class ControllersOfRun {
 public:
  struct Settings {
    ControllersFrom from = ControllersFrom::kSpawn;
    std::optional<int> domain = {};   ///< DDS domain; none: the first free one.
    std::filesystem::path logs = {};  ///< Folder for the logs of spawned controllers.
    /// Starts controllers inside their agents' networks; must outlive them. Null: there are none.
    gateway::server::InsideStarter* inside = nullptr;
    /// In a repetition, the recorded answers of controllers inside networks, from take_replies().
    /// Null: this is not a repetition.
    const std::vector<sim::OutsideArrival>* replies = nullptr;
    bool repeats_lockstep = false;  ///< The recorded run was in lock-step.
  };

  /// Connects every agent of the simulation to its controller, except those that are teleoperated.
  /// @throws std::runtime_error  a program or plug-in that cannot be started, a busy domain,
  ///   agents without a controller.  @throws hal::files::config::ConfigErrors  controller
  ///   parameters.
  ControllersOfRun(const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
                   const Settings& settings);
  ~ControllersOfRun();
  ControllersOfRun(const ControllersOfRun&) = delete;
  ControllersOfRun& operator=(const ControllersOfRun&) = delete;

  std::size_t processes() const { return processes_; }
  /// DDS domain of the exchange; none: the controllers are in this process.
  std::optional<int> domain() const;

  /// Ends the processes that were started.
  /// @param stopped  they have been told that the run is over and get time to end by themselves.
  /// @param logs  folder that holds their logs now.
  /// @return one line for each process that ended badly and for each thing dropped or refused.
  std::vector<std::string> finish(bool stopped, const std::filesystem::path& logs);

 private:
  void connect_in_process(const std::vector<sim::scenario::ProcessPlan>& plans,
                          sim::agents::Simulation& simulation);
  void serve(const std::vector<sim::scenario::ProcessPlan>& plans,
             const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
             const Settings& settings);
  void spawn(const std::vector<sim::scenario::ProcessPlan>& plans,
             const sim::scenario::Scenario& scenario, const Settings& settings);
  void start_inside(const sim::scenario::ProcessPlan& plan, std::vector<std::string> arguments,
                    const Settings& settings);
  void start_held(const sim::scenario::ProcessPlan& plan, std::vector<std::string> arguments,
                  const Settings& settings);

  /// Whether all started processes are running. Errors: as Spawner::check().
  hal::Result<void> check_started(const Settings& settings) const;

  sim::agents::Simulation& simulation_;
  std::optional<InsideControllers> inside_;
  /// The simulation with only the agents whose controllers are served.
  std::unique_ptr<hal::node::exchange::AgentHost> served_;
  std::unique_ptr<gateway::server::AgentServer> server_;
  gateway::process::Spawner spawner_;
  std::size_t processes_ = 0;
};

}  // namespace baraka::run::controllers
