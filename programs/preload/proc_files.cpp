// Opening files of /proc that contain times: POSIX.1-2017, <fcntl.h>, <stdio.h>, <unistd.h>. The
// program gets a memory file with the converted text under the same descriptor. As in the kernel,
// the text is made again when it is read from its beginning once more: top(1) keeps /proc/stat
// open.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/proc_text.h"
#include "programs/preload/process_time.h"

namespace {

using programs::preload::ProcessTime;
using programs::preload::ProcFile;

/// Prefix of the memory file's name, followed by the kernel's name of the original.
constexpr const char* kMemory = "baraka:";

/// Bits for descriptors below this number that may be memory files; whether a marked one still is,
/// is checked by its name when it is rewound.
constexpr int kMostMarked = 1024;
constexpr int kBits = 64;
std::array<std::atomic<std::uint64_t>, kMostMarked / kBits> marked;

bool is_marked(int descriptor) {
  if (descriptor < 0 || descriptor >= kMostMarked) return false;
  const std::uint64_t bits =
      marked[static_cast<std::size_t>(descriptor / kBits)].load(std::memory_order_relaxed);
  return (bits >> (descriptor % kBits) & 1U) != 0;
}

void mark(int descriptor) {
  if (descriptor >= kMostMarked) return;
  marked[static_cast<std::size_t>(descriptor / kBits)].fetch_or(
      std::uint64_t{1} << (descriptor % kBits), std::memory_order_relaxed);
}

/// The kernel's name of an open file, terminated by null; empty: it has none.
using Name = std::array<char, 128>;

Name name_of(int descriptor) {
  std::array<char, 32> link{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
  Name name{};
  const ssize_t length = readlink(link.data(), name.data(), name.size() - 1);
  if (length < 0 || static_cast<std::size_t>(length) == name.size() - 1) name[0] = '\0';
  return name;
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> part;
  ssize_t length = 0;
  while ((length = read(descriptor, part.data(), part.size())) != 0) {
    if (length < 0 && errno != EINTR) break;
    if (length > 0) text.append(part.data(), static_cast<std::size_t>(length));
  }
  return text;
}

bool fill(int memory, std::string_view text) {
  return ftruncate(memory, 0) == 0 &&
         pwrite(memory, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

/// Replaces the file of a descriptor by a memory file if it is one of these files; if that fails,
/// the file stays. @param flags  with which it was opened.
int told_in_place_of(int descriptor, int flags) {
  if (descriptor < 0 || (flags & (O_ACCMODE | O_PATH)) != O_RDONLY) return descriptor;
  const int kept = errno;
  const Name name = name_of(descriptor);
  const auto file = programs::preload::proc_file(name.data());
  if (!file) return descriptor;
  const std::string text = programs::preload::as_told(*file, read_all(descriptor));
  const int memory = memfd_create((kMemory + std::string(name.data())).c_str(), MFD_CLOEXEC);
  if (memory >= 0 && !text.empty() && fill(memory, text) &&
      dup3(memory, descriptor, flags & O_CLOEXEC) == descriptor) {
    mark(descriptor);
  } else {
    lseek(descriptor, 0, SEEK_SET);
  }
  if (memory >= 0) close(memory);
  errno = kept;
  return descriptor;
}

/// The path of the file whose text a memory file has, from the kernel's name
/// "/memfd:baraka:/proc/stat (deleted)"; empty: it is not a memory file.
std::string original_of(int memory) {
  const Name name = name_of(memory);
  const std::string_view text = name.data();
  const std::string begin = std::string("/memfd:") + kMemory;
  if (text.substr(0, begin.size()) != begin) return "";
  const std::size_t end = text.find(' ');
  return std::string(text.substr(begin.size(), end - begin.size()));
}

void renew(int descriptor) {
  if (!is_marked(descriptor)) return;
  const int kept = errno;
  const std::string path = original_of(descriptor);
  const auto file = programs::preload::proc_file(path);
  const int original = file ? BARAKA_NEXT(open)(path.c_str(), O_RDONLY | O_CLOEXEC) : -1;
  if (original >= 0) {
    fill(descriptor, programs::preload::as_told(*file, read_all(original)));
    close(original);
  }
  errno = kept;
}

void renew(FILE* stream, long place, int from) {
  if (place == 0 && from == SEEK_SET) renew(fileno(stream));
}

bool is_concerned(const char* path) {
  return path != nullptr && !ProcessTime::get().dilation().is_none() &&
         programs::preload::may_be_proc_file(path);
}

/// Whether open() has a mode argument with these flags.
bool makes_files(int flags) { return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE; }

/// Null: to be opened as usual.
FILE* opened(const char* path, const char* mode) {
  if (!is_concerned(path) || mode == nullptr || mode[0] != 'r' ||
      std::strchr(mode, '+') != nullptr) {
    return nullptr;
  }
  const int flags = O_RDONLY | (std::strchr(mode, 'e') != nullptr ? O_CLOEXEC : 0);
  const int descriptor = told_in_place_of(BARAKA_NEXT(open)(path, flags), flags);
  if (descriptor < 0) return nullptr;
  FILE* const stream = fdopen(descriptor, mode);
  if (stream == nullptr) close(descriptor);
  return stream;
}

}  // namespace

extern "C" {
/// Functions that the GNU C library's headers call if they know the number of arguments
/// (_FORTIFY_SOURCE).
int checked_open(const char* path, int flags) __asm__("__open_2");
int checked_open64(const char* path, int flags) __asm__("__open64_2");
int checked_openat(int folder, const char* path, int flags) __asm__("__openat_2");
int checked_openat64(int folder, const char* path, int flags) __asm__("__openat64_2");
}

/// The mode argument, if the flags require one.
#define BARAKA_RIGHTS(flags)                            \
  mode_t rights = 0;                                    \
  if (makes_files(flags)) {                             \
    va_list list;                                       \
    va_start(list, flags);                              \
    rights = static_cast<mode_t>(va_arg(list, mode_t)); \
    va_end(list);                                       \
  }

BARAKA_EXPORTED int open(const char* path, int flags, ...) {
  BARAKA_RIGHTS(flags)
  const int descriptor = BARAKA_NEXT(open)(path, flags, rights);
  return is_concerned(path) ? told_in_place_of(descriptor, flags) : descriptor;
}

BARAKA_EXPORTED int open64(const char* path, int flags, ...) {
  BARAKA_RIGHTS(flags)
  const int descriptor = BARAKA_NEXT(open64)(path, flags, rights);
  return is_concerned(path) ? told_in_place_of(descriptor, flags) : descriptor;
}

BARAKA_EXPORTED int openat(int folder, const char* path, int flags, ...) {
  BARAKA_RIGHTS(flags)
  const int descriptor = BARAKA_NEXT(openat)(folder, path, flags, rights);
  return is_concerned(path) ? told_in_place_of(descriptor, flags) : descriptor;
}

BARAKA_EXPORTED int openat64(int folder, const char* path, int flags, ...) {
  BARAKA_RIGHTS(flags)
  const int descriptor = BARAKA_NEXT(openat64)(folder, path, flags, rights);
  return is_concerned(path) ? told_in_place_of(descriptor, flags) : descriptor;
}

BARAKA_EXPORTED int checked_open(const char* path, int flags) { return open(path, flags); }

BARAKA_EXPORTED int checked_open64(const char* path, int flags) { return open64(path, flags); }

BARAKA_EXPORTED int checked_openat(int folder, const char* path, int flags) {
  return openat(folder, path, flags);
}

BARAKA_EXPORTED int checked_openat64(int folder, const char* path, int flags) {
  return openat64(folder, path, flags);
}

BARAKA_EXPORTED FILE* fopen(const char* __restrict path, const char* __restrict mode) {
  FILE* const stream = opened(path, mode);
  return stream != nullptr ? stream : BARAKA_NEXT(fopen)(path, mode);
}

BARAKA_EXPORTED FILE* fopen64(const char* __restrict path, const char* __restrict mode) {
  FILE* const stream = opened(path, mode);
  return stream != nullptr ? stream : BARAKA_NEXT(fopen64)(path, mode);
}

BARAKA_EXPORTED off_t lseek(int descriptor, off_t place, int from) noexcept {
  if (place == 0 && from == SEEK_SET) renew(descriptor);
  return BARAKA_NEXT(lseek)(descriptor, place, from);
}

BARAKA_EXPORTED off64_t lseek64(int descriptor, off64_t place, int from) noexcept {
  if (place == 0 && from == SEEK_SET) renew(descriptor);
  return BARAKA_NEXT(lseek64)(descriptor, place, from);
}

BARAKA_EXPORTED void rewind(FILE* stream) {
  renew(stream, 0, SEEK_SET);
  BARAKA_NEXT(rewind)(stream);
}

BARAKA_EXPORTED int fseek(FILE* stream, long place, int from) {
  renew(stream, place, from);
  return BARAKA_NEXT(fseek)(stream, place, from);
}

BARAKA_EXPORTED int fseeko(FILE* stream, off_t place, int from) {
  renew(stream, place, from);
  return BARAKA_NEXT(fseeko)(stream, place, from);
}

BARAKA_EXPORTED int fseeko64(FILE* stream, off64_t place, int from) {
  renew(stream, place, from);
  return BARAKA_NEXT(fseeko64)(stream, place, from);
}
