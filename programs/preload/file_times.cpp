// Times of files: POSIX.1-2017, <sys/stat.h>, <utime.h>, <sys/time.h>; statx(2).
//
// The kernel stamps files with its own time, which is converted for the program by the same rule
// for all files. So newer files stay newer, and a file just written has the present time. A time
// that a program sets is converted such that it reads the same again.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <utime.h>

#include <array>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

namespace {

using programs::preload::ForKernel;
using programs::preload::is_time;
using programs::preload::ProcessTime;

/// For timespec or statx_timestamp. Times before 1970 are not converted, because no run began
/// before.
template <class Moment>
void convert(Moment& moment) {
  const timespec kernel{moment.tv_sec, static_cast<long>(moment.tv_nsec)};
  if (!is_time(&kernel)) return;
  const timespec told = programs::preload::to_timespec(
      ProcessTime::get().to_program(programs::preload::nanoseconds(kernel), CLOCK_REALTIME));
  moment.tv_sec = told.tv_sec;
  moment.tv_nsec = static_cast<decltype(moment.tv_nsec)>(told.tv_nsec);
}

/// Converts the times of a file. @param status  of the call. @param file  stat or stat64.
template <class File>
int told(int status, File& file) {
  if (status != 0 || ProcessTime::get().dilation().is_none()) return status;
  convert(file.st_atim);
  convert(file.st_mtim);
  convert(file.st_ctim);
  return status;
}

/// The time stamps for a file: null stands for now and stays null. The two special numbers of
/// nanoseconds for 'now' and 'unchanged' stay as well.
class Stamps {
 public:
  explicit Stamps(const timespec* given) {
    if (given != nullptr) set({given[0], given[1]});
  }
  explicit Stamps(const timeval* given) {
    if (given != nullptr) set({of(given[0]), of(given[1])});
  }
  explicit Stamps(const utimbuf* given) {
    if (given != nullptr) set({timespec{given->actime, 0}, timespec{given->modtime, 0}});
  }
  const timespec* get() const { return is_given_ ? kernel_.data() : nullptr; }

 private:
  static timespec of(const timeval& time) { return {time.tv_sec, time.tv_usec * 1000}; }
  void set(const std::array<timespec, 2>& given) {
    is_given_ = true;
    for (std::size_t i = 0; i < given.size(); ++i) {
      kernel_[i] = *ForKernel::moment(&given[i], CLOCK_REALTIME).get();
    }
  }

  std::array<timespec, 2> kernel_{};
  bool is_given_ = false;
};

}  // namespace

BARAKA_EXPORTED int stat(const char* __restrict path, struct stat* __restrict file) noexcept {
  return told(BARAKA_NEXT(stat)(path, file), *file);
}

BARAKA_EXPORTED int stat64(const char* __restrict path, struct stat64* __restrict file) noexcept {
  return told(BARAKA_NEXT(stat64)(path, file), *file);
}

BARAKA_EXPORTED int lstat(const char* __restrict path, struct stat* __restrict file) noexcept {
  return told(BARAKA_NEXT(lstat)(path, file), *file);
}

BARAKA_EXPORTED int lstat64(const char* __restrict path, struct stat64* __restrict file) noexcept {
  return told(BARAKA_NEXT(lstat64)(path, file), *file);
}

BARAKA_EXPORTED int fstat(int descriptor, struct stat* file) noexcept {
  return told(BARAKA_NEXT(fstat)(descriptor, file), *file);
}

BARAKA_EXPORTED int fstat64(int descriptor, struct stat64* file) noexcept {
  return told(BARAKA_NEXT(fstat64)(descriptor, file), *file);
}

BARAKA_EXPORTED int fstatat(int folder, const char* __restrict path, struct stat* __restrict file,
                            int flags) noexcept {
  return told(BARAKA_NEXT(fstatat)(folder, path, file, flags), *file);
}

BARAKA_EXPORTED int fstatat64(int folder, const char* __restrict path,
                              struct stat64* __restrict file, int flags) noexcept {
  return told(BARAKA_NEXT(fstatat64)(folder, path, file, flags), *file);
}

