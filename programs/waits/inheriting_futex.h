#pragma once

#include <cstdint>

#include "programs/waits/kernel_call.h"
#include "programs/waits/turn.h"

namespace programs::waits {

/// Futexes with priority inheritance, as futex(2) has them: FUTEX_LOCK_PI and FUTEX_LOCK_PI2,
/// FUTEX_TRYLOCK_PI, FUTEX_UNLOCK_PI. The word says who has the lock. In lock-step all threads have
/// one priority, so it is handed over to the one that has waited longest.
/// @param object  what its waiters are parked for. @param is_private  nobody else is.
/// @return as a system call: -1 and errno.
long lock_inheriting(const Arguments& arguments, std::uint64_t object, Nanoseconds deadline);
long try_inheriting(const Arguments& arguments);
long unlock_inheriting(const Arguments& arguments, std::uint64_t object, bool is_private);

}  // namespace programs::waits
