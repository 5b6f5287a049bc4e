#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "hal/types/time.h"

namespace hal::node::agent {

/// Keeps what happens in every control cycle from filling the log: each text at once, then no more
/// than every five seconds, saying how often it came meanwhile.
class RepeatedLines {
 public:
  static constexpr Duration kPeriod = std::chrono::seconds{5};
  static constexpr std::size_t kMostTexts = 64;  ///< Remembered; beyond them all are new again.

  /// @return the line to be said; nothing: not now.
  std::optional<std::string> take(Time now, const std::string& text);

 private:
  struct Said {
    Time at{};
    std::uint64_t since = 0;  ///< Times that it was not said.
  };
  std::map<std::string, Said> said_;
};

}  // namespace hal::node::agent
