// Timers: POSIX.1-2017, <time.h>, <sys/time.h>, <unistd.h>; timerfd_create(2).
#include <fcntl.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

namespace {

using programs::preload::for_program;
using programs::preload::ForKernel;
using programs::preload::is_time;
using programs::preload::kSecond;
using programs::preload::Nanoseconds;
using programs::preload::ProcessTime;

/// Converts a setting: the first expiry at a time of this clock, or after a duration, and the
/// period.
itimerspec for_kernel(const itimerspec& setting, std::optional<clockid_t> moment_of) {
  // Zero disarms the timer, also if it is a point in time.
  const bool is_armed = setting.it_value.tv_sec != 0 || setting.it_value.tv_nsec != 0;
  const auto first = moment_of && is_armed ? ForKernel::moment(&setting.it_value, *moment_of)
                                           : ForKernel::duration(&setting.it_value);
  return {*ForKernel::duration(&setting.it_interval).get(), *first.get()};
}

itimerspec told_to_program(const itimerspec& setting) {
  return {for_program(setting.it_interval), for_program(setting.it_value)};
}

/// The clock of a timer descriptor, as shown in /proc.
std::optional<clockid_t> clock_of_descriptor(int descriptor) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "/proc/self/fdinfo/%d", descriptor);
  const int file = open(name.data(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  std::array<char, 512> text{};
  const ssize_t length = read(file, text.data(), text.size() - 1);
  close(file);
  constexpr const char* kKey = "clockid: ";
  const char* const found = length > 0 ? std::strstr(text.data(), kKey) : nullptr;
  if (found == nullptr) return std::nullopt;
  return static_cast<clockid_t>(std::strtol(found + std::strlen(kKey), nullptr, 10));
}

/// The clocks of this process's timers, which no function returns. Never destroyed, because timers
/// can exist longer.
std::mutex timers_mutex;
std::map<timer_t, clockid_t>* clocks_of_timers = nullptr;

void add(timer_t timer, clockid_t clock) {
  const std::lock_guard lock(timers_mutex);
  if (clocks_of_timers == nullptr) clocks_of_timers = new std::map<timer_t, clockid_t>;
  (*clocks_of_timers)[timer] = clock;
}

void remove(timer_t timer) {
  const std::lock_guard lock(timers_mutex);
  if (clocks_of_timers != nullptr) clocks_of_timers->erase(timer);
}

clockid_t clock_of_timer(timer_t timer) {
  const std::lock_guard lock(timers_mutex);
  if (clocks_of_timers == nullptr) return CLOCK_REALTIME;
  const auto found = clocks_of_timers->find(timer);
  return found == clocks_of_timers->end() ? CLOCK_REALTIME : found->second;
}

itimerval for_kernel(const itimerval& setting) {
  const auto one = [](const timeval& time) {
    if (!is_time(&time)) return time;
    const Nanoseconds kernel =
        ProcessTime::get().dilation().to_kernel(programs::preload::nanoseconds(time));
    return programs::preload::to_timeval_up(kernel);
  };
  return {one(setting.it_interval), one(setting.it_value)};
}

itimerval told_to_program(const itimerval& setting) {
  return {for_program(setting.it_interval), for_program(setting.it_value)};
}

timeval to_time(useconds_t microseconds) {
  constexpr useconds_t kMillion = 1'000'000;
  return {microseconds / kMillion, microseconds % kMillion};
}

}  // namespace

BARAKA_EXPORTED int timerfd_settime(int timer, int flags, const itimerspec* setting,
                                    itimerspec* before) noexcept {
  std::optional<clockid_t> moment_of;
  if ((flags & TFD_TIMER_ABSTIME) != 0) moment_of = clock_of_descriptor(timer);
  if (setting == nullptr) return BARAKA_NEXT(timerfd_settime)(timer, flags, setting, before);
  const itimerspec kernel = for_kernel(*setting, moment_of);
  const int status = BARAKA_NEXT(timerfd_settime)(timer, flags, &kernel, before);
  if (status == 0 && before != nullptr) *before = told_to_program(*before);
  return status;
}

BARAKA_EXPORTED int timerfd_gettime(int timer, itimerspec* setting) noexcept {
  const int status = BARAKA_NEXT(timerfd_gettime)(timer, setting);
  if (status == 0) *setting = told_to_program(*setting);
  return status;
}

BARAKA_EXPORTED int timer_create(clockid_t clock, sigevent* __restrict event,
                                 timer_t* __restrict timer) noexcept {
  const int status = BARAKA_NEXT(timer_create)(clock, event, timer);
  if (status == 0) add(*timer, clock);
  return status;
}

BARAKA_EXPORTED int timer_delete(timer_t timer) noexcept {
  remove(timer);
  return BARAKA_NEXT(timer_delete)(timer);
}

BARAKA_EXPORTED int timer_settime(timer_t timer, int flags, const itimerspec* __restrict setting,
                                  itimerspec* __restrict before) noexcept {
  const auto next = BARAKA_NEXT(timer_settime);
  const clockid_t clock = clock_of_timer(timer);
  if (setting == nullptr || !ProcessTime::get().origin(clock)) {
    return next(timer, flags, setting, before);
  }
  std::optional<clockid_t> moment_of;
  if ((flags & TIMER_ABSTIME) != 0) moment_of = clock;
  const itimerspec kernel = for_kernel(*setting, moment_of);
  const int status = next(timer, flags, &kernel, before);
  if (status == 0 && before != nullptr) *before = told_to_program(*before);
  return status;
}

BARAKA_EXPORTED int timer_gettime(timer_t timer, itimerspec* setting) noexcept {
  const int status = BARAKA_NEXT(timer_gettime)(timer, setting);
  if (status == 0 && ProcessTime::get().origin(clock_of_timer(timer))) {
    *setting = told_to_program(*setting);
  }
  return status;
}

BARAKA_EXPORTED int setitimer(__itimer_which_t which, const itimerval* __restrict setting,
                              itimerval* __restrict before) noexcept {
  if (setting == nullptr) return BARAKA_NEXT(setitimer)(which, setting, before);
  const itimerval kernel = for_kernel(*setting);
  const int status = BARAKA_NEXT(setitimer)(which, &kernel, before);
  if (status == 0 && before != nullptr) *before = told_to_program(*before);
  return status;
}

BARAKA_EXPORTED int getitimer(__itimer_which_t which, itimerval* setting) noexcept {
  const int status = BARAKA_NEXT(getitimer)(which, setting);
  if (status == 0) *setting = told_to_program(*setting);
  return status;
}

/// On Linux this is the timer ITIMER_REAL; the remaining time is rounded to seconds as in Linux,
/// but up if it is less than one.
BARAKA_EXPORTED unsigned alarm(unsigned seconds) noexcept {
  const itimerval setting{{}, {static_cast<time_t>(seconds), 0}};
  itimerval before{};
  if (setitimer(ITIMER_REAL, &setting, &before) != 0) return 0;
  const auto left = static_cast<unsigned>(before.it_value.tv_sec);
  const bool rounds_up = before.it_value.tv_usec >= 500'000;
  return rounds_up || (left == 0 && before.it_value.tv_usec > 0) ? left + 1 : left;
}

BARAKA_EXPORTED useconds_t ualarm(useconds_t first, useconds_t interval) noexcept {
  const itimerval setting{to_time(interval), to_time(first)};
  itimerval before{};
  if (setitimer(ITIMER_REAL, &setting, &before) != 0) return static_cast<useconds_t>(-1);
  return static_cast<useconds_t>(before.it_value.tv_sec * 1'000'000 + before.it_value.tv_usec);
}
