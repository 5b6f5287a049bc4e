#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "hal/routing/node.h"

namespace hal::routing {

/// A message at this node on its way.
struct Transit {
  Data data;
  std::optional<AgentId> came_from;  ///< The neighbour that gave it to us.
  bool owes_fate = false;            ///< We sent it, and its sender has not been told its fate.
};

/// Who hears how the link did with what the outbox gave it.
class OutboxListener {
 public:
  virtual ~OutboxListener() = default;
  /// A unicast frame to this neighbour was not acknowledged. Comes before on_sent.
  virtual void on_no_answer(AgentId neighbour) = 0;
  /// A message left, or did not.
  virtual void on_sent(Transit transit, Verdict verdict) = 0;
};

/// Frames that the link has and has not yet reported on.
class Outbox {
 public:
  Outbox(Node& node, OutboxListener& listener) : node_(node), listener_(listener) {}

  /// How the link did with a packet.
  using Done = std::function<void(Verdict)>;

  /// A packet of the protocol's own. @param done  empty: nobody asks how the link did with it, only
  /// the neighbour that did not answer is told of.
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

}  // namespace hal::routing
