#include "sim/radio/mac/backoff.h"

#include <algorithm>

namespace sim::radio {

Backoff::Backoff(EventQueue& events, hal::AgentId agent, const AccessTiming& timing,
                 hal::RandomStream& random, AccessListener& listener)
    : events_(events),
      agent_(agent),
      timing_(timing),
      random_(random),
      listener_(listener),
      // Nothing was sent before the run began, so the medium has been idle for an AIFS.
      idle_since_(events.now() - timing.aifs) {}

void Backoff::request(std::uint32_t contention_window) {
  if (wanted_) return;
  if (!busy_) count_slots(events_.now());
  wanted_ = true;
  if (busy_ && !backing_off_) {
    draw(contention_window);
  } else {
    schedule();
  }
}

void Backoff::draw(std::uint32_t contention_window) {
  backing_off_ = true;
  slots_ = random_.below(contention_window + 1);
  // Slots that were idle before do not count.
  if (!busy_) idle_since_ = std::max(idle_since_, events_.now() - timing_.aifs);
  schedule();
}

void Backoff::on_busy(std::uint32_t contention_window) {
  if (busy_) return;
  // Two stations whose backoffs end in the same slot do not sense each other: their frames collide.
  const hal::Time sensed = events_.now() + timing_.cca_time;
  const bool too_late = events_.is_pending(access_) && access_at_ <= sensed;
  if (!too_late) count_slots(sensed);
  busy_ = true;
  if (too_late) return;
  events_.cancel(access_);
  if (wanted_ && !backing_off_) draw(contention_window);
}

void Backoff::on_idle() {
  if (!busy_) return;
  busy_ = false;
  idle_since_ = events_.now();
  schedule();
}

void Backoff::set_aifs(hal::Duration aifs) {
  if (aifs == timing_.aifs) return;
  if (!busy_) count_slots(events_.now());
  idle_since_ += timing_.aifs - aifs;
  timing_.aifs = aifs;
  schedule();
}

void Backoff::reset(bool busy) {
  events_.cancel(access_);
  busy_ = busy;
  wanted_ = false;
  backing_off_ = false;
  slots_ = 0;
  idle_since_ = events_.now();
  held_until_ = hal::Time::min();
}

hal::Time Backoff::counting_from() const {
  return std::max(idle_since_, held_until_) + timing_.aifs;
}

/// With DCF only whole idle slots after the interframe space count; an interrupted slot is counted
/// again later.
void Backoff::count_slots(hal::Time until) {
  const hal::Duration counted = until - counting_from();
  if (!backing_off_ || counted < hal::Duration{}) return;
  const std::int64_t passed = counted / timing_.slot + (timing_.counts_first ? 1 : 0);
  if (passed >= slots_ && !wanted_) backing_off_ = false;
  // Counting continues from the slot boundary, so no slot is counted twice.
  const hal::Time boundary = counting_from() + passed * timing_.slot;
  idle_since_ = (passed < slots_ ? boundary : std::min(boundary, until)) - timing_.aifs;
  slots_ -= std::min(slots_, passed);
}

void Backoff::schedule() {
  events_.cancel(access_);
  if (!wanted_ || busy_) return;
  const std::int64_t slots = backing_off_ ? slots_ : 0;
  access_at_ = std::max(events_.now(), counting_from() + slots * timing_.slot);
  access_ = events_.schedule(access_at_, Rank::kRadio, agent_, [this] {
    wanted_ = false;
    backing_off_ = false;
    slots_ = 0;
    listener_.on_access();
  });
}

}  // namespace sim::radio
