#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "baraka/commands/coverage_command.h"
#include "baraka/commands/wrong_kind.h"
#include "baraka/main/commands.h"
#include "gateway/process/command_line.h"
#include "results/coverage/coverage_classes.h"

namespace baraka::main {

Subcommand add_coverage(CLI::App& app) {
  const auto held = std::make_shared<commands::CoverageCommand>();
  commands::CoverageCommand& options = *held;
  CLI::App* add = app.add_subcommand(
      "coverage", "Where in the world of a scenario its access points are received, and how well");
  add->add_option("SCENARIO", options.scenario, "Scenario file")->required();
  add->add_option("-o", options.file,
                  "Write a page with all maps (.html), one map (.svg) or a table (.csv); default: "
                  "print a summary");
  add->add_option("--at", options.at,
                  "Height of the receiving antenna above the ground, 1.5 m; default: the radio's "
                  "antenna_height");
  add->add_option("--step", options.step, "Distance of the points; default: 0.5 m");
  add->add_option("--area", options.area,
                  "Two corners X,Y,X,Y in m; default: around all walls and agents");
  add->add_option("--of", options.of,
                  "Pattern of the agents that transmit; default: the access points");
  add->add_option("--length", options.length,
                  "Bytes of a frame for the expected rate; default: 1500");
  std::vector<std::string> layers;
  for (const auto& one : results::coverage::kLayers) layers.emplace_back(one.name);
  add->add_option("--layer", options.layer, "What an .svg shows; default: rssi")
      ->transform(gateway::process::one_of(layers));
  add->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  return {add, [held] {
            return commands::with_file_of("scenario",
                                          {held->scenario, {"scenarios"}, held->overrides},
                                          [&] { return commands::coverage(*held); });
          }};
}

Subcommand add_survey(CLI::App& app) {
  const auto held = std::make_shared<commands::SurveyCommand>();
  commands::SurveyCommand& options = *held;
  CLI::App* add = app.add_subcommand(
      "survey", "Fit the multi-wall law of a scenario's walls to measured powers");
  add->add_option("SURVEY", options.survey, "CSV with the columns x, y, access_point, dbm and z")
      ->required();
  add->add_option("SCENARIO", options.scenario, "Scenario file with the walls and access points")
      ->required();
  add->add_option("-o", options.file,
                  "Write the scenario's radio with the fitted law to this file");
  add->add_option("--set", options.overrides, "KEY=VALUE, the key as a dotted path")
      ->allow_extra_args(false);
  return {add, [held] {
            return commands::with_file_of("scenario",
                                          {held->scenario, {"scenarios"}, held->overrides},
                                          [&] { return commands::survey(*held); });
          }};
}

}  // namespace baraka::main
