// How long the computer has been on: proc_uptime(5), sysinfo(2).
#include "programs/waits/uptime.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/virtual_clock.h"

namespace programs::waits {

bool is_uptime_file(const char* path) {
  return path != nullptr && own_slot() != nullptr && std::strcmp(path, "/proc/uptime") == 0;
}

int open_uptime(int flags) {
  constexpr Nanoseconds kHundredth = kSecond / 100;
  const timespec now = to_timespec(reading(CLOCK_BOOTTIME));
  std::array<char, 64> text{};
  const int length = std::snprintf(text.data(), text.size(), "%ld.%02ld 0.00\n", now.tv_sec,
                                   now.tv_nsec / kHundredth);
  const int file = memfd_create("uptime", (flags & O_CLOEXEC) != 0 ? MFD_CLOEXEC : 0);
  if (file >= 0) (void)!pwrite(file, text.data(), static_cast<std::size_t>(length), 0);
  return file;
}

}  // namespace programs::waits

/// Rounded up, as Linux does.
BARAKA_EXPORTED int sysinfo(struct sysinfo* info) noexcept {
  const int status = BARAKA_NEXT(sysinfo)(info);
  if (status != 0 || programs::waits::own_slot() == nullptr) return status;
  const timespec now = programs::waits::to_timespec(programs::waits::reading(CLOCK_BOOTTIME));
  info->uptime = now.tv_sec + (now.tv_nsec > 0 ? 1 : 0);
  return status;
}
