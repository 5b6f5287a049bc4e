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

/// What a radio draws in each of its states, W, each >= 0.
struct RadioPower {
  double transmit = 0;
  double receive = 0;  ///< The medium is busy: a frame, or energy, comes in.
  double listen = 0;   ///< The medium is idle.
  double off = 0;
  bool operator==(const RadioPower&) const = default;
};

template <class Fields>
void keys_of(Fields& io, RadioPower& c) {
  io.number({"transmit", "While it transmits.", "1.3 W"}, "W", {0, 1e5}, c.transmit);
  io.number({"receive", "While the medium is busy.", "0.9 W"}, "W", {0, 1e5}, c.receive);
  io.number({"listen", "While the medium is idle.", "0.7 W"}, "W", {0, 1e5}, c.listen);
  io.number({"off", "While it is off.", "0 W"}, "W", {0, 1e5}, c.off);
}

/// What becomes of an agent whose battery is empty.
enum class WhenEmpty : std::uint8_t {
  kStayUp,  ///< Nothing: only the gauge tells.
  kOff,     ///< Its radio, its motors and its sensors but the gauge go off for good.
};
struct WhenEmptyName {
  std::string_view name;  ///< In files.
  WhenEmpty value;
};
inline constexpr std::array kWhenEmptyNames{WhenEmptyName{"stay_up", WhenEmpty::kStayUp},
                                            WhenEmptyName{"off", WhenEmpty::kOff}};

/// A battery with its gauge. It feeds the computer, the radio and the motors.
struct Battery {
  static constexpr std::string_view kKind = "battery";
  static constexpr std::array kValues{ValueName{"charge", "1"}, ValueName{"voltage", "V"},
                                      ValueName{"current", "A"}, ValueName{"energy", "J"},
                                      ValueName{"capacity", "J"}};

  Mount mount{"battery", {}, 0};  ///< Only its name counts.
  double capacity = 0;            ///< J, > 0, when full
  double charge = 1;              ///< 0 .. 1 at the start, share of the capacity
  double full_voltage = 0;        ///< V, > 0, without load
  double empty_voltage = 0;       ///< V, > 0, without load; in between it falls with the charge
  double resistance = 0;          ///< ohm, >= 0, inside
  double idle_power = 0;          ///< W, >= 0, of the computer and all that is always on
  RadioPower radio;
  WhenEmpty when_empty = WhenEmpty::kStayUp;

  /// Kind "battery": charge 0 .. 1; voltage at the terminals [V]; current drawn [A], as a mean
  /// since the reading before; energy in the battery now and when it is full [J].
  Channel describe() const;

  bool operator==(const Battery&) const = default;
};

template <class Fields>
void keys_of(Fields& io, Battery& c) {
  name_key(io, c.mount);
  io.needed({"capacity", "Energy in the full battery.", "20 Wh"}, "J", {1e-6, 1e12}, c.capacity);
  io.number({"charge", "At the start, as a share of the capacity.", "0.8"}, "1", {0, 1}, c.charge);
  io.needed({"full_voltage", "Of the full battery, without load.", "12.6 V"}, "V", {0.1, 1e4},
            c.full_voltage);
  if (io.reading() != nullptr) c.empty_voltage = c.full_voltage;
  io.number({"empty_voltage",
             "Of the empty battery, without load; in between the voltage falls with the charge.",
             "9.6 V", "that of `full_voltage`"},
            "V", {0.1, 1e4}, c.empty_voltage);
  io.number({"resistance", "Inside the battery.", "50 mohm"}, "ohm", {0, 1e6}, c.resistance);
  io.number({"idle_power", "Of the computer and all else that is always on.", "4 W"}, "W", {0, 1e5},
            c.idle_power);
  io.choice({"when_empty",
             "stay_up: only the gauge tells; off: radio, motors and all sensors but the gauge go "
             "off at that instant, for good.",
             "off"},
            kWhenEmptyNames, c.when_empty);
  if (c.empty_voltage > c.full_voltage)
    io.mistake("empty_voltage", "must not be above full_voltage");
  io.inside({"radio", "What the radio draws from the battery."},
            [&](Fields& radio) { keys_of(radio, c.radio); });
}

/// A sum of many terms, exact but for its last bit (A. Neumaier, "Rundungsfehleranalyse einiger
/// Verfahren zur Summation endlicher Summen", ZAMM, 1974).
class ExactSum {
 public:
  void add(double term);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0;
  double lost_ = 0;  ///< What rounding took from sum_.
};

/// Empties a battery: a source of the voltage U(charge) = empty + charge (full - empty) behind the
/// internal resistance R. A load of the power P draws the current I of
///   P = (U - R I) I,  I = (U - sqrt(U^2 - 4 R P)) / (2 R)
/// and takes U I out of the charge, R I^2 of it as heat (M. Chen, G. A. Rincon-Mora, "Accurate
/// Electrical Battery Model Capable of Predicting Runtime and I-V Performance", IEEE Transactions
/// on Energy Conversion, 2006, without its RC elements). More than U^2 / (4 R) it cannot give: then
/// I = U / (2 R). While the load is constant this has a solution in closed form (docs/models.md 6),
/// so that the length of the steps changes nothing.
class Discharge {
 public:
  explicit Discharge(const Battery& battery);

  /// A constant load. An empty battery gives no energy; the load is fed as if it had an empty
  /// battery's voltage.
  /// @param watts  >= 0  @param over  >= 0
  void draw(double watts, Duration over);

  /// Charge is gone, or has come, by no load: at once, without heat. @param joules  may be
  /// negative; it gets no fuller than full and no emptier than empty.
  void take(double joules);

  /// s from now on until it is empty under a constant load; none: never. @param watts  >= 0
  std::optional<double> lasts(double watts) const;

  /// What rounding left is drawn.
  void finish();

  double charge() const { return energy() / capacity_; }  ///< 0 .. 1
  double energy() const;                                  ///< J that are in it
  double capacity() const { return capacity_; }           ///< J, when full
  double drawn() const { return drawn_.value(); }         ///< J for loads so far, with the heat
  double coulombs() const { return coulombs_.value(); }   ///< A s through the loads so far
  double open_voltage() const;                            ///< V, without load
  double resistance() const { return resistance_; }       ///< ohm

 private:
  double spare(double watts) const;
  double draw_fed(double watts, double seconds);
  double draw_limited(double seconds);
  void give(double joules);

  double capacity_;       ///< J
  double empty_voltage_;  ///< V
  double slope_;          ///< V per J that are in it
  double resistance_;     ///< ohm
  double stored_;         ///< J that were in it at the start, less those taken
  ExactSum drawn_;        ///< J
  ExactSum coulombs_;     ///< A s
};

}  // namespace hal::node::devices
