#pragma once

#include <sys/types.h>

#include "programs/netns/wait_page.h"

namespace programs::waits {

using netns::kEndWait;
using netns::kNever;
using netns::SlotState;
using netns::WaitKind;
using netns::WaitPage;
using netns::WaitSlot;

/// The page of the agent that this process runs in; null: it is not in lock-step, and every call of
/// a program goes to the C library as it is.
WaitPage* page();

/// The slot of the calling thread, which takes one if it has none; null: not in lock-step.
WaitSlot* own_slot();
/// The same, but a thread that has none takes none.
WaitSlot* known_slot();

/// A free slot. Ends the process with a message if all are taken.
WaitSlot& take_slot(SlotState state);
void give_back_slot(WaitSlot& slot);

/// A slot for a thread or process that this thread is about to make. Until it begins, the run frees
/// the slot if this process ends.
WaitSlot& expect_one();
/// It is a process, and exists.
void expected_is(WaitSlot& slot, pid_t process);

/// Makes the calling thread, which has just begun to exist, the one of a slot of state kExpected,
/// and waits for its turn.
void adopt(WaitSlot& slot);

/// Forgets the slot of the thread that fork() copied. To be called in the child, before adopt().
void forget_own_slot();

}  // namespace programs::waits
