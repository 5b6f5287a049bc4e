#pragma once

namespace programs::waits {

/// Makes the functions of the vDSO (vdso(7)) system calls, which the net (net.h) catches: the C
/// library asks them for the time where it needs it itself, for numbers of DNS queries and in its
/// waits, and so do programs that know them (Go). To be called once in a process.
void take_over_vdso();

}  // namespace programs::waits
