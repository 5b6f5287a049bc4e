#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace programs::netns {

/// Where an agent's programs find their page, a file: the variable of their environment.
inline constexpr const char* kRoomVariable = "BARAKA_ROOM";

/// Back-pressure of one agent's interface: a page that the run shares with the programs of that
/// agent. A TAP takes every frame at once, so the preloaded library asks here for room before a
/// program's datagram goes out, and waits, as the full queue of a driver would make it wait.
///
/// A *place* is one frame in the queue of the agent's station; a datagram takes as many as it has
/// IP fragments. Places are counted from the beginning of the run, so nothing is ever reset:
///
///   sender  reserve(n)  until reserved + n <= limit     (else waits, or EAGAIN)
///           the system call; then finish(n), or give_back(n) if it failed
///
/// One that waits for several places at once would wait for ever beside those that need one each:
/// they take whatever gets free. So one of them at a time, the collector, keeps what it gets:
///
///   collector  start_collecting(); collect(m) until it has all n; end_collecting()
///
///   run     S = sent(); drains the TAP until EAGAIN; publish(S, free places of the queue)
///
/// What had been sent before S was read has been drained, and is in the queue or gone; whatever is
/// reserved beyond it still needs a place of its own. So preloaded senders never overfill the
/// queue. Other frames (ARP, TCP, IGMP) take their places without asking.
///
/// The run publishes whenever it has drained the TAP, whenever a request of the agent ends, and
/// again within a millisecond of wall time as long as publish() tells it so: a sender may be
/// between its system call and finish().
///
/// Lives in shared memory, all zero at first: then nobody has room until the run publishes. Any
/// thread of any process; publish() by the run's thread alone.
class RoomPage {
 public:
  /// @name Of the run
  /// @{

  /// Places whose frames are in the TAP, or were read from it. Read before the TAP is drained.
  std::uint64_t sent() const { return sent_.load(std::memory_order_acquire); }

  /// Whether somebody has reserved places and not finished: publish() again soon.
  /// @param sent  what sent() was before the TAP was drained.
  bool is_between(std::uint64_t sent) const {
    return reserved_.load(std::memory_order_acquire) > sent;
  }

  /// Tells the senders that there is room, and wakes those that wait.
  /// @param sent  what sent() was before the TAP was drained.
  /// @param room  free places of the station's queue, frames.
  /// @param capacity  places of the queue when it is empty, at least 1. A datagram of more
  ///   fragments is let in when all of them are free, and loses what does not fit.
  /// @return whether somebody is in between: publish again within a millisecond (sent() and
  ///   draining anew), even if nothing happens. A sender that was killed there is given up after
  ///   200 ms, a collector only if it has not said still_collects() meanwhile.
  bool publish(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity);

  /// Programs that have loaded the library since the run began.
  std::uint32_t loaded() const { return loaded_.load(std::memory_order_relaxed); }
  /// @}

  /// @name Of the preloaded library
  /// @{

  /// What a datagram of so many fragments needs.
  std::uint32_t places_for(std::uint32_t fragments) const {
    const std::uint32_t capacity = capacity_.load(std::memory_order_relaxed);
    return capacity != 0 && fragments > capacity ? capacity : fragments;
  }
  bool has_room(std::uint32_t places) const {
    return reserved_.load(std::memory_order_relaxed) + places <= limit_.load();
  }
  /// @return whether there was room. @param places  of places_for().
  bool reserve(std::uint32_t places) {
    std::uint64_t reserved = reserved_.load(std::memory_order_relaxed);
    while (reserved + places <= limit_.load(std::memory_order_acquire)) {
      if (reserved_.compare_exchange_weak(reserved, reserved + places, std::memory_order_acq_rel)) {
        return true;
      }
    }
    return false;
  }

  /// @return what tells this collector from others; 0: there is one already.
  std::uint32_t start_collecting();
  /// Whether it is not given up. If it is, its places count as sent.
  bool is_collecting(std::uint32_t collector) const { return collector_.load() == collector; }
  /// Takes free places. @return how many, up to `most`. @pre is_collecting()
  std::uint32_t collect(std::uint32_t most);
  /// At least every 100 ms while it waits.
  void still_collects() { beats_.fetch_add(1, std::memory_order_relaxed); }
  /// Its places are then like those of reserve().
  void end_collecting(std::uint32_t collector);

  /// The frames are in the TAP.
  void finish(std::uint32_t places) { sent_.fetch_add(places, std::memory_order_release); }
  /// They never will be. Whoever waits is to be woken: change().
  void give_back(std::uint32_t places) { reserved_.fetch_sub(places, std::memory_order_acq_rel); }

  /// A futex: changes whenever there may be room that was not.
  std::atomic<std::uint32_t>& change() { return change_; }
  /// How many wait for it.
  std::atomic<std::uint32_t>& waiting() { return waiting_; }
  void count_load() { loaded_.fetch_add(1, std::memory_order_relaxed); }

  /// What the interface is: set before any program starts.
  struct Interface {
    std::uint32_t address = 0;                    ///< IPv4, host order.
    std::uint32_t mtu = 0;                        ///< Bytes of IP.
    std::array<std::uint8_t, 16> link_local{};    ///< IPv6.
    std::array<std::uint8_t, 16> unique_local{};  ///< IPv6.
  };
  const Interface& interface() const { return interface_; }
  void set_interface(const Interface& interface) { interface_ = interface; }
  /// @}

 private:
  void give_up_the_dead(std::uint64_t sent);

  std::atomic<std::uint64_t> reserved_ = 0, sent_ = 0, limit_ = 0;
  /// Places of the collector; which it is, 0: none; how many there were; signs of its life.
  std::atomic<std::uint32_t> collected_ = 0, collector_ = 0, collectors_ = 0, beats_ = 0;
  std::atomic<std::uint32_t> capacity_ = 0, change_ = 0, waiting_ = 0, loaded_ = 0;
  Interface interface_;
  // Of publish(): since when nothing has moved.
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
