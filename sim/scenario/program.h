#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/types/time.h"

namespace sim::scenario {

/// What the end of a program does to the run.
enum class OnExit : std::uint8_t {
  kIgnore,
  kFail,  ///< The run fails, unless the program ended with status 0.
  kEnd,   ///< The run ends with the program's name as its result; fails as with kFail.
};

/// A program that runs inside each agent of a group, and uses its network.
struct Program {
  std::string name;
  /// The program and its arguments; kAgentWord and so on stand for what differs.
  std::vector<std::string> command;
  hal::Duration start{};                                           ///< Simulated time.
  std::vector<std::pair<std::string, std::string>> environment{};  ///< The same words.
  std::vector<std::string> shown{};  ///< Of the host's /tmp, /run and /dev/shm; the same words.
  std::string log{};  ///< File in the results' folder; kAgentWord stands for the agent.
  OnExit on_exit = OnExit::kIgnore;
  std::string place{};  ///< "file:line:column".
};

/// In a program's command, environment and log.
inline constexpr std::string_view kAgentWord = "{agent}", kAddressWord = "{address}",
                                  kNumberWord = "{number}", kResultsWord = "{results}";

/// What the words stand for.
struct ProgramWords {
  std::string agent;    ///< Name.
  std::string address;  ///< IPv4: "10.77.0.3".
  std::string number;   ///< In its group, from 0.
  std::string results;  ///< Folder, absolute.
};

/// The text with what they stand for in their places; other braces stay.
std::string filled_in(std::string text, const ProgramWords& words);

/// "10.77.0.3" of an address in host order.
std::string dotted(std::uint32_t address);

}  // namespace sim::scenario
