#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "hal/node/routing/node.h"

namespace hal::node::routing {

/// A message that this node is to forward.
struct Transit {
  Data data;
  std::optional<AgentId> came_from;  ///< The neighbour that gave it to us.
  bool owes_fate = false;            ///< It is this node's own, and its fate was not reported yet.
};

/// Told of the results of frames that the outbox gave to the link.
class OutboxListener {
 public:
  virtual ~OutboxListener() = default;
  /// A unicast frame to this neighbour was not acknowledged. Comes before on_sent.
  virtual void on_no_answer(AgentId neighbour) = 0;
  /// A message left, or did not.
  virtual void on_sent(Transit transit, Verdict verdict) = 0;
};

/// Frames at the link whose result is not known yet.
class Outbox {
 public:
  Outbox(Node& node, OutboxListener& listener) : node_(node), listener_(listener) {}

  /// How the link did with a packet.
  using Done = std::function<void(Verdict)>;

  /// Sends a control packet. @param done  called with its result; may be empty. A neighbour that
  /// did not answer is reported in any case.
  void send_control(AgentId next_hop, const Packet& packet, Done done = {}) {
    transmit(next_hop, packet, {.next_hop = next_hop, .transit = {}, .done = std::move(done)});
  }

  /// Counts the transmission in the message. @pre it has one left.
  void send_message(AgentId next_hop, Transit transit);

  void on_transmitted(const Transmission& transmission);

 private:
  struct Outgoing {
    AgentId next_hop;
    std::optional<Transit> transit;  ///< None: of the protocol's own.
    Done done;                       ///< Of such a packet; may be empty.
  };

  void transmit(AgentId next_hop, const Packet& packet, Outgoing outgoing);

  Node& node_;
  OutboxListener& listener_;
  LinkTag last_tag_ = 0;
  std::map<LinkTag, Outgoing> outgoing_;
};

}  // namespace hal::node::routing
