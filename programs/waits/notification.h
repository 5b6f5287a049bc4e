#pragma once

#include <csignal>
#include <cstddef>

namespace programs::waits {

/// Starts a detached thread of this process, which the run knows as its other ones.
/// @param stack  its size in bytes; 0: as usual. @return 0, or an error.
int start_detached(void* (*function)(void*), void* argument, std::size_t stack);

/// The same of a thread of this library's own: no signal of the program reaches it.
int start_server(void* (*function)(void*), void* argument);

/// SIGEV_THREAD: starts a thread that calls the function, with no signal blocked.
void call_in_thread(void (*function)(sigval), sigval value, std::size_t stack);

/// The size of the stack that the attributes of an event ask for; 0: as usual.
std::size_t stack_of(const sigevent& event);

}  // namespace programs::waits
