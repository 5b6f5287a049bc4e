#pragma once

#include <map>
#include <vector>

#include "hal/node/routing/anthocnet_node.h"

namespace hal::node::routing::anthocnet {

/// The messages that wait at this node for a path, by target.
class Backlog {
 public:
  explicit Backlog(Node& node) : node_(node) {}

  /// Keeps a message until release(), for buffer_age at most (then kExpired). @return false:
  /// buffer_limit wait already, the message has ended (kQueueFull).
  bool keep(Transit transit);

  /// Takes out all of a target's, in order of arrival.
  std::vector<Transit> release(const Target& target);

  /// Ends all of a target's.
  void abandon(const Target& target, Verdict verdict);

 private:
  struct Waiting {
    Transit transit;
    OwnTimers::Handle expiry = 0;
  };

  void on_expiry(const Target& target, std::uint64_t place);

  Node& node_;
  std::uint64_t last_place_ = 0;
  std::map<Target, std::map<std::uint64_t, Waiting>> waiting_;  ///< By place in the queue.
};

}  // namespace hal::node::routing::anthocnet
