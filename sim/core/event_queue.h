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

namespace sim {

using hal::AgentId;
using hal::Duration;
using hal::Time;

/// What happens first among events of one time.
enum class Rank : std::uint8_t { kScenario, kPhysics, kRadio, kNodeTimer, kControl, kAction };

/// Owner of events that belong to no agent (physics, scenario). Sorts before all agents.
inline constexpr AgentId kWorld{0};

/// Future events, run in order of (time, rank, agent, that agent's counter): never of insertion
/// across agents, so results do not depend on how code happens to schedule. Agents' addresses start
/// at 1. A handler may schedule and cancel anything at or after now(). One thread.
///
///   const auto id = queue.schedule(now + 10us, Rank::kRadio, self, [this] { send_cts(); });
///   queue.cancel(id);
class EventQueue {
 public:
  /// Names one scheduled event. Default: names none.
  struct EventId {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  ///< 0: no event.
    bool operator==(const EventId&) const = default;
  };

  EventQueue() = default;
  ~EventQueue();
  EventQueue(const EventQueue&) = delete;
  EventQueue& operator=(const EventQueue&) = delete;

  Time now() const { return now_; }

  /// @param handler  callable, at most kHandlerSize bytes: capture pointers and small values.
  /// @pre at >= now().
  template <class F>
  EventId schedule(Time at, Rank rank, AgentId agent, F&& handler);

  /// @return false if the event has run, was cancelled, or `id` names none. Clears `id`.
  bool cancel(EventId& id);

  /// Whether the event is still to come.
  bool is_pending(EventId id) const;

  /// Time of the next event; none if the queue is empty.
  std::optional<Time> next_time();

  /// Runs the next event. @pre there is one.
  void run_next();

  /// Sets now() without running anything. @pre no event is pending before `at`.
  void advance_to(Time at);

  std::uint64_t executed() const { return executed_; }
  std::size_t pending() const { return live_; }

 private:
  static constexpr std::size_t kHandlerSize = 48;

  struct Slot {
    alignas(std::max_align_t) std::byte storage[kHandlerSize];
    void (*run)(void*) = nullptr;  ///< Null: free or cancelled.
    void (*destroy)(void*) = nullptr;
    std::uint32_t generation = 1;
  };
  struct Entry {
    std::int64_t time;
    std::uint64_t order;  ///< rank, agent, counter from high bits to low.
    std::uint32_t slot;
    bool before(const Entry& other) const {
      return time != other.time ? time < other.time : order < other.order;
    }
  };

  Slot& claim(Time at, Rank rank, AgentId agent, EventId& id);
  void release(Slot& slot, std::uint32_t index);
  void push(Entry entry);
  void pop();
  void drop_cancelled();

  std::vector<Entry> heap_;  ///< 4-ary, smallest first.
  std::vector<Slot*> slots_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint64_t> counters_;  ///< Per agent.
  Time now_{};
  std::uint64_t executed_ = 0;
  std::size_t live_ = 0;
};

template <class F>
EventQueue::EventId EventQueue::schedule(Time at, Rank rank, AgentId agent, F&& handler) {
  using Handler = std::decay_t<F>;
  static_assert(sizeof(Handler) <= kHandlerSize && alignof(Handler) <= alignof(std::max_align_t));
  EventId id;
  Slot& slot = claim(at, rank, agent, id);
  ::new (static_cast<void*>(slot.storage)) Handler(std::forward<F>(handler));
  slot.run = [](void* h) { (*static_cast<Handler*>(h))(); };
  slot.destroy = [](void* h) { static_cast<Handler*>(h)->~Handler(); };
  return id;
}

}  // namespace sim
