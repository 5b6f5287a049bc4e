#pragma once

#include <cstdint>
#include <string_view>

#include "hal/devices/mount.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::devices {

/// What a radio draws in each of its states, W, each >= 0.
struct RadioPower {
  double transmit = 0;
  double receive = 0;  ///< The medium is busy: a frame, or energy, comes in.
  double listen = 0;   ///< The medium is idle.
  double off = 0;
  bool operator==(const RadioPower&) const = default;
};

/// What becomes of an agent whose battery is empty.
enum class WhenEmpty : std::uint8_t {
  kStayUp,  ///< Nothing: only the gauge tells.
  kOff,     ///< Its radio and its motors go off for good.
};

/// A battery with its gauge. It feeds the computer, the radio and the motors.
struct Battery {
  static constexpr std::string_view kKind = "battery";

  Mount mount{"battery", {}, 0};  ///< Only its name counts.
  double capacity = 0;            ///< J, > 0, when full
  double charge = 1;              ///< 0 .. 1 at the start, share of the capacity
  double full_voltage = 0;        ///< V, > 0, without load
  double empty_voltage = 0;       ///< V, > 0, without load; in between it falls with the charge
  double resistance = 0;          ///< ohm, >= 0, inside
  double idle_power = 0;          ///< W, >= 0, of the computer and all that is always on
  RadioPower radio;
  WhenEmpty when_empty = WhenEmpty::kStayUp;

  /// Kind "battery": charge 0 .. 1, voltage at the terminals [V], current drawn [A], as a mean
  /// since the reading before.
  Channel describe() const;

  bool operator==(const Battery&) const = default;
};

/// Empties a battery: a source of the voltage U(charge) = empty + charge (full - empty) behind the
/// internal resistance R. A load of the power P draws the current I of
///   P = (U - R I) I,  I = (U - sqrt(U^2 - 4 R P)) / (2 R)
/// and takes U I out of the charge, R I^2 of it as heat (M. Chen, G. A. Rincon-Mora, "Accurate
/// Electrical Battery Model Capable of Predicting Runtime and I-V Performance", IEEE Transactions
/// on Energy Conversion, 2006, without its RC elements). More than U^2 / (4 R) it cannot give.
class Discharge {
 public:
  explicit Discharge(const Battery& battery) : battery_(battery), charge_(battery.charge) {}

  /// Loads drew so much energy, evenly. @param joules  >= 0. @param over  > 0.
  void draw(double joules, Duration over);

  /// Charge is gone, or has come, by no load: at once, without heat. @param joules  may be
  /// negative.
  void take(double joules);

  double charge() const { return charge_; }    ///< 0 .. 1
  double voltage() const;                      ///< V, at the terminals, under the last load
  double current() const { return current_; }  ///< A, of the last load

 private:
  double open_voltage() const;

  Battery battery_;
  double charge_;
  double current_ = 0;
};

}  // namespace hal::devices
