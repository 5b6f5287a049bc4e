#include "programs/netns/room_page.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <ctime>

namespace programs::netns {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kPatience = kSecond / 5;  ///< Maximum time for a sender to finish.

std::int64_t monotonic() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

}  // namespace

std::uint64_t RoomPage::announce(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity) {
  capacity_.store(capacity, std::memory_order_relaxed);
  const std::uint64_t limit = sent + room;
  // A sender that was given up has finished after all: count its places as reserved, too.
  const std::uint64_t reserved = reserved_.load(std::memory_order_acquire);
  if (sent > reserved) reserved_.fetch_add(sent - reserved, std::memory_order_acq_rel);
  const bool has_changed = limit_.exchange(limit) != limit;
  if (has_changed) {
    change_.fetch_add(1);
    if (waiting_.load() != 0) {
      syscall(SYS_futex, &change_, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
    }
  }
  return reserved;
}

bool RoomPage::publish(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity) {
  if (announce(sent, room, capacity) <= sent) return false;
  give_up_the_dead(sent);
  return true;
}

/// Counts the places of senders that have not moved for long as sent; the next publish() announces
/// them.
void RoomPage::give_up_the_dead(std::uint64_t sent) {
  const std::uint64_t reserved = reserved_.load(std::memory_order_acquire);
  const std::uint32_t beats = beats_.load(std::memory_order_relaxed);
  const std::int64_t now = monotonic();
  if (reserved != seen_reserved_ || sent != seen_sent_) {
    seen_reserved_ = reserved;
    seen_sent_ = sent;
    seen_beats_ = beats;
    unmoved_since_ = now;
    return;
  }
  if (now - unmoved_since_ < kPatience) return;
  const bool is_collector_alive = beats != seen_beats_ && collector_.load() != 0;
  seen_beats_ = beats;
  unmoved_since_ = now;
  const std::uint64_t kept =
      is_collector_alive ? std::min<std::uint64_t>(collected_.load(), reserved - sent) : 0;
  // Only if nobody has moved meanwhile.
  if (!sent_.compare_exchange_strong(sent, reserved - kept, std::memory_order_acq_rel)) return;
  if (is_collector_alive) return;
  collected_.store(0);
  collector_.store(0);
}

}  // namespace programs::netns
