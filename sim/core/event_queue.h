#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/event_slots.h"
#include "sim/core/future_events.h"

namespace sim {

using hal::AgentId;
using hal::Duration;
using hal::Time;

/// Order of events of one time: lower ranks run first.
enum class Rank : std::uint8_t {
  kScenario,
  kPhysics,
  kRadio,
  kNodeTimer,
  kControl,
  kAction,
  kProgram,  ///< Unmodified programs in lock-step.
};

/// Owner of events that belong to no agent (physics, scenario). Sorts before all agents.
inline constexpr AgentId kWorld{0};

/// Future events, run in the order (time, rank, agent, that agent's counter). The order of
/// insertion across agents has no influence, so results do not depend on the order in which code
/// schedules. Agents' addresses start at 1. A handler may schedule and cancel anything at or after
/// now(). One thread.
///
///   const auto id = queue.schedule(now + 10us, Rank::kRadio, self, [this] { send_cts(); });
///   queue.cancel(id);
class EventQueue {
 public:
  /// Identifies one scheduled event. A default-constructed one identifies none.
  struct EventId {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  ///< 0: no event.
    bool operator==(const EventId&) const = default;
  };

  EventQueue() = default;
  EventQueue(const EventQueue&) = delete;
  EventQueue& operator=(const EventQueue&) = delete;

  Time now() const { return now_; }

  /// @param handler  callable, at most EventSlot::kHandlerSize bytes: capture pointers and small
  /// values.
  /// @pre at >= now().
  template <class F>
  EventId schedule(Time at, Rank rank, AgentId agent, F&& handler);

  /// Position in the order of events of one time, reserved for an event that is scheduled later.
  struct Place {
    std::uint64_t order = 0;
    bool operator==(const Place&) const = default;
  };

  /// Reserves the place that an event scheduled now would get.
  Place reserve(Rank rank, AgentId agent);

  /// Schedules an event in a reserved place. @param place  from reserve() of this queue; each
  /// serves for one event.
  template <class F>
  EventId schedule(Time at, Place place, F&& handler);

  /// For a handler that processes a series of events: makes (at, place) the running event, as if it
  /// had been scheduled, provided that no other event precedes it and that run_next() lets handlers
  /// continue that far. @return false if not: schedule the event instead.
  bool go_on(Time at, Place place);

  /// @return false if the event has run, was cancelled, or `id` names none. Clears `id`.
  bool cancel(EventId& id) { return id.generation != 0 && cancel_known(id); }

  /// Whether the event has neither run nor been cancelled.
  bool is_pending(EventId id) const;

  /// Time of the next event; none if the queue is empty.
  std::optional<Time> next_time();

  /// Runs the next event, and the rest of its series (go_on()) up to and including `last`.
  /// @pre there is one.
  void run_next(Time last = Time::min());

  /// Sets now() without running anything. @pre no event is pending before `at`.
  void advance_to(Time at);

  std::uint64_t executed() const { return executed_; }
  std::size_t pending() const { return events_.size(); }

 private:
  // From the highest bits of a place to the lowest: rank, agent, counter.
  static constexpr int kCounterBits = 40;
  static constexpr int kAgentBits = 16;

  EventSlot& claim(Time at, Place place, bool must_destroy, EventId& id);
  void add_counters(AgentId agent);
  bool cancel_known(EventId& id);

  EventSlots slots_;
  FutureEvents events_{slots_};
  std::vector<std::uint64_t> counters_;  ///< Counters of the agents.
  Time now_{};
  Time last_ = Time::min();  ///< Up to this time, the running handler may go on.
  std::uint64_t executed_ = 0;
};

inline EventQueue::Place EventQueue::reserve(Rank rank, AgentId agent) {
  if (agent.value >= counters_.size()) [[unlikely]]
    add_counters(agent);
  const std::uint64_t counter = counters_[agent.value]++;
  return {(static_cast<std::uint64_t>(rank) << (kAgentBits + kCounterBits)) |
          (static_cast<std::uint64_t>(agent.value) << kCounterBits) | counter};
}

template <class F>
EventQueue::EventId EventQueue::schedule(Time at, Rank rank, AgentId agent, F&& handler) {
  return schedule(at, reserve(rank, agent), std::forward<F>(handler));
}

template <class F>
EventQueue::EventId EventQueue::schedule(Time at, Place place, F&& handler) {
  using Handler = std::decay_t<F>;
  static_assert(sizeof(Handler) <= EventSlot::kHandlerSize && alignof(Handler) <= alignof(void*));
  EventId id;
  EventSlot& slot = claim(at, place, !std::is_trivially_destructible_v<Handler>, id);
  ::new (static_cast<void*>(slot.storage)) Handler(std::forward<F>(handler));
  slot.act = [](void* h, EventSlot::Act act) {
    auto& stored = *static_cast<Handler*>(h);
    if (act == EventSlot::Act::kRunAndDestroy) stored();
    stored.~Handler();
  };
  return id;
}

}  // namespace sim
