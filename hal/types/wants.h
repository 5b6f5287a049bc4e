#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace hal {

/// What a controller subscribes to. It receives nothing else.
///
///   .wants = {.channels = {"infrared"}, .optional = {"battery"}}
struct Wants {
  /// Names of the channels that it requires, e.g. "infrared".
  std::vector<std::string> channels{};
  /// Topics whose routes it reads.
  std::vector<std::string> watched{};
  /// Whether it reads the list of neighbours.
  bool neighbours = false;
  /// Names of channels that it uses where an agent has them; elsewhere reading them gives
  /// kNotAvailable.
  std::vector<std::string> optional{};
  /// Whether it uses address_of() and name_of() of other agents.
  bool names = false;

  /// Whether it requires the channel of this name.
  bool needs(std::string_view channel) const { return lists(channels, channel); }

  /// Whether it gets the channel of this name if the agent has it.
  bool asks_for(std::string_view channel) const {
    return needs(channel) || lists(optional, channel);
  }

  bool operator==(const Wants&) const = default;  ///< Member by member.

 private:
  static bool lists(const std::vector<std::string>& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  }
};

}  // namespace hal
