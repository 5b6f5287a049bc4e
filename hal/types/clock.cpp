#include "hal/types/clock.h"

namespace hal {

int poll_for(std::span<pollfd> descriptors, Duration at_most) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  timespec left{};
  left.tv_sec = at_most.count() / kNsPerSecond;
  left.tv_nsec = at_most.count() % kNsPerSecond;
  const bool for_ever = at_most == Duration::max();
  return ::ppoll(descriptors.data(), descriptors.size(), for_ever ? nullptr : &left, nullptr);
}

}  // namespace hal
