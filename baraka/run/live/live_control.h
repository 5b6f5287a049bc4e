#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/clock.h"
#include "hal/types/geometry.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation.h"
#include "sim/agents/simulation_config.h"
#include "view/server/control.h"

namespace baraka::run::live {

/// Control of a running simulation from the view's page, and the state that the page is told.
///
/// In lock-step the run pauses between two instants: nothing happens meanwhile, no controller owes
/// an answer, and the run continues as if it had not paused. A run in real time can only be viewed.
///
///            step done, a break                Resume, Step
///   running ------------------> paused ----------------------> running
///            Pause                       Speed: running on, slower or faster
///
/// Threads: act(), now() and keep() on those of the server; everything else on that of the run.
class LiveControl final : public view::server::RunControl,
                          public view::server::Clock,
                          public sim::agents::Observer {
 public:
  struct Settings {
    bool lockstep = true;
    bool paused = false;   ///< Paused from the start until resumed.
    double max_speed = 0;  ///< Simulated seconds per second; 0: as fast as possible.
    /// Makes the record so far readable for the server.
    std::function<void()> commit;
    /// Drives a teleoperated robot. @return false: the robot is not teleoperated.
    std::function<bool(hal::AgentId, const hal::Twist2&)> drive;
  };

  /// @param config, simulation, clock  must outlive this object.
  LiveControl(const sim::agents::SimulationConfig& config,
              const sim::agents::Simulation& simulation, hal::Clock& clock, Settings settings);

  hal::Result<std::int64_t> act(const view::server::Command& command) override;
  Now now() const override;
  void keep() const override;

  /// To be called before the events of `next`. @return time to wait before calling again; none: go
  /// on.
  std::optional<hal::Duration> hold(hal::Time next);

  /// Whether keep() (a page is open) or now() was called within this time.
  bool watched_within(hal::Duration time) const;

  /// Notes that the run has ended.
  void end(hal::Time at, const std::string& result);

  void on_cycle(hal::Time at, hal::AgentId agent) override;
  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_message_sent(hal::Time at, const hal::Message& message) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override;
  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;

 private:
  struct Stepping {
    view::server::Steps steps;
    /// Time of the last counted cycle: cycles of several agents at the same time are one step.
    hal::Time last{-hal::Duration{1}};
  };

  hal::Result<std::int64_t> start(const view::server::Steps& steps);
  hal::Result<std::int64_t> add(const view::server::Break& at);
  void refresh();
  /// Parts of hold(), called with the lock held: note that the run has come to `next`; whether a
  /// viewer needs data that are not written yet; how long to wait.
  void reach(hal::Time next);
  bool is_to_refresh(hal::Time wall) const;
  std::optional<hal::Duration> wait_left(hal::Time wall) const;
  void restart_pace();
  void count(view::server::Steps::Of what, hal::Time at, hal::AgentId agent);
  bool is_watched(view::server::Break::On on) const;
  /// Pauses if a break applies. @param text  state or topic @param why  the reason, for display
  void pause_if(view::server::Break::On on, hal::AgentId agent, std::string_view text,
                const std::function<std::string()>& why);
  void pause(std::string why);
  std::string name(hal::AgentId agent) const;

  const sim::agents::SimulationConfig& config_;
  const sim::agents::Simulation& simulation_;
  hal::Clock& clock_;
  Settings settings_;
  std::map<hal::AgentId, sim::agents::ContactCounts> contacts_;  ///< At the last cycle.
  hal::Time committed_at_{};                                     ///< Wall time of the last commit.

  mutable std::mutex mutex_;  ///< Guards all members below.
  Now now_;
  std::optional<Stepping> stepping_;
  std::map<std::int64_t, view::server::Break> breaks_;
  std::int64_t last_break_ = 0;
  /// Time of the next instant, and simulated and wall time from which the speed is measured.
  hal::Time next_{}, paced_from_{}, paced_since_{};
  bool has_begun_ = false;
  mutable std::optional<hal::Time> asked_at_;  ///< Wall time of the last now().
  mutable std::optional<hal::Time> kept_at_;   ///< Wall time of the last keep().
};

}  // namespace baraka::run::live
