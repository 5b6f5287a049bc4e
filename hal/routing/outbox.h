#pragma once

#include <map>
#include <optional>

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

  /// A packet of the protocol's own. Nobody is told how the link did with it, except that the
  /// neighbour did not answer.
  void send_control(AgentId next_hop, const Packet& packet) {
    transmit(next_hop, packet, std::nullopt);
  }

  /// Counts the transmission in the message. @pre it has one left.
  void send_message(AgentId next_hop, Transit transit);

  void on_transmitted(const Transmission& transmission);

 private:
  struct Outgoing {
    AgentId next_hop;
    std::optional<Transit> transit;  ///< None: of the protocol's own; nobody misses it.
  };

  void transmit(AgentId next_hop, const Packet& packet, std::optional<Transit> transit);

  Node& node_;
  OutboxListener& listener_;
  LinkTag last_tag_ = 0;
  std::map<LinkTag, Outgoing> outgoing_;
};

}  // namespace hal::routing
