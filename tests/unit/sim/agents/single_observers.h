#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/agents/observer.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/mac_sap.h"

/// For each callback of an Observer one that overrides it alone, and notes its calls.
namespace tests {

using namespace sim;
using namespace sim::agents;
using hal::AgentId;
using hal::Time;

// What a callback was called with: numbers that differ where the arguments do, or where what they
// refer to is.

inline std::uint64_t trace(Time value) {
  return static_cast<std::uint64_t>((value - Time{}).count());
}
inline std::uint64_t trace(AgentId value) { return value.value; }
inline std::uint64_t trace(std::optional<AgentId> value) { return value ? value->value : ~0u; }
inline std::uint64_t trace(double value) { return std::bit_cast<std::uint64_t>(value); }
inline std::uint64_t trace(std::string_view value) { return value.size(); }
inline std::uint64_t trace(std::span<const double> value) { return value.size(); }
template <class T>
inline std::uint64_t trace(const T& value) {
  if constexpr (std::is_enum_v<T> || std::is_integral_v<T>)
    return static_cast<std::uint64_t>(value);
  else
    return std::bit_cast<std::uintptr_t>(&value);
}

using Call = std::vector<std::uint64_t>;

/// Arguments of its calls.
class Heard : public Observer {
 public:
  std::vector<Call> calls;

 protected:
  template <class... Arguments>
  void heard(const Arguments&... arguments) {
    calls.push_back({trace(arguments)...});
  }
};

// An observer of each callback alone.

struct OfFrameStart final : Heard {
  void on_frame_start(Time at, const radio::Frame& frame) override { heard(at, frame); }
};
struct OfFaint final : Heard {
  void on_faint(const radio::Frame& frame, std::uint32_t radios) override { heard(frame, radios); }
};
struct OfFrameCut final : Heard {
  void on_frame_cut(Time at, const radio::Frame& frame) override { heard(at, frame); }
};
struct OfSinr final : Heard {
  void on_sinr(double sinr_db) override { heard(sinr_db); }
};
struct OfReception final : Heard {
  void on_reception(Time at, const radio::Frame& frame, AgentId receiver, hal::Verdict verdict,
                    double rssi_dbm) override {
    heard(at, frame, receiver, verdict, rssi_dbm);
  }
};
struct OfDelivered final : Heard {
  void on_delivered(Time at, const radio::Frame& frame, AgentId receiver) override {
    heard(at, frame, receiver);
  }
};
struct OfRequestEnd final : Heard {
  void on_request_end(Time at, AgentId sender, AgentId destination, hal::Verdict verdict) override {
    heard(at, sender, destination, verdict);
  }
};
struct OfRelayLost final : Heard {
  void on_relay_lost(Time at, AgentId source, const radio::MacRequest& request,
                     hal::Verdict verdict) override {
    heard(at, source, request, verdict);
  }
};
struct OfRelayQueued final : Heard {
  void on_relay_queued(Time at, const radio::Msdu& msdu) override { heard(at, msdu); }
};
struct OfQueue final : Heard {
  void on_queue(Time at, const radio::QueueChange& change) override { heard(at, change); }
};
struct OfMsduEnd final : Heard {
  void on_msdu_end(Time at, const radio::Msdu& msdu, const radio::MsduEnd& end) override {
    heard(at, msdu, end);
  }
};
struct OfAssociation final : Heard {
  void on_association(Time at, AgentId station, std::optional<AgentId> access_point) override {
    heard(at, station, access_point);
  }
};
struct OfStart final : Heard {
  void on_start(const std::vector<std::pair<AgentId, AgentId>>& links) override { heard(links); }
};
struct OfBody final : Heard {
  void on_body(Time at, AgentId agent, const BodyState& body) override { heard(at, agent, body); }
};
struct OfMovable final : Heard {
  void on_movable(Time at, std::uint32_t number, const physics::BodyPose& pose) override {
    heard(at, number, pose);
  }
};
struct OfDisplaced final : Heard {
  void on_displaced(Time at, AgentId agent) override { heard(at, agent); }
};
struct OfBodyLost final : Heard {
  void on_body_lost(const physics::LostBody& lost) override { heard(lost); }
};
struct OfScripted final : Heard {
  void on_scripted(const ScriptedDone& done) override { heard(done); }
};
struct OfTurn final : Heard {
  void on_turn(const Turn& turn) override { heard(turn); }
};
struct OfAirEntered final : Heard {
  void on_air_entered(Time at, AgentId agent, const radio::MacRequest& request) override {
    heard(at, agent, request);
  }
};
struct OfAirLeft final : Heard {
  void on_air_left(Time at, AgentId agent, const radio::MacIndication& indication) override {
    heard(at, agent, indication);
  }
};
struct OfAirRefused final : Heard {
  void on_air_refused(Time at, AgentId agent, air::Refusal refusal, std::size_t bytes) override {
    heard(at, agent, refusal, bytes);
  }
};
struct OfArrival final : Heard {
  void on_arrival(const OutsideArrival& arrival) override { heard(arrival); }
};
struct OfCycle final : Heard {
  void on_cycle(Time at, AgentId agent) override { heard(at, agent); }
};
struct OfPose final : Heard {
  void on_pose(Time at, AgentId agent, const hal::Pose2& pose) override { heard(at, agent, pose); }
};
/// Readings come to those only that ask for them.
struct OfReading final : Heard {
  bool observes_readings() const override { return true; }
  bool observes(AgentId /*agent*/, const hal::Channel& /*channel*/) const override { return true; }
  void on_reading(Time at, AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override {
    heard(at, agent, channel, values);
  }
};
struct OfEvent final : Heard {
  void on_event(const hal::node::exchange::Event& event) override { heard(event); }
};
struct OfAction final : Heard {
  void on_action(Time at, const hal::node::exchange::Action& action) override { heard(at, action); }
};
struct OfMessageSent final : Heard {
  void on_message_sent(Time at, const hal::Message& message) override { heard(at, message); }
};
struct OfMessageDelivered final : Heard {
  void on_message_delivered(Time at, AgentId receiver, const hal::Message& message,
                            int transmissions) override {
    heard(at, receiver, message, transmissions);
  }
};
struct OfFate final : Heard {
  void on_fate(Time at, AgentId sender, hal::MessageId id, hal::Fate fate) override {
    heard(at, sender, id, fate);
  }
};
struct OfMessageEnd final : Heard {
  void on_message_end(Time at, AgentId at_node, AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override {
    heard(at, at_node, sender, id, verdict);
  }
};
struct OfDiscovery final : Heard {
  void on_discovery(Time at, AgentId agent, const Discovery& discovery) override {
    heard(at, agent, discovery);
  }
};
struct OfProtocolEvent final : Heard {
  void on_protocol_event(AgentId agent, hal::node::routing::ProtocolEvent event) override {
    heard(agent, event);
  }
};
struct OfRouteChange final : Heard {
  void on_route_change(Time at, AgentId agent, const hal::RouteChange& change) override {
    heard(at, agent, change);
  }
};
struct OfState final : Heard {
  void on_state(Time at, AgentId agent, std::string_view state) override {
    heard(at, agent, state);
  }
};
struct OfRecord final : Heard {
  void on_record(Time at, AgentId agent, std::string_view name, double value) override {
    heard(at, agent, name, value);
  }
};

}  // namespace tests
