#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "hal/node/routing/node.h"

namespace hal::node::routing {

/// A message that this node has to forward.
struct Transit {
  Data data;
  std::optional<AgentId> came_from;  ///< The neighbour from which it was received.
  /// It originates at this node, and its fate was not reported yet.
  bool owes_fate = false;
};

/// Receives the results of frames that the outbox passed to the link.
class OutboxListener {
 public:
  virtual ~OutboxListener() = default;
  /// A unicast frame to this neighbour was not acknowledged. Called before on_sent.
  virtual void on_no_answer(AgentId neighbour) = 0;
  /// A message was transmitted, or was not.
  virtual void on_sent(Transit transit, Verdict verdict) = 0;
};

/// Frames passed to the link whose result is not known yet.
class Outbox {
 public:
  Outbox(Node& node, OutboxListener& listener) : node_(node), listener_(listener) {}

  /// Receives the link's result of a packet.
  using Done = std::function<void(Verdict)>;

  /// Sends a control packet. @param done  called with its result; may be empty. A missing
  /// acknowledgement is reported to the listener in any case.
  void send_control(AgentId next_hop, const Packet& packet, Done done = {}) {
    transmit(next_hop, packet, {.next_hop = next_hop, .transit = {}, .done = std::move(done)});
  }

  /// Increments the message's number of transmissions. @pre it is below its limit.
  void send_message(AgentId next_hop, Transit transit);

  void on_transmitted(const Transmission& transmission);

 private:
  struct Outgoing {
    AgentId next_hop;
    std::optional<Transit> transit;  ///< nullopt: a control packet.
    Done done;                       ///< For a control packet; may be empty.
  };

  void transmit(AgentId next_hop, const Packet& packet, Outgoing outgoing);

  Node& node_;
  OutboxListener& listener_;
  LinkTag last_tag_ = 0;
  std::map<LinkTag, Outgoing> outgoing_;
};

}  // namespace hal::node::routing
