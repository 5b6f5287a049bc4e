#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/agents/observer.h"
#include "sim/agents/quantities.h"
#include "sim/agents/real_time.h"
#include "sim/agents/sampler.h"
#include "sim/agents/simulation_config.h"
#include "sim/air/frame_sink.h"
#include "sim/air/frame_source.h"
#include "sim/air/held_programs.h"
#include "sim/core/outside_input.h"
#include "sim/radio/phy/radio_use.h"

namespace sim::agents {

struct Progress {
  hal::Time now{};
  std::uint64_t events = 0;
  std::uint64_t exchanges = 0;
};

/// What an agent has used since the start of the run.
struct AgentUse {
  radio::RadioUse radio;
  std::optional<double> energy{};  ///< Drawn from its battery [J]; nullopt: it has none.
  /// Requested by computer, radio and motors [J]; nullopt: no battery.
  std::optional<double> load{};
};

/// Decides how fast a run proceeds and when it is interrupted. It may wait; it changes nothing
/// else.
class Pace {
 public:
  virtual ~Pace() = default;
  enum class Verdict : std::uint8_t {
    kGoOn,
    /// It has waited for a while; the simulation checks that the controllers are alive.
    kAskAgain,
    kBreakOff,
  };
  /// Called before the events of `next` run.
  virtual Verdict may_go_on(hal::Time next, const Progress& progress) = 0;
};

/// How a run ended.
struct Outcome {
  enum class Kind : std::uint8_t { kEnded, kUntil, kInterrupted, kFailed };
  Kind kind = Kind::kEnded;
  std::string result;  ///< Result of the end condition; "until", "interrupted" or "failed".
  std::string error;   ///< kFailed: one line with process, agents and simulated time.
  hal::Time ended_at{};
  std::uint64_t events = 0;
  std::uint64_t exchanges = 0;
  std::uint64_t refused_actions = 0;  ///< Malformed or out of limits, and therefore dropped.
  std::uint64_t ode_messages = 0;     ///< Messages of the physics engine.
  /// One line per lost body, in order: "r0 tipped over at 1.230000000 s".
  std::vector<std::string> bodies_lost = {};
  std::optional<RealTimeSummary> real_time = {};  ///< For follow() and repeat().
  /// Of run() with programs: what passed the interfaces; nothing is late.
  std::optional<AirSummary> held_air = {};
};

/// A simulation of bodies, radio and controllers with one clock. One thread.
///
///   Simulation simulation(config, observers);
///   simulation.connect(port, {id, …}, wants);   // until every agent has a controller
///   const Outcome outcome = simulation.run(std::nullopt, pace);
class Simulation final : public hal::node::exchange::AgentHost {
 public:
  /// @param observers  called for everything, in this order; outlive the simulation.
  Simulation(const SimulationConfig& config, const std::vector<Observer*>& observers);
  ~Simulation() override;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Adds an observer after the others. @pre the simulation has not run.
  void add_observer(Observer& observer);

  /// Sets the sampler; there is at most one. @pre the simulation has not run.
  /// @param sampler  outlives the simulation.
  void set_sampler(Sampler& sampler);

  std::vector<hal::node::exchange::AgentOffer> offers() const override;
  std::vector<hal::node::exchange::AgentName> directory() const override;
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
               const std::vector<hal::AgentId>& agents, const hal::Wants& wants) override;

  /// Entry for velocities from teleoperation and other input from outside. Doors are opened before
  /// the run; for a repetition, the recorded inputs are also set before it.
  OutsideInput& outside();

  /// Connects programs to the interfaces of the agents that have a network: received frames go to
  /// `sink`, frames of programs come from `source`. Before a real-time run; not for a repetition.
  void connect_air(air::FrameSink& sink, air::FrameSource& source);

  /// The same for a run in lock-step, in which the programs go on when the run says so.
  void connect_air(air::FrameSink& sink, air::HeldPrograms& programs);

  /// Simulated time: of the last event.
  hal::Time now() const;
  /// In lock-step: makes the run have an instant at this time, not before now(), after which
  /// controllers whose answers take simulated time are asked for them.
  void stop_at(hal::Time at);

  /// In lock-step: something comes from programs at this instant, through a door of outside().
  void arrive(const std::string& door, std::span<const std::uint8_t> bytes);

  /// Before run(), in place of programs: what came from them in a run in lock-step, in that order.
  void repeat_arrivals(std::vector<OutsideArrival> arrivals);

  /// Has it recorded, as of now, that something came from outside by another way than a door: a
  /// reply of a controller that hears others. On the run's thread.
  void note_arrival(const std::string& name, std::vector<std::uint8_t> bytes);

  /// Runs once, until an end condition or `until`. @pre every agent that has a program is
  /// connected.
  Outcome run(std::optional<hal::Time> until, Pace& pace);

  /// The same in real time: simulated time follows a clock and never waits for controllers.
  Outcome follow(std::optional<hal::Time> until, FollowedClock& clock);

  /// Repeats a real-time run from its turns: same scenario, seed and controllers, same events.
  /// @param open_loop  true if something differs from the recorded run: turns that a controller
  /// cannot take, because it has another number of events, are skipped. Otherwise they are an
  /// error.
  Outcome repeat(std::optional<hal::Time> until, std::span<const Turn> turns, Pace& pace,
                 bool open_loop = false);

  /// Ends the run with this result, or fails it with this error. Call from a receiver of outside(),
  /// so that a repetition ends in the same way. On the run's thread.
  void end(std::string result);
  void fail(std::string error);

  /// Outcome of a run after an exception from run(), follow() or repeat(), or while these are
  /// blocked in a controller: failed with that error, or interrupted if it is empty. The run cannot
  /// continue.
  Outcome broken_off_by(const std::string& error);

  /// True state, world frame [m].
  BodyState body(hal::AgentId agent) const;
  ContactCounts contacts(hal::AgentId agent) const;
  AgentUse use(hal::AgentId agent) const;
  /// Current value of one of quantities(); nullopt: no value now. @pre the agent has the quantity.
  std::optional<double> read(const Quantity& quantity, hal::AgentId agent,
                             std::size_t number = 0) const;
  /// Whether a condition of SimulationConfig::asked holds now, or has held at any time of the run.
  bool holds(std::size_t asked) const;
  bool has_held(std::size_t asked) const;
  /// Last state that the agent's controller named; empty if none.
  const std::string& state(hal::AgentId agent) const;

 private:
  struct State;
  class RealTimeRun;
  void begin(std::optional<hal::Time> until);
  Outcome end_of(RealTimeRun& run);
  std::unique_ptr<State> state_;
};

}  // namespace sim::agents
