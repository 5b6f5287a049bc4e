#pragma once

#include <pthread.h>

#include "programs/waits/turn.h"

namespace programs::waits {

/// POSIX.1-2017, System Interfaces, 2.9.5.2: where a call of a program that may wait ends its
/// thread if that was asked for. Not to be called while a KernelWait lives.
inline void cancellation_point() {
  if (page() != nullptr) pthread_testcancel();
}

/// Notes the handle of the calling thread, whose slot this is.
void note_handle(const WaitSlot& slot);

/// Makes a wait of a thread of this process end, as a handler of a signal does.
void interrupt(pthread_t thread);

}  // namespace programs::waits
