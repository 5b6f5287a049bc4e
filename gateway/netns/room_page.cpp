#include "gateway/netns/room_page.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>
#include <ctime>

namespace gateway::netns {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kPatience = kSecond / 5;  ///< With a sender that does not finish.

std::int64_t monotonic() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

}  // namespace

bool RoomPage::publish(std::uint64_t sent, std::uint32_t room, std::uint32_t capacity) {
  capacity_.store(capacity, std::memory_order_relaxed);
  const std::uint64_t limit = sent + room;
  // One that was given up has finished after all: it goes on counting as reserved, too.
  const std::uint64_t reserved = reserved_.load(std::memory_order_acquire);
  if (sent > reserved) reserved_.fetch_add(sent - reserved, std::memory_order_acq_rel);
  const bool has_changed = limit_.exchange(limit) != limit;
  if (has_changed) {
    change_.fetch_add(1);
    if (waiting_.load() != 0) {
      syscall(SYS_futex, &change_, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
    }
  }
  return reserved > sent && !gives_up(sent);
}

/// Whether those in between were given up: they count as sent.
bool RoomPage::gives_up(std::uint64_t sent) {
  const std::uint64_t reserved = reserved_.load(std::memory_order_acquire);
  const std::int64_t now = monotonic();
  if (reserved != seen_reserved_ || sent != seen_sent_) {
    seen_reserved_ = reserved;
    seen_sent_ = sent;
    unmoved_since_ = now;
    return false;
  }
  if (now - unmoved_since_ < kPatience) return false;
  // Only if nobody has moved meanwhile; and the next publish() counts them.
  sent_.compare_exchange_strong(sent, reserved, std::memory_order_acq_rel);
  return false;
}

}  // namespace gateway::netns
