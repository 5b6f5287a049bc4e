#pragma once

#include <pthread.h>

#include <cstdint>

#include "programs/netns/wait_page.h"

namespace programs::waits {

/// What threads are parked for: the address of a mutex, a condition variable …, together with the
/// process, for one address means different things in two processes; or one of these.
inline constexpr std::uint64_t kSleep = 1;                  ///< Nothing but the deadline.
inline constexpr std::uint64_t kRoom = netns::kRoomObject;  ///< Room in the station's queue.
/// A semaphore, lock or futex that processes share, whichever it is: those that wait look again.
inline constexpr std::uint64_t kSharedObject = 3;
inline constexpr std::uint64_t kQueueRoom = 4;  ///< Room in a message queue of System V.
inline constexpr std::uint64_t kFileLock = netns::kFileLockObject;  ///< That a file may be locked.

/// Of something in this process's own memory.
std::uint64_t object_at(const volatile void* address);
/// The end of a thread of this process.
std::uint64_t object_of(pthread_t thread);
/// Whether it is about to end, and has woken whoever was parked for that.
bool is_ending(pthread_t thread);

}  // namespace programs::waits
