#pragma once

#include <cstdint>

namespace sim::radio {

/// Retry counters of a station and the frame in service (IEEE Std 802.11-2016, 10.3.4.4): the short
/// one counts RTS and data frames sent without RTS, the long one data frames sent after RTS/CTS.
class RetryCounters {
 public:
  RetryCounters(std::uint32_t short_limit, std::uint32_t long_limit)
      : short_limit_(short_limit), long_limit_(long_limit) {}

  enum class Kind : std::uint8_t { kShort, kLong };

  /// Counts a failure. @return whether the frame must be given up.
  bool fail(Kind kind) {
    std::uint32_t& count = kind == Kind::kShort ? short_ : long_;
    const std::uint32_t limit = kind == Kind::kShort ? short_limit_ : long_limit_;
    return ++count >= limit;
  }
  /// Whether the last attempt has failed.
  bool is_counting() const { return short_ > 0 || long_ > 0; }
  void succeed(Kind kind) { (kind == Kind::kShort ? short_ : long_) = 0; }
  /// Resets both counters when the frame in service ends, however it ends, and after a group frame.
  void reset() { short_ = long_ = 0; }

 private:
  std::uint32_t short_limit_, long_limit_;
  std::uint32_t short_ = 0;
  std::uint32_t long_ = 0;
};

}  // namespace sim::radio
