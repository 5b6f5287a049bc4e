#pragma once

#include "hal/node/routing/memory.h"
#include "hal/node/routing/outbox.h"

namespace hal::node::routing {

/// Floods a message: its source broadcasts it at once, and every other node once after a jitter. A
/// message to the neighbours is not forwarded; one to a single node is delivered there and not
/// forwarded by that node.
class Flooding {
 public:
  Flooding(Node& node, Outbox& outbox) : node_(node), outbox_(outbox) {}

  void send(const Message& message);
  void on_data(Data data);

  /// Result of a message at the link.
  void on_sent(const Transit& transit, Verdict verdict);

 private:
  void relay(const Data& data);

  Node& node_;
  Outbox& outbox_;
  Memory<std::pair<AgentId, Sequence>, Seen> seen_;
};

}  // namespace hal::node::routing
