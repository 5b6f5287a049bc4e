#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hal::rtps {

/// Why a datagram is none of RTPS, or none that a receiver should look at. Cheap to make: the texts
/// are constants.
struct Fault {
  std::size_t at = 0;     ///< Octets from the start of the datagram to the part it is in.
  std::string_view part;  ///< "header", "DATA", …
  std::string_view what;

  /// "octet 24: DATA: its payload is too short"
  std::string text() const;
};

/// What is wrong with a part, or empty: nothing.
using Objection = std::string_view;

}  // namespace hal::rtps
