#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "hal/types/time.h"

namespace baraka::run::network {

/// Keeps a run in lock-step from passing faster than wall time while the kernel's TCP waits for a
/// timer, for these timers follow the wall clock. Otherwise a run that is ten times as fast would
/// send a lost segment again ten times as late. On the run's thread.
class TcpPace {
 public:
  /// @param has_timer  whether a connection waits for a timer now; it need not be quick.
  explicit TcpPace(std::function<bool()> has_timer) : has_timer_(std::move(has_timer)) {}

  /// A segment is on its way: timers may be set from now on.
  void on_segment() { may_have_timer_ = true; }

  /// Whether the run has to wait before it goes to `next`.
  /// @param next  virtual time; never decreases. @param wall  of any clock.
  /// @return how long it should wait before it asks again, at most 1 ms; none: it may go on.
  std::optional<hal::Duration> hold(hal::Time next, hal::Time wall);

  /// The virtual time that has been reached if hold() held the run at `wall`.
  hal::Time reached(hal::Time wall) const { return from_ + (wall - wall_from_); }

 private:
  void set_out(hal::Time virtual_time, hal::Time wall);

  std::function<bool()> has_timer_;
  bool may_have_timer_ = false;
  hal::Time from_{}, wall_from_{};
};

}  // namespace baraka::run::network
