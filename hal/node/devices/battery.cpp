#include "hal/node/devices/battery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::node::devices {
namespace {

/// Operating point of a battery under a load that it can supply.
struct Operation {
  double open = 0;      ///< V, without load
  double root = 0;      ///< V: sqrt(open^2 - 4 R P)
  double terminal = 0;  ///< V, at the terminals: open - R I
};

/// @param squared  R P, at most open^2 / 4 [V^2].
Operation operation(double open, double squared) {
  const double least = 2 * std::sqrt(squared);
  const double root = std::sqrt(std::max(0.0, (open - least) * (open + least)));
  return {open, root, 0.5 * (open + root)};
}

/// 1 - atan(x) / x. @param x  >= 0
double lack_of_atan(double x) {
  constexpr double kSmall = 0.1;
  if (x > kSmall) return 1 - math::atan2(x, 1) / x;
  constexpr std::array kTerms{1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11,
                              1.0 / 9,  1.0 / 7,  1.0 / 5,  1.0 / 3};
  double sum = 0;
  for (const double term : kTerms) sum = x * x * (term - sum);
  return sum;
}

/// log(1 + x) / x. @param x  >= 0
double share_of_log(double x) {
  constexpr double kSmall = 1e-3;
  if (x > kSmall) return math::log(1 + x) / x;
  constexpr std::array kTerms{1.0 / 6, 1.0 / 5, 1.0 / 4, 1.0 / 3, 1.0 / 2, 1.0};
  double sum = 0;
  for (const double term : kTerms) sum = term - x * sum;
  return sum;
}

/// A supplied amount of energy.
struct Drain {
  double joules;
  double watts;
  double fall;  ///< V, by which this energy lowers the voltage without load
};

/// Time [s] in which a constant load draws an amount of energy. With a^2 = R P and the terminal
/// voltage V, U = V + a^2 / V is linear in the energy E, and dE/dt = -P (1 + a^2 / V^2).
/// Integration over V gives the antiderivative V - 2 a atan(V / a). The form used here avoids
/// cancellation when V hardly changes or R is small.
/// @param squared  a^2 [V^2]
double seconds_to_draw(const Drain& drain, const Operation& from, const Operation& to,
                       double squared) {
  const auto [joules, watts, fall] = drain;
  if (squared == 0) return joules / watts;
  const double product = from.terminal * to.terminal;
  const double roots = from.root + to.root;
  double bend = 0;
  if (product > squared && roots > 0) {
    const double sag = 0.5 * fall * (1 + (from.open + to.open) / roots);
    const double x = std::sqrt(squared) * sag / (squared + product);
    bend = 2 * squared * lack_of_atan(x) / (product - squared);
  }
  return joules / watts * product / (squared + product) * (1 + bend);
}

/// Power [W] that a supplied load takes out of the charge, heat included.
double power_within(double watts, double terminal, double squared) {
  return watts * (1 + squared / (terminal * terminal));
}

}  // namespace

Channel Battery::describe() const {
  Channel channel;
  channel.name = mount.name;
  channel.kind = std::string(kKind);
  channel.unit = "1, V, A, J, J";
  channel.length = 5;
  channel.frame = "base";
  return channel;
}

void ExactSum::add(double term) {
  const double sum = sum_ + term;
  lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
  sum_ = sum;
}

Discharge::Discharge(const Battery& battery)
    : capacity_(battery.capacity),
      empty_voltage_(battery.empty_voltage),
      slope_((battery.full_voltage - battery.empty_voltage) / battery.capacity),
      resistance_(battery.resistance),
      stored_(battery.charge * battery.capacity) {}

double Discharge::energy() const { return std::max(0.0, stored_ - drawn_.value()); }

double Discharge::open_voltage() const { return empty_voltage_ + slope_ * energy(); }

