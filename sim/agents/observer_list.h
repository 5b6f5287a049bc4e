#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/agents/observer.h"

namespace sim::agents {

/// Hands every observation to several observers, in their order.
class ObserverList final : public Observer {
 public:
  explicit ObserverList(std::vector<Observer*> observers) : observers_(std::move(observers)) {}

  void add(Observer& observer) { observers_.push_back(&observer); }

  void on_frame_start(hal::Time at, const radio::Frame& frame) override {
    for (Observer* o : observers_) o->on_frame_start(at, frame);
  }
  void on_faint(const radio::Frame& frame, std::uint32_t radios) override {
    for (Observer* o : observers_) o->on_faint(frame, radios);
  }
  void on_frame_cut(hal::Time at, const radio::Frame& frame) override {
    for (Observer* o : observers_) o->on_frame_cut(at, frame);
  }
  void on_sinr(double sinr_db) override {
    for (Observer* o : observers_) o->on_sinr(sinr_db);
  }
  void on_reception(hal::Time at, const radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override {
    for (Observer* o : observers_) o->on_reception(at, frame, receiver, verdict, rssi_dbm);
  }
  void on_delivered(hal::Time at, const radio::Frame& frame, hal::AgentId receiver) override {
    for (Observer* o : observers_) o->on_delivered(at, frame, receiver);
  }
  void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                      hal::Verdict verdict) override {
    for (Observer* o : observers_) o->on_request_end(at, sender, destination, verdict);
  }
  void on_relay_lost(hal::Time at, hal::AgentId source, const radio::MacRequest& request,
                     hal::Verdict verdict) override {
    for (Observer* o : observers_) o->on_relay_lost(at, source, request, verdict);
  }
  void on_relay_queued(hal::Time at, const radio::Msdu& msdu) override {
    for (Observer* o : observers_) o->on_relay_queued(at, msdu);
  }
  void on_msdu_end(hal::Time at, const radio::Msdu& msdu, const radio::MsduEnd& end) override {
    for (Observer* o : observers_) o->on_msdu_end(at, msdu, end);
  }
  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override {
    for (Observer* o : observers_) o->on_association(at, station, access_point);
  }
  void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) override {
    for (Observer* o : observers_) o->on_start(links);
  }
  void on_body(hal::Time at, hal::AgentId agent, const BodyState& body) override {
    for (Observer* o : observers_) o->on_body(at, agent, body);
  }
  void on_displaced(hal::Time at, hal::AgentId agent) override {
    for (Observer* o : observers_) o->on_displaced(at, agent);
  }
  void on_cycle(hal::Time at, hal::AgentId agent) override {
    for (Observer* o : observers_) o->on_cycle(at, agent);
  }
  void on_pose(hal::Time at, hal::AgentId agent, const hal::Pose2& pose) override {
    for (Observer* o : observers_) o->on_pose(at, agent, pose);
  }
  bool observes_readings() const override {
    return std::ranges::any_of(observers_,
                               [](const Observer* o) { return o->observes_readings(); });
  }
  bool observes(hal::AgentId agent, const hal::Channel& channel) const override {
    return std::ranges::any_of(observers_, [&](const Observer* o) {
      return o->observes_readings() && o->observes(agent, channel);
    });
  }
  /// To those that observe the channel.
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override {
    for (Observer* o : observers_) {
      if (o->observes_readings() && o->observes(agent, channel))
        o->on_reading(at, agent, channel, values);
    }
  }
  void on_body_lost(const physics::LostBody& lost) override {
    for (Observer* o : observers_) o->on_body_lost(lost);
  }
  void on_event(const hal::node::exchange::Event& event) override {
    for (Observer* o : observers_) o->on_event(event);
  }
  void on_action(hal::Time at, const hal::node::exchange::Action& action) override {
    for (Observer* o : observers_) o->on_action(at, action);
  }
  void on_message_sent(hal::Time at, const hal::Message& message) override {
    for (Observer* o : observers_) o->on_message_sent(at, message);
  }
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override {
    for (Observer* o : observers_) o->on_message_delivered(at, receiver, message, transmissions);
  }
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override {
    for (Observer* o : observers_) o->on_fate(at, sender, id, fate);
  }
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override {
    for (Observer* o : observers_) o->on_message_end(at, at_node, sender, id, verdict);
  }
  void on_protocol_event(hal::AgentId agent, hal::node::routing::ProtocolEvent event) override {
    for (Observer* o : observers_) o->on_protocol_event(agent, event);
  }
  void on_discovery(hal::Time at, hal::AgentId agent, const Discovery& discovery) override {
    for (Observer* o : observers_) o->on_discovery(at, agent, discovery);
  }
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override {
    for (Observer* o : observers_) o->on_route_change(at, agent, change);
  }
  void on_air_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request) override {
    for (Observer* o : observers_) o->on_air_entered(at, agent, request);
  }
  void on_air_left(hal::Time at, hal::AgentId agent,
                   const radio::MacIndication& indication) override {
    for (Observer* o : observers_) o->on_air_left(at, agent, indication);
  }
  void on_air_refused(hal::Time at, hal::AgentId agent, air::Refusal refusal,
                      std::size_t bytes) override {
    for (Observer* o : observers_) o->on_air_refused(at, agent, refusal, bytes);
  }
  void on_arrival(const OutsideArrival& arrival) override {
    for (Observer* o : observers_) o->on_arrival(arrival);
  }
  void on_scripted(const ScriptedDone& done) override {
    for (Observer* o : observers_) o->on_scripted(done);
  }
  void on_turn(const Turn& turn) override {
    for (Observer* o : observers_) o->on_turn(turn);
  }
  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override {
    for (Observer* o : observers_) o->on_state(at, agent, state);
  }
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override {
    for (Observer* o : observers_) o->on_record(at, agent, name, value);
  }

 private:
  std::vector<Observer*> observers_;
};

}  // namespace sim::agents
