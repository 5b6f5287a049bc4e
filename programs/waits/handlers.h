#pragma once

#include <csignal>

#include "programs/waits/net.h"

namespace programs::waits {

/// Handlers of programs, with what a wait has to know of them. signal(7): a call that one without
/// SA_RESTART interrupts ends with EINTR; some go on after one with it.

/// Puts one of ours, which calls it, in the place of a program's handler.
/// @param flags  of the action. @return what the kernel is to have.
SignalHandler put_handler(int signal, SignalHandler handler, unsigned long flags);

/// What a program has given, of what the kernel has.
SignalHandler given_handler(int signal, SignalHandler handler);

/// Handlers that have run in this thread; and those of them without SA_RESTART.
unsigned handlers_run();
unsigned interruptions();

}  // namespace programs::waits
