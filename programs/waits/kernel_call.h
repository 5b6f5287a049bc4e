#pragma once

#include <array>

namespace programs::waits {

/// The arguments of a system call, as registers hold them.
using Arguments = std::array<long, 6>;

/// One of them as what it points to.
template <class T>
T* pointer(long argument) {
  return reinterpret_cast<T*>(argument);  // NOLINT(performance-no-int-to-ptr): they come so
}

/// A system call by an instruction of this library, which the net (net.h) lets pass.
/// @return as the kernel gives it: -errno on failure.
long kernel_call(long number, const Arguments& arguments);

/// The same. @return -1 and errno on failure.
long pass_on(long number, const Arguments& arguments);

/// What the library knows of system calls: those that wait, tell the time or draw entropy are
/// answered as the C library's calls of the same meaning are; all others are the kernel's.
/// @return -1 and errno on failure.
long answer(long number, const Arguments& arguments);
/// The part of it for calls of which no program makes many.
long answer_rare(long number, const Arguments& arguments);

}  // namespace programs::waits
