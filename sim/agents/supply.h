#pragma once

#include <functional>

#include "hal/node/devices/battery.h"
#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/radio_use.h"

namespace sim::agents {

/// The battery of a simulated agent, and what it feeds: computer, radio and motors. All loads are
/// constant between the instants at which they change, so that the battery is followed in closed
/// form (hal::node::devices::Discharge). With `when_empty: off` it tells at the very instant at
/// which it is empty, rounded up to a nanosecond: by an event of the rank kNodeTimer, so that what
/// the radio does and ends at that instant is done and has ended.
///
///   Supply supply(battery, events, agent, [this] { switch_off(); });
///   mac.set_use_listener(&supply);
///   … after each step of the physics: supply.set_motors(watts); …
///
/// The event stands where the battery could be empty at the earliest, under the largest load that
/// it may get or has had. Only when that is near it follows each change of the load.
class Supply final : public radio::RadioUseListener {
 public:
  Supply(const hal::node::devices::Battery& battery, EventQueue& events, hal::AgentId agent,
         std::function<void()> on_empty);
  ~Supply() override { events_.cancel(look_); }
  Supply(const Supply&) = delete;
  Supply& operator=(const Supply&) = delete;

  void on_activity(radio::RadioActivity activity) override;
  /// What the motors take from now on. @param watts  >= 0
  void set_motors(double watts);
  /// Whether the agent takes part: else nothing is fed.
  void set_present(bool present);
  /// Charge is gone, or has come, by no load. @param joules  may be negative.
  void take(double joules);

  /// The battery as of now.
  hal::node::devices::Discharge battery() const;
  /// J that all loads took since time 0, also from a battery that was empty and let them stay up.
  double load() const;
  /// It was empty and switched its agent off: it feeds nothing any more.
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
  hal::Time since_{};                  ///< Until when it has been followed.
  double power_ = 0;                   ///< W, since then.
  radio::RadioActivity activity_ = radio::RadioActivity::kListening;
  double motors_ = 0;      ///< W
  double most_power_ = 0;  ///< W, that look_ allows for.
  bool is_near_ = false;   ///< It may be empty soon: look_ is for the load there is.
  bool is_present_ = true, is_spent_ = false;
  EventQueue::EventId look_;
};

}  // namespace sim::agents
