#pragma once

#include <functional>
#include <map>
#include <span>
#include <utility>

#include "hal/node/routing/ports.h"
#include "hal/types/clock.h"

namespace tests {

/// Time, and its events in order of (time, insertion). It passes by run_until(), and while somebody
/// waits for what is not there.
class FakeClock final : public hal::node::routing::Timers, public hal::Clock {
 public:
  hal::Time now() const override { return now_; }
  Handle schedule(hal::Time at, std::function<void()> handler) override {
    events_.emplace(std::pair{at, ++last_}, std::move(handler));
    times_[last_] = at;
    return last_;
  }
  void cancel(Handle handle) override {
    if (const auto time = times_.find(handle); time != times_.end()) {
      events_.erase({time->second, handle});
    }
  }
  int wait(std::span<pollfd> descriptors, hal::Duration at_most) override {
    const int there = hal::poll_for(descriptors, hal::Duration::zero());
    if (there == 0) run_until(now_ + at_most);
    return there;
  }
  /// Runs everything before and at `end`.
  void run_until(hal::Time end) {
    while (!events_.empty() && events_.begin()->first.first <= end) {
      auto next = events_.extract(events_.begin());
      now_ = next.key().first;
      next.mapped()();
    }
    now_ = end;
  }

 private:
  hal::Time now_{};
  Handle last_ = 0;
  std::map<std::pair<hal::Time, Handle>, std::function<void()>> events_;
  std::map<Handle, hal::Time> times_;
};

}  // namespace tests
