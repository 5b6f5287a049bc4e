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

/// The link of a run with standard tools: inspection and teleoperation.
class RunInspection {
 public:
  struct Settings {
    bool shown = true;          ///< False: teleoperation only.
    std::optional<int> domain;  ///< DDS domain; none: the domain of the run.
    bool repeated = false;      ///< Velocities come from a record, not from DDS.
  };

  /// @param scenario  must outlive this object.
  RunInspection(const sim::scenario::Scenario& scenario, const Settings& settings);

  /// The observer to add to the simulation.
  sim::agents::Observer& observer() { return observer_; }

  /// As InspectionObserver::set_ledger().
  void set_ledger(const sim::air::Ledger* ledger) { observer_.set_ledger(ledger); }

  /// Joins the domain, prints it on standard error, and connects the agents whose controller is
  /// kTeleop. Nothing is published without a domain, as in a run with controllers in this process,
  /// nor (after a warning) if DDS cannot be opened and is not required.
  /// @param domain_of_run  none: the run has no domain.
  /// @throws std::runtime_error  DDS cannot be opened although Settings::domain or a teleoperated
  ///   agent requires it; or there are teleoperated agents but no domain, except in a repetition.
  void start(std::optional<int> domain_of_run, sim::agents::Simulation& simulation);

  /// Drives an agent whose controller is kTeleop, like a velocity received by DDS. Any thread,
  /// after start(). @return false: the agent has another controller.
  bool drive(hal::AgentId agent, const hal::Twist2& twist);

 private:
  void open(int domain);
  void connect_teleop(sim::agents::Simulation& simulation);

  const sim::scenario::Scenario& scenario_;
  Settings settings_;
  std::unique_ptr<gateway::inspection::InspectionParticipant> participant_;
  InspectionObserver observer_;
  /// Teleoperated agents; not changed after start().
  std::map<hal::AgentId, std::shared_ptr<TeleopVelocities>> driven_;
};

}  // namespace baraka::run::topics
