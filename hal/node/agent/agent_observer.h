#pragma once

#include <span>
#include <string_view>

#include "hal/node/exchange/step.h"
#include "hal/node/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/geometry.h"
#include "hal/types/message.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"

namespace hal::node::agent {

/// The end of a search for a route.
struct Discovery {
  std::string_view topic;
  AgentId destination;
  Duration took{};     ///< Includes retries.
  bool found = false;  ///< False: given up after the last retry.
};

/// Observes agents, simulated or real, for records, fingerprints and inspection. Calls come in
/// event order, all on the host's thread; `at` is the host's time. Implementations must be quick.
class AgentObserver {
 public:
  virtual ~AgentObserver() = default;

  /// A control instant of an agent, with or without a controller; the other calls of the instant
  /// follow.
  virtual void on_cycle(Time at, AgentId agent) { (void)at, (void)agent; }
  /// Pose of an agent in the world frame, if its host knows it, e.g. from motion capture.
  virtual void on_pose(Time at, AgentId agent, const Pose2& pose) {
    (void)at, (void)agent, (void)pose;
  }
  /// Whether the observer may want readings of any channel of any agent now. If not, observes() is
  /// not called.
  virtual bool observes_readings() const { return false; }
  /// Called only if observes_readings(): whether it wants the readings of a channel now, including
  /// channels to which no controller subscribes.
  virtual bool observes(AgentId agent, const Channel& channel) const {
    (void)agent, (void)channel;
    return false;
  }
  /// A reading of an observed channel, at a control instant.
  virtual void on_reading(Time at, AgentId agent, const Channel& channel,
                          std::span<const double> values) {
    (void)at, (void)agent, (void)channel, (void)values;
  }
  /// An event is delivered to an agent's controller; an action of the controller takes effect.
  virtual void on_event(const exchange::Event& event) { (void)event; }
  virtual void on_action(Time at, const exchange::Action& action) { (void)at, (void)action; }
  /// `message.id` is numbered by the agent, consecutively over all its controllers.
  virtual void on_message_sent(Time at, const Message& message) { (void)at, (void)message; }
  /// Delivery at one receiver; a flooded message is delivered once per node that it reaches.
  /// @param transmissions  number of hops so far, including the last one.
  virtual void on_message_delivered(Time at, AgentId receiver, const Message& message,
                                    int transmissions) {
    (void)at, (void)receiver, (void)message, (void)transmissions;
  }
  virtual void on_fate(Time at, AgentId sender, MessageId id, Fate fate) {
    (void)at, (void)sender, (void)id, (void)fate;
  }
  /// A message, or one branch of a flood, ended at node `at_node`.
  virtual void on_message_end(Time at, AgentId at_node, AgentId sender, MessageId id,
                              Verdict verdict) {
    (void)at, (void)at_node, (void)sender, (void)id, (void)verdict;
  }
  virtual void on_discovery(Time at, AgentId agent, const Discovery& discovery) {
    (void)at, (void)agent, (void)discovery;
  }
  /// The agent's routing protocol reports an event that is counted.
  virtual void on_protocol_event(AgentId agent, routing::ProtocolEvent event) {
    (void)agent, (void)event;
  }
  virtual void on_route_change(Time at, AgentId agent, const RouteChange& change) {
    (void)at, (void)agent, (void)change;
  }
  virtual void on_state(Time at, AgentId agent, std::string_view state) {
    (void)at, (void)agent, (void)state;
  }
  /// The agent's controller records a value; `at` is the time of the value, now or earlier.
  virtual void on_record(Time at, AgentId agent, std::string_view name, double value) {
    (void)at, (void)agent, (void)name, (void)value;
  }
};

}  // namespace hal::node::agent
