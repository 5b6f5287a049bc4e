#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace baraka::commands {

/// What can be listed: "scenarios", "robots", …, "controllers".
const std::vector<std::string>& listed_kinds();

/// Prints what comes with BARAKA and what BARAKA_CONFIG_PATH and BARAKA_CONTROLLER_PATH add: of
/// each kind the folder, and a line for each file with its name and the first sentence of the
/// comment that it begins with; of a controller, whom it drives and its parameters.
/// @param kind  one of listed_kinds(); empty: all. @return exit status.
int list(const std::string& kind);

/// The first sentence of the comment that a file begins with, without its full stop and on one
/// line; empty: it begins with none.
std::string first_sentence(std::string_view text);

}  // namespace baraka::commands
