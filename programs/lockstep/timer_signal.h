#pragma once

#include <cstdint>

#include "programs/lockstep/kernel_thread.h"
#include "programs/netns/wait_page.h"

namespace programs::lockstep {

/// Moves a timer that is due to when it is due next.
/// @param now  virtual time, ns. @return how often it has expired.
std::uint64_t expire_once(netns::WaitSlot& timer, std::int64_t now);

/// Sends the signal of a timer of timer_create(), as the kernel would: with what the program gave
/// for it, and not while the last one is pending, which is an overrun (POSIX.1-2017,
/// timer_getoverrun).
/// @param times  that it has expired since the last call.
/// @param target  the thread that is to get it, or the first one of the process.
/// @return false: there is no such process or thread any more.
bool send_signal(netns::WaitSlot& timer, const KernelThread& target, std::uint64_t times);

}  // namespace programs::lockstep
