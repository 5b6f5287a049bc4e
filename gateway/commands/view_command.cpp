#include "gateway/commands/view_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "gateway/commands/output_file.h"
#include "gateway/commands/result_folder.h"
#include "gateway/exit_status.h"
#include "gateway/run/judge_controllers.h"
#include "gateway/run/wall_pace.h"
#include "gateway/view/browser.h"
#include "gateway/view/bundled_page.h"
#include "gateway/view/export.h"
#include "gateway/view/view_server.h"
#include "hal/config/errors.h"
#include "hal/config/shared_folders.h"
#include "hal/types/terminal_colours.h"

namespace gateway {
namespace {

/// What is given is no folder. @return the scenario of that name.
/// @throws UsageError  there is no file of that name either, so a folder may have been meant.
/// @throws hal::config::ConfigErrors  it can only be the name of a scenario.
std::filesystem::path scenario_named(const std::string& given) {
  const std::filesystem::path path(given);
  const bool is_yaml = path.extension() == ".yaml" || path.extension() == ".yml";
  try {
    std::filesystem::path file = hal::config::named_file(path, {"scenarios"});
    if (is_yaml || std::filesystem::exists(file)) return file;
  } catch (const hal::config::ConfigErrors&) {
    if (is_yaml) throw;
  }
  std::string similar = similar_folder(path);
  if (similar.empty() && !path.has_parent_path()) {
    similar = hal::config::similar_file(path, std::filesystem::path("scenarios") / path);
  }
  throw UsageError(
      fmt::format("{}: there is no such folder{}; view takes folders of results, where a run wrote "
                  "run.sqlite, or one scenario file",
                  given, similar));
}

/// A scenario that has not been run, with what `baraka check` says of it.
std::unique_ptr<view::Run> open_scenario(const std::string& given) {
  const auto file = scenario_named(given);
  JudgedScenario judged = judge_scenario(file, {});
  return std::make_unique<view::Run>(file, std::move(judged.scenario), std::move(judged.remarks));
}

view::ViewServer::Settings settings_of(const ViewOptions& options) {
  view::ViewServer::Settings settings{
      .page = view::find_page(view::kPage), .runs = {}, .port = options.port};
  const auto is_folder = [](const std::string& what) {
    return std::filesystem::is_directory(what);
  };
  if (options.what.size() == 1 && !is_folder(options.what.front())) {
    settings.mode = view::ViewApi::Mode::kScenario;
    settings.runs.push_back(open_scenario(options.what.front()));
  } else {
    require_results(options.what);
    settings.runs = view::open_results({options.what.begin(), options.what.end()});
  }
  return settings;
}

int serve(const ViewOptions& options) {
  auto settings = settings_of(options);
  if (!settings.page) {
    hal::print_line(hal::Tone::kWarning, fmt::format("warning: {}", view::kNoPage));
  }
  catch_interrupts();
  view::ViewServer server(std::move(settings));
  server.start();
  fmt::print("view: {}\n", server.address());
  std::fflush(stdout);
  std::optional<view::Browser> browser;
  if (options.open) browser.emplace(server.address());
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.stop();
  return kDone;
}

int write_page(const ViewOptions& options) {
  const std::string page = view::bundled_page(
      view::kPage,
      "the page of the view is bundled with npm: ./setup pages installs it and builds the page");
  auto settings = settings_of(options);
  const view::ViewApi api(std::move(settings.runs), settings.mode, false);
  const auto most = std::size_t{1'000'000} * static_cast<std::size_t>(options.most_mb);
  const view::ExportedPage exported = view::export_page(api, page, most);
  write_output(options.file, exported.html);
  if (exported.finest != 0) {
    hal::print_line(
        hal::Tone::kWarning,
        fmt::format("warning: {} MB hold no details below spans of {:.3g} s where there are many; "
                    "--most-mb allows more",
                    options.most_mb, static_cast<double>(exported.finest) / 1e9));
  }
  fmt::print("page: {}\n", options.file);
  return kDone;
}

}  // namespace

int show_view(const ViewOptions& options) {
  return options.file.empty() ? serve(options) : write_page(options);
}

}  // namespace gateway
