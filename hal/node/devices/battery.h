#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/node/devices/value_name.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// Power that a radio draws in each of its states, W, each >= 0.
struct RadioPower {
  double transmit = 0;
  double receive = 0;  ///< The medium is busy: a frame or other energy is received.
  double listen = 0;   ///< The medium is idle.
  double off = 0;
  bool operator==(const RadioPower&) const = default;
};

template <class Fields>
void keys_of(Fields& io, RadioPower& c) {
  io.number({"transmit", "Power while the radio transmits.", "1.3 W"}, "W", {0, 1e5}, c.transmit);
  io.number(
      {"receive", "Power while the medium is busy, but the radio does not transmit.", "0.9 W"}, "W",
      {0, 1e5}, c.receive);
  io.number({"listen", "Power while the medium is idle.", "0.7 W"}, "W", {0, 1e5}, c.listen);
  io.number({"off", "Power while the radio is switched off.", "0 W"}, "W", {0, 1e5}, c.off);
}

/// What happens to an agent whose battery is empty.
enum class WhenEmpty : std::uint8_t {
  kStayUp,  ///< Nothing; only the gauge shows it.
  /// Its radio, motors and sensors, except the gauge, are switched off for the rest of the run.
  kOff,
};
struct WhenEmptyName {
  std::string_view name;  ///< In files.
  WhenEmpty value;
};
inline constexpr std::array kWhenEmptyNames{WhenEmptyName{"stay_up", WhenEmpty::kStayUp},
                                            WhenEmptyName{"off", WhenEmpty::kOff}};

/// A battery with its gauge. It supplies the computer, the radio and the motors.
struct Battery {
  static constexpr std::string_view kKind = "battery";
  static constexpr std::array kValues{ValueName{"charge", "1"}, ValueName{"voltage", "V"},
                                      ValueName{"current", "A"}, ValueName{"energy", "J"},
                                      ValueName{"capacity", "J"}};

  Mount mount{"battery", {}, 0};  ///< Only its name is used.
  double capacity = 0;            ///< J, > 0, when full
  double charge = 1;              ///< 0 .. 1 at the start, share of the capacity
  double full_voltage = 0;        ///< V, > 0, without load
  /// V, > 0, without load; between full and empty the voltage is linear in the charge
  double empty_voltage = 0;
  double resistance = 0;  ///< ohm, >= 0, internal
  double idle_power = 0;  ///< W, >= 0, of the computer and everything else that is always on
  RadioPower radio;
  WhenEmpty when_empty = WhenEmpty::kStayUp;

  /// Kind "battery": charge 0 .. 1; voltage at the terminals [V]; current drawn [A], mean since the
  /// previous reading; energy in the battery now and when it is full [J].
  Channel describe() const;

  bool operator==(const Battery&) const = default;
};

template <class Fields>
void keys_of(Fields& io, Battery& c) {
  name_key(io, c.mount);
  io.needed({"capacity", "Energy of the fully charged battery.", "20 Wh"}, "J", {1e-6, 1e12},
            c.capacity);
  io.number({"charge", "State of charge at the start, as a share of the capacity.", "0.8"}, "1",
            {0, 1}, c.charge);
  io.needed({"full_voltage", "Voltage of the full battery without load.", "12.6 V"}, "V",
            {0.1, 1e4}, c.full_voltage);
  if (io.reading() != nullptr) c.empty_voltage = c.full_voltage;
  io.number(
      {"empty_voltage",
       "Voltage of the empty battery without load; in between the voltage is linear in the charge.",
       "9.6 V", "that of `full_voltage`"},
      "V", {0.1, 1e4}, c.empty_voltage);
  io.number({"resistance", "Internal resistance of the battery.", "50 mohm"}, "ohm", {0, 1e6},
            c.resistance);
  io.number({"idle_power", "Power of the computer and everything else that is always on.", "4 W"},
            "W", {0, 1e5}, c.idle_power);
  io.choice({"when_empty",
             "Effect of an empty battery. stay_up: none, only the gauge shows it; off: radio, "
             "motors and all sensors but the gauge switch off at that instant and stay off.",
             "off"},
            kWhenEmptyNames, c.when_empty);
  if (c.empty_voltage > c.full_voltage)
    io.mistake("empty_voltage", "must not be above full_voltage");
  io.inside({"radio", "Power that the radio draws from the battery."},
            [&](Fields& radio) { keys_of(radio, c.radio); });
}

/// A sum of many terms with compensated rounding, exact except for its last bit (A. Neumaier,
/// "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", ZAMM, 1974).
class ExactSum {
 public:
  void add(double term);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0;
  double lost_ = 0;  ///< Sum of the rounding errors of sum_.
};

/// Discharges a battery: a source of the voltage U(charge) = empty + charge (full - empty) behind
/// the internal resistance R. A load of the power P draws the current I for which
///   P = (U - R I) I,  I = (U - sqrt(U^2 - 4 R P)) / (2 R)
/// and takes the power U I out of the charge, R I^2 of it as heat (M. Chen, G. A. Rincon-Mora,
/// "Accurate Electrical Battery Model Capable of Predicting Runtime and I-V Performance", IEEE
/// Transactions on Energy Conversion, 2006, without its RC elements). The battery cannot supply
/// more than U^2 / (4 R); a greater load draws I = U / (2 R). For a constant load this has a
/// closed-form solution (docs/models.md 6), so the step length does not affect the result.
class Discharge {
 public:
  explicit Discharge(const Battery& battery);

  /// Applies a constant load. An empty battery gives no energy; the charge counted is that of a
  /// load supplied at the voltage of an empty battery.
  /// @param watts  >= 0  @param over  >= 0
  void draw(double watts, Duration over);

  /// Removes energy, or adds it if `joules` is negative, at once and without heat. The energy stays
  /// within 0 .. capacity().
  void take(double joules);

  /// Time [s] until the battery is empty under a constant load; nullopt: never. @param watts  >= 0
  std::optional<double> lasts(double watts) const;

  /// Draws the remainder that rounding left, so that the battery is exactly empty.
  void finish();

  double charge() const { return energy() / capacity_; }  ///< 0 .. 1
  double energy() const;                                  ///< J stored now
  double capacity() const { return capacity_; }           ///< J, when full
  double drawn() const { return drawn_.value(); }        ///< J drawn by loads so far, heat included
  double coulombs() const { return coulombs_.value(); }  ///< A s delivered to loads so far
  double open_voltage() const;                           ///< V, without load
  double resistance() const { return resistance_; }      ///< ohm

 private:
  double spare(double watts) const;
  double draw_fed(double watts, double seconds);
  double draw_limited(double seconds);
  void give(double joules);

  double capacity_;       ///< J
  double empty_voltage_;  ///< V
  double slope_;          ///< V per stored J
  double resistance_;     ///< ohm
  double stored_;         ///< J stored at the start, adjusted by take()
  ExactSum drawn_;        ///< J
  ExactSum coulombs_;     ///< A s
};

}  // namespace hal::node::devices
