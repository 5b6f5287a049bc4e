#pragma once

#include <string>
#include <vector>

namespace hal {

/// What a controller asks for. It gets this and nothing else.
struct Wants {
  std::vector<std::string> channels{};  ///< Names of channels, e.g. "infrared".
  std::vector<std::string> watched{};   ///< Topics whose routes it looks at.
  bool neighbours = false;
  bool operator==(const Wants&) const = default;
};

}  // namespace hal
