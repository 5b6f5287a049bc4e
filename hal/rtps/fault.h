#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hal::rtps {

/// Why a datagram is not RTPS, or should not be passed to a receiver. Cheap to create: the texts
/// are constants.
struct Fault {
  std::size_t at = 0;     ///< Octets from the start of the datagram to the faulty part.
  std::string_view part;  ///< "header", "DATA", …
  std::string_view what;

  /// "octet 24: DATA: its payload is too short"
  std::string text() const;
};

/// What is wrong with a part; empty if nothing is.
using Objection = std::string_view;

}  // namespace hal::rtps
