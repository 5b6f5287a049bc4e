#pragma once

#include <functional>

#include "hal/node/devices/battery.h"
#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/phy/radio_use.h"

namespace sim::agents {

/// The battery of a simulated agent, and its loads: computer, radio and motors. All loads are
/// constant between the instants at which they change, so the battery is computed in closed form
/// (hal::node::devices::Discharge). With `when_empty: off` it calls back exactly when it is empty,
/// rounded up to a nanosecond, in an event of rank kNodeTimer: what the radio does and ends at that
/// time comes before.
///
///   Supply supply(battery, events, agent, [this] { switch_off(); });
///   mac.set_use_listener(&supply);
///   … after each step of the physics: supply.set_motors(watts); …
///
/// The event is scheduled for the earliest time at which the battery could be empty, at the largest
/// load so far or expected. Only when that time is near, the event follows each change of the load.
class Supply final : public radio::RadioUseListener {
 public:
  Supply(const hal::node::devices::Battery& battery, EventQueue& events, hal::AgentId agent,
         std::function<void()> on_empty);
  ~Supply() override { events_.cancel(look_); }
  Supply(const Supply&) = delete;
  Supply& operator=(const Supply&) = delete;

  void on_activity(radio::RadioActivity activity) override;
  /// Sets the power of the motors from now on [W]. @param watts  >= 0
  void set_motors(double watts);
  /// Sets whether the agent takes part; otherwise nothing is supplied.
  void set_present(bool present);
  /// Removes or adds charge independently of the loads. @param joules  may be negative.
  void take(double joules);

  /// State of the battery now.
  hal::node::devices::Discharge battery() const;
  /// Energy requested by all loads since time 0 [J], including that from an empty battery that does
  /// not switch its agent off.
  double load() const;
  /// Whether it has become empty and switched its agent off: it supplies nothing any more.
  bool is_spent() const { return is_spent_; }

 private:
  double power() const;
  double radio_power() const;
  void settle();
  void change();
  void watch();
  void look_in(double seconds);
  void look();

  const hal::node::devices::Battery battery_;
  EventQueue& events_;
  const hal::AgentId agent_;
  const std::function<void()> on_empty_;
  hal::node::devices::Discharge discharge_;
  hal::node::devices::ExactSum load_;  ///< J
  hal::Time since_{};                  ///< Time up to which the battery has been computed.
  double power_ = 0;                   ///< Load since then [W].
  radio::RadioActivity activity_ = radio::RadioActivity::kListening;
  double motors_ = 0;      ///< W
  double most_power_ = 0;  ///< Largest load for which look_ is valid [W].
  /// The battery may be empty soon: look_ is scheduled for the present load.
  bool is_near_ = false;
  bool is_present_ = true, is_spent_ = false;
  EventQueue::EventId look_;
};

}  // namespace sim::agents
