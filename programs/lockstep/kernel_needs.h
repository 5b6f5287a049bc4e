#pragma once

namespace programs::lockstep {

/// Tries what lock-step needs of the kernel besides namespaces and TAP interfaces, on a child that
/// it makes and ends: catching system calls (Syscall User Dispatch), futexes, seeing from outside
/// whether and in which call a thread sleeps (wchan and syscall in /proc), and descriptors of
/// another process (pidfd_getfd). Takes about a millisecond. Any thread.
///
/// @throws std::runtime_error  one sentence that names all that is missing.
void require_kernel();

}  // namespace programs::lockstep
