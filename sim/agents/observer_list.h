#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/agents/observer.h"

namespace sim::agents {

/// Passes observations to several observers, in the order in which they were added. One whose type
/// is known is called only for the callbacks that it overrides; one that was added as `Observer&`
/// is called for all.
class ObserverList : public Observer {
 public:
  explicit ObserverList(const std::vector<Observer*>& observers = {}) {
    for (Observer* const one : observers) add(*one);
  }

  template <class One>
  void add(One& observer) {
    static_assert(std::is_final_v<One> || std::is_same_v<One, Observer>, "overrides may be hidden");
    listen<&One::on_frame_start>(frame_start_, observer);
    listen<&One::on_faint>(faint_, observer);
    listen<&One::on_frame_cut>(frame_cut_, observer);
    listen<&One::on_sinr>(sinr_, observer);
    listen<&One::on_reception>(reception_, observer);
    listen<&One::on_delivered>(delivered_, observer);
    listen<&One::on_request_end>(request_end_, observer);
    listen<&One::on_relay_lost>(relay_lost_, observer);
    listen<&One::on_relay_queued>(relay_queued_, observer);
    listen<&One::on_queue>(queue_, observer);
    listen<&One::on_msdu_end>(msdu_end_, observer);
    listen<&One::on_association>(association_, observer);
    listen<&One::on_start>(start_, observer);
    listen<&One::on_body>(body_, observer);
    listen<&One::on_movable>(movable_, observer);
    listen<&One::on_displaced>(displaced_, observer);
    listen<&One::on_cycle>(cycle_, observer);
    listen<&One::on_pose>(pose_, observer);
    listen<&One::on_reading>(reading_, observer);
    listen<&One::on_body_lost>(body_lost_, observer);
    listen<&One::on_event>(event_, observer);
    listen<&One::on_action>(action_, observer);
    listen<&One::on_message_sent>(message_sent_, observer);
    listen<&One::on_message_delivered>(message_delivered_, observer);
    listen<&One::on_fate>(fate_, observer);
    listen<&One::on_message_end>(message_end_, observer);
    listen<&One::on_protocol_event>(protocol_event_, observer);
    listen<&One::on_discovery>(discovery_, observer);
    listen<&One::on_route_change>(route_change_, observer);
    listen<&One::on_air_entered>(air_entered_, observer);
    listen<&One::on_air_left>(air_left_, observer);
    listen<&One::on_air_refused>(air_refused_, observer);
    listen<&One::on_arrival>(arrival_, observer);
    listen<&One::on_scripted>(scripted_, observer);
    listen<&One::on_turn>(turn_, observer);
    listen<&One::on_state>(state_, observer);
    listen<&One::on_record>(record_, observer);
  }

