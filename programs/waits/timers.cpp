// Timers: POSIX.1-2017, <sys/time.h>, <unistd.h>; timerfd_create(2). The run lets them expire: it
// writes to an eventfd(2) that stands in for the timer, or sends the signal.
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/ports.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::kNever;
using programs::waits::Nanoseconds;
using programs::waits::now;
using programs::waits::own_slot;
using programs::waits::SlotState;
using programs::waits::to_timespec;
using programs::waits::WaitSlot;

/// The slot of this process's timer of a descriptor or signal; null: there is none.
WaitSlot* timer_of(int descriptor, int signal) {
  const auto process = own_slot()->process.load();
  for (std::uint32_t i = 0; i < programs::waits::page()->used.load(); ++i) {
    WaitSlot& slot = programs::waits::page()->slots[i];
    if (slot.state.load() == SlotState::kTimer && slot.process.load() == process &&
        slot.descriptor.load() == descriptor && slot.signal.load() == signal) {
      return &slot;
    }
  }
  return nullptr;
}

WaitSlot& new_timer(int descriptor, int signal) {
  WaitSlot& slot = programs::waits::take_slot(SlotState::kTimer);
  slot.deadline = kNever;
  slot.descriptor = descriptor;
  slot.signal = signal;
  slot.process = own_slot()->process.load();
  return slot;
}

Nanoseconds left_of(const WaitSlot* timer) {
  const Nanoseconds deadline = timer == nullptr ? kNever : timer->deadline.load();
  return deadline == kNever ? 0 : std::max<Nanoseconds>(1, deadline - now());
}

itimerspec setting_of(const WaitSlot* timer) {
  if (timer == nullptr) return {};
  return {to_timespec(timer->interval.load()), to_timespec(left_of(timer))};
}

timeval to_timeval(Nanoseconds time) {
  const timespec whole = to_timespec(time);
  return {whole.tv_sec, whole.tv_nsec / 1000};
}

Nanoseconds nanoseconds(const timeval& time) {
  return time.tv_sec * programs::waits::kSecond + time.tv_usec * 1000;
}

/// The run would write to whatever has the number of a timer that was closed.
void forget_timer(int descriptor) {
  if (own_slot() == nullptr || descriptor < 0) return;
  WaitSlot* const timer = timer_of(descriptor, 0);
  if (timer != nullptr) programs::waits::give_back_slot(*timer);
}

/// The clock of a timer is kept in its slot.
clockid_t clock_of(const WaitSlot& timer) { return static_cast<clockid_t>(timer.thread.load()); }

}  // namespace

BARAKA_EXPORTED int timerfd_create(clockid_t clock, int flags) noexcept {
  if (own_slot() == nullptr || !programs::waits::start_of(clock)) {
    return BARAKA_NEXT(timerfd_create)(clock, flags);
  }
  const int of_event = ((flags & TFD_NONBLOCK) != 0 ? EFD_NONBLOCK : 0) |
                       ((flags & TFD_CLOEXEC) != 0 ? EFD_CLOEXEC : 0);
  const int descriptor = eventfd(0, of_event);
  if (descriptor < 0) return descriptor;
  forget_timer(descriptor);
  new_timer(descriptor, 0).thread = clock;
  return descriptor;
}

BARAKA_EXPORTED int close(int descriptor) {
  forget_timer(descriptor);
  programs::waits::forget(descriptor);
  return BARAKA_NEXT(close)(descriptor);
}

BARAKA_EXPORTED int dup2(int from, int to) noexcept {
  if (from != to) forget_timer(to);
  return BARAKA_NEXT(dup2)(from, to);
}

BARAKA_EXPORTED int dup3(int from, int to, int flags) noexcept {
  if (from != to) forget_timer(to);
  return BARAKA_NEXT(dup3)(from, to, flags);
}

