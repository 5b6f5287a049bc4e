// Waits for signals, and signals that are sent: POSIX.1-2017, <signal.h>, <unistd.h>; tgkill(2).
#include "programs/waits/signals.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/cancellation.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::KernelWait;
using programs::waits::kNever;
using programs::waits::own_slot;

constexpr timespec kNoTime{0, 0};

}  // namespace

namespace programs::waits {

OpenToEnd::OpenToEnd() {
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, kEndWait);
  pthread_sigmask(SIG_UNBLOCK, &one, &before_);
}

OpenToEnd::~OpenToEnd() {
  const int kept = errno;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  errno = kept;
}

long told(long status) {
  if (own_slot() == nullptr) return status;
  const int kept = errno;
  page()->signals.fetch_add(1);
  give_turn_away();
  errno = kept;
  return status;
}

}  // namespace programs::waits

BARAKA_EXPORTED int sigtimedwait(const sigset_t* __restrict signals, siginfo_t* __restrict info,
                                 const timespec* __restrict timeout) {
  const auto next = BARAKA_NEXT(sigtimedwait);
  if (own_slot() == nullptr) return next(signals, info, timeout);
  const int at_once = next(signals, info, &kNoTime);
  if (at_once >= 0 || errno != EAGAIN) return at_once;
  const programs::waits::OpenToEnd open;
  KernelWait wait(programs::waits::deadline_in(timeout));
  const int signal = BARAKA_NEXT(sigwaitinfo)(signals, info);
  wait.end();
  if (signal < 0) programs::waits::cancellation_point();
  if (signal < 0 && wait.has_expired()) errno = EAGAIN;
  return signal;
}

BARAKA_EXPORTED int sigwaitinfo(const sigset_t* __restrict signals, siginfo_t* __restrict info) {
  if (own_slot() == nullptr) return BARAKA_NEXT(sigwaitinfo)(signals, info);
  return sigtimedwait(signals, info, nullptr);
}

BARAKA_EXPORTED int sigwait(const sigset_t* __restrict signals, int* __restrict signal) {
  if (own_slot() == nullptr) return BARAKA_NEXT(sigwait)(signals, signal);
  int found = -1;
  do {
    found = sigtimedwait(signals, nullptr, nullptr);
  } while (found < 0 && errno == EINTR);
  if (found < 0) return errno;
  *signal = found;
  return 0;
}

BARAKA_EXPORTED int pause() {
  if (own_slot() == nullptr) return BARAKA_NEXT(pause)();
  KernelWait wait(kNever);
  const int status = BARAKA_NEXT(pause)();
  wait.end();
  programs::waits::cancellation_point();
  return status;
}

BARAKA_EXPORTED int sigsuspend(const sigset_t* signals) {
  if (own_slot() == nullptr) return BARAKA_NEXT(sigsuspend)(signals);
  KernelWait wait(kNever);
  const int status = BARAKA_NEXT(sigsuspend)(signals);
  wait.end();
  programs::waits::cancellation_point();
  return status;
}

namespace {

int told(int status) { return static_cast<int>(programs::waits::told(status)); }

}  // namespace

BARAKA_EXPORTED int kill(pid_t process, int signal) noexcept {
  return told(BARAKA_NEXT(kill)(process, signal));
}

BARAKA_EXPORTED int killpg(pid_t group, int signal) noexcept {
  return told(BARAKA_NEXT(killpg)(group, signal));
}

BARAKA_EXPORTED int tgkill(pid_t process, pid_t thread, int signal) {
  return told(BARAKA_NEXT(tgkill)(process, thread, signal));
}

BARAKA_EXPORTED int pthread_kill(pthread_t thread, int signal) noexcept {
  return told(BARAKA_NEXT(pthread_kill)(thread, signal));
}

BARAKA_EXPORTED int sigqueue(pid_t process, int signal, const sigval value) noexcept {
  return told(BARAKA_NEXT(sigqueue)(process, signal, value));
}
