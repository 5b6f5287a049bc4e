#pragma once

#include <map>
#include <vector>

#include "hal/node/routing/anthocnet_node.h"

namespace hal::node::routing::anthocnet {

/// Messages that wait at this node for a path, by target.
class Backlog {
 public:
  explicit Backlog(Node& node) : node_(node) {}

  /// Keeps a message until release(), at most for buffer_age; it then ends with kExpired. @return
  /// false: buffer_limit messages wait already and this one has ended with kQueueFull.
  bool keep(Transit transit);

  /// Removes and returns all messages of a target, in order of arrival.
  std::vector<Transit> release(const Target& target);

  /// Ends all messages of a target.
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
