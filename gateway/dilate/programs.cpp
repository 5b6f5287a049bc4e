// Programs that a program becomes: POSIX.1-2017, <unistd.h>. One that is statically linked would
// live in the wall's time unnoticed, so it is refused where time is slowed, as baraka does with
// what it starts itself. The C library's own system(), popen() and posix_spawn() do not come by
// here.
#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include "gateway/dilate/exported.h"
#include "gateway/dilate/intercepted.h"
#include "gateway/dilate/process_time.h"

namespace {

bool names_a_loader(int file, const ElfW(Ehdr) & header) {
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) part;
    const auto place = static_cast<off_t>(header.e_phoff + i * header.e_phentsize);
    if (pread(file, &part, sizeof part, place) != sizeof part) return true;  // the kernel will say
    if (part.p_type == PT_INTERP) return true;
  }
  return false;
}

/// Of the machine's own kind; anything else is left to the kernel. The loader itself names none,
/// but is a shared object, as are the few that are static and movable at once: those go unnoticed.
/// Safe after fork().
bool is_static(const char* path) {
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  ElfW(Ehdr) header;
  const bool is_program = pread(file, &header, sizeof header, 0) == sizeof header &&
                          std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
                          header.e_type == ET_EXEC;
  const bool result = is_program && !names_a_loader(file, header);
  close(file);
  return result;
}

bool is_refused(const char* path) {
  const int kept = errno;
  const bool refused = !gateway::dilate::ProcessTime::get().dilation().is_none() &&
                       path != nullptr && is_static(path);
  errno = kept;
  if (!refused) return false;
  dprintf(STDERR_FILENO, "baraka: %s is statically linked, so its time cannot be slowed\n", path);
  errno = EPERM;
  return true;
}

}  // namespace

BARAKA_EXPORTED int execve(const char* path, char* const arguments[],
                           char* const environment[]) noexcept {
  if (is_refused(path)) return -1;
  return BARAKA_NEXT(execve)(path, arguments, environment);
}

BARAKA_EXPORTED int execv(const char* path, char* const arguments[]) noexcept {
  return execve(path, arguments, environ);
}
