#include "hal/dds/waiting.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace hal::dds {
namespace {

/// Longer than this is never: the sum with the time of day could overflow.
constexpr Duration kForEver = std::chrono::years{100};

class WallClock final : public Clock {
 public:
  Time now() const override {
    return Time{
        std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch())};
  }
  int wait(std::span<pollfd> descriptors, Duration at_most) override {
    return poll_for(descriptors, at_most);
  }
};

Duration steady_now() { return wall_clock().now().time_since_epoch(); }

}  // namespace

Signal::Signal() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0) throw std::runtime_error("no eventfd: too many open files");
}

Signal::~Signal() { close(descriptor_); }

void Signal::raise() noexcept {
  // It can only fail when the counter is full, and then the signal is raised.
  [[maybe_unused]] const int result = eventfd_write(descriptor_, 1);
}

void Signal::lower() noexcept {
  eventfd_t count = 0;
  [[maybe_unused]] const int result = eventfd_read(descriptor_, &count);
}

bool wait_readable(std::span<const int> descriptors, Duration timeout) {
  std::vector<pollfd> polled;
  polled.reserve(descriptors.size());
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  return poll_for(polled, timeout) > 0;
}

Clock& wall_clock() {
  static WallClock clock;
  return clock;
}

Deadline::Deadline(Duration from_now)
    : end_(from_now > kForEver ? Duration::max() : steady_now() + from_now) {}

Duration Deadline::left() const {
  if (end_ == Duration::max()) return end_;
  return std::max(end_ - steady_now(), Duration::zero());
}

}  // namespace hal::dds
