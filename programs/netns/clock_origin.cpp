#include "programs/netns/clock_origin.h"

#include <fmt/format.h>

#include <ctime>

namespace programs::netns {

std::string dilation_from_now(double factor) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  std::string text = fmt::format("{:.9f}", factor);
  for (const clockid_t clock :
       {CLOCK_MONOTONIC, CLOCK_REALTIME, CLOCK_MONOTONIC_RAW, CLOCK_BOOTTIME}) {
    timespec now{};
    clock_gettime(clock, &now);
    text += fmt::format(" {}", now.tv_sec * kSecond + now.tv_nsec);
  }
  return text;
}

}  // namespace programs::netns
