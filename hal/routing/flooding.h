#pragma once

#include "hal/routing/memory.h"
#include "hal/routing/outbox.h"

namespace hal::routing {

/// Takes a message through the whole network: its source broadcasts it at once, every other node
/// once more after a jitter. One to the neighbours is not repeated; one to a single node is
/// delivered there, and not repeated by it.
class Flooding {
 public:
  Flooding(Node& node, Outbox& outbox) : node_(node), outbox_(outbox) {}

  void send(const Message& message);
  void on_data(Data data);

  /// How the link did with a message.
  void on_sent(const Transit& transit, Verdict verdict);

 private:
  void relay(const Data& data);

  Node& node_;
  Outbox& outbox_;
  Memory<std::pair<AgentId, Sequence>, Seen> seen_;
};

}  // namespace hal::routing