void Discharge::draw(double watts, Duration over) {
  BARAKA_CHECK(watts >= 0 && over >= Duration::zero());
  double seconds = to_seconds(over);
  if (watts == 0 || seconds == 0) return;
  seconds = draw_fed(watts, seconds);
  if (seconds > 0) seconds = draw_limited(seconds);
  if (seconds <= 0) return;
  const double squared = resistance_ * watts;
  const bool is_fed = empty_voltage_ * empty_voltage_ >= 4 * squared;
  const double amperes = is_fed ? watts / operation(empty_voltage_, squared).terminal
                                : empty_voltage_ / (2 * resistance_);
  coulombs_.add(amperes * seconds);
}

/// Energy [J] at which the voltage becomes too low to supply the load; negative if that never
/// happens.
double Discharge::spare(double watts) const {
  const double least = 2 * std::sqrt(resistance_ * watts);
  if (slope_ > 0) return (least - empty_voltage_) / slope_;
  constexpr double kEver = std::numeric_limits<double>::infinity();
  return least > empty_voltage_ ? kEver : -kEver;
}

/// Supplies a load until the battery no longer can. @return remaining time [s].
double Discharge::draw_fed(double watts, double seconds) {
  const double able = energy() - std::max(0.0, spare(watts));
  if (!(able > 0)) return seconds;
  const double squared = resistance_ * watts;
  const Operation from = operation(open_voltage(), squared);
  const auto seconds_for = [&](double joules, const Operation& to) {
    return seconds_to_draw({joules, watts, slope_ * joules}, from, to, squared);
  };
  // Supplying a load loses at most as much as heat as the load receives.
  if (2 * watts * seconds > able) {
    const double all = seconds_for(able, operation(from.open - slope_ * able, squared));
    if (seconds >= all) {
      give(able);
      return seconds - all;
    }
  }
  // Newton's method: the power grows as the voltage falls, so the iteration converges from below,
  // quadratically: after a step of 1e-9 the next would be 1e-18.
  double joules = std::min(able, seconds * power_within(watts, from.terminal, squared));
  constexpr int kMostSteps = 50;
  constexpr double kLastStep = 1e-9;
  for (int i = 0; squared > 0 && i < kMostSteps; ++i) {
    const Operation to = operation(from.open - slope_ * joules, squared);
    const double more =
        (seconds - seconds_for(joules, to)) * power_within(watts, to.terminal, squared);
    joules = std::min(able, joules + more);
    if (std::abs(more) <= kLastStep * joules) break;
  }
  give(joules);
  return 0;
}

/// Discharges by a load that takes the maximum power, U^2 / (2 R) including the heat: 1 / U grows
/// linearly with time.
/// @return remaining time [s] after the battery is empty.
double Discharge::draw_limited(double seconds) {
  const double joules = energy();
  if (!(joules > 0)) return seconds;
  const double open = open_voltage();
  const double all = 2 * resistance_ * joules / (open * empty_voltage_);
  if (seconds >= all) {
    give(joules);
    return seconds - all;
  }
  const double rate = open / (2 * resistance_);
  give(seconds * rate * open / (1 + slope_ * seconds * rate));
  return 0;
}

/// The charge is the integral of dQ = dE / U.
void Discharge::give(double joules) {
  const double open = open_voltage() - slope_ * joules;
  coulombs_.add(joules / open * share_of_log(slope_ * joules / open));
  drawn_.add(joules);
}

void Discharge::take(double joules) {
  const double before = energy();
  stored_ += std::clamp(before - joules, 0.0, capacity_) - before;
}

std::optional<double> Discharge::lasts(double watts) const {
  const double joules = energy();
  if (!(joules > 0)) return 0;
  if (watts == 0) return std::nullopt;
  const double able = std::max(0.0, joules - std::max(0.0, spare(watts)));
  const double rest = joules - able;
  const double squared = resistance_ * watts;
  const double open = open_voltage(), low = open - slope_ * able;
  double seconds = 0;
  if (able > 0)
    seconds = seconds_to_draw({able, watts, slope_ * able}, operation(open, squared),
                              operation(low, squared), squared);
  if (rest > 0) seconds += 2 * resistance_ * rest / (low * empty_voltage_);
  return seconds;
}

void Discharge::finish() { drawn_.add(stored_ - drawn_.value()); }

}  // namespace hal::node::devices
