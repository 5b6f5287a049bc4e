#pragma once

#include <optional>

#include "baraka/commands/coverage_command.h"

namespace CLI {
class App;
}

namespace baraka::main {

/// Adds `baraka coverage` and `baraka survey` to the command line.
void add_coverage(CLI::App& app, commands::CoverageCommand& options);
void add_survey(CLI::App& app, commands::SurveyCommand& options);

/// Carries out the one of them that is asked for. @return exit status; nullopt: neither is.
/// @throws std::exception
std::optional<int> act(const CLI::App& app, const commands::CoverageCommand& coverage,
                       const commands::SurveyCommand& survey);

}  // namespace baraka::main
