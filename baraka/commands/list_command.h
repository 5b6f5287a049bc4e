#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace baraka::commands {

/// The kinds that can be listed: "scenarios", "robots", …, "controllers".
const std::vector<std::string>& listed_kinds();

/// Prints the files that come with BARAKA and those in BARAKA_CONFIG_PATH and
/// BARAKA_CONTROLLER_PATH: for each kind the folders, and a line for each file with its name and
/// the first sentence of its leading comment; for a controller, the agents that it can drive and
/// its parameters.
/// @param kind  one of listed_kinds(); empty: all.
/// @return exit status.
int list(const std::string& kind);

/// The first sentence of a file's leading comment, on one line and without its full stop; empty:
/// there is no leading comment.
std::string first_sentence(std::string_view text);

}  // namespace baraka::commands
