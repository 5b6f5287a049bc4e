#pragma once

#include <string>
#include <string_view>

#include "hal/types/result.h"

namespace hal::dds {

/// Converts enumerators whose order is the same on both sides, and remembers the first that is
/// outside: DDS decodes any number into an enumeration.
class Ranges {
 public:
  template <class To, class From>
  To enumerator(From value, To last, std::string_view name) {
    if (static_cast<unsigned>(value) <= static_cast<unsigned>(last)) return static_cast<To>(value);
    if (bad_.empty()) bad_ = std::string(name) + " " + std::to_string(static_cast<unsigned>(value));
    return last;
  }

  Result<void> check() const {
    if (bad_.empty()) return {};
    return fail(Errc::kProtocol, "unknown " + bad_);
  }

 private:
  std::string bad_;
};

}  // namespace hal::dds
