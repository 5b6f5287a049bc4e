#include "baraka/run/live/live_view.h"

#include <fmt/format.h>

#include <cstdio>
#include <thread>
#include <utility>

#include "baraka/run/pace/interrupts.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/waiting.h"
#include "hal/types/terminal_colours.h"
#include "view/server/bundled_page.h"

namespace baraka::run::live {

using namespace std::chrono_literals;

LiveView::LiveView(const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
                   Settings settings)
    : options_(settings.options),
      control_(scenario.simulation, simulation, gateway::process::wall_clock(),
               {.lockstep = settings.lockstep,
                .paused = settings.options.paused,
                .max_speed = settings.max_speed,
                .commit = std::move(settings.commit),
                .drive = std::move(settings.drive)}) {
  simulation.add_observer(control_);
}

void LiveView::start(const std::filesystem::path& folder) {
  view::server::ViewServer::Settings settings{.page = view::server::find_page(view::server::kPage),
                                              .runs = view::server::open_results({folder}),
                                              .mode = view::server::ViewApi::Mode::kLive,
                                              .port = options_.port,
                                              .control = &control_,
                                              .clock = &control_};
  if (!settings.page) {
    hal::print_line(hal::Tone::kWarning, fmt::format("warning: {}", view::server::kNoPage));
  }
  server_ = std::make_unique<view::server::ViewServer>(std::move(settings));
  if (const auto started = server_->start(); !started) {
    throw gateway::process::UsageError(started.error().message);
  }
  fmt::print(stderr, "view: {}\n", server_->address());
  if (options_.open) browser_.emplace(server_->address());
}

void LiveView::end(const sim::agents::Outcome& outcome) {
  control_.end(outcome.ended_at, outcome.result);
  if (control_.watched_within(3s)) {
    fmt::print(stderr, "view: the run has ended; served until its pages are closed, or Ctrl-C\n");
  }
  while (control_.watched_within(3s) && !pace::interrupted()) std::this_thread::sleep_for(50ms);
  server_->stop();
}

}  // namespace baraka::run::live