extern "C" {
/// Functions that programs call that were linked with a GNU C library before 2.33. The first
/// argument is the version of the structure; machines with 64 bits have only one.
int old_stat(int version, const char* path, struct stat* file) __asm__("__xstat");
int old_stat64(int version, const char* path, struct stat64* file) __asm__("__xstat64");
int old_lstat(int version, const char* path, struct stat* file) __asm__("__lxstat");
int old_lstat64(int version, const char* path, struct stat64* file) __asm__("__lxstat64");
int old_fstat(int version, int descriptor, struct stat* file) __asm__("__fxstat");
int old_fstat64(int version, int descriptor, struct stat64* file) __asm__("__fxstat64");
int old_fstatat(int version, int folder, const char* path, struct stat* file,
                int flags) __asm__("__fxstatat");
int old_fstatat64(int version, int folder, const char* path, struct stat64* file,
                  int flags) __asm__("__fxstatat64");
}

BARAKA_EXPORTED int old_stat(int, const char* path, struct stat* file) { return stat(path, file); }

BARAKA_EXPORTED int old_stat64(int, const char* path, struct stat64* file) {
  return stat64(path, file);
}

BARAKA_EXPORTED int old_lstat(int, const char* path, struct stat* file) {
  return lstat(path, file);
}

BARAKA_EXPORTED int old_lstat64(int, const char* path, struct stat64* file) {
  return lstat64(path, file);
}

BARAKA_EXPORTED int old_fstat(int, int descriptor, struct stat* file) {
  return fstat(descriptor, file);
}

BARAKA_EXPORTED int old_fstat64(int, int descriptor, struct stat64* file) {
  return fstat64(descriptor, file);
}

BARAKA_EXPORTED int old_fstatat(int, int folder, const char* path, struct stat* file, int flags) {
  return fstatat(folder, path, file, flags);
}

BARAKA_EXPORTED int old_fstatat64(int, int folder, const char* path, struct stat64* file,
                                  int flags) {
  return fstatat64(folder, path, file, flags);
}

BARAKA_EXPORTED int statx(int folder, const char* __restrict path, int flags, unsigned mask,
                          struct statx* __restrict file) noexcept {
  const int status = BARAKA_NEXT(statx)(folder, path, flags, mask, file);
  if (status != 0 || ProcessTime::get().dilation().is_none()) return status;
  convert(file->stx_atime);
  convert(file->stx_btime);
  convert(file->stx_ctime);
  convert(file->stx_mtime);
  return status;
}

BARAKA_EXPORTED int utimensat(int folder, const char* path, const timespec times[2],
                              int flags) noexcept {
  return BARAKA_NEXT(utimensat)(folder, path, Stamps(times).get(), flags);
}

BARAKA_EXPORTED int futimens(int descriptor, const timespec times[2]) noexcept {
  return BARAKA_NEXT(futimens)(descriptor, Stamps(times).get());
}

// These have no nanoseconds, which the kernel's time for a program's microsecond can have.

BARAKA_EXPORTED int utime(const char* path, const utimbuf* times) noexcept {
  return BARAKA_NEXT(utimensat)(AT_FDCWD, path, Stamps(times).get(), 0);
}

BARAKA_EXPORTED int utimes(const char* path, const timeval times[2]) noexcept {
  return BARAKA_NEXT(utimensat)(AT_FDCWD, path, Stamps(times).get(), 0);
}

BARAKA_EXPORTED int lutimes(const char* path, const timeval times[2]) noexcept {
  return BARAKA_NEXT(utimensat)(AT_FDCWD, path, Stamps(times).get(), AT_SYMLINK_NOFOLLOW);
}

BARAKA_EXPORTED int futimes(int descriptor, const timeval times[2]) noexcept {
  return BARAKA_NEXT(futimens)(descriptor, Stamps(times).get());
}

BARAKA_EXPORTED int futimesat(int folder, const char* path, const timeval times[2]) noexcept {
  if (path == nullptr) return futimes(folder, times);
  return BARAKA_NEXT(utimensat)(folder, path, Stamps(times).get(), 0);
}