  void on_frame_start(hal::Time at, const radio::Frame& frame) override {
    for (Observer* o : frame_start_) o->on_frame_start(at, frame);
  }
  void on_faint(const radio::Frame& frame, std::uint32_t radios) override {
    for (Observer* o : faint_) o->on_faint(frame, radios);
  }
  void on_frame_cut(hal::Time at, const radio::Frame& frame) override {
    for (Observer* o : frame_cut_) o->on_frame_cut(at, frame);
  }
  void on_sinr(double sinr_db) override {
    for (Observer* o : sinr_) o->on_sinr(sinr_db);
  }
  void on_reception(hal::Time at, const radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override {
    for (Observer* o : reception_) o->on_reception(at, frame, receiver, verdict, rssi_dbm);
  }
  void on_delivered(hal::Time at, const radio::Frame& frame, hal::AgentId receiver) override {
    for (Observer* o : delivered_) o->on_delivered(at, frame, receiver);
  }
  void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                      hal::Verdict verdict) override {
    for (Observer* o : request_end_) o->on_request_end(at, sender, destination, verdict);
  }
  void on_relay_lost(hal::Time at, hal::AgentId source, const radio::MacRequest& request,
                     hal::Verdict verdict) override {
    for (Observer* o : relay_lost_) o->on_relay_lost(at, source, request, verdict);
  }
  void on_relay_queued(hal::Time at, const radio::Msdu& msdu) override {
    for (Observer* o : relay_queued_) o->on_relay_queued(at, msdu);
  }
  void on_queue(hal::Time at, const radio::QueueChange& change) override {
    for (Observer* o : queue_) o->on_queue(at, change);
  }
  void on_msdu_end(hal::Time at, const radio::Msdu& msdu, const radio::MsduEnd& end) override {
    for (Observer* o : msdu_end_) o->on_msdu_end(at, msdu, end);
  }
  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override {
    for (Observer* o : association_) o->on_association(at, station, access_point);
  }
  void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) override {
    for (Observer* o : start_) o->on_start(links);
  }
  void on_body(hal::Time at, hal::AgentId agent, const BodyState& body) override {
    for (Observer* o : body_) o->on_body(at, agent, body);
  }
  void on_movable(hal::Time at, std::uint32_t number, const physics::BodyPose& pose) override {
    for (Observer* o : movable_) o->on_movable(at, number, pose);
  }
  void on_displaced(hal::Time at, hal::AgentId agent) override {
    for (Observer* o : displaced_) o->on_displaced(at, agent);
  }
  void on_cycle(hal::Time at, hal::AgentId agent) override {
    for (Observer* o : cycle_) o->on_cycle(at, agent);
  }
  void on_pose(hal::Time at, hal::AgentId agent, const hal::Pose2& pose) override {
    for (Observer* o : pose_) o->on_pose(at, agent, pose);
  }
  bool observes_readings() const override {
    return std::ranges::any_of(reading_, [](const Observer* o) { return o->observes_readings(); });
  }
  bool observes(hal::AgentId agent, const hal::Channel& channel) const override {
    return std::ranges::any_of(reading_, [&](const Observer* o) {
      return o->observes_readings() && o->observes(agent, channel);
    });
  }
  /// To those that observe the channel.
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override {
    for (Observer* o : reading_) {
      if (o->observes_readings() && o->observes(agent, channel))
        o->on_reading(at, agent, channel, values);
    }
  }
  void on_body_lost(const physics::LostBody& lost) override {
    for (Observer* o : body_lost_) o->on_body_lost(lost);
  }
  void on_event(const hal::node::exchange::Event& event) override {
    for (Observer* o : event_) o->on_event(event);
  }
  void on_action(hal::Time at, const hal::node::exchange::Action& action) override {
    for (Observer* o : action_) o->on_action(at, action);
  }
  void on_message_sent(hal::Time at, const hal::Message& message) override {
    for (Observer* o : message_sent_) o->on_message_sent(at, message);
  }
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override {
    for (Observer* o : message_delivered_)
      o->on_message_delivered(at, receiver, message, transmissions);
  }
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override {
    for (Observer* o : fate_) o->on_fate(at, sender, id, fate);
  }
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override {
    for (Observer* o : message_end_) o->on_message_end(at, at_node, sender, id, verdict);
  }
  void on_protocol_event(hal::AgentId agent, hal::node::routing::ProtocolEvent event) override {
    for (Observer* o : protocol_event_) o->on_protocol_event(agent, event);
  }
  void on_discovery(hal::Time at, hal::AgentId agent, const Discovery& discovery) override {
    for (Observer* o : discovery_) o->on_discovery(at, agent, discovery);
  }
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override {
    for (Observer* o : route_change_) o->on_route_change(at, agent, change);
  }
  void on_air_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request) override {
    for (Observer* o : air_entered_) o->on_air_entered(at, agent, request);
  }
  void on_air_left(hal::Time at, hal::AgentId agent,
                   const radio::MacIndication& indication) override {
    for (Observer* o : air_left_) o->on_air_left(at, agent, indication);
  }
  void on_air_refused(hal::Time at, hal::AgentId agent, air::Refusal refusal,
                      std::size_t bytes) override {
    for (Observer* o : air_refused_) o->on_air_refused(at, agent, refusal, bytes);
  }
  void on_arrival(const OutsideArrival& arrival) override {
    for (Observer* o : arrival_) o->on_arrival(arrival);
  }
  void on_scripted(const ScriptedDone& done) override {
    for (Observer* o : scripted_) o->on_scripted(done);
  }
  void on_turn(const Turn& turn) override {
    for (Observer* o : turn_) o->on_turn(turn);
  }
  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override {
    for (Observer* o : state_) o->on_state(at, agent, state);
  }
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override {
    for (Observer* o : record_) o->on_record(at, agent, name, value);
  }

 private:
  template <class Base, class Function>
  static constexpr bool is_of_observer(Function Base::*) {
    return std::is_base_of_v<Base, Observer>;
  }
  template <auto kMember, class One>
  void listen(std::vector<Observer*>& list, One& observer) {
    if constexpr (std::is_same_v<One, Observer> || !is_of_observer(kMember))
      list.push_back(&observer);
  }

  std::vector<Observer*> frame_start_, faint_, frame_cut_, sinr_, reception_, delivered_,
      request_end_, relay_lost_, relay_queued_, queue_, msdu_end_, association_, start_, body_,
      movable_, displaced_, cycle_, pose_, reading_, body_lost_, event_, action_, message_sent_,
      message_delivered_, fate_, message_end_, protocol_event_, discovery_, route_change_,
      air_entered_, air_left_, air_refused_, arrival_, scripted_, turn_, state_, record_;
};

}  // namespace sim::agents
