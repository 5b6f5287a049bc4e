#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/exchange/ports.h"
#include "hal/exchange/step.h"
#include "hal/routing/router.h"
#include "hal/types/result.h"
#include "hal/types/topics.h"
#include "sim/agents/inbox.h"
#include "sim/agents/observer.h"
#include "sim/agents/queue_timers.h"
#include "sim/agents/radio_link.h"
#include "sim/agents/simulation_config.h"
#include "sim/agents/surroundings.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac_sap.h"

namespace sim::agents {

/// What all agents of a run share; outlives them.
struct Surroundings {
  EventQueue& events;
  physics::World& world;
  Scene& scene;
  Observer& observer;
  const SimulationConfig& config;
};

/// Told when an agent has something for its controller, or its controller something for the run.
class AgentListener {
 public:
  virtual ~AgentListener() = default;
  virtual void on_inbox(hal::AgentId agent) = 0;
  virtual void on_state(hal::AgentId agent, const std::string& state) = 0;
};

/// One agent: a body with sensors, a radio with routing, and what its controller is told and does.
class SimulatedAgent : public hal::routing::Application, public hal::routing::RoutingObserver {
 public:
  SimulatedAgent(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                 AgentListener& listener);
  ~SimulatedAgent() override = default;
  SimulatedAgent(const SimulatedAgent&) = delete;
  SimulatedAgent& operator=(const SimulatedAgent&) = delete;

  const AgentConfig& config() const { return config_; }
  hal::AgentId id() const { return config_.id; }
  const std::string& name() const { return config_.name; }
  const std::string& last_state() const { return last_state_; }

  /// What the controller asked for. Before start().
  void connect(const hal::Wants& wants) { wants_ = wants; }

  /// Schedules the start event and the control cycle: both at the agent's phase. What is there for
  /// the controller before that (radio and routing are up from time 0) is handed over with it.
  void start();
  /// The last event. A controller that was not started yet is started first.
  void add_stop_event();
  std::vector<hal::exchange::Event> take_events();

  /// Lets an action take effect now. Errors: kInvalidArgument, naming field and value.
  hal::Result<void> apply(const hal::exchange::Action& action);

  /// Whether there is something that stop_wheels() stops.
  virtual bool has_wheels() const { return false; }
  void stop_wheels() { halt(); }

  /// Its controller is gone: no more events; wheels stop at `at`; radio and routing live on.
  void silence(hal::Time stop_at);

  void on_message(hal::Message message) override;
  void on_fate(hal::MessageId id, hal::Fate fate) override;
  void on_route_change(const hal::RouteChange& change) override;
  void on_neighbour(const hal::Neighbour& neighbour) override;
  void on_neighbour_lost(hal::AgentId neighbour) override;
  void on_discovery(std::string_view topic, hal::AgentId destination, hal::Duration took,
                    bool found) override;
  void on_message_end(hal::AgentId sent_by, hal::MessageId id, std::string_view topic,
                      hal::Verdict verdict) override;

 protected:
  Surroundings& surroundings() { return surroundings_; }
  bool wants_channel(std::string_view channel) const { return wants_.asks_for(channel); }

  /// Reads, at each control instant, what is to be read whether or not the controller asks.
  virtual void observe(hal::Time now) { (void)now; }
  /// Adds the readings of this control instant that the controller asked for. After observe().
  virtual void sample(hal::exchange::Event& event);
  /// Errors: kInvalidArgument (no wheels; NaN; beyond a limit).
  virtual hal::Result<void> drive(const hal::exchange::Action& action);
  virtual void halt() {}

 private:
  void start_controller();
  void on_control();
  void add(hal::exchange::Event event);
  hal::exchange::Event event(hal::exchange::Cause cause) const;
  hal::Result<void> send(const hal::exchange::Action& action);
  void set_timer(const hal::exchange::Action& action);
  void set_state(const std::string& state);

  const AgentConfig& config_;
  Surroundings surroundings_;
  AgentListener& listener_;
  radio::MacSap& mac_;
  RadioLink link_;
  QueueTimers timers_;
  hal::routing::Router router_;
  hal::Wants wants_;
  hal::Topics topics_;  ///< That its controller named.
  Inbox inbox_;
  std::set<hal::AgentId> heard_;  ///< Neighbours, if the controller wants them.
  std::map<hal::TimerId, EventQueue::EventId> controller_timers_;
  std::string last_state_;
  bool started_ = false;
  std::vector<hal::exchange::Event> early_;  ///< Before the start.
  bool silent_ = false;
};

}  // namespace sim::agents
