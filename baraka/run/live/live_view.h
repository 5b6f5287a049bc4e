#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "baraka/run/live/live_control.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"
#include "view/server/browser.h"
#include "view/server/view_server.h"

namespace baraka::run::live {

/// Options of `baraka run --view`.
struct LiveViewOptions {
  bool shown = false;
  bool paused = false;  ///< Start paused.
  bool open = true;     ///< Open a browser, if there is a desktop.
  int port = 0;         ///< 0: any free port.
};

/// Shows a run in the browser while it is running.
///
///   LiveView view(scenario, simulation, settings);
///   pace settings: .hold = [&](auto next) { return view.control().hold(next); }
///   view.start(folder);       // its record has begun
///   …run…
///   view.end(outcome);        // stays as long as a page is open
class LiveView {
 public:
  struct Settings {
    LiveViewOptions options;
    bool lockstep = true;
    double max_speed = 0;  ///< This and the following: as in LiveControl::Settings.
    std::function<void()> commit;
    std::function<bool(hal::AgentId, const hal::Twist2&)> drive;
  };

  /// Becomes an observer of the simulation. Scenario and simulation must outlive this object.
  LiveView(const sim::scenario::Scenario& scenario, sim::agents::Simulation& simulation,
           Settings settings);

  LiveControl& control() { return control_; }

  /// Starts the server, prints its address on standard error and opens a browser.
  /// @throws UsageError  the port is taken.
  void start(const std::filesystem::path& folder);

  /// To be called when the run has ended and its record is written. Waits until no page has been
  /// open for some seconds or the user interrupts, then ends the server.
  void end(const sim::agents::Outcome& outcome);

 private:
  LiveViewOptions options_;
  LiveControl control_;
  std::unique_ptr<view::server::ViewServer> server_;
  std::optional<view::server::Browser> browser_;
};

}  // namespace baraka::run::live
