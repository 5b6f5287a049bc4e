#pragma once

#include "baraka/commands/coverage_command.h"

namespace CLI {
class App;
}

namespace baraka::main {

/// Adds `baraka coverage` and `baraka survey` to the command line.
void add_coverage(CLI::App& app, commands::CoverageCommand& options);
void add_survey(CLI::App& app, commands::SurveyCommand& options);

/// Carries them out. @return exit status. @throws std::exception
int act(const commands::CoverageCommand& asked);
int act(const commands::SurveyCommand& asked);

}  // namespace baraka::main
