#include "sim/agents/supply.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sim::agents {
namespace {

using hal::node::devices::RadioPower;
using radio::RadioActivity;

/// If the battery may be empty within this time [s], the event follows each change of the load.
constexpr double kNear = 0.1;
/// Times below this are ignored [s]: rounding causes such an error in a time of hours.
constexpr double kRounding = 1e-11;
/// Events are scheduled at most this far ahead [s].
constexpr double kFar = 1e9;

double most(const RadioPower& power) {
  return std::max({power.transmit, power.receive, power.listen, power.off});
}

}  // namespace

Supply::Supply(const hal::node::devices::Battery& battery, EventQueue& events, hal::AgentId agent,
               std::function<void()> on_empty)
    : battery_(battery),
      events_(events),
      agent_(agent),
      on_empty_(std::move(on_empty)),
      discharge_(battery),
      most_power_(battery.idle_power + most(battery.radio)) {
  power_ = power();
  watch();
}

void Supply::on_activity(RadioActivity activity) {
  if (activity == activity_) return;
  settle();
  activity_ = activity;
  change();
}

void Supply::set_motors(double watts) {
  if (watts == motors_) return;
  settle();
  motors_ = watts;
  change();
}

void Supply::set_present(bool present) {
  settle();
  is_present_ = present;
  power_ = power();
  watch();
}

void Supply::take(double joules) {
  settle();
  discharge_.take(joules);
  watch();
}

hal::node::devices::Discharge Supply::battery() const {
  hal::node::devices::Discharge now = discharge_;
  now.draw(power_, events_.now() - since_);
  return now;
}

double Supply::load() const {
  return load_.value() + power_ * hal::to_seconds(events_.now() - since_);
}

double Supply::power() const {
  if (!is_present_ || is_spent_) return 0;
  return battery_.idle_power + radio_power() + motors_;
}

double Supply::radio_power() const {
  switch (activity_) {
    case RadioActivity::kTransmitting:
      return battery_.radio.transmit;
    case RadioActivity::kReceiving:
      return battery_.radio.receive;
    case RadioActivity::kListening:
      return battery_.radio.listen;
    case RadioActivity::kOff:
      break;
  }
  return battery_.radio.off;
}

/// Computes the battery up to now.
void Supply::settle() {
  const hal::Time now = events_.now();
  if (now == since_) return;
  load_.add(power_ * hal::to_seconds(now - since_));
  discharge_.draw(power_, now - since_);
  since_ = now;
}

/// Updates the load.
void Supply::change() {
  power_ = power();
  if (power_ > most_power_) {
    most_power_ = 2 * power_;
    watch();
  } else if (is_near_) {
    watch();
  }
}

/// Schedules the next check at the earliest time at which the battery can be empty.
void Supply::watch() {
  events_.cancel(look_);
  if (battery_.when_empty != hal::node::devices::WhenEmpty::kOff || is_spent_ || !is_present_)
    return;
  const std::optional<double> at_least = discharge_.lasts(most_power_);
  if (!at_least) return;
  is_near_ = *at_least < kNear;
  if (!is_near_) return look_in(*at_least);
  if (const std::optional<double> lasts = discharge_.lasts(power_)) look_in(*lasts);
}

/// @param seconds  from now, rounded up to a nanosecond.
void Supply::look_in(double seconds) {
  const double ns = std::ceil(1e9 * (std::min(seconds, kFar) - kRounding));
  const hal::Duration wait{static_cast<hal::Duration::rep>(std::max(0.0, ns))};
  look_ = events_.schedule(events_.now() + wait, Rank::kNodeTimer, agent_, [this] { look(); });
}

void Supply::look() {
  settle();
  const std::optional<double> lasts = discharge_.lasts(power_);
  if (!lasts || *lasts > kRounding) return watch();
  discharge_.finish();
  is_spent_ = true;
  power_ = 0;
  on_empty_();
}

}  // namespace sim::agents
