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

/// The controllers of one run: in this process, or in others that were started for it or by hand.
/// They end with this object.
class ControllersOfRun {
 public:
  struct Settings {
    ControllersFrom from = ControllersFrom::kSpawn;
    std::optional<int> domain = {};   ///< None: the first free one.
    std::filesystem::path logs = {};  ///< Folder for the logs of spawned controllers.
    /// Starts those that run inside their agents' networks; outlives them. Null: there are none.
    gateway::server::InsideStarter* inside = nullptr;
    /// Of a repetition: what these answered, as take_replies(). Null: this is none.
    const std::vector<sim::OutsideArrival>* replies = nullptr;
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
  /// DDS domain that the processes talk in; none: the controllers are in this process.
  std::optional<int> domain() const;

  /// Ends what was started. @param stopped  they have been told the run is over, and get time to
  /// end by themselves. @param logs  folder in which their logs are by now. @return one line per
  /// process that ended badly, and per thing that was dropped or refused.
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

  /// Whether all processes that were started run. Errors: as Spawner::check().
  hal::Result<void> check_started(const Settings& settings) const;

  std::optional<InsideControllers> inside_;
  std::unique_ptr<hal::node::exchange::AgentHost> served_;  ///< The simulation without the others.
  std::unique_ptr<gateway::server::AgentServer> server_;
  gateway::process::Spawner spawner_;
  std::size_t processes_ = 0;
};

}  // namespace baraka::run::controllers
