#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace hal {

/// What a controller asks for. It gets this and nothing else.
///
///   .wants = {.channels = {"infrared"}, .optional = {"battery"}}
struct Wants {
  std::vector<std::string>
      channels{};                      ///< Names of channels it cannot do without, e.g. "infrared".
  std::vector<std::string> watched{};  ///< Topics whose routes it looks at.
  bool neighbours = false;
  /// Channels it can do without: on an agent that has none of that name its readings are
  /// kNotAvailable.
  std::vector<std::string> optional{};

  /// Whether it is to get the channel of that name where there is one.
  bool asks_for(std::string_view channel) const {
    const auto names = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), channel) != list.end();
    };
    return names(channels) || names(optional);
  }

  bool operator==(const Wants&) const = default;
};

}  // namespace hal
