#include "baraka/commands/view_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "baraka/commands/output_file.h"
#include "baraka/commands/result_folder.h"
#include "baraka/run/check/check_scenario.h"
#include "baraka/run/pace/interrupts.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/terminal_colours.h"
#include "view/server/browser.h"
#include "view/server/bundled_page.h"
#include "view/server/export.h"
#include "view/server/view_server.h"

namespace baraka::commands {
namespace {

/// Finds the scenario named by an argument that is not a folder.
/// @throws UsageError  there is no such file either, so a folder may have been meant.
/// @throws hal::files::config::ConfigErrors  the argument can only be the name of a scenario.
std::filesystem::path scenario_named(const std::string& given) {
  const std::filesystem::path path(given);
  const bool is_yaml = path.extension() == ".yaml" || path.extension() == ".yml";
  try {
    std::filesystem::path file = hal::files::config::named_file(path, {"scenarios"});
    if (is_yaml || std::filesystem::exists(file)) return file;
  } catch (const hal::files::config::ConfigErrors&) {
    if (is_yaml) throw;
  }
  std::string similar = similar_folder(path);
  if (similar.empty() && !path.has_parent_path()) {
    similar = hal::files::config::similar_file(path, std::filesystem::path("scenarios") / path);
  }
  throw gateway::process::UsageError(
      fmt::format("{}: there is no such folder{}; view takes folders of results, where a run wrote "
                  "run.sqlite, or one scenario file",
                  given, similar));
}

/// The view of a scenario that has not been run, with the findings of `baraka check`.
std::unique_ptr<view::server::Run> open_scenario(const std::string& given) {
  const auto file = scenario_named(given);
  run::check::CheckedScenario checked = run::check::check_scenario(file, {});
  return std::make_unique<view::server::Run>(file, std::move(checked.scenario),
                                             std::move(checked.remarks));
}

view::server::ViewServer::Settings settings_of(const ViewOptions& options) {
  view::server::ViewServer::Settings settings{
      .page = view::server::find_page(view::server::kPage), .runs = {}, .port = options.port};
  const auto is_folder = [](const std::string& what) {
    return std::filesystem::is_directory(what);
  };
  if (options.what.size() == 1 && !is_folder(options.what.front())) {
    settings.mode = view::server::ViewApi::Mode::kScenario;
    settings.runs.push_back(open_scenario(options.what.front()));
  } else {
    require_results(options.what);
    settings.runs = view::server::open_results({options.what.begin(), options.what.end()});
  }
  return settings;
}

int serve(const ViewOptions& options) {
  auto settings = settings_of(options);
  if (!settings.page) {
    hal::print_line(hal::Tone::kWarning, fmt::format("warning: {}", view::server::kNoPage));
  }
  run::pace::catch_interrupts();
  view::server::ViewServer server(std::move(settings));
  if (const auto started = server.start(); !started) {
    throw gateway::process::UsageError(started.error().message);
  }
  fmt::print("view: {}\n", server.address());
  std::fflush(stdout);
  std::optional<view::server::Browser> browser;
  if (options.open) browser.emplace(server.address());
  while (!run::pace::interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.stop();
  return gateway::process::kDone;
}

int write_page(const ViewOptions& options) {
  const std::string page = view::server::bundled_page(
      view::server::kPage,
      "the page of the view is bundled with npm: ./setup pages installs it and builds the page");
  auto settings = settings_of(options);
  const view::server::ViewApi api(std::move(settings.runs), settings.mode, false);
  const auto most = std::size_t{1'000'000} * static_cast<std::size_t>(options.most_mb);
  const view::server::ExportedPage exported = view::server::export_page(api, page, most);
  write_output(options.file, exported.html);
  if (exported.finest != 0) {
    hal::print_line(
        hal::Tone::kWarning,
        fmt::format("warning: {} MB hold no details below spans of {:.3g} s where there are many; "
                    "--most-mb allows more",
                    options.most_mb, static_cast<double>(exported.finest) / 1e9));
  }
  fmt::print("page: {}\n", options.file);
  return gateway::process::kDone;
}

}  // namespace

int show_view(const ViewOptions& options) {
  return options.file.empty() ? serve(options) : write_page(options);
}

}  // namespace baraka::commands
