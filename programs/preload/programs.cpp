// Programs that replace a program or are started by it: POSIX.1-2017, <unistd.h>, <spawn.h>. A
// statically linked program would run in wall time unnoticed, so it is refused if time is slowed,
// as baraka refuses it for the programs that it starts. For system() and popen() the C library
// starts a shell; execl() and similar functions do not pass through here.
#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/process_time.h"

namespace {

template <class T>
bool read_at(int file, T& value, std::uint64_t place) {
  return pread(file, &value, sizeof value, static_cast<off_t>(place)) == sizeof value;
}

/// Whether a shared object or position-independent program is marked as a program. The loader
/// itself is not.
bool says_program(int file, const ElfW(Phdr) & dynamic) {
  for (std::size_t i = 0; i < dynamic.p_filesz / sizeof(ElfW(Dyn)); ++i) {
    ElfW(Dyn) entry;
    if (!read_at(file, entry, dynamic.p_offset + i * sizeof entry) || entry.d_tag == DT_NULL) break;
    if (entry.d_tag == DT_FLAGS_1) return (entry.d_un.d_val & DF_1_PIE) != 0;
  }
  return false;
}

/// Whether it is a program without a loader.
bool is_static(int file, const ElfW(Ehdr) & header) {
  bool is_program = header.e_type == ET_EXEC;
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) part;
    if (!read_at(file, part, header.e_phoff + i * header.e_phentsize)) return false;
    if (part.p_type == PT_INTERP) return false;
    if (part.p_type == PT_DYNAMIC) is_program = is_program || says_program(file, part);
  }
  return is_program;
}

/// The first bytes of a file, terminated by null.
using Beginning = std::array<char, 256>;

/// Extracts the interpreter from "#! /path arguments"; null: the file is not a script.
const char* interpreter_in(Beginning& text) {
  constexpr const char* kBlanks = " \t";
  if (text[0] != '#' || text[1] != '!') return nullptr;
  char* const begin = text.data() + 2 + std::strspn(text.data() + 2, kBlanks);
  begin[std::strcspn(begin, " \t\n")] = '\0';
  return *begin == '\0' ? nullptr : begin;
}

bool is_static_elf(int file) {
  ElfW(Ehdr) header;
  return read_at(file, header, 0) && std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
         header.e_ident[EI_CLASS] == (sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32) &&
         is_static(file, header);
}

/// Whether a program for this machine is statically linked; anything else is left to the kernel.
/// For a script, this is decided for the interpreter in its first line. Safe after fork().
bool is_static(const char* path) {
  Beginning text{};
  for (int scripts = 4; path != nullptr && scripts >= 0; --scripts) {  // Linux has the same limit
    const int file = BARAKA_NEXT(open)(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool result = is_static_elf(file);
    text.fill('\0');
    const ssize_t length = result ? -1 : pread(file, text.data(), text.size() - 1, 0);
    close(file);
    if (length < 0) return result;
    path = interpreter_in(text);
  }
  return false;
}

bool is_refused(const char* path) {
  const int kept = errno;
  const bool refused = !programs::preload::ProcessTime::get().dilation().is_none() &&
                       path != nullptr && is_static(path);
  errno = kept;
  if (!refused) return false;
  dprintf(STDERR_FILENO,
          "baraka: %s is statically linked, or run by what is, so its time cannot be slowed\n",
          path);
  errno = EPERM;
  return true;
}

/// For a name as a shell resolves it: the first match in the folders of PATH, unless it has a
/// slash.
bool is_refused_by_name(const char* name) {
  if (name == nullptr || programs::preload::ProcessTime::get().dilation().is_none()) return false;
  if (std::strchr(name, '/') != nullptr) return is_refused(name);
  const char* const path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "/bin:/usr/bin" : path;
  while (*name != '\0' && !folders.empty()) {
    const std::string_view folder = folders.substr(0, folders.find(':'));
    folders.remove_prefix(std::min(folders.size(), folder.size() + 1));
    std::array<char, PATH_MAX> file{};
    const int length =
        std::snprintf(file.data(), file.size(), "%.*s/%s", static_cast<int>(folder.size()),
                      folder.empty() ? "." : folder.data(), name);
    if (length > 0 && static_cast<std::size_t>(length) < file.size() &&
        access(file.data(), X_OK) == 0) {
      return is_refused(file.data());
    }
  }
  return false;
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

BARAKA_EXPORTED int execvpe(const char* name, char* const arguments[],
                            char* const environment[]) noexcept {
  if (is_refused_by_name(name)) return -1;
  return BARAKA_NEXT(execvpe)(name, arguments, environment);
}

BARAKA_EXPORTED int execvp(const char* name, char* const arguments[]) noexcept {
  return execvpe(name, arguments, environ);
}

// POSIX defines six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int posix_spawn(pid_t* __restrict process, const char* __restrict path,
                                const posix_spawn_file_actions_t* __restrict actions,
                                const posix_spawnattr_t* __restrict attributes,
                                char* const arguments[], char* const environment[]) {
  if (is_refused(path)) return EPERM;
  return BARAKA_NEXT(posix_spawn)(process, path, actions, attributes, arguments, environment);
}

// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED int posix_spawnp(pid_t* process, const char* name,
                                 const posix_spawn_file_actions_t* actions,
                                 const posix_spawnattr_t* attributes, char* const arguments[],
                                 char* const environment[]) {
  if (is_refused_by_name(name)) return EPERM;
  return BARAKA_NEXT(posix_spawnp)(process, name, actions, attributes, arguments, environment);
}
