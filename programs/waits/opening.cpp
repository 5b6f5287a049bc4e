// Files that are opened: POSIX.1-2017, <fcntl.h>, <stdio.h>; fifo(7), random(4), proc_uptime(5).
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <cstdarg>
#include <cstdio>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/entropy.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/turn.h"
#include "programs/waits/uptime.h"

namespace {

using programs::waits::kernel_call;
using programs::waits::own_slot;

/// Whether it is a named pipe, and opened so that it waits for somebody who opens its other end.
bool waits_for_other_end(int folder, const char* path, int flags) {
  const bool may_wait = own_slot() != nullptr &&
                        (flags & (O_NONBLOCK | O_PATH | O_DIRECTORY)) == 0 &&
                        (flags & O_ACCMODE) != O_RDWR;
  struct stat found {};
  return may_wait &&
         kernel_call(SYS_newfstatat, {folder, reinterpret_cast<long>(path),
                                      reinterpret_cast<long>(&found), 0, 0, 0}) == 0 &&
         S_ISFIFO(found.st_mode);
}

int open_file(int folder, const char* path, int flags, mode_t mode) {
  if (programs::waits::is_random_device(path)) return programs::waits::open_drawn(flags);
  if (programs::waits::is_uptime_file(path)) return programs::waits::open_uptime(flags);
  const auto next = BARAKA_NEXT(openat);
  if (!waits_for_other_end(folder, path, flags)) return next(folder, path, flags, mode);
  programs::waits::KernelWait wait(programs::waits::kNever);
  return next(folder, path, flags, mode);
}

/// Of a call with optional arguments: whether the third is there.
bool has_mode(int flags) { return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE; }

}  // namespace

/// The mode is an argument of those calls only that may make a file.
#define BARAKA_MODE(flags)                                   \
  mode_t mode = 0;                                           \
  if (has_mode(flags)) {                                     \
    va_list arguments;                                       \
    va_start(arguments, flags);                              \
    mode = static_cast<mode_t>(va_arg(arguments, unsigned)); \
    va_end(arguments);                                       \
  }

BARAKA_EXPORTED int open(const char* path, int flags, ...) {
  BARAKA_MODE(flags)
  return open_file(AT_FDCWD, path, flags, mode);
}

BARAKA_EXPORTED int open64(const char* path, int flags, ...) {
  BARAKA_MODE(flags)
  return open_file(AT_FDCWD, path, flags, mode);
}

BARAKA_EXPORTED int openat(int folder, const char* path, int flags, ...) {
  BARAKA_MODE(flags)
  return open_file(folder, path, flags, mode);
}

BARAKA_EXPORTED int openat64(int folder, const char* path, int flags, ...) {
  BARAKA_MODE(flags)
  return open_file(folder, path, flags, mode);
}

/// The net catches the call by which the C library opens it.
BARAKA_EXPORTED FILE* fopen(const char* path, const char* mode) {
  static constinit programs::preload::Intercepted next("fopen");
  if (!programs::waits::is_random_device(path)) {
    return reinterpret_cast<decltype(&::fopen)>(next.find())(path, mode);
  }
  return fdopen(programs::waits::open_drawn(0), "r");
}

BARAKA_EXPORTED FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }
