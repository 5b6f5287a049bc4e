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
#include "sim/radio/mac/observer.h"

namespace sim::agents {

/// State of a body at one instant, world frame.
struct BodyState {
  double x = 0, y = 0;  ///< Reference point of the body on the ground [m].
  double theta = 0;     ///< Heading [rad].
  double tilt = 0;      ///< Angle between the body's z axis and the vertical [rad].
  /// Distance from (x, y) to the nearest wall's surface [m]; infinite without walls.
  double clearance = 0;
};

/// Contacts of one body since the start of the run.
struct ContactCounts {
  std::uint64_t wall_steps = 0;    ///< Physics steps in which the body touched a wall.
  std::uint64_t object_steps = 0;  ///< Physics steps in which it touched another body.
};

using hal::node::agent::Discovery;

/// Observer of a run, for records and fingerprints. Calls come in event order, all on the
/// simulation's thread. The callbacks of the radio and of the agents are inherited.
class Observer : public radio::RadioObserver, public hal::node::agent::AgentObserver {
 public:
  /// Called once, before the first event.
  virtual void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) {
    (void)links;
  }
  /// Called at each control instant of an agent.
  virtual void on_body(hal::Time at, hal::AgentId agent, const BodyState& body) {
    (void)at, (void)agent, (void)body;
  }
  /// Called for each movable at the start and then, once per control period, if it has moved.
  /// @param number  its number in the world.
  virtual void on_movable(hal::Time at, std::uint32_t number, const physics::BodyPose& pose) {
    (void)at, (void)number, (void)pose;
  }
  /// The physics step that ended now placed its body elsewhere, as the scenario demands.
  virtual void on_displaced(hal::Time at, hal::AgentId agent) { (void)at, (void)agent; }
  /// An agent's body tipped over or was lost; called once per body, after the physics step.
  virtual void on_body_lost(const physics::LostBody& lost) { (void)lost; }
  /// A scripted action was done to an agent or to the medium.
  virtual void on_scripted(const ScriptedDone& done) { (void)done; }
  /// Real time: a controller process influenced the run.
  virtual void on_turn(const Turn& turn) { (void)turn; }
  /// A frame from the agent's interface was accepted as this request, which has a unique tag.
  virtual void on_air_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request) {
    (void)at, (void)agent, (void)request;
  }
  /// A frame that the agent received was passed to its interface.
  virtual void on_air_left(hal::Time at, hal::AgentId agent,
                           const radio::MacIndication& indication) {
    (void)at, (void)agent, (void)indication;
  }
  /// A frame of this many bytes from the agent's interface cannot be sent, for this reason.
  virtual void on_air_refused(hal::Time at, hal::AgentId agent, air::Refusal refusal,
                              std::size_t bytes) {
    (void)at, (void)agent, (void)refusal, (void)bytes;
  }
  /// An input from outside entered the run.
  virtual void on_arrival(const OutsideArrival& arrival) { (void)arrival; }
};

}  // namespace sim::agents
