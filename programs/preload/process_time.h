#pragma once

#include <ctime>
#include <optional>

#include "programs/preload/dilation.h"

namespace programs::preload {

/// The dilation of this process and where it began, from BARAKA_DILATION: the factor alone, e.g.
/// `0.1`, from the moment at which the process starts; or the factor and the readings of
/// CLOCK_MONOTONIC, CLOCK_REALTIME, CLOCK_MONOTONIC_RAW and CLOCK_BOOTTIME at the origin in ns,
/// with blanks between: `0.1 81723… 17320… 81720… 81723…`. A process hands its own origin on to
/// those that it starts. Without the variable nothing is changed. A value that is not one ends the
/// process with status 127, for nobody would notice the wrong time.
///
/// Any thread, and signal handlers.
class ProcessTime {
 public:
  /// Of this process; read when it is asked for first.
  static const ProcessTime& get();

  const Dilation& dilation() const { return dilation_; }

  /// What a dilated clock said at the origin: 0 of those of processor time, which begin with their
  /// process or thread; none: the clock is not dilated (a device's).
  std::optional<Nanoseconds> origin(clockid_t clock) const;

  /// Of a dilated clock; a wait until then ends no earlier. Before the origin both are the same: a
  /// file of last year is of last year. Any other clock stays.
  Nanoseconds to_program(Nanoseconds kernel, clockid_t clock) const;
  Nanoseconds to_kernel(Nanoseconds program, clockid_t clock) const;

 private:
  ProcessTime();
  bool read(const char* text);
  void begin_now();
  void hand_on(const char* factor) const;

  Dilation dilation_;
  Nanoseconds monotonic_ = 0, realtime_ = 0, raw_ = 0, boot_ = 0;
  Nanoseconds atomic_ = 0;  ///< CLOCK_TAI: whole seconds before CLOCK_REALTIME.
};

/// The clock of the kernel itself.
Nanoseconds kernel_time(clockid_t clock);

}  // namespace programs::preload
