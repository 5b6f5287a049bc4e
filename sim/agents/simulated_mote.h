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
#include "sim/radio/mac_sap.h"

namespace sim::agents {

/// What all agents of a run share; outlives them.
struct Surroundings {
  EventQueue& events;
  physics::World& world;
  Scene& scene;
  Observer& observer;
  const SimulationConfig& config;
};

/// An agent in the simulator: its core, whose ports end in the event queue, the simulated MAC and
/// the scene. Its body, if it has one, is in the world already.
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

  /// Schedules the start event and the control cycle: both at the agent's phase. What is there for
  /// the controller before that (radio and routing are up from time 0) is handed over with it.
  void start();

  /// Its controller is gone: no more events; wheels stop at `at`; radio and routing live on.
  void silence(hal::Time stop_at);
  /// A controller that knows nothing begins now, with wheels that stand and the radio on, as far as
  /// it has power. @param wants  of its kind.
  void begin_anew(const hal::Wants& wants);

  /// Radio and motors have power, or have not.
  void set_power(bool on);
  /// Whether the agent takes part: else it has no power, is not seen, and its battery does not run
  /// down. It comes switched on. Its body and its controller are for the caller to see to.
  void set_present(bool present);
  bool is_present() const { return is_present_; }

  /// Its battery; null: it has none, and never runs out of energy.
  Supply* supply() { return supply_.get(); }
  const Supply* supply() const { return supply_.get(); }

  void advance(hal::Time at) override { senses_.advance(at); }
  bool sample(std::size_t channel, hal::Time at, std::vector<double>& values) override;

 protected:
  /// @param drive  of the derived agent; null: none.
  SimulatedMote(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                hal::node::agent::AgentListener& listener, hal::node::agent::Drive* drive);

  hal::AgentId id() const { return id_; }
  Surroundings& surroundings() { return surroundings_; }
  const Surroundings& surroundings() const { return surroundings_; }
  const Senses& senses() const { return senses_; }

 private:
  void add_supply();
  sensing::SensorSite site();
  /// Whether there is power to measure with: nothing but the gauge of an empty battery tells
  /// anything if that has switched the agent off.
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
  EventQueue::EventId stop_;  ///< Of the wheels, after the end of a controller.
};

}  // namespace sim::agents
