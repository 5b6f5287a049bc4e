#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace programs::preload {

/// Of a clock, or between two of its readings.
using Nanoseconds = std::int64_t;
inline constexpr Nanoseconds kSecond = 1'000'000'000;

/// How much slower the time of programs passes than the kernel's. As on a real clock, a wait never
/// ends before its time: what is asked of the kernel is rounded up, what is told to the program is
/// rounded down, and what does not fit is the largest or smallest number.
class Dilation {
 public:
  /// 0.01 .. 1, a decimal number with at most nine places: "1", "0.25"; none: it is not one.
  static std::optional<Dilation> from_text(std::string_view text);

  Dilation() = default;  ///< 1: no difference.

  bool is_none() const { return billionths_ == kWhole; }

  /// Of a clock that says `origin` in both times at once.
  Nanoseconds to_program(Nanoseconds kernel, Nanoseconds origin) const;
  /// The first moment of the kernel's at which to_program() gives no less.
  Nanoseconds to_kernel(Nanoseconds program, Nanoseconds origin) const;

  /// Of durations.
  Nanoseconds to_program(Nanoseconds kernel) const { return to_program(kernel, 0); }
  Nanoseconds to_kernel(Nanoseconds program) const { return to_kernel(program, 0); }

 private:
  static constexpr Nanoseconds kWhole = 1'000'000'000;

  explicit Dilation(Nanoseconds billionths) : billionths_(billionths) {}

  Nanoseconds billionths_ = kWhole;  ///< Of the kernel's time.
};

}  // namespace programs::preload
