#pragma once

#include <memory>
#include <vector>

#include "hal/node/agent/agent_core.h"
#include "sim/agents/observer.h"
#include "sim/agents/queue_timers.h"
#include "sim/agents/radio_link.h"
#include "sim/agents/senses.h"
#include "sim/agents/simulation_config.h"
#include "sim/agents/supply.h"
#include "sim/agents/surroundings.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::agents {

/// What all agents of a run share; outlives them.
struct Surroundings {
  EventQueue& events;
  physics::World& world;
  Scene& scene;
  Observer& observer;
  const SimulationConfig& config;
};

/// An agent in the simulator: its core, connected to the event queue, the simulated MAC and the
/// scene. Its body, if it has one, is already in the world.
class SimulatedMote : public hal::node::agent::Sensors {
 public:
  SimulatedMote(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                hal::node::agent::AgentListener& listener)
      : SimulatedMote(config, mac, surroundings, listener, nullptr) {}
  ~SimulatedMote() override;
  SimulatedMote(const SimulatedMote&) = delete;
  SimulatedMote& operator=(const SimulatedMote&) = delete;

  const AgentConfig& config() const { return config_; }
  hal::node::agent::AgentCore& core() { return core_; }
  const hal::node::agent::AgentCore& core() const { return core_; }
  const std::string& name() const { return config_.name; }

  /// Schedules the start event and the control cycle, both at the agent's phase. Events for the
  /// controller from before that time (radio and routing are up from time 0) are passed on together
  /// with the start event.
  void start();

  /// The controller has ended: no more events; wheels stop at `stop_at`; radio and routing
  /// continue.
  void silence(hal::Time stop_at);
  /// A new controller begins now, with wheels at rest and the radio on, as far as there is power.
  /// @param wants  of this kind of controller.
  void begin_anew(const hal::Wants& wants);

  /// Switches the power of radio and motors.
  void set_power(bool on);
  /// Sets whether the agent takes part. One that is not present has no power, is not sensed, and
  /// does not use its battery. It returns switched on. The caller handles its body and its
  /// controller.
  void set_present(bool present);
  bool is_present() const { return is_present_; }

  /// Its battery; null if it has none and therefore never runs out of energy.
  Supply* supply() { return supply_.get(); }
  const Supply* supply() const { return supply_.get(); }

  void advance(hal::Time at) override { senses_.advance(at); }
  bool sample(std::size_t channel, hal::Time at, std::vector<double>& values) override;

 protected:
  /// @param drive  of the derived agent; null if it has none.
  SimulatedMote(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                hal::node::agent::AgentListener& listener, hal::node::agent::Drive* drive);

  hal::AgentId id() const { return id_; }
  Surroundings& surroundings() { return surroundings_; }
  const Surroundings& surroundings() const { return surroundings_; }
  const Senses& senses() const { return senses_; }

 private:
  void add_supply();
  sensing::SensorSite site();
  /// Whether there is power to measure with: after an empty battery has switched the agent off,
  /// only the gauge of that battery still delivers values.
  bool is_fed(const hal::Channel& channel) const;
  void on_control();
  void on_empty();
  void power_motors();
  virtual void set_motors(bool on) { (void)on; }

  const AgentConfig& config_;
  Surroundings surroundings_;
  const hal::AgentId id_;
  RadioLink link_;
  QueueTimers timers_;
  hal::node::agent::AgentCore core_;
  Senses senses_;
  radio::MacSap& mac_;
  std::unique_ptr<Supply> supply_;
  bool is_on_ = true, is_present_ = true;
  EventQueue::EventId stop_;  ///< Stops the wheels after the end of a controller.
};

}  // namespace sim::agents
