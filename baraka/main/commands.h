#pragma once

#include <functional>
#include <vector>

namespace CLI {
class App;
}

/// The commands of `baraka`, each with its options.
namespace baraka::main {

/// A command that a user may ask for.
struct Subcommand {
  const CLI::App* app;       ///< Its place on the command line.
  std::function<int()> act;  ///< After parsing. Returns the exit status. Throws std::exception.
};

// Scenarios.
Subcommand add_run(CLI::App& app);
Subcommand add_campaign(CLI::App& app);
Subcommand add_fleet(CLI::App& app);

// Files, and what they consist of.
Subcommand add_check(CLI::App& app);
Subcommand add_describe(CLI::App& app);
Subcommand add_list(CLI::App& app);
Subcommand add_robot(CLI::App& app);
Subcommand add_new_controller(CLI::App& app);

// The radio of a scenario's world.
Subcommand add_coverage(CLI::App& app);
Subcommand add_survey(CLI::App& app);

// Results.
Subcommand add_report(CLI::App& app);
Subcommand add_view(CLI::App& app);
Subcommand add_export(CLI::App& app);
Subcommand add_capsule(CLI::App& app);
Subcommand add_diff(CLI::App& app);

// Runs and robots under way.
Subcommand add_exec(CLI::App& app);
std::vector<Subcommand> add_topic(CLI::App& app);

}  // namespace baraka::main
