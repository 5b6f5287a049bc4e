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
#include "sim/core/outside_input.h"
#include "sim/radio/radio_use.h"

namespace sim::agents {

struct Progress {
  hal::Time now{};
  std::uint64_t events = 0;
  std::uint64_t exchanges = 0;
};

/// What an agent used since the start of the run.
struct AgentUse {
  radio::RadioUse radio;
  std::optional<double> energy{};  ///< J drawn from its battery; none: it has none.
  std::optional<double> load{};    ///< J that computer, radio and motors asked for, likewise.
};

/// Decides how fast a run goes and when it is broken off. It may wait; it changes nothing else.
class Pace {
 public:
  virtual ~Pace() = default;
  enum class Verdict : std::uint8_t {
    kGoOn,
    kAskAgain,  ///< It has waited a while; the simulation looks whether the controllers live.
    kBreakOff,
  };
  /// Before the events of `next` run.
  virtual Verdict may_go_on(hal::Time next, const Progress& progress) = 0;
};

/// How a run ended.
struct Outcome {
  enum class Kind : std::uint8_t { kEnded, kUntil, kInterrupted, kFailed };
  Kind kind = Kind::kEnded;
  std::string result;  ///< Of the end condition that held; "until", "interrupted", "failed".
  std::string error;   ///< kFailed: one line that names process, agents and simulated time.
  hal::Time ended_at{};
  std::uint64_t events = 0;
  std::uint64_t exchanges = 0;
  std::uint64_t refused_actions = 0;  ///< Malformed or out of limits, dropped.
  std::uint64_t ode_messages = 0;     ///< Complaints of the physics engine.
  /// One line each, as it happened: "r0 tipped over at 1.230000000 s".
  std::vector<std::string> bodies_lost = {};
  std::optional<RealTimeSummary> real_time = {};  ///< Of follow() and repeat().
};

/// One world of bodies, radio and controllers with one clock. One thread.
///
///   Simulation simulation(config, observers);
///   simulation.connect(port, {id, …}, wants);   // until every agent has a controller
///   const Outcome outcome = simulation.run(std::nullopt, pace);
class Simulation final : public hal::node::exchange::AgentHost {
 public:
  /// @param observers  see everything, in this order; outlive the simulation.
  Simulation(const SimulationConfig& config, const std::vector<Observer*>& observers);
  ~Simulation() override;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// One more observer, after the others. @pre the simulation has not run.
  void add_observer(Observer& observer);

  /// Has it look at the run from now on; at most one. @pre the simulation has not run.
  /// @param sampler  outlives the simulation.
  void set_sampler(Sampler& sampler);

  std::vector<hal::node::exchange::AgentOffer> offers() const override;
  std::vector<hal::node::exchange::AgentName> directory() const override;
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
               const std::vector<hal::AgentId>& agents, const hal::Wants& wants) override;

  /// By which velocities by hand and the like enter the run. Doors are opened before the run; a
  /// repetition is told before it what to take in.
  OutsideInput& outside();

  /// Programs use the interfaces of the agents that have a network: what comes off the air goes to
  /// `sink`, what they send comes from `source`. Before a run in real time, none in a repetition.
  void connect_air(air::FrameSink& sink, air::FrameSource& source);

  /// Has it recorded, as of now, that something came from outside by another way than a door: a
  /// reply of a controller that hears others. On the run's thread.
  void note_arrival(const std::string& name, std::vector<std::uint8_t> bytes);

  /// Runs once, to an end condition or `until`. @pre every agent is connected that has a program.
  Outcome run(std::optional<hal::Time> until, Pace& pace);

  /// The same in real time: simulated time follows a clock and waits for no controller.
  Outcome follow(std::optional<hal::Time> until, FollowedClock& clock);

  /// Repeats a run in real time from its turns: same scenario, seed and controllers, same events.
  /// @param open_loop  something is not as it was: turns that a controller cannot take now, for it
  ///   has another number of events, are left out. Else they are an error.
  Outcome repeat(std::optional<hal::Time> until, std::span<const Turn> turns, Pace& pace,
                 bool open_loop = false);

  /// Ends the run with this result, or fails it with this error: from a receiver of outside(), so
  /// that a repetition ends in the same way. On the run's thread.
  void end(std::string result);
  void fail(std::string error);

  /// How the run stands after an exception out of run(), follow() or repeat(), or while these do
  /// not return from a controller: failed with that error; interrupted if it is empty. It cannot go
  /// on.
  Outcome broken_off_by(const std::string& error);

  /// True state, for expectations: m, world frame.
  BodyState body(hal::AgentId agent) const;
  ContactCounts contacts(hal::AgentId agent) const;
  AgentUse use(hal::AgentId agent) const;
  /// One of quantities(), as it is now; none: the agent does not have it now. @pre it has it.
  std::optional<double> read(const Quantity& quantity, hal::AgentId agent,
                             std::size_t number = 0) const;
  /// Whether a condition of SimulationConfig::asked holds now, or has held at any time of the run.
  bool holds(std::size_t asked) const;
  bool has_held(std::size_t asked) const;
  /// Last state the agent's controller named; empty: none.
  const std::string& state(hal::AgentId agent) const;

 private:
  struct State;
  class RealTimeRun;
  void begin(std::optional<hal::Time> until);
  Outcome end_of(RealTimeRun& run);
  std::unique_ptr<State> state_;
};

}  // namespace sim::agents
