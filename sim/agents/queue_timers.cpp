#include "sim/agents/queue_timers.h"

#include <utility>

namespace sim::agents {
namespace {

constexpr int kGenerationShift = 32;

}  // namespace

hal::node::routing::Timers::Handle QueueTimers::schedule(hal::Time at,
                                                         std::function<void()> handler) {
  const EventQueue::EventId id =
      events_.schedule(at, Rank::kNodeTimer, owner_, [handler = std::move(handler)] { handler(); });
  return (static_cast<Handle>(id.generation) << kGenerationShift) | id.slot;
}

void QueueTimers::cancel(Handle handle) {
  EventQueue::EventId id{static_cast<std::uint32_t>(handle),
                         static_cast<std::uint32_t>(handle >> kGenerationShift)};
  events_.cancel(id);
}

}  // namespace sim::agents
