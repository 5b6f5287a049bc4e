#pragma once

#include <span>

#include "hal/types/clock.h"
#include "hal/types/time.h"

namespace gateway::process {

/// A flag that other threads and signal handlers raise and that poll() can wait for.
class Signal {
 public:
  Signal();  ///< @throws std::runtime_error  if the process has too many open files.
  ~Signal();
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;

  void raise() noexcept;  ///< Any thread, also from a signal handler.
  void lower() noexcept;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Waits until one of the descriptors is readable. -1 is skipped.
/// @param timeout  by the wall clock; Duration::max(): no limit.
/// @returns whether one is readable. After an interruption by a signal handler it returns false.
bool wait_readable(std::span<const int> descriptors, hal::Duration timeout);

/// The wall clock, CLOCK_MONOTONIC, as a parameter for functions that wait.
hal::Clock& wall_clock();

/// A time-out on the wall clock, never for simulated time.
class Deadline {
 public:
  explicit Deadline(hal::Duration from_now);  ///< Duration::max(): never.
  hal::Duration left() const;                 ///< 0 after it has passed.
  bool has_passed() const { return left() <= hal::Duration::zero(); }

 private:
  hal::Duration end_;  ///< Since the epoch of the steady clock.
};

}  // namespace gateway::process
