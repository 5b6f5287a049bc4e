#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/types/time.h"

namespace sim::scenario {

/// Effect on the run when a program ends.
enum class OnExit : std::uint8_t {
  kIgnore,
  kFail,  ///< The run fails, unless the program's exit status is 0.
  kEnd,   ///< The run ends with the program's name as its result; otherwise as kFail.
};

/// A program that runs inside each agent of a group and uses its network.
struct Program {
  std::string name;
  /// The program and its arguments, which may contain placeholders such as kAgentWord.
  std::vector<std::string> command;
  hal::Duration start{};  ///< Simulated time.
  /// May contain the same placeholders.
  std::vector<std::pair<std::string, std::string>> environment{};
  /// Paths in the host's /tmp, /run and /dev/shm that it can see; may contain placeholders.
  std::vector<std::string> shown{};
  std::string log{};  ///< File in the folder of results; may contain kAgentWord.
  OnExit on_exit = OnExit::kIgnore;
  bool is_shipped = false;  ///< Installed with baraka, and not searched for in PATH.
  std::string place{};      ///< "file:line:column".
};

/// Placeholders in a program's command, environment and log.
inline constexpr std::string_view kAgentWord = "{agent}", kAddressWord = "{address}",
                                  kNumberWord = "{number}", kResultsWord = "{results}";

/// Values of the placeholders.
struct ProgramWords {
  std::string agent;    ///< Name.
  std::string address;  ///< IPv4 address: "10.77.0.3".
  std::string number;   ///< Number in its group, from 0.
  std::string results;  ///< Folder of results, an absolute path.
};

/// The text with placeholders replaced by their values; other braces stay.
std::string filled_in(std::string text, const ProgramWords& words);

/// An address in host order as text: "10.77.0.3".
std::string dotted(std::uint32_t address);

}  // namespace sim::scenario
