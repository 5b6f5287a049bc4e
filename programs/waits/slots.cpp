#include "programs/waits/slots.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "programs/netns/room_page.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/net.h"
#include "programs/waits/parking.h"
#include "programs/waits/turn.h"
#include "programs/waits/vdso.h"

namespace programs::waits {
namespace {

WaitPage* shared = nullptr;
pthread_key_t end_of_thread;
__attribute__((tls_model("initial-exec"))) thread_local WaitSlot* own = nullptr;

long call(long number, auto... arguments) {
  return BARAKA_NEXT_QUIET(syscall)(number, arguments...);
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
  slot.process = static_cast<std::int32_t>(call(SYS_getpid));
  slot.thread = static_cast<std::int32_t>(call(SYS_gettid));
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
  const auto thread = static_cast<std::int32_t>(call(SYS_gettid));
  for (std::uint32_t i = 0; i < shared->used.load(); ++i) {
    WaitSlot& slot = shared->slots[i];
    if (slot.thread.load() == thread && slot.state.load() == SlotState::kRunning) return &slot;
  }
  return nullptr;
}

/// Those of the threads that ended when this process became another program.
void free_other_slots(const WaitSlot& kept) {
  const auto process = static_cast<std::int32_t>(call(SYS_getpid));
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

void map_page() {
  const char* const path = std::getenv(netns::kRoomVariable);
  if (path == nullptr) return;
  const auto file = static_cast<int>(call(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC, 0));
  if (file < 0) return;
  void* const memory = mmap(nullptr, sizeof(WaitPage), PROT_READ | PROT_WRITE, MAP_SHARED, file,
                            static_cast<off_t>(netns::kWaitPageOffset));
  call(SYS_close, file);
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

}  // namespace

WaitPage* page() { return shared; }

WaitSlot* known_slot() { return own; }

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

void forget_own_slot() { own = nullptr; }

WaitSlot* own_slot() {
  if (own != nullptr || shared == nullptr) return own;
  adopt(take_slot(SlotState::kExpected));
  return own;
}

}  // namespace programs::waits
