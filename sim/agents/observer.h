#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/exchange/step.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/message.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/agents/real_time.h"
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

/// The end of a search for a route.
struct Discovery {
  std::string_view topic;
  hal::AgentId destination;
  hal::Duration took{};  ///< Retries included.
  bool found = false;    ///< Or given up after the last retry.
};

/// What there is to see of a run, for records and fingerprints. Calls come in event order, all on
/// the simulation's thread. The radio's part is inherited.
class Observer : public radio::RadioObserver {
 public:
  /// Once, before the first event.
  virtual void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) {
    (void)links;
  }
  /// At each control instant of an agent.
  virtual void on_body(hal::Time at, hal::AgentId agent, const BodyState& body) {
    (void)at, (void)agent, (void)body;
  }
  /// What a robot's own wheels tell, at each control instant: m, rad since the start; m/s, rad/s in
  /// the body's frame.
  virtual void on_odometry(hal::Time at, hal::AgentId agent, const hal::Pose2& pose,
                           const hal::Twist2& twist) {
    (void)at, (void)agent, (void)pose, (void)twist;
  }
  /// A body tipped over or got lost; once per body, after the physics step.
  virtual void on_body_lost(const physics::LostBody& lost) { (void)lost; }
  /// An event is handed to an agent's controller / an action of it takes effect.
  virtual void on_event(const hal::exchange::Event& event) { (void)event; }
  virtual void on_action(hal::Time at, const hal::exchange::Action& action) {
    (void)at, (void)action;
  }
  virtual void on_message_sent(hal::Time at, const hal::Message& message) {
    (void)at, (void)message;
  }
  /// At one receiver; a flood is delivered once per node that it reaches.
  virtual void on_message_delivered(hal::Time at, hal::AgentId receiver,
                                    const hal::Message& message) {
    (void)at, (void)receiver, (void)message;
  }
  virtual void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) {
    (void)at, (void)sender, (void)id, (void)fate;
  }
  /// A message, or one branch of a flood, ended at node `at_node`.
  virtual void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender,
                              hal::MessageId id, hal::Verdict verdict) {
    (void)at, (void)at_node, (void)sender, (void)id, (void)verdict;
  }
  virtual void on_discovery(hal::Time at, hal::AgentId agent, const Discovery& discovery) {
    (void)at, (void)agent, (void)discovery;
  }
  virtual void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) {
    (void)at, (void)agent, (void)change;
  }
  /// In real time: a controller process had an influence on the run.
  virtual void on_turn(const Turn& turn) { (void)turn; }
  /// Something from outside was taken in.
  virtual void on_arrival(const OutsideArrival& arrival) { (void)arrival; }
  virtual void on_state(hal::Time at, hal::AgentId agent, std::string_view state) {
    (void)at, (void)agent, (void)state;
  }
};

}  // namespace sim::agents
