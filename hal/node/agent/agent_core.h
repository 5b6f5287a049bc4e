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

/// What an agent is to its controller, simulated or real: it routes messages, tells of what
/// happens, and does what it is asked to, if that is in order. When control instants are, how
/// events travel, and what a drive and sensors are made of is for the host.
///
///                ┌────────────────── disconnect() ──────────────────┐
///                ▼                                                  │
///   no controller ──connect()──▶ waiting ──start(): START──▶ driven ──stop(): STOP──▶ over
///
/// Without a controller, and when it is over, the agent routes on, and tells observers only. What
/// happens while it waits is told right after START. When it is over, only words take effect.
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

  /// @param session  with all channels that `ports.sensors` has.   @param ports  outlive the core.
  AgentCore(exchange::AgentSession session, const routing::RoutingConfig& routing,
            const Ports& ports);
  AgentCore(const AgentCore&) = delete;
  AgentCore& operator=(const AgentCore&) = delete;

  const exchange::AgentSession& session() const { return session_; }
  AgentId id() const { return id_; }
  const std::string& name() const { return session_.name; }
  const std::string& last_state() const { return last_state_; }

  /// For the link: frames and what became of them.
  routing::Router& router() { return router_; }
  const routing::Router& router() const { return router_; }

  /// A controller that knows nothing comes: it will be told of the routes and neighbours there are.
  void connect(const Wants& wants);
  bool is_connected() const { return phase_ == Phase::kWaiting || phase_ == Phase::kDriven; }
  /// The controller is gone, with its timers and what waited for it. The wheels turn on.
  void disconnect();
  /// @pre connected. Once more: no effect.
  void start();
  /// The last event. A controller that was not started yet is started first; without one: none.
  void stop();

  /// A control instant.
  void control();

  /// What there is to be handed over now, by (time, cause, arrival).
  std::vector<exchange::Event> take_events();
  /// The same, appended.
  void take_events(std::vector<exchange::Event>& to);

  /// Lets an action take effect now. ControllerFailed has none: it is for the host.
  /// @param as_of  when the answer came in that it is of.
  /// Errors, which are counted and logged: those of exchange::validate(), UsedNames and Drive.
  Result<void> apply(const exchange::Action& action, Time as_of);

  /// Counts and logs that an action is not done, the same reason once in five seconds.
  void refuse(const std::string& why);
  std::uint64_t refused() const { return refused_; }

  bool has_wheels() const { return ports_.drive != nullptr; }
  void halt();  ///< Without wheels: no effect.

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
  exchange::Event event(exchange::Event::What what) const;
  void add(exchange::Event event);
  bool is_asked_for(std::size_t channel) const { return is_connected() && asked_[channel]; }
  void sample(exchange::Event& control);
  Result<void> take_effect(const exchange::Action& action, Time as_of);
  Drive& wheels();
  Result<void> send(const exchange::Send& message);
  Result<void> record(const exchange::Record& record);
  void set_timer(const exchange::SetTimer& timer);
  void set_state(const std::string& state);

  // First what every control instant needs: of thousands of agents, little else is in the cache.
  const Ports ports_;
  const AgentId id_;
  Phase phase_ = Phase::kNoController;
  bool asks_ = false;  ///< The controller asked for some channel.
  Inbox inbox_;

  const exchange::AgentSession session_;
  routing::Router router_;
  Wants wants_;
  std::vector<bool> asked_;  ///< By channel: the controller asked for it.
  Topics topics_;            ///< That it named.
  RecordedNames recorded_;
  std::map<TimerId, Timers::Handle> timers_;
  /// A controller numbers its messages from 1, as the one before it did; for the network they are
  /// numbered on. By the network's number.
  std::map<MessageId, MessageId> sent_;
  std::set<AgentId> told_;  ///< Neighbours that it knows, or is about to.

  std::vector<exchange::Event> early_;  ///< Before the start.
  MessageId last_message_ = 0;          ///< The network's number.
  std::string last_state_;
  RepeatedLines refusals_;
  std::uint64_t refused_ = 0;
};

}  // namespace hal::node::agent
