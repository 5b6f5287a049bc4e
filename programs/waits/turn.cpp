#include "programs/waits/turn.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "programs/netns/room_page.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/net.h"
#include "programs/waits/parking.h"
#include "programs/waits/vdso.h"

namespace programs::waits {
namespace {

WaitPage* shared = nullptr;
pthread_key_t end_of_thread;
__attribute__((tls_model("initial-exec"))) thread_local WaitSlot* own = nullptr;
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

void want_to_go_on(WaitSlot& slot) {
  slot.state.store(SlotState::kWants);
  tell_run();
  wait_for_turn(slot);
}

void clear(WaitSlot& slot) {
  slot.process = slot.thread = 0;
  slot.grant = slot.expired = slot.readings = 0;
  slot.deadline = kNever;
  slot.interval = 0;
  slot.object = 0;
  slot.kind = WaitKind::kParked;
  slot.descriptor = -1;
  slot.signal = slot.timer = slot.target = 0;
  slot.value = 0;
  slot.overruns = 0;
}

void name_thread(WaitSlot& slot) {
  catch_system_calls();
  slot.process = static_cast<std::int32_t>(system_call(SYS_getpid));
  slot.thread = static_cast<std::int32_t>(system_call(SYS_gettid));
  own = &slot;
  note_handle(slot);
  pthread_setspecific(end_of_thread, &slot);
}

/// Called again and again while other destructors of the thread still run: it is the last.
void on_end_of_thread(void* slot) {
  __attribute__((tls_model("initial-exec"))) static thread_local int round = 0;
  if (++round < PTHREAD_DESTRUCTOR_ITERATIONS - 1) {
    pthread_setspecific(end_of_thread, slot);
    return;
  }
  auto& ending = *static_cast<WaitSlot*>(slot);
  const std::uint64_t object = object_of(pthread_self());
  ending.object.store(object);
  ending.state.store(SlotState::kEnding);
  wake(object, ~0U);
  tell_run();
}

WaitSlot* slot_of_this_thread() {
  const auto thread = static_cast<std::int32_t>(system_call(SYS_gettid));
  for (std::uint32_t i = 0; i < shared->used.load(); ++i) {
    WaitSlot& slot = shared->slots[i];
    if (slot.thread.load() == thread && slot.state.load() == SlotState::kRunning) return &slot;
  }
  return nullptr;
}

/// Those of the threads that ended when this process became another program.
void free_other_slots(const WaitSlot& kept) {
  const auto process = static_cast<std::int32_t>(system_call(SYS_getpid));
  for (std::uint32_t i = 0; i < shared->used.load(); ++i) {
    WaitSlot& slot = shared->slots[i];
    if (&slot != &kept && slot.process.load() == process) give_back_slot(slot);
  }
}

WaitSlot* reserved_slot() {
  const char* const text = std::getenv(netns::kSlotVariable);
  if (text == nullptr) return nullptr;
  const auto number = static_cast<std::size_t>(std::strtoul(text, nullptr, 10));
  unsetenv(netns::kSlotVariable);
  if (number >= WaitPage::kSlots) return nullptr;
  WaitSlot& slot = shared->slots[number];
  return slot.state.load() == SlotState::kExpected ? &slot : nullptr;
}

void on_end_of_wait(int, siginfo_t*, void*) {}

std::atomic<std::uint32_t>& parked_like(std::uint64_t object) {
  constexpr std::uint64_t kMix = 0x9e37'79b9'7f4a'7c15;
  constexpr int kShift = 56;
  return shared->parked[object * kMix >> kShift];
}

void map_page() {
  const char* const path = std::getenv(netns::kRoomVariable);
  if (path == nullptr) return;
  const auto file =
      static_cast<int>(system_call(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC, 0));
  if (file < 0) return;
  void* const memory = mmap(nullptr, sizeof(WaitPage), PROT_READ | PROT_WRITE, MAP_SHARED, file,
                            static_cast<off_t>(netns::kWaitPageOffset));
  system_call(SYS_close, file);
  if (memory != MAP_FAILED) shared = static_cast<WaitPage*>(memory);
}

/// Before any other constructor of the program's libraries.
__attribute__((constructor(101))) void register_process() {
  map_page();
  if (shared == nullptr) return;
  pthread_key_create(&end_of_thread, on_end_of_thread);
  set_handler(kEndWait, on_end_of_wait);
  take_over_vdso();
  if (WaitSlot* const reserved = reserved_slot(); reserved != nullptr) return adopt(*reserved);
  if (WaitSlot* const kept = slot_of_this_thread(); kept != nullptr) {
    free_other_slots(*kept);
    return name_thread(*kept);
  }
  adopt(take_slot(SlotState::kExpected));
}

__attribute__((destructor)) void unregister_process() {
  if (own == nullptr) return;
  own->state.store(SlotState::kEnding);
  tell_run();
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
  for (std::uint32_t i = 0; i < shared->used.load(); ++i) {
    WaitSlot& slot = shared->slots[i];
    if (!is_parked(slot, object)) continue;
    if (first == nullptr || slot.ticket.load() < first->ticket.load()) first = &slot;
  }
  return first;
}

}  // namespace

WaitPage* page() { return shared; }

bool is_over() { return shared->is_over.load() != 0; }

Nanoseconds now() { return shared->now.load(); }

void stir() {
  if (shared != nullptr) shared->stirs.fetch_add(1);
}

void stir_by_reading() {
  if (shared == nullptr) return;
  const std::uint32_t used = shared->used.load();
  for (std::uint32_t i = 0; i < used; ++i) {
    if (shared->slots[i].object.load() == netns::kSendingObject) return stir();
  }
}

void tell_run() {
  shared->event.fetch_add(1);
  if (shared->is_awaited.load() != 0) futex_wake(shared->event);
}

void go_on_after_end(WaitSlot& slot) {
  if (!is_over()) return;
  slot.grant.store(1);
  futex_wake(slot.grant);
}

WaitSlot& take_slot(SlotState state) {
  for (std::size_t i = 0; i < WaitPage::kSlots; ++i) {
    WaitSlot& slot = shared->slots[i];
    auto free = SlotState::kFree;
    if (slot.state.load() != free || !slot.state.compare_exchange_strong(free, state)) continue;
    clear(slot);
    std::uint32_t used = shared->used.load();
    while (used <= i &&
           !shared->used.compare_exchange_weak(used, static_cast<std::uint32_t>(i + 1)))
      continue;
    return slot;
  }
  std::fprintf(stderr, "baraka: an agent has at most %zu threads and timers in lock-step\n",
               WaitPage::kSlots);
  _exit(127);
}

void give_back_slot(WaitSlot& slot) {
  slot.thread = slot.process = 0;
  slot.state.store(SlotState::kFree);
}

WaitSlot& expect_one() {
  WaitSlot& slot = take_slot(SlotState::kExpected);
  slot.process = own_slot()->process.load();
  slot.thread = netns::kNewThread;
  return slot;
}

/// Unless it has said so itself.
void expected_is(WaitSlot& slot, pid_t process) {
  std::int32_t maker = own_slot()->process.load(), new_thread = netns::kNewThread;
  slot.process.compare_exchange_strong(maker, process);
  slot.thread.compare_exchange_strong(new_thread, 0);
}

void adopt(WaitSlot& slot) {
  name_thread(slot);
  want_to_go_on(slot);
}

void return_from_call() {
  if (own != nullptr && own->state.load() == SlotState::kUnknown) want_to_go_on(*own);
}

void forget_own_slot() { own = nullptr; }

WaitSlot* own_slot() {
  if (own != nullptr || shared == nullptr) return own;
  adopt(take_slot(SlotState::kExpected));
  return own;
}

Woken park(std::uint64_t object, Nanoseconds deadline) {
  WaitSlot& slot = *own_slot();
  start_to_wait(slot);
  slot.object.store(object);
  slot.ticket.store(shared->tickets.fetch_add(1) + 1);
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
  for (std::uint32_t i = 0; i < shared->used.load(); ++i) {
    const WaitSlot& slot = shared->slots[i];
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
  if (shared == nullptr || parked_like(object).load() == 0) return woken;
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
  slot_.ticket.store(shared->tickets.fetch_add(1) + 1);
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
  shared->spins.fetch_add(1);
}

}  // namespace programs::waits
