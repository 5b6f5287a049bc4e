#include "programs/waits/turn.h"

#include <linux/futex.h>
#include <pthread.h>
#include <sys/syscall.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <ctime>

#include "programs/preload/intercepted.h"
#include "programs/waits/parking.h"

namespace programs::waits {
namespace {

__attribute__((tls_model("initial-exec"))) thread_local unsigned steps_of_spinner = 0;

long system_call(long number, auto... arguments) {
  return BARAKA_NEXT_QUIET(syscall)(number, arguments...);
}

void futex_wake(std::atomic<std::uint32_t>& word) {
  system_call(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

/// @return whether a handler has run. The time-out, far away, makes Linux say so even where the
/// handler asks for calls to be restarted.
bool futex_wait(std::atomic<std::uint32_t>& word) {
  const timespec far{1'000'000'000, 0};
  return system_call(SYS_futex, &word, FUTEX_WAIT, 0, &far, nullptr, 0) != 0 && errno == EINTR;
}

void wait_for_turn(WaitSlot& slot) {
  while (slot.grant.load() == 0 && !is_over()) futex_wait(slot.grant);
  slot.grant.store(0);
}

std::atomic<std::uint32_t>& parked_like(std::uint64_t object) {
  constexpr std::uint64_t kMix = 0x9e37'79b9'7f4a'7c15;
  constexpr int kShift = 56;
  return page()->parked[object * kMix >> kShift];
}

/// A wait for a time that has passed takes a microsecond: `while (now() <= deadline)
/// wait(deadline)` would otherwise never end, for virtual time passes in waits only.
Nanoseconds at_least_a_moment_away(Nanoseconds deadline) {
  constexpr Nanoseconds kMoment = 1000;
  return deadline > now() ? deadline : now() + kMoment;
}

void publish(WaitSlot& slot, WaitKind kind, Nanoseconds deadline) {
  slot.kind.store(kind);
  slot.deadline.store(at_least_a_moment_away(deadline));
  slot.expired.store(0);
  slot.state.store(SlotState::kWaiting);
  tell_run();
}

void start_to_wait(WaitSlot& slot) {
  slot.readings.store(0);
  steps_of_spinner = 0;
}

/// Time passes as the wall clock's from now on, in steps. Who waits without a deadline looks again.
Woken end_of_run(const WaitSlot& slot, bool has_handled) {
  constexpr long kStep = 1'000'000;
  const timespec step{0, kStep};
  if (has_handled) return Woken::kBySignal;
  BARAKA_NEXT(nanosleep)(&step, nullptr);
  return slot.deadline.load() == netns::kNever ? Woken::kByThread : Woken::kByDeadline;
}

Woken wait_parked(WaitSlot& slot) {
  bool is_interrupted = false;
  while (slot.grant.load() == 0) {
    if (is_over()) return end_of_run(slot, false);
    const bool has_handled = futex_wait(slot.grant);
    if (is_over() && slot.grant.load() == 0) return end_of_run(slot, has_handled);
    if (!has_handled) continue;
    auto waiting = SlotState::kWaiting;
    if (!slot.state.compare_exchange_strong(waiting, SlotState::kWants)) continue;
    is_interrupted = true;
    tell_run();
  }
  slot.grant.store(0);
  if (is_interrupted) return Woken::kBySignal;
  switch (slot.expired.load()) {
    case 0:
      return Woken::kByThread;
    case netns::kInterrupted:
      return Woken::kBySignal;
    default:
      return Woken::kByDeadline;
  }
}

bool is_parked(const WaitSlot& slot, std::uint64_t object) {
  return slot.object.load() == object && slot.state.load() == SlotState::kWaiting &&
         slot.kind.load() == WaitKind::kParked;
}

/// The one that has waited longest; null: there is none.
WaitSlot* first_parked(std::uint64_t object) {
  WaitSlot* first = nullptr;
  for (std::uint32_t i = 0; i < page()->used.load(); ++i) {
    WaitSlot& slot = page()->slots[i];
    if (!is_parked(slot, object)) continue;
    if (first == nullptr || slot.ticket.load() < first->ticket.load()) first = &slot;
  }
  return first;
}

}  // namespace

bool is_over() { return page()->is_over.load() != 0; }

Nanoseconds now() { return page()->now.load(); }

void stir() {
  if (page() != nullptr) page()->stirs.fetch_add(1);
}

void stir_by_reading() {
  if (page() == nullptr) return;
  const std::uint32_t used = page()->used.load();
  for (std::uint32_t i = 0; i < used; ++i) {
    if (page()->slots[i].object.load() == netns::kSendingObject) return stir();
  }
}

void tell_run() {
  page()->event.fetch_add(1);
  if (page()->is_awaited.load() != 0) futex_wake(page()->event);
}

void go_on_after_end(WaitSlot& slot) {
  if (!is_over()) return;
  slot.grant.store(1);
  futex_wake(slot.grant);
}

void want_to_go_on(WaitSlot& slot) {
  slot.state.store(SlotState::kWants);
  tell_run();
  wait_for_turn(slot);
}

void return_from_call() {
  WaitSlot* const slot = known_slot();
  if (slot != nullptr && slot->state.load() == SlotState::kUnknown) want_to_go_on(*slot);
}

Woken park(std::uint64_t object, Nanoseconds deadline) {
  WaitSlot& slot = *own_slot();
  start_to_wait(slot);
  slot.object.store(object);
  slot.ticket.store(page()->tickets.fetch_add(1) + 1);
  parked_like(object).fetch_add(1);
  publish(slot, WaitKind::kParked, deadline);
  const Woken woken = wait_parked(slot);
  parked_like(object).fetch_sub(1);
  slot.object.store(0);
  return woken;
}

std::uint64_t object_of(pthread_t thread) {
  return object_at(reinterpret_cast<const void*>(thread));  // NOLINT(performance-no-int-to-ptr)
}

bool is_ending(pthread_t thread) {
  const std::uint64_t object = object_of(thread);
  for (std::uint32_t i = 0; i < page()->used.load(); ++i) {
    const WaitSlot& slot = page()->slots[i];
    if (slot.state.load() == SlotState::kEnding && slot.object.load() == object) return true;
  }
  return false;
}

std::uint64_t object_at(const volatile void* address) {
  constexpr int kBitsOfAddress = 48;
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  return place | static_cast<std::uint64_t>(own_slot()->process.load()) << kBitsOfAddress;
}

std::int32_t first_waiting(std::uint64_t object) {
  const WaitSlot* const first = parked_like(object).load() == 0 ? nullptr : first_parked(object);
  return first == nullptr ? 0 : first->thread.load();
}

unsigned wake(std::uint64_t object, unsigned most) {
  unsigned woken = 0;
  if (page() == nullptr || parked_like(object).load() == 0) return woken;
  for (; woken < most; ++woken) {
    WaitSlot* const first = first_parked(object);
    if (first == nullptr) break;
    auto waiting = SlotState::kWaiting;
    first->object.store(0);
    first->state.compare_exchange_strong(waiting, SlotState::kWants);
    go_on_after_end(*first);
  }
  if (woken > 0) tell_run();
  return woken;
}

KernelWait::KernelWait(Nanoseconds deadline, std::uint64_t object) : slot_(*own_slot()) {
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state_);
  start_to_wait(slot_);
  slot_.object.store(object);
  slot_.ticket.store(page()->tickets.fetch_add(1) + 1);
  publish(slot_, WaitKind::kInKernel, deadline);
}

void KernelWait::end() {
  if (is_over_) return;
  is_over_ = true;
  const int kept = errno;
  want_to_go_on(slot_);
  expired_ = slot_.expired.load() == 1;
  pthread_setcancelstate(cancel_state_, nullptr);
  errno = kept;
}

bool sleep_until(Nanoseconds until) {
  constexpr unsigned kAsManyLooks = 20;
  if (until <= now()) {
    count_look(kAsManyLooks);
    return true;
  }
  return park(kSleep, until) == Woken::kByDeadline;
}

void give_turn_away() {
  WaitSlot* const slot = own_slot();
  if (slot != nullptr && slot->state.load() == SlotState::kRunning) want_to_go_on(*slot);
}

void count_look(unsigned weight) {
  constexpr std::uint32_t kMost = 2000;
  constexpr Nanoseconds kStep = 10'000;
  constexpr unsigned kDoublings = 5;
  WaitSlot* const slot = own_slot();
  if (slot == nullptr || slot->readings.fetch_add(weight) + weight < kMost) return;
  const unsigned steps = steps_of_spinner;
  sleep_until(now() + (kStep << std::min(steps, kDoublings)));
  steps_of_spinner = steps + 1;
  slot->readings.store(kMost - kMost / 10);
  page()->spins.fetch_add(1);
}

}  // namespace programs::waits
