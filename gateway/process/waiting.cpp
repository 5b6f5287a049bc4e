#include "gateway/process/waiting.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace gateway::process {
namespace {

/// Longer times are treated as unlimited: their sum with the time of day could overflow.
constexpr hal::Duration kForEver = std::chrono::years{100};

class WallClock final : public hal::Clock {
 public:
  hal::Time now() const override {
    return hal::Time{std::chrono::duration_cast<hal::Duration>(
        std::chrono::steady_clock::now().time_since_epoch())};
  }
  int wait(std::span<pollfd> descriptors, hal::Duration at_most) override {
    return hal::poll_for(descriptors, at_most);
  }
};

hal::Duration steady_now() { return wall_clock().now().time_since_epoch(); }

}  // namespace

Signal::Signal() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0) throw std::runtime_error("no eventfd: too many open files");
}

Signal::~Signal() { close(descriptor_); }

void Signal::raise() noexcept {
  // It can only fail if the counter is full, and then the signal is raised already.
  [[maybe_unused]] const int result = eventfd_write(descriptor_, 1);
}

void Signal::lower() noexcept {
  eventfd_t count = 0;
  [[maybe_unused]] const int result = eventfd_read(descriptor_, &count);
}

bool wait_readable(std::span<const int> descriptors, hal::Duration timeout) {
  std::vector<pollfd> polled;
  polled.reserve(descriptors.size());
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  return hal::poll_for(polled, timeout) > 0;
}

hal::Clock& wall_clock() {
  static WallClock clock;
  return clock;
}

Deadline::Deadline(hal::Duration from_now)
    : end_(from_now > kForEver ? hal::Duration::max() : steady_now() + from_now) {}

hal::Duration Deadline::left() const {
  if (end_ == hal::Duration::max()) return end_;
  return std::max(end_ - steady_now(), hal::Duration::zero());
}

}  // namespace gateway::process
