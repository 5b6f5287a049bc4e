#pragma once

#include <ctime>

#include "programs/waits/turn.h"

namespace programs::waits {

/// A timer of this process that the run lets expire; it is not armed yet.
/// @param descriptor  of an eventfd to be written; -1: none. @param signal  to be sent; 0: none.
WaitSlot& new_timer(int descriptor, int signal);

/// When it is to expire first: virtual time; kNever: it is not to.
/// @pre is_time() of both. @param is_moment  whether `value` is a time of the clock, not a length.
Nanoseconds first_expiration(const timespec& value, clockid_t clock, bool is_moment);

/// What is left, and the interval, as timer_gettime() says it.
itimerspec setting_of(Nanoseconds next, Nanoseconds interval);

/// The descriptor is closed: if it stands for a timer, that is no more.
void close_timer(int descriptor);

}  // namespace programs::waits
