#pragma once

#include <ctime>
#include <optional>

#include "programs/preload/dilation.h"

namespace programs::preload {

/// The dilation of this process and its origin, from BARAKA_DILATION. The variable has either the
/// factor alone, e.g. `0.1`, and the origin is the start of the process; or the factor and the
/// readings of CLOCK_MONOTONIC, CLOCK_REALTIME, CLOCK_MONOTONIC_RAW and CLOCK_BOOTTIME at the
/// origin in ns, separated by blanks: `0.1 81723… 17320… 81720… 81723…`. A process passes its own
/// origin to its children. Without the variable nothing is changed. An invalid value ends the
/// process with status 127, because nobody would notice wrong times.
///
/// Any thread, and signal handlers.
class ProcessTime {
 public:
  /// The time of this process; the variable is read by the first call.
  static const ProcessTime& get();

  const Dilation& dilation() const { return dilation_; }

  /// Reading of a dilated clock at the origin: 0 for clocks of processor time, which begin with
  /// their process or thread; none: the clock is not dilated (a device's clock).
  std::optional<Nanoseconds> origin(clockid_t clock) const;

  /// Convert readings of a dilated clock; a wait until the converted time does not end early.
  /// Before the origin both times are the same, so that a file of last year remains a file of last
  /// year. Readings of other clocks are unchanged.
  Nanoseconds to_program(Nanoseconds kernel, clockid_t clock) const;
  Nanoseconds to_kernel(Nanoseconds program, clockid_t clock) const;

 private:
  ProcessTime();
  bool read(const char* text);
  void begin_now();
  void hand_on(const char* factor) const;

  Dilation dilation_;
  Nanoseconds monotonic_ = 0, realtime_ = 0, raw_ = 0, boot_ = 0;
  Nanoseconds atomic_ = 0;  ///< CLOCK_TAI, which differs from CLOCK_REALTIME by whole seconds.
};

/// Reads the clock of the kernel itself.
Nanoseconds kernel_time(clockid_t clock);

}  // namespace programs::preload
