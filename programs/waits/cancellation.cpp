// Threads that are cancelled: POSIX.1-2017, <pthread.h>, pthread_cancel().
#include "programs/waits/cancellation.h"

#include <sys/syscall.h>

#include <array>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/signals.h"

namespace programs::waits {
namespace {

/// Of this process's threads, by the number of their slot.
std::array<pthread_t, WaitPage::kSlots> handles;

}  // namespace

void note_handle(const WaitSlot& slot) {
  handles[static_cast<std::size_t>(&slot - page()->slots.data())] = pthread_self();
}

void interrupt(pthread_t thread) {
  for (std::uint32_t i = 0; i < page()->used.load(); ++i) {
    WaitSlot& slot = page()->slots[i];
    auto waiting = SlotState::kWaiting;
    const bool is_it = handles[i] == thread && slot.process == own_slot()->process.load() &&
                       slot.state.load() == waiting;
    if (!is_it) continue;
    if (slot.kind.load() == WaitKind::kInKernel) {
      kernel_call(SYS_tgkill, {slot.process.load(), slot.thread.load(), kEndWait, 0, 0, 0});
      continue;
    }
    slot.expired.store(netns::kInterrupted);
    slot.state.compare_exchange_strong(waiting, SlotState::kWants);
    go_on_after_end(slot);
  }
  told(0);
}

}  // namespace programs::waits

BARAKA_EXPORTED int pthread_cancel(pthread_t thread) {
  const int error = BARAKA_NEXT(pthread_cancel)(thread);
  if (error == 0 && programs::waits::own_slot() != nullptr) programs::waits::interrupt(thread);
  return error;
}
