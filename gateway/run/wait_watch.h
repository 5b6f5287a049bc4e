#pragma once

#include <optional>

#include "hal/types/time.h"

namespace gateway {

/// Tells of a wait of this thread how long ago at most it was woken: for how old what woke it may
/// be. After proc(5): /proc/thread-self/schedstat has the time that the thread was ready and did
/// not run.
///
///   WaitWatch watch;
///   watch.before();
///   poll(…);
///   watch.after();
///   if (watch.woken()) …   // it slept, and was woken at most *watch.woken() before after()
class WaitWatch {
 public:
  /// Of the calling thread, which alone uses it.
  WaitWatch();
  ~WaitWatch();
  WaitWatch(const WaitWatch&) = delete;
  WaitWatch& operator=(const WaitWatch&) = delete;

  void before();
  void after();

  /// None: the thread did not sleep between before() and after(), or the system does not tell.
  std::optional<hal::Duration> woken() const { return woken_; }

 private:
  struct Reading {
    hal::Duration ready{};  ///< Ready and not running, in all.
    hal::Duration ran{};
    long sleeps = 0;
  };
  std::optional<Reading> read() const;

  int schedstat_;
  std::optional<Reading> before_;
  std::optional<hal::Duration> woken_;
};

}  // namespace gateway
