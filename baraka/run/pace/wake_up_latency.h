#pragma once

#include <optional>

#include "hal/types/time.h"

namespace baraka::run::pace {

/// Upper bound of the time since this thread was woken from a wait, and therefore of the age of the
/// event that woke it. Source: /proc/thread-self/schedstat (proc(5)), the time that the thread was
/// ready but not running.
///
///   WakeUpLatency latency;
///   latency.before_wait();
///   poll(…);
///   latency.after_wait();
///   if (latency.at_most()) …   // It slept, and was woken at most this long before after_wait().
class WakeUpLatency {
 public:
  /// Measures the calling thread; only that thread may use the object.
  WakeUpLatency();
  ~WakeUpLatency();
  WakeUpLatency(const WakeUpLatency&) = delete;
  WakeUpLatency& operator=(const WakeUpLatency&) = delete;

  void before_wait();
  void after_wait();

  /// None: the thread did not sleep between before_wait() and after_wait(), or the system does not
  /// provide the times.
  std::optional<hal::Duration> at_most() const { return at_most_; }

 private:
  struct SchedulerTimes {
    hal::Duration ready{};  ///< Total time ready but not running.
    hal::Duration ran{};
    long sleeps = 0;
  };
  std::optional<SchedulerTimes> read() const;

  int schedstat_;
  std::optional<SchedulerTimes> before_;
  std::optional<hal::Duration> at_most_;
};

}  // namespace baraka::run::pace
