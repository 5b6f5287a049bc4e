#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "hal/types/result.h"

namespace gateway::exchange {

/// Converts enumerators whose order is the same on both sides, and remembers the first one that is
/// out of range: DDS decodes any number as an enumerator. The same for numbers with a limit.
class Ranges {
 public:
  template <class To, class From>
  To enumerator(From value, To last, std::string_view name) {
    return is_known(value, last, name) ? static_cast<To>(value) : last;
  }

  template <class Enum, class Last>
  bool is_known(Enum value, Last last, std::string_view name) {
    if (static_cast<unsigned>(value) <= static_cast<unsigned>(last)) return true;
    if (bad_.empty()) bad_ = fmt::format("unknown {} {}", name, static_cast<unsigned>(value));
    return false;
  }

  void at_most(std::size_t number, std::size_t most, std::string_view of_what) {
    if (number > most && bad_.empty())
      bad_ = fmt::format("{} {} instead of at most {}", number, of_what, most);
  }

  bool exactly(std::size_t number, std::size_t expected, std::string_view of_what) {
    if (number == expected) return true;
    if (bad_.empty()) bad_ = fmt::format("{} {} instead of {}", number, of_what, expected);
    return false;
  }

  hal::Result<void> check() const {
    if (bad_.empty()) return {};
    return hal::fail(hal::Errc::kProtocol, bad_);
  }

 private:
  std::string bad_;
};

/// The error of one part of a sample. @param part  "event"
inline tl::unexpected<hal::Error> malformed(std::string_view part, std::size_t index,
                                            std::uint16_t agent, const hal::Error& error) {
  return hal::fail(error.code,
                   fmt::format("{} {} of agent {}: {}", part, index, agent, error.message));
}

}  // namespace gateway::exchange
