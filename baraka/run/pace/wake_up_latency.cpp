#include "baraka/run/pace/wake_up_latency.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <ctime>

namespace baraka::run::pace {

WakeUpLatency::WakeUpLatency()
    : schedstat_(::open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC)) {}

WakeUpLatency::~WakeUpLatency() {
  if (schedstat_ >= 0) ::close(schedstat_);
}

std::optional<WakeUpLatency::SchedulerTimes> WakeUpLatency::read() const {
  // "<ns on the processor> <ns ready> <turns>"
  std::array<char, 96> text{};
  const ssize_t size = schedstat_ < 0 ? -1 : ::pread(schedstat_, text.data(), text.size(), 0);
  if (size <= 0) return std::nullopt;
  const char* const end = text.data() + size;
  std::int64_t on_processor = 0, ready = 0;
  const auto first = std::from_chars(text.data(), end, on_processor);
  if (first.ec != std::errc{} || first.ptr == end) return std::nullopt;
  if (std::from_chars(first.ptr + 1, end, ready).ec != std::errc{}) return std::nullopt;

  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  timespec ran{};
  rusage usage{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &ran) != 0) return std::nullopt;
  if (::getrusage(RUSAGE_THREAD, &usage) != 0) return std::nullopt;
  return SchedulerTimes{.ready = hal::Duration{ready},
                        .ran = hal::Duration{ran.tv_sec * kNsPerSecond + ran.tv_nsec},
                        .sleeps = usage.ru_nvcsw};
}

void WakeUpLatency::before_wait() { before_ = read(); }

/// The thread became ready when the event arrived. Since then it was either ready or running, so
/// the sum of both is an upper bound; it also includes the time on the way into the wait.
void WakeUpLatency::after_wait() {
  at_most_.reset();
  const std::optional<SchedulerTimes> now = read();
  if (!now || !before_ || now->sleeps == before_->sleeps) return;
  at_most_ = now->ready - before_->ready + now->ran - before_->ran;
}

}  // namespace baraka::run::pace
