#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "hal/types/time.h"

namespace hal::node::agent {

/// Keeps conditions that recur in every control cycle from filling the log: a text is logged at
/// once, and then at most every five seconds, with the number of occurrences in between.
class RepeatedLines {
 public:
  static constexpr Duration kPeriod = std::chrono::seconds{5};
  /// Number of texts remembered; beyond it all are forgotten.
  static constexpr std::size_t kMostTexts = 64;

  /// @return the line to log; nullopt if the text is not due.
  std::optional<std::string> take(Time now, const std::string& text);

 private:
  struct Said {
    Time at{};
    std::uint64_t since = 0;  ///< Occurrences since it was last logged.
  };
  std::map<std::string, Said> said_;
};

}  // namespace hal::node::agent
