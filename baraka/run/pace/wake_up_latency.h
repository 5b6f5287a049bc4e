#pragma once

#include <optional>

#include "hal/types/time.h"

namespace baraka::run::pace {

/// Tells of a wait of this thread how long ago at most it was woken: for how old what woke it may
/// be. After proc(5): /proc/thread-self/schedstat has the time that the thread was ready and did
/// not run.
///
///   WakeUpLatency latency;
///   latency.before_wait();
///   poll(…);
///   latency.after_wait();
///   if (latency.at_most()) …   // it slept; *latency.at_most() before after_wait(), or later, it
///                              // was woken
class WakeUpLatency {
 public:
  /// Of the calling thread, which alone uses it.
  WakeUpLatency();
  ~WakeUpLatency();
  WakeUpLatency(const WakeUpLatency&) = delete;
  WakeUpLatency& operator=(const WakeUpLatency&) = delete;

  void before_wait();
  void after_wait();

  /// None: the thread did not sleep between before_wait() and after_wait(), or the system does not
  /// tell.
  std::optional<hal::Duration> at_most() const { return at_most_; }

 private:
  struct SchedulerTimes {
    hal::Duration ready{};  ///< Ready and not running, in all.
    hal::Duration ran{};
    long sleeps = 0;
  };
  std::optional<SchedulerTimes> read() const;

  int schedstat_;
  std::optional<SchedulerTimes> before_;
  std::optional<hal::Duration> at_most_;
};

}  // namespace baraka::run::pace
