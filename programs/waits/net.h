#pragma once

#include <csignal>

namespace programs::waits {

/// Catches the system calls that programs and the C library make past the calls that this library
/// replaces: stdio, the resolver, locks of files, code with system calls of its own. Linux delivers
/// each as a signal to the thread itself (Syscall User Dispatch,
/// Documentation/admin-guide/syscall-user-dispatch.rst; since Linux 5.11), and the handler answers
/// it. Switched on for each thread by itself, for the kernel switches it off in new ones.
void catch_system_calls();

using SignalHandler = void (*)(int signal, siginfo_t* info, void* context);

/// Installs a handler of this library's, from which a thread returns without being caught.
void set_handler(int signal, SignalHandler handler);

}  // namespace programs::waits
