/* Preloaded into a program: kills it just before its Nth change of a folder, N from KILL_AT. What it
 * has done by then is what a killed program leaves. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static void count(void) {
  static int left = -1;
  if (left < 0) {
    const char *text = getenv("KILL_AT");
    left = text ? atoi(text) : 0;
  }
  if (left > 0 && --left == 0) kill(getpid(), SIGKILL);
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

int rename(const char *from, const char *to) { count(); return NEXT(rename)(from, to); }
int unlink(const char *path) { count(); return NEXT(unlink)(path); }
int rmdir(const char *path) { count(); return NEXT(rmdir)(path); }
int mkdir(const char *path, mode_t mode) { count(); return NEXT(mkdir)(path, mode); }
ssize_t write(int file, const void *from, size_t size) { count(); return NEXT(write)(file, from, size); }
ssize_t pwrite64(int file, const void *from, size_t size, off64_t at) {
  count();
  return NEXT(pwrite64)(file, from, size, at);
}

int open(const char *path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (flags & O_CREAT) count();
  return NEXT(open)(path, flags, mode);
}
