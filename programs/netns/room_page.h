#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace programs::netns {

/// The environment variable that tells an agent's programs the file of their page.
inline constexpr const char* kRoomVariable = "BARAKA_ROOM";

/// Back-pressure of one agent's interface: a page of memory that the run shares with the programs
/// of that agent. A TAP accepts every frame at once, so the preloaded library asks here for room
/// before it sends a program's datagram, and waits as the full queue of a driver would make it
/// wait.
///
/// A *place* is one frame in the queue of the agent's station; a datagram needs as many as it has
/// IP fragments. Places are counted from the beginning of the run, so no counter is ever reset:
///
///   sender  reserve(n)  until reserved + n <= limit     (else waits, or EAGAIN)
///           the system call; then finish(n), or give_back(n) if it failed
///
/// A sender that needs several places at once could wait for ever if others need only one each and
/// take every place that becomes free. Therefore one such sender at a time, the collector, keeps
/// the places that it gets:
///
///   collector  start_collecting(); collect(m) until it has all n; end_collecting()
///
///   run     S = sent(); drains the TAP until EAGAIN; publish(S, free places of the queue)
///
/// Everything that was sent before S was read has been drained, and is in the queue or was dropped;
/// every reservation beyond S still needs a place of its own. So senders with the preloaded library
/// never overfill the queue. Other frames (ARP, TCP, IGMP) take places without asking.
///
/// The run publishes after it has drained the TAP, after a request of the agent has ended, and
/// again within a millisecond of wall time as long as publish() returns true: a sender may be
/// between its system call and finish().
///
/// The page is in shared memory and all zero at first, so that nobody has room until the run
/// publishes. Any thread of any process; publish() only by the run's thread.
class RoomPage {
 public:
  /// @name For the run
  /// @{

  /// Places whose frames are in the TAP, or were read from it. Read before the TAP is drained.
  std::uint64_t sent() const { return sent_.load(std::memory_order_acquire); }

  /// Whether a sender has reserved places and not finished: then publish() again soon.
  /// @param sent  what sent() was before the TAP was drained.
  bool is_between(std::uint64_t sent) const {
    return reserved_.load(std::memory_order_acquire) > sent;
  }

  /// Announces free places to the senders, and wakes those that wait.
  /// @param sent  what sent() was before the TAP was drained.
  /// @param room  free places of the station's queue [frames].
  /// @param capacity  places of the empty queue, at least 1. A datagram with more fragments is sent
  /// when all of them are free, and loses the fragments that do not fit.
  /// @return whether a sender is between its reservation and finish(): then publish again within a
  /// millisecond (calling sent() and draining anew), even if nothing happens. A sender that was
  /// killed there is given up after 200 ms; a collector only if it has not called still_collects()
  /// in that time.
  bool publish(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity);
  /// The same in lock-step, where a sender may stand still for any time and nobody is given up.
  void publish_held(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity) {
    announce(sent, room, capacity);
  }

  /// Number of programs that have loaded the library since the run began.
  std::uint32_t loaded() const { return loaded_.load(std::memory_order_relaxed); }
  /// @}

  /// @name For the preloaded library
  /// @{

  /// Places that a datagram with this number of fragments needs.
  std::uint32_t places_for(std::uint32_t fragments) const {
    const std::uint32_t capacity = capacity_.load(std::memory_order_relaxed);
    return capacity != 0 && fragments > capacity ? capacity : fragments;
  }
  bool has_room(std::uint32_t places) const {
    return reserved_.load(std::memory_order_relaxed) + places <= limit_.load();
  }
  /// @return whether there was room. @param places  a result of places_for().
  bool reserve(std::uint32_t places) {
    std::uint64_t reserved = reserved_.load(std::memory_order_relaxed);
    while (reserved + places <= limit_.load(std::memory_order_acquire)) {
      if (reserved_.compare_exchange_weak(reserved, reserved + places, std::memory_order_acq_rel)) {
        return true;
      }
    }
    return false;
  }

