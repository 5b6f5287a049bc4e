#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "hal/types/result.h"

namespace gateway::exchange {

/// Converts enumerators whose order is the same on both sides, and remembers the first that is out
/// of range: DDS decodes any number into an enumeration. The same for numbers with a limit.
class Ranges {
 public:
  template <class To, class From>
  To enumerator(From value, To last, std::string_view name) {
    if (static_cast<unsigned>(value) <= static_cast<unsigned>(last)) return static_cast<To>(value);
    if (bad_.empty())
      bad_ = "unknown " + std::string(name) + " " + std::to_string(static_cast<unsigned>(value));
    return last;
  }

  void at_most(std::size_t number, std::size_t most, std::string_view of_what) {
    exactly(number, std::min(number, most), of_what);
  }

  void exactly(std::size_t number, std::size_t expected, std::string_view of_what) {
    if (number == expected || !bad_.empty()) return;
    bad_ = std::to_string(number) + " " + std::string(of_what);
  }

  hal::Result<void> check() const {
    if (bad_.empty()) return {};
    return hal::fail(hal::Errc::kProtocol, bad_);
  }

 private:
  std::string bad_;
};

}  // namespace gateway::exchange
