// Timers of POSIX.1-2017, <time.h>: timer_create(2). Of clocks of processor time the kernel's own
// are taken, for programs take no processor time that a timer could measure.
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <limits>
#include <new>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/notification.h"
#include "programs/waits/parking.h"
#include "programs/waits/timers.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::kNever;
using programs::waits::Nanoseconds;
using programs::waits::now;
using programs::waits::own_slot;
using programs::waits::WaitSlot;
using programs::waits::Woken;

struct Timer {
  std::int32_t process;  ///< Whose it is: fork() copies this.
  clockid_t clock;
  WaitSlot* slot;  ///< Of one that sends a signal; null: another one, of which the rest says more.
  Nanoseconds next = kNever, interval = 0;
  void (*function)(sigval) = nullptr;  ///< To be called by a thread of its own.
  sigval value{};
  std::size_t stack = 0;  ///< Of that thread, in bytes; 0: as usual.
  bool is_deleted = false;
};

/// What programs know a timer by is its place here, after this number: the kernel's own count from
/// 0, and the C library's are negative or even more.
constexpr int kFirst = 0x4000'0000;
std::array<Timer*, programs::waits::WaitPage::kSlots> timers;

/// Null: not one of ours.
Timer* timer_of(timer_t given) {
  const auto place = reinterpret_cast<std::uintptr_t>(given) - kFirst;
  if (own_slot() == nullptr || place >= timers.size()) return nullptr;
  Timer* const timer = timers[place];
  return timer != nullptr && timer->process == own_slot()->process.load() ? timer : nullptr;
}

/// A free place; none: timers.size(). Those of the process that this one was copied from are free.
std::size_t free_place() {
  const auto process = own_slot()->process.load();
  std::size_t place = 0;
  while (place < timers.size() && timers[place] != nullptr && timers[place]->process == process)
    ++place;
  return place;
}

bool is_processor_time(clockid_t clock) {
  return clock < 0 || clock == CLOCK_PROCESS_CPUTIME_ID || clock == CLOCK_THREAD_CPUTIME_ID;
}

/// The thread of a timer with a function: parked until it expires or is set anew.
void* serve(void* given) {
  auto& timer = *static_cast<Timer*>(given);
  while (!timer.is_deleted && !programs::waits::is_over()) {
    if (programs::waits::park(programs::waits::object_at(&timer), timer.next) != Woken::kByDeadline)
      continue;
    if (timer.is_deleted || timer.next > now()) continue;
    timer.next = timer.interval > 0 ? timer.next + timer.interval : kNever;
    programs::waits::call_in_thread(timer.function, timer.value, timer.stack);
  }
  if (timer.is_deleted) delete &timer;
  return nullptr;
}

bool is_thread_of_process(pid_t thread) {
  const auto process = own_slot()->process.load();
  return programs::waits::kernel_call(SYS_tgkill, {process, thread, 0, 0, 0, 0}) == 0;
}

/// @return what is wrong with it: an error; 0: nothing.
int complaint(const sigevent& event) {
  switch (event.sigev_notify) {
    case SIGEV_NONE:
      return 0;
    case SIGEV_THREAD:
      return event.sigev_notify_function == nullptr ? EINVAL : 0;
    case SIGEV_THREAD_ID:
      if (!is_thread_of_process(event._sigev_un._tid)) return EINVAL;
      [[fallthrough]];
    case SIGEV_SIGNAL:
      return event.sigev_signo >= 1 && event.sigev_signo < NSIG ? 0 : EINVAL;
    default:
      return EINVAL;
  }
}

void prepare(Timer& timer, const sigevent& event, int number) {
  const bool has_target = event.sigev_notify == SIGEV_THREAD_ID;
  if (event.sigev_notify == SIGEV_SIGNAL || has_target) {
    timer.slot = &programs::waits::new_timer(-1, event.sigev_signo);
    std::uint64_t value = 0;
    std::memcpy(&value, &event.sigev_value, sizeof value);
    timer.slot->value = value;
    timer.slot->timer = number;
    timer.slot->target = has_target ? event._sigev_un._tid : 0;
  } else if (event.sigev_notify == SIGEV_THREAD) {
    timer.function = event.sigev_notify_function;
    timer.value = event.sigev_value;
    timer.stack = programs::waits::stack_of(event);
    programs::waits::start_server(serve, &timer);
  }
}

