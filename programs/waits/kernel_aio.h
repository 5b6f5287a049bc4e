#pragma once

#include "programs/waits/kernel_call.h"

namespace programs::waits {

/// io_submit(2), io_getevents(2) and io_pgetevents(2), which the C library does not have. Waits for
/// descriptors that are to become ready (IOCB_CMD_POLL) end by others, and are held; reading and
/// writing files ends by itself, so a process that has asked for that waits as the kernel lets it.
/// @return as a system call: -1 and errno.
long submit_to_kernel(const Arguments& arguments);
long get_kernel_events(long number, const Arguments& arguments);

}  // namespace programs::waits
