#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace programs::preload {

/// A reading of a clock, or the difference of two.
using Nanoseconds = std::int64_t;
inline constexpr Nanoseconds kSecond = 1'000'000'000;

/// The ratio between the time of programs and that of the kernel: programs' time is slower. As on a
/// real clock, a wait never ends early: times for the kernel are rounded up, times for the program
/// are rounded down, and numbers that do not fit become the largest or smallest one.
class Dilation {
 public:
  /// Parses 0.01 .. 1, a decimal number with at most nine decimal places: "1", "0.25"; none: it is
  /// invalid.
  static std::optional<Dilation> from_text(std::string_view text);

  Dilation() = default;  ///< Factor 1: no difference.

  bool is_none() const { return billionths_ == kWhole; }

  /// Converts a reading of a clock that shows `origin` in both times at one point in time.
  Nanoseconds to_program(Nanoseconds kernel, Nanoseconds origin) const;
  /// The earliest time of the kernel for which to_program() gives at least `program`.
  Nanoseconds to_kernel(Nanoseconds program, Nanoseconds origin) const;

  /// Convert durations.
  Nanoseconds to_program(Nanoseconds kernel) const { return to_program(kernel, 0); }
  Nanoseconds to_kernel(Nanoseconds program) const { return to_kernel(program, 0); }

 private:
  static constexpr Nanoseconds kWhole = 1'000'000'000;

  explicit Dilation(Nanoseconds billionths) : billionths_(billionths) {}

  Nanoseconds billionths_ = kWhole;  ///< programs' nanoseconds per second of kernel time.
};

}  // namespace programs::preload
