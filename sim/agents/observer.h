#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hal/node/agent/agent_observer.h"
#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/agents/real_time.h"
#include "sim/agents/scripted_event.h"
#include "sim/air/refusal.h"
#include "sim/core/outside_input.h"
#include "sim/physics/world.h"
#include "sim/radio/observer.h"

namespace sim::agents {

/// Where a body is at one instant; world frame.
struct BodyState {
  double x = 0, y = 0;   ///< m, of the body's reference point on the ground.
  double theta = 0;      ///< rad, heading.
  double tilt = 0;       ///< rad, between the body's z axis and the vertical.
  double clearance = 0;  ///< m, from (x, y) to the nearest wall's surface; infinite: no walls.
};

/// Touches of one body since the start of the run.
struct ContactCounts {
  std::uint64_t wall_steps = 0;    ///< Physics steps in which the body touched a wall.
  std::uint64_t object_steps = 0;  ///< … or another body.
};

using hal::node::agent::Discovery;

/// What there is to see of a run, for records and fingerprints. Calls come in event order, all on
/// the simulation's thread. The parts of the radio and of the agents are inherited.
class Observer : public radio::RadioObserver, public hal::node::agent::AgentObserver {
 public:
  /// Once, before the first event.
  virtual void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) {
    (void)links;
  }
  /// At each control instant of an agent.
  virtual void on_body(hal::Time at, hal::AgentId agent, const BodyState& body) {
    (void)at, (void)agent, (void)body;
  }
  /// The physics step that ended now put its body somewhere else, as the scenario says.
  virtual void on_displaced(hal::Time at, hal::AgentId agent) { (void)at, (void)agent; }
  /// A body tipped over or got lost; once per body, after the physics step.
  virtual void on_body_lost(const physics::LostBody& lost) { (void)lost; }
  /// Something happened to an agent, or to the air, because the scenario says so.
  virtual void on_scripted(const ScriptedDone& done) { (void)done; }
  /// In real time: a controller process had an influence on the run.
  virtual void on_turn(const Turn& turn) { (void)turn; }
  /// A frame from the agent's interface became this request, with a tag of its own.
  virtual void on_air_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request) {
    (void)at, (void)agent, (void)request;
  }
  /// What the agent received went to its interface.
  virtual void on_air_left(hal::Time at, hal::AgentId agent,
                           const radio::MacIndication& indication) {
    (void)at, (void)agent, (void)indication;
  }
  /// A frame from the agent's interface that no radio can send: why, and so many bytes.
  virtual void on_air_refused(hal::Time at, hal::AgentId agent, air::Refusal refusal,
                              std::size_t bytes) {
    (void)at, (void)agent, (void)refusal, (void)bytes;
  }
  /// Something from outside was taken in.
  virtual void on_arrival(const OutsideArrival& arrival) { (void)arrival; }
};

}  // namespace sim::agents
