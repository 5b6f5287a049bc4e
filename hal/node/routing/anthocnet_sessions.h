#pragma once

#include <map>

#include "hal/node/routing/anthocnet_ants.h"

namespace hal::node::routing::anthocnet {

/// Proactive path maintenance ([PPSN], 3.3; [ETT], 3.4): during a session its source sends a
/// proactive ant every proactive_period if virtual pheromone is at least proactive_margin times the
/// best regular one.
class Sessions {
 public:
  Sessions(AntNode ants, Ants& traffic) : ants_(ants), traffic_(traffic) {}

  /// This node sends a message to the target.
  void on_message(const Target& target);

 private:
  void wait(const Target& target);
  void on_period(const Target& target);
  bool is_promising(const Target& target) const;

  AntNode ants_;
  Ants& traffic_;
  std::map<Target, Time> last_message_;  ///< Only for running sessions.
};

}  // namespace hal::node::routing::anthocnet