BARAKA_EXPORTED int timerfd_settime(int descriptor, int flags, const itimerspec* setting,
                                    itimerspec* before) noexcept {
  WaitSlot* const timer = own_slot() == nullptr ? nullptr : timer_of(descriptor, 0);
  if (timer == nullptr || setting == nullptr) {
    return BARAKA_NEXT(timerfd_settime)(descriptor, flags, setting, before);
  }
  if (!programs::waits::is_time(&setting->it_value) ||
      !programs::waits::is_time(&setting->it_interval)) {
    errno = EINVAL;
    return -1;
  }
  if (before != nullptr) *before = setting_of(timer);
  std::uint64_t expirations = 0;
  pollfd one{descriptor, POLLIN, 0};
  const timespec no_time{0, 0};
  if (BARAKA_NEXT(ppoll)(&one, 1, &no_time, nullptr) > 0) {  // those before are forgotten
    (void)!BARAKA_NEXT(read)(descriptor, &expirations, sizeof expirations);
  }
  timer->interval = programs::waits::nanoseconds(setting->it_interval);
  const bool is_armed = setting->it_value.tv_sec != 0 || setting->it_value.tv_nsec != 0;
  const bool is_moment = (flags & TFD_TIMER_ABSTIME) != 0;
  const Nanoseconds first = is_moment
                                ? programs::waits::deadline_at(&setting->it_value, clock_of(*timer))
                                : programs::waits::deadline_in(&setting->it_value);
  timer->deadline = is_armed ? std::max(first, now() + 1) : kNever;
  return 0;
}

BARAKA_EXPORTED int timerfd_gettime(int descriptor, itimerspec* setting) noexcept {
  const WaitSlot* const timer = own_slot() == nullptr ? nullptr : timer_of(descriptor, 0);
  if (timer == nullptr) return BARAKA_NEXT(timerfd_gettime)(descriptor, setting);
  *setting = setting_of(timer);
  return 0;
}

BARAKA_EXPORTED int setitimer(__itimer_which_t which, const itimerval* __restrict setting,
                              itimerval* __restrict before) noexcept {
  if (own_slot() == nullptr || which != ITIMER_REAL || setting == nullptr) {
    return BARAKA_NEXT(setitimer)(which, setting, before);
  }
  WaitSlot* timer = timer_of(-1, SIGALRM);
  if (before != nullptr) {
    const itimerspec old = setting_of(timer);
    *before = {to_timeval(programs::waits::nanoseconds(old.it_interval)),
               to_timeval(programs::waits::nanoseconds(old.it_value))};
  }
  const Nanoseconds first = nanoseconds(setting->it_value);
  if (timer == nullptr && first == 0) return 0;
  if (timer == nullptr) timer = &new_timer(-1, SIGALRM);
  timer->interval = nanoseconds(setting->it_interval);
  timer->deadline = first == 0 ? kNever : programs::waits::deadline_in(first);
  return 0;
}

BARAKA_EXPORTED int getitimer(__itimer_which_t which, itimerval* setting) noexcept {
  if (own_slot() == nullptr || which != ITIMER_REAL) return BARAKA_NEXT(getitimer)(which, setting);
  const itimerspec now_set = setting_of(timer_of(-1, SIGALRM));
  *setting = {to_timeval(programs::waits::nanoseconds(now_set.it_interval)),
              to_timeval(programs::waits::nanoseconds(now_set.it_value))};
  return 0;
}

/// What is left is rounded to seconds as Linux does, up from 0.
BARAKA_EXPORTED unsigned alarm(unsigned seconds) noexcept {
  const itimerval setting{{}, {static_cast<time_t>(seconds), 0}};
  itimerval before{};
  if (setitimer(ITIMER_REAL, &setting, &before) != 0) return 0;
  const auto left = static_cast<unsigned>(before.it_value.tv_sec);
  const bool rounds_up = before.it_value.tv_usec >= 500'000;
  return rounds_up || (left == 0 && before.it_value.tv_usec > 0) ? left + 1 : left;
}