itimerspec setting_of(Timer& timer) {
  if (timer.slot != nullptr)
    return programs::waits::setting_of(timer.slot->deadline, timer.slot->interval);
  const Nanoseconds past = now() - timer.next;
  if (timer.next != kNever && past >= 0) {
    timer.next =
        timer.interval > 0 ? timer.next + (past / timer.interval + 1) * timer.interval : kNever;
  }
  return programs::waits::setting_of(timer.next, timer.interval);
}

void set(Timer& timer, Nanoseconds next, Nanoseconds interval) {
  if (timer.slot != nullptr) {
    timer.slot->interval = interval;
    timer.slot->deadline = next;
    timer.slot->overruns = 0;
    return;
  }
  timer.interval = interval;
  timer.next = next;
  if (timer.function != nullptr) programs::waits::wake(programs::waits::object_at(&timer), 1);
}

int failed(int error) {
  errno = error;
  return -1;
}

}  // namespace

BARAKA_EXPORTED int timer_create(clockid_t clock, sigevent* __restrict event,
                                 timer_t* __restrict made) noexcept {
  const bool is_ours =
      own_slot() != nullptr && !is_processor_time(clock) && programs::waits::start_of(clock);
  if (!is_ours) return BARAKA_NEXT(timer_create)(clock, event, made);
  const std::size_t place = free_place();
  if (place == timers.size()) return failed(EAGAIN);
  const int number = kFirst + static_cast<int>(place);
  sigevent usual{};
  usual.sigev_notify = SIGEV_SIGNAL;
  usual.sigev_signo = SIGALRM;
  usual.sigev_value.sival_int = number;
  const sigevent& given = event == nullptr ? usual : *event;
  if (const int error = complaint(given); error != 0) return failed(error);
  auto* const timer = new (std::nothrow) Timer{own_slot()->process.load(), clock, nullptr};
  if (timer == nullptr) return failed(EAGAIN);
  timers[place] = timer;
  prepare(*timer, given, number);
  *made = programs::waits::pointer<void>(number);
  return 0;
}

BARAKA_EXPORTED int timer_settime(timer_t given, int flags, const itimerspec* __restrict setting,
                                  itimerspec* __restrict before) noexcept {
  Timer* const timer = timer_of(given);
  if (timer == nullptr) return BARAKA_NEXT(timer_settime)(given, flags, setting, before);
  if (setting == nullptr || !programs::waits::is_time(&setting->it_value) ||
      !programs::waits::is_time(&setting->it_interval)) {
    return failed(EINVAL);
  }
  if (before != nullptr) *before = setting_of(*timer);
  set(*timer,
      programs::waits::first_expiration(setting->it_value, timer->clock,
                                        (flags & TIMER_ABSTIME) != 0),
      programs::waits::nanoseconds(setting->it_interval));
  return 0;
}

BARAKA_EXPORTED int timer_gettime(timer_t given, itimerspec* setting) noexcept {
  Timer* const timer = timer_of(given);
  if (timer == nullptr) return BARAKA_NEXT(timer_gettime)(given, setting);
  *setting = setting_of(*timer);
  return 0;
}

BARAKA_EXPORTED int timer_getoverrun(timer_t given) noexcept {
  const Timer* const timer = timer_of(given);
  if (timer == nullptr) return BARAKA_NEXT(timer_getoverrun)(given);
  if (timer->slot == nullptr) return 0;
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max();  // DELAYTIMER_MAX of Linux
  return static_cast<int>(std::min(timer->slot->overruns.load(), kMost));
}

BARAKA_EXPORTED int timer_delete(timer_t given) noexcept {
  Timer* const timer = timer_of(given);
  if (timer == nullptr) return BARAKA_NEXT(timer_delete)(given);
  timers[reinterpret_cast<std::uintptr_t>(given) - kFirst] = nullptr;
  timer->is_deleted = true;
  if (timer->slot != nullptr) programs::waits::give_back_slot(*timer->slot);
  if (timer->function != nullptr) {
    programs::waits::wake(programs::waits::object_at(timer), 1);
  } else {
    delete timer;
  }
  return 0;
}
