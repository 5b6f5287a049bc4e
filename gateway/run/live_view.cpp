#include "gateway/run/live_view.h"

#include <fmt/format.h>

#include <cstdio>
#include <thread>
#include <utility>

#include "gateway/run/wall_pace.h"
#include "gateway/view/bundled_page.h"
#include "hal/dds/waiting.h"
#include "hal/types/terminal_colours.h"

namespace gateway {

using namespace std::chrono_literals;

LiveView::LiveView(const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
                   Settings settings)
    : options_(settings.options),
      control_(scenario.simulation, simulation, hal::dds::wall_clock(),
               {.lockstep = settings.lockstep,
                .paused = settings.options.paused,
                .max_speed = settings.max_speed,
                .commit = std::move(settings.commit),
                .drive = std::move(settings.drive)}) {
  simulation.add_observer(control_);
}

void LiveView::start(const std::filesystem::path& folder) {
  view::ViewServer::Settings settings{.page = view::find_page(view::kPage),
                                      .runs = view::open_results({folder}),
                                      .mode = view::ViewApi::Mode::kLive,
                                      .port = options_.port,
                                      .control = &control_,
                                      .clock = &control_};
  if (!settings.page) {
    hal::print_line(hal::Tone::kWarning, fmt::format("warning: {}", view::kNoPage));
  }
  server_ = std::make_unique<view::ViewServer>(std::move(settings));
  server_->start();
  fmt::print(stderr, "view: {}\n", server_->address());
  if (options_.open) browser_.emplace(server_->address());
}

void LiveView::end(const sim::agents::Outcome& outcome) {
  control_.end(outcome.ended_at, outcome.result);
  if (control_.watched_within(3s)) {
    fmt::print(stderr, "view: the run has ended; served until its pages are closed, or Ctrl-C\n");
  }
  while (control_.watched_within(3s) && !interrupted()) std::this_thread::sleep_for(50ms);
  server_->stop();
}

}  // namespace gateway
