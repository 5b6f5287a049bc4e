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
  /// Who is who: address_of() and name_of() of other agents.
  bool names = false;

  /// Whether it cannot do without the channel of that name.
  bool needs(std::string_view channel) const { return lists(channels, channel); }

  /// Whether it is to get the channel of that name where there is one.
  bool asks_for(std::string_view channel) const {
    return needs(channel) || lists(optional, channel);
  }

  bool operator==(const Wants&) const = default;

 private:
  static bool lists(const std::vector<std::string>& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  }
};

}  // namespace hal
