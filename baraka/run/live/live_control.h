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

/// What the page may do with a run that goes on, and what it is told of it.
///
/// In lock-step the run waits between two instants: nothing happens in it meanwhile, no controller
/// owes an answer, and it goes on as if it had not waited. In real time it can be looked at only.
///
///            step done, a break                Resume, Step
///   running ------------------> paused ----------------------> running
///            Pause                       Speed: running on, slower or faster
///
/// act() and now() are of the server's threads; all else is of the run's.
class LiveControl final : public view::server::RunControl,
                          public view::server::Clock,
                          public sim::agents::Observer {
 public:
  struct Settings {
    bool lockstep = true;
    bool paused = false;   ///< From the start, until somebody says otherwise.
    double max_speed = 0;  ///< Simulated seconds per second; 0: as fast as possible.
    /// Makes what there is readable for the server.
    std::function<void()> commit;
    /// For a robot that is driven by hand; @return false: it is not.
    std::function<bool(hal::AgentId, const hal::Twist2&)> drive;
  };

  /// @param config, simulation, clock  outlive this object.
  LiveControl(const sim::agents::SimulationConfig& config,
              const sim::agents::Simulation& simulation, hal::Clock& clock, Settings settings);

  hal::Result<std::int64_t> act(const view::server::Command& command) override;
  Now now() const override;
  void keep() const override;

  /// Before the events of `next`. @return how long to wait before asking again; none: go on.
  std::optional<hal::Duration> hold(hal::Time next);

  /// Whether a page was open, or somebody asked for now(), within that time.
  bool watched_within(hal::Duration time) const;

  /// The run has ended like this.
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
    hal::Time last{-hal::Duration{1}};  ///< Cycles of several agents at one time are one step.
  };

  hal::Result<std::int64_t> start(const view::server::Steps& steps);
  hal::Result<std::int64_t> add(const view::server::Break& at);
  void refresh();
  /// Of hold(), under the lock: the run has come to `next`; whether somebody waits for what is not
  /// written yet; how long to wait.
  void reach(hal::Time next);
  bool is_to_refresh(hal::Time wall) const;
  std::optional<hal::Duration> wait_left(hal::Time wall) const;
  void restart_pace();
  void count(view::server::Steps::Of what, hal::Time at, hal::AgentId agent);
  bool is_watched(view::server::Break::On on) const;
  /// Pauses if a break wants that. @param text  state or topic  @param why  for people
  void pause_if(view::server::Break::On on, hal::AgentId agent, std::string_view text,
                const std::function<std::string()>& why);
  void pause(std::string why);
  std::string name(hal::AgentId agent) const;

  const sim::agents::SimulationConfig& config_;
  const sim::agents::Simulation& simulation_;
  hal::Clock& clock_;
  Settings settings_;
  std::map<hal::AgentId, sim::agents::ContactCounts> contacts_;  ///< At the last cycle.
  hal::Time committed_at_{};                                     ///< By the wall clock.

  mutable std::mutex mutex_;  ///< Of all that follows.
  Now now_;
  std::optional<Stepping> stepping_;
  std::map<std::int64_t, view::server::Break> breaks_;
  std::int64_t last_break_ = 0;
  /// The pace counts from here: simulated and wall.
  hal::Time next_{}, paced_from_{}, paced_since_{};
  bool has_begun_ = false;
  mutable std::optional<hal::Time> asked_at_;  ///< now(), the last time; by the wall clock.
  mutable std::optional<hal::Time> kept_at_;   ///< keep(), likewise.
};

}  // namespace baraka::run::live
