#pragma once

#include "hal/node/routing/ports.h"
#include "sim/core/event_queue.h"

namespace sim::agents {

/// A node's timers, on the event queue.
class QueueTimers final : public hal::node::routing::Timers {
 public:
  /// @param owner  address of the node, by which its events are ordered.
  QueueTimers(EventQueue& events, hal::AgentId owner) : events_(events), owner_(owner) {}

  hal::Time now() const override { return events_.now(); }
  Handle schedule(hal::Time at, std::function<void()> handler) override;
  void cancel(Handle handle) override;

 private:
  EventQueue& events_;
  hal::AgentId owner_;
};

}  // namespace sim::agents
