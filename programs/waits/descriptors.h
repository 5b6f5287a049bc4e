#pragma once

#include <poll.h>
#include <signal.h>

#include "programs/waits/turn.h"

namespace programs::waits {

/// Waits until a descriptor is ready, as ppoll() does, but until a virtual time. What it returns is
/// what is ready once it is this thread's turn: what became ready meanwhile counts, and what others
/// have taken does not.
/// @param signals  blocked meanwhile in place of the thread's own; null: those stay.
int wait_for_descriptors(pollfd* descriptors, nfds_t count, Nanoseconds deadline,
                         const sigset_t* signals);

/// The same for one descriptor, of a call that goes on after a handler with SA_RESTART if it has no
/// time-out.
int wait_to_transfer(int descriptor, short events, Nanoseconds deadline);

/// The signals to be blocked in a system call that waits: these, or the thread's own, but never
/// kEndWait, which is to end it.
sigset_t blocked_in_wait(const sigset_t* signals);

/// Whether calls for this descriptor wait at all.
bool is_blocking(int descriptor, int flags);

/// SO_RCVTIMEO or SO_SNDTIMEO of a socket, virtual time, as a deadline from now on; kNever: none.
/// The kernel does not know of them: it would count wall time.
Nanoseconds receive_deadline(int socket);
Nanoseconds send_deadline(int socket);

/// Calls again and again what may say EAGAIN, with MSG_DONTWAIT or its like, and waits between the
/// calls for `events`, as a blocking call would.
/// @param wants  whether this call of a program waits. @param call  as a system call: -1 and errno.
template <class Call>
auto until_done(int descriptor, short events, bool waits, Nanoseconds deadline, const Call& call)
    -> decltype(call(true)) {
  // A socket that was shut down is ready for ever and yet says EAGAIN to MSG_DONTWAIT: then the
  // kernel is asked to wait, which it will not.
  constexpr int kTries = 3;
  for (int tries = 0;; ++tries) {
    const bool asks_not_to_wait = tries < kTries || !waits;
    const auto result = call(asks_not_to_wait);
    if (result >= 0 || errno != EAGAIN || !waits || !asks_not_to_wait) return result;
    const int ready = wait_to_transfer(descriptor, events, deadline);
    if (ready > 0) continue;
    if (ready == 0) errno = EAGAIN;
    return -1;
  }
}

}  // namespace programs::waits