  /// @return the number of this collector; 0: there is another one already.
  std::uint32_t start_collecting();
  /// Whether the collector has not been given up. The places of one that was given up count as
  /// sent.
  bool is_collecting(std::uint32_t collector) const { return collector_.load() == collector; }
  /// Takes free places. @return their number, up to `most`. @pre is_collecting()
  std::uint32_t collect(std::uint32_t most);
  /// Call at least every 100 ms while the collector waits.
  void still_collects() { beats_.fetch_add(1, std::memory_order_relaxed); }
  /// Its places are then like those of reserve().
  void end_collecting(std::uint32_t collector);

  /// Call when the frames are in the TAP.
  void finish(std::uint32_t places) { sent_.fetch_add(places, std::memory_order_release); }
  /// Call if the frames will never be in the TAP. Then wake up those that wait: change().
  void give_back(std::uint32_t places) { reserved_.fetch_sub(places, std::memory_order_acq_rel); }

  /// A futex; it changes whenever there may be new room.
  std::atomic<std::uint32_t>& change() { return change_; }
  /// Number of threads that wait for the futex.
  std::atomic<std::uint32_t>& waiting() { return waiting_; }
  void count_load() { loaded_.fetch_add(1, std::memory_order_relaxed); }

  /// The agent's interface; set before any program starts.
  struct Interface {
    std::uint32_t address = 0;                    ///< IPv4, host byte order.
    std::uint32_t mtu = 0;                        ///< Maximum IP packet [byte].
    std::array<std::uint8_t, 16> link_local{};    ///< IPv6.
    std::array<std::uint8_t, 16> unique_local{};  ///< IPv6.
  };
  const Interface& interface() const { return interface_; }
  void set_interface(const Interface& interface) { interface_ = interface; }
  /// @}

 private:
  /// @return reserved places before.
  std::uint64_t announce(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity);
  void give_up_the_dead(std::uint64_t sent);

  std::atomic<std::uint64_t> reserved_ = 0, sent_ = 0, limit_ = 0;
  /// Places that the collector holds; its number, 0: none; the number of collectors so far; counter
  /// of its signs of life.
  std::atomic<std::uint32_t> collected_ = 0, collector_ = 0, collectors_ = 0, beats_ = 0;
  std::atomic<std::uint32_t> capacity_ = 0, change_ = 0, waiting_ = 0, loaded_ = 0;
  Interface interface_;
  // For publish(): the state when something last changed.
  std::uint64_t seen_reserved_ = 0, seen_sent_ = 0;
  std::uint32_t seen_beats_ = 0;
  std::int64_t unmoved_since_ = 0;  ///< CLOCK_MONOTONIC, ns.
};

inline std::uint32_t RoomPage::start_collecting() {
  std::uint32_t nobody = 0;
  std::uint32_t collector = collectors_.fetch_add(1) + 1;
  if (collector == 0) collector = collectors_.fetch_add(1) + 1;
  return collector_.compare_exchange_strong(nobody, collector) ? collector : 0;
}

inline std::uint32_t RoomPage::collect(std::uint32_t most) {
  std::uint64_t reserved = reserved_.load(std::memory_order_relaxed);
  for (;;) {
    const std::uint64_t limit = limit_.load(std::memory_order_acquire);
    if (reserved >= limit) return 0;
    const auto taken = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, limit - reserved));
    if (reserved_.compare_exchange_weak(reserved, reserved + taken, std::memory_order_acq_rel)) {
      collected_.fetch_add(taken);
      return taken;
    }
  }
}

inline void RoomPage::end_collecting(std::uint32_t collector) {
  if (!is_collecting(collector)) return;
  collected_.store(0);
  collector_.compare_exchange_strong(collector, 0);
}

static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "shared between processes");

}  // namespace programs::netns
