#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/agent/agent_observer.h"
#include "hal/node/agent/inbox.h"
#include "hal/node/agent/ports.h"
#include "hal/node/agent/repeated_lines.h"
#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/node/routing/router.h"
#include "hal/types/result.h"
#include "hal/types/used_names.h"
#include "hal/types/wants.h"

namespace hal::node::agent {

/// What a simulated and a real agent have in common: it routes messages, delivers events to its
/// controller and carries out the controller's actions if they are valid. The host decides when
/// control instants are and how events travel, and provides the drive and the sensors.
///
///                ┌────────────────── disconnect() ──────────────────┐
///                ▼                                                  │
///   no controller ──connect()──▶ waiting ──start(): START──▶ driven ──stop(): STOP──▶ over
///
/// Without a controller, and when it is over, the agent keeps routing and reports to observers
/// only. Events that occur while it is waiting are delivered right after START. When it is over,
/// only actions for which exchange::is_word() holds take effect.
///
///   AgentCore core(session, routing, ports);
///   core.connect(wants);
///   core.start();
///   … at each control instant: core.control(); … each action: core.apply(action, now); …
///   … after on_inbox(): for (Event& event : core.take_events()) …
///
/// One thread.
class AgentCore final : public routing::Application, public routing::RoutingObserver {
 public:
  struct Ports {
    Timers& timers;
    Link& link;
    Drive* drive;  ///< Null: it has no wheels.
    Sensors& sensors;
    AgentObserver& observer;
    AgentListener& listener;
  };

  /// @param session  contains all channels that `ports.sensors` has.   @param ports  outlive the
  ///   core.
  AgentCore(exchange::AgentSession session, const routing::RoutingConfig& routing,
            const Ports& ports);
  AgentCore(const AgentCore&) = delete;
  AgentCore& operator=(const AgentCore&) = delete;

  const exchange::AgentSession& session() const { return session_; }
  AgentId id() const { return id_; }
  const std::string& name() const { return session_.name; }
  const std::string& last_state() const { return last_state_; }

  /// For the link: receives frames and the results of transmissions.
  routing::Router& router() { return router_; }
  const routing::Router& router() const { return router_; }

  /// Connects a new controller. It is given all present routes and neighbours to which it
  /// subscribes.
  void connect(const Wants& wants);
  bool is_connected() const { return phase_ == Phase::kWaiting || phase_ == Phase::kDriven; }
  /// The controller is gone: cancels its timers and drops its waiting events. The wheels keep
  /// turning.
  void disconnect();
  /// @pre connected. A second call has no effect.
  void start();
  /// Delivers the last event. A controller that has not been started is started first. No effect
  /// without a controller.
  void stop();

  /// Performs a control instant: samples the sensors and adds the control event.
  void control();

  /// Removes and returns the events to be delivered now, by (time, cause, arrival).
  std::vector<exchange::Event> take_events();
  /// The same, appended to `to`.
  void take_events(std::vector<exchange::Event>& to);

  /// Lets an action take effect now. ControllerFailed has no effect here: the host handles it.
  /// @param as_of  when the reply that contains the action arrived.
  /// Errors, which are counted and logged: those of exchange::validate(), UsedNames and Drive.
  Result<void> apply(const exchange::Action& action, Time as_of);

  /// Counts and logs a refused action; the same reason is logged at most once in five seconds.
  void refuse(const std::string& why);
  std::uint64_t refused() const { return refused_; }

  bool has_wheels() const { return ports_.drive != nullptr; }
  void halt();  ///< No effect without wheels.

  void on_message(Message message, int transmissions) override;
  void on_fate(MessageId id, Fate fate) override;
  void on_route_change(const RouteChange& change) override;
  void on_neighbour(const Neighbour& neighbour) override;
  void on_neighbour_lost(AgentId neighbour) override;
  void on_discovery(std::string_view topic, AgentId destination, Duration took,
                    bool found) override;
  void on_message_end(AgentId sent_by, MessageId id, std::string_view topic,
                      Verdict verdict) override;
  void on_protocol_event(routing::ProtocolEvent event) override;

 private:
  enum class Phase : std::uint8_t { kNoController, kWaiting, kDriven, kOver };

  Time now() const { return ports_.timers.now(); }
  bool is_watched(const std::string& topic) const;
  void begin_anew(const Wants& wants);
  exchange::Event event(exchange::Event::What&& what) const;
  void add(exchange::Event&& event);
  bool is_asked_for(std::size_t channel) const { return is_connected() && asked_[channel]; }
  void sample(exchange::Event& control);
  Result<void> take_effect(const exchange::Action& action, Time as_of);
  Drive& wheels();
  Result<void> send(const exchange::Send& message);
  Result<void> record(const exchange::Record& record);
  void set_timer(const exchange::SetTimer& timer);
  void set_state(const std::string& state);

  // Members used at every control instant come first: with thousands of agents little else stays in
  // the cache.
  const Ports ports_;
  const AgentId id_;
  Phase phase_ = Phase::kNoController;
  bool asks_ = false;  ///< The controller subscribes to some channel.
  Inbox inbox_;

  const exchange::AgentSession session_;
  const std::map<std::string, Priority, std::less<>> priorities_;  ///< By topic.
  routing::Router router_;
  Wants wants_;
  std::vector<bool> asked_;  ///< By channel: the controller subscribes to it.
  Topics topics_;            ///< Used by the controller.
  RecordedNames recorded_;
  std::map<TimerId, Timers::Handle> timers_;
  /// Every controller numbers its messages from 1; in the network they are numbered consecutively
  /// over all controllers. Maps the network's number to the controller's.
  std::map<MessageId, MessageId> sent_;
  std::set<AgentId> told_;  ///< Neighbours reported to the controller, or about to be.

  std::vector<exchange::Event> early_;  ///< Events before START.
  MessageId last_message_ = 0;          ///< As numbered in the network.
  std::string last_state_;
  RepeatedLines refusals_;
  std::uint64_t refused_ = 0;
};

}  // namespace hal::node::agent
