// Timers: POSIX.1-2017, <sys/time.h>, <unistd.h>; timerfd_create(2). The run lets them expire: it
// writes to an eventfd(2) that stands in for the timer, or sends the signal.
#include "programs/waits/timers.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/ports.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::kNever;
using programs::waits::Nanoseconds;
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

/// The timers of descriptors that this process has made or has by fork(), which copies this. It
/// takes a slot for the latter when it asks for them first. Those beyond are of their maker alone.
struct Known {
  std::uint64_t timer = 0;  ///< WaitSlot::value; 0: none.
  int descriptor = -1;
  clockid_t clock = CLOCK_MONOTONIC;
};
std::array<Known, 64> known;

void note(const Known& one) {
  const auto free = std::ranges::find(known, std::uint64_t{0}, &Known::timer);
  if (free != known.end()) *free = one;
}

void forget_timer(int descriptor) {
  const auto one = std::ranges::find(known, descriptor, &Known::descriptor);
  if (one != known.end()) *one = {};
}

/// The slot of this process's timer of a descriptor; null: there is none.
WaitSlot* timer_of_descriptor(int descriptor) {
  if (own_slot() == nullptr) return nullptr;
  if (WaitSlot* const timer = timer_of(descriptor, 0); timer != nullptr) return timer;
  const auto inherited = std::ranges::find(known, descriptor, &Known::descriptor);
  if (inherited == known.end()) return nullptr;
  WaitSlot& timer = programs::waits::new_timer(descriptor, 0);
  timer.thread = inherited->clock;
  timer.value = inherited->timer;
  return &timer;
}

/// Another slot of a timer of a descriptor, in another process that has it by fork(), too.
bool is_same_timer(const WaitSlot& one, const WaitSlot& other) {
  return &one != &other && one.state.load() == SlotState::kTimer && one.descriptor.load() >= 0 &&
         one.value.load() == other.value.load();
}

template <class Function>
void for_each_same(const WaitSlot& timer, const Function& function) {
  for (std::uint32_t i = 0; i < programs::waits::page()->used.load(); ++i) {
    WaitSlot& slot = programs::waits::page()->slots[i];
    if (is_same_timer(slot, timer)) function(slot);
  }
}

void set(WaitSlot& timer, Nanoseconds deadline, Nanoseconds interval) {
  timer.interval = interval;
  timer.deadline = deadline;
}

/// Of the one that is set. A timer has a slot in each process, of which at most one is.
itimerspec setting_of_shared(const WaitSlot& timer) {
  const WaitSlot* is_set = &timer;
  for_each_same(timer, [&](const WaitSlot& slot) {
    if (slot.deadline.load() != kNever) is_set = &slot;
  });
  return programs::waits::setting_of(is_set->deadline.load(), is_set->interval.load());
}

itimerspec setting_of(const WaitSlot* timer) {
  if (timer == nullptr) return {};
  return programs::waits::setting_of(timer->deadline.load(), timer->interval.load());
}

timeval to_timeval(Nanoseconds time) {
  const timespec whole = to_timespec(time);
  return {whole.tv_sec, whole.tv_nsec / 1000};
}

Nanoseconds nanoseconds(const timeval& time) {
  return time.tv_sec * programs::waits::kSecond + time.tv_usec * 1000;
}

/// The clock of a timer is kept in its slot.
clockid_t clock_of(const WaitSlot& timer) { return static_cast<clockid_t>(timer.thread.load()); }

}  // namespace

namespace programs::waits {

WaitSlot& new_timer(int descriptor, int signal) {
  WaitSlot& slot = take_slot(SlotState::kTimer);
  slot.descriptor = descriptor;
  slot.signal = signal;
  slot.process = own_slot()->process.load();
  return slot;
}

Nanoseconds first_expiration(const timespec& value, clockid_t clock, bool is_moment) {
  if (value.tv_sec == 0 && value.tv_nsec == 0) return kNever;
  return is_moment ? deadline_at(&value, clock) : deadline_in(&value);
}

itimerspec setting_of(Nanoseconds next, Nanoseconds interval) {
  const Nanoseconds left = next == kNever ? 0 : std::max<Nanoseconds>(1, next - now());
  return {to_timespec(interval), to_timespec(left)};
}

void close_timer(int descriptor) {
  forget_timer(descriptor);
  WaitSlot* const timer = own_slot() == nullptr ? nullptr : timer_of(descriptor, 0);
  if (timer == nullptr) return;
  netns::hand_over(*timer, page()->slots);
  give_back_slot(*timer);
}

}  // namespace programs::waits

using programs::waits::new_timer;

BARAKA_EXPORTED int timerfd_create(clockid_t clock, int flags) noexcept {
  if (own_slot() == nullptr || !programs::waits::start_of(clock)) {
    return BARAKA_NEXT(timerfd_create)(clock, flags);
  }
  const int of_event = ((flags & TFD_NONBLOCK) != 0 ? EFD_NONBLOCK : 0) |
                       ((flags & TFD_CLOEXEC) != 0 ? EFD_CLOEXEC : 0);
  const int descriptor = eventfd(0, of_event);
  if (descriptor < 0) return descriptor;
  programs::waits::close_timer(descriptor);  // by a way that is not known
  WaitSlot& timer = new_timer(descriptor, 0);
  timer.thread = clock;
  timer.value = programs::waits::page()->tickets.fetch_add(1) + 1;
  note({timer.value.load(), descriptor, clock});
  return descriptor;
}

BARAKA_EXPORTED int timerfd_settime(int descriptor, int flags, const itimerspec* setting,
                                    itimerspec* before) noexcept {
  WaitSlot* const timer = timer_of_descriptor(descriptor);
  if (timer == nullptr || setting == nullptr) {
    return BARAKA_NEXT(timerfd_settime)(descriptor, flags, setting, before);
  }
  if (!programs::waits::is_time(&setting->it_value) ||
      !programs::waits::is_time(&setting->it_interval)) {
    errno = EINVAL;
    return -1;
  }
  if (before != nullptr) *before = setting_of_shared(*timer);
  std::uint64_t expirations = 0;
  pollfd one{descriptor, POLLIN, 0};
  const timespec no_time{0, 0};
  if (BARAKA_NEXT(ppoll)(&one, 1, &no_time, nullptr) > 0) {  // those before are forgotten
    (void)!BARAKA_NEXT(read)(descriptor, &expirations, sizeof expirations);
  }
  for_each_same(*timer, [](WaitSlot& slot) { set(slot, kNever, 0); });
  set(*timer,
      programs::waits::first_expiration(setting->it_value, clock_of(*timer),
                                        (flags & TFD_TIMER_ABSTIME) != 0),
      programs::waits::nanoseconds(setting->it_interval));
  return 0;
}

BARAKA_EXPORTED int timerfd_gettime(int descriptor, itimerspec* setting) noexcept {
  const WaitSlot* const timer = timer_of_descriptor(descriptor);
  if (timer == nullptr) return BARAKA_NEXT(timerfd_gettime)(descriptor, setting);
  *setting = setting_of_shared(*timer);
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
