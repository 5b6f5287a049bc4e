#include "programs/preload/process_time.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

#include "programs/preload/intercepted.h"

namespace programs::preload {
namespace {

constexpr const char* kVariable = "BARAKA_DILATION";
constexpr int kWrongEnvironment = 127;

alignas(ProcessTime) std::array<std::byte, sizeof(ProcessTime)> storage;
pthread_once_t once = PTHREAD_ONCE_INIT;

/// Removes and returns the next word, up to a blank.
std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(text.size(), word.size() + 1));
  return word;
}

bool read_number(std::string_view word, Nanoseconds& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

/// Whether a clock is one of processor time, of a process or thread. Clocks of other processes have
/// negative numbers; if the lowest two bits are 3, it is a device's clock
/// (include/linux/posix-timers.h of Linux).
bool is_of_processor(clockid_t clock) {
  constexpr clockid_t kKind = 3, kDevice = 3;
  if (clock < 0) return (clock & kKind) != kDevice;
  return clock == CLOCK_PROCESS_CPUTIME_ID || clock == CLOCK_THREAD_CPUTIME_ID;
}

}  // namespace

Nanoseconds kernel_time(clockid_t clock) {
  timespec now{};
  BARAKA_NEXT(clock_gettime)(clock, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

/// So that programs that never read the time notice an invalid value as well.
__attribute__((constructor)) static void read_environment() { ProcessTime::get(); }

const ProcessTime& ProcessTime::get() {
  pthread_once(&once, [] { new (storage.data()) ProcessTime; });
  return *std::launder(reinterpret_cast<const ProcessTime*>(storage.data()));
}

ProcessTime::ProcessTime() {
  const char* const text = std::getenv(kVariable);
  if (text == nullptr || read(text)) return;
  std::fprintf(stderr,
               "baraka: %s='%s' must be a factor 0.01 .. 1, or a factor and the four clocks' "
               "readings at the origin\n",
               kVariable, text);
  _exit(kWrongEnvironment);
}

bool ProcessTime::read(const char* text) {
  std::string_view rest = text;
  const std::string_view factor = take_word(rest);
  const auto dilation = Dilation::from_text(factor);
  if (!dilation) return false;
  dilation_ = *dilation;
  begin_now();
  if (rest.empty()) {
    hand_on(text);
    return true;
  }
  for (Nanoseconds* const origin : {&monotonic_, &realtime_, &raw_, &boot_}) {
    if (!read_number(take_word(rest), *origin)) return false;
  }
  return rest.empty();
}

void ProcessTime::begin_now() {
  monotonic_ = kernel_time(CLOCK_MONOTONIC);
  realtime_ = kernel_time(CLOCK_REALTIME);
  raw_ = kernel_time(CLOCK_MONOTONIC_RAW);
  boot_ = kernel_time(CLOCK_BOOTTIME);
  const Nanoseconds apart = kernel_time(CLOCK_TAI) - realtime_;
  atomic_ = (apart + kSecond / 2) / kSecond * kSecond;
}

void ProcessTime::hand_on(const char* factor) const {
  std::array<char, 128> text{};
  const int length =
      std::snprintf(text.data(), text.size(), "%s %lld %lld %lld %lld", factor,
                    static_cast<long long>(monotonic_), static_cast<long long>(realtime_),
                    static_cast<long long>(raw_), static_cast<long long>(boot_));
  if (length > 0 && static_cast<std::size_t>(length) < text.size())
    setenv(kVariable, text.data(), 1);
}

std::optional<Nanoseconds> ProcessTime::origin(clockid_t clock) const {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
    case CLOCK_REALTIME_ALARM:
      return realtime_;
    case CLOCK_TAI:
      return realtime_ + atomic_;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_COARSE:
      return monotonic_;
    case CLOCK_MONOTONIC_RAW:
      return raw_;
    case CLOCK_BOOTTIME:
    case CLOCK_BOOTTIME_ALARM:
      return boot_;
    default:
      return is_of_processor(clock) ? std::optional<Nanoseconds>(0) : std::nullopt;
  }
}

Nanoseconds ProcessTime::to_program(Nanoseconds kernel, clockid_t clock) const {
  const auto begin = origin(clock);
  return begin && kernel > *begin ? dilation_.to_program(kernel, *begin) : kernel;
}

Nanoseconds ProcessTime::to_kernel(Nanoseconds program, clockid_t clock) const {
  const auto begin = origin(clock);
  return begin && program > *begin ? dilation_.to_kernel(program, *begin) : program;
}

}  // namespace programs::preload
