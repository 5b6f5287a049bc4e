#pragma once

#include <map>
#include <memory>
#include <optional>

#include "baraka/run/topics/inspection_observer.h"
#include "baraka/run/topics/teleop_velocities.h"
#include "gateway/inspection/inspection_participant.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::topics {

/// What a run shows to standard tools, and what it hears from them: inspection and teleoperation.
class RunInspection {
 public:
  struct Settings {
    bool shown = true;          ///< Else only teleoperation.
    std::optional<int> domain;  ///< DDS domain; none: the run's.
    bool repeated = false;      ///< Velocities come from the record, not from DDS.
  };

  /// @param scenario  outlives this object.
  RunInspection(const sim::scenario::Scenario& scenario, const Settings& settings);

  /// Sees the run; to be handed to the simulation.
  sim::agents::Observer& observer() { return observer_; }

  /// As InspectionObserver::set_ledger().
  void set_ledger(const sim::air::Ledger* ledger) { observer_.set_ledger(ledger); }

  /// Joins the domain and says so on standard error; connects the agents whose controller is
  /// kTeleop. Without a domain, as in a run with its controllers in this process, nothing is shown;
  /// neither, with a warning, if DDS cannot be opened and nobody asked for it.
  /// @param domain_of_run  if it has one.
  /// @throws std::runtime_error  if DDS cannot be opened and Settings::domain or an agent to
  ///   teleoperate asks for it; agents to teleoperate and no domain, but in a repetition.
  void start(std::optional<int> domain_of_run, sim::agents::Simulation& simulation);

  /// Drives an agent whose controller is kTeleop, as a velocity on DDS does. From any thread, after
  /// start(). @return false: it has another controller.
  bool drive(hal::AgentId agent, const hal::Twist2& twist);

 private:
  void open(int domain);
  void connect_teleop(sim::agents::Simulation& simulation);

  const sim::scenario::Scenario& scenario_;
  Settings settings_;
  std::unique_ptr<gateway::inspection::InspectionParticipant> participant_;
  InspectionObserver observer_;
  std::map<hal::AgentId, std::shared_ptr<TeleopVelocities>> driven_;  ///< Unchanged after start().
};

}  // namespace baraka::run::topics
