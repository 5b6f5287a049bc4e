#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "baraka/campaign/campaign_command.h"
#include "baraka/run/controllers/controllers_of_run.h"
#include "baraka/run/run_command.h"

/// The options of commands that run scenarios.
namespace baraka::main {

/// @param of_what  text before the description of each choice.
void add_controllers(CLI::App& command, run::controllers::ControllersFrom& controllers,
                     const std::string& of_what);

void add_run(CLI::App& app, run::RunOptions& options, std::string& seed);
void add_campaign(CLI::App& app, campaign::CampaignOptions& options);
void add_fleet(CLI::App& app, campaign::CampaignOptions& options);

}  // namespace baraka::main
