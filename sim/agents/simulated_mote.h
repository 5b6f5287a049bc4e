#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hal/agent/agent_core.h"
#include "hal/devices/battery.h"
#include "hal/devices/sensor.h"
#include "sim/agents/observer.h"
#include "sim/agents/queue_timers.h"
#include "sim/agents/radio_link.h"
#include "sim/agents/simulation_config.h"
#include "sim/agents/surroundings.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac_sap.h"

namespace sim::agents {

/// What a radio drew, J.
double energy(const radio::RadioUse& use, const hal::devices::RadioPower& power);

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
class SimulatedMote : public hal::agent::Sensors {
 public:
  SimulatedMote(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                hal::agent::AgentListener& listener)
      : SimulatedMote(config, mac, surroundings, listener, nullptr) {}
  ~SimulatedMote() override = default;
  SimulatedMote(const SimulatedMote&) = delete;
  SimulatedMote& operator=(const SimulatedMote&) = delete;

  const AgentConfig& config() const { return config_; }
  hal::agent::AgentCore& core() { return core_; }
  const hal::agent::AgentCore& core() const { return core_; }
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

  /// How long it has not been present in all.
  hal::Duration absence(hal::Time now) const {
    return is_present_ ? absence_ : absence_ + (now - absent_since_);
  }

  /// Of the first battery now, 0 .. 1; none: it has none.
  std::optional<double> charge();
  /// Takes charge out of the first battery. @param joules  may be negative. @pre it has one.
  void drain(double joules);
  /// J, of the first battery, full. @pre it has one.
  double capacity() const;

  bool sample(std::size_t channel, hal::Time at, std::vector<double>& values) override;

 protected:
  /// @param drive  of the derived agent; null: none.
  SimulatedMote(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                hal::agent::AgentListener& listener, hal::agent::Drive* drive);

  hal::AgentId id() const { return id_; }
  Surroundings& surroundings() { return surroundings_; }
  const Surroundings& surroundings() const { return surroundings_; }

 private:
  /// One of `sensors:`, and its last values.
  struct Part {
    std::unique_ptr<hal::devices::Sensor> sensor;
    std::vector<double> held;
  };

  void add_sensors(radio::MacSap& mac);
  const std::vector<double>& read(Part& part, hal::Time at);
  void on_control();
  void cut_power();
  void power_motors();
  virtual void set_motors(bool on) { (void)on; }
  void localise(hal::Time at, std::vector<double>& values);

  const AgentConfig& config_;
  Surroundings surroundings_;
  const hal::AgentId id_;
  RadioLink link_;
  QueueTimers timers_;
  hal::agent::AgentCore core_;
  std::vector<Part> sensors_;  ///< As in the description.
  /// Of the battery that, empty, switches the agent off; none: there is no such, or it is empty.
  std::optional<std::size_t> cutting_;
  bool is_empty_ = false, is_on_ = true, is_present_ = true;
  std::optional<std::size_t> battery_;  ///< The first one.
  double taken_energy_ = 0;             ///< J, out of that, by no load.
  std::optional<double> kept_charge_;   ///< While it is not present.
  hal::Time absent_since_{};            ///< If it is not present.
  hal::Duration absence_{};             ///< Before that.
  EventQueue::EventId stop_;            ///< Of the wheels, after the end of a controller.
};

}  // namespace sim::agents
