#include "programs/waits/kernel_aio.h"

#include <linux/aio_abi.h>
#include <sys/syscall.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <ctime>

#include "programs/waits/descriptors.h"
#include "programs/waits/handlers.h"
#include "programs/waits/virtual_clock.h"

namespace programs::waits {
namespace {

/// As the kernel takes a set of signals beside five other arguments.
struct Signals {
  const sigset_t* set;
  std::size_t size;
};

std::atomic<bool> has_files = false;  ///< Of a process that reads or writes some so.

long failed(int error) {
  errno = error;
  return -1;
}

/// What is there now, behind those that were got before. @return as the kernel: -errno.
long look(const Arguments& rest) {
  const timespec no_time{0, 0};
  return kernel_call(SYS_io_getevents,
                     {rest[0], 0, rest[2], rest[3], reinterpret_cast<long>(&no_time)});
}

/// Waits for one at least, a handler, or the deadline. @return how many came; -errno.
long wait_for_some(const Arguments& rest, const sigset_t* signals, Nanoseconds deadline) {
  constexpr std::size_t kSizeOfSet = 8;  // the kernel's
  const sigset_t blocked = blocked_in_wait(signals);
  const Signals with{&blocked, kSizeOfSet};
  KernelWait wait(deadline);
  const long got = kernel_call(SYS_io_pgetevents,
                               {rest[0], 1, rest[2], rest[3], 0, reinterpret_cast<long>(&with)});
  wait.end();
  return got == -EINTR ? look(rest) : got;
}

long get_events(const Arguments& a, const sigset_t* signals, Nanoseconds deadline) {
  const unsigned handled = handlers_run();
  Arguments rest = a;
  long got = 0;
  for (long some = look(rest); some >= 0; some = wait_for_some(rest, signals, deadline)) {
    got += some;
    if (got >= a[1] || is_over()) return got;
    if (deadline <= now()) {
      count_look(1);
      return got;
    }
    if (handlers_run() != handled) return got > 0 ? got : failed(EINTR);
    rest[2] -= some;
    rest[3] += some * static_cast<long>(sizeof(io_event));
  }
  return got > 0 ? got : failed(EINVAL);
}

}  // namespace

long submit_to_kernel(const Arguments& a) {
  auto* const all = pointer<const iocb*>(a[2]);
  for (long i = 0; all != nullptr && i < a[1]; ++i) {
    if (all[i] != nullptr && all[i]->aio_lio_opcode != IOCB_CMD_POLL) has_files = true;
  }
  return pass_on(SYS_io_submit, a);
}

long get_kernel_events(long number, const Arguments& a) {
  const bool is_valid = a[1] >= 0 && a[2] >= a[1] && a[3] != 0;
  if (has_files.load() || !is_valid) return pass_on(number, a);
  const auto* const signals = number == SYS_io_pgetevents ? pointer<const Signals>(a[5]) : nullptr;
  return get_events(a, signals == nullptr ? nullptr : signals->set,
                    deadline_in(pointer<const timespec>(a[4])));
}

}  // namespace programs::waits
