#include "hal/files/description/sensor_keys.h"

#include <array>

namespace hal::files::description {
namespace {

using node::devices::Battery;
using node::devices::WhenEmpty;

constexpr std::array kWhenEmpty = {Option<WhenEmpty>{"stay_up", WhenEmpty::kStayUp},
                                   Option<WhenEmpty>{"off", WhenEmpty::kOff}};

constexpr Range kVoltage{0.1, 1e4};  // V
constexpr Range kPower{0, 1e5};      // W

void supply_keys(Fields& io, Battery& c) {
  io.needed({"capacity", "Energy in the full battery.", "20 Wh"}, "J", {1e-6, 1e12}, c.capacity);
  io.number({"charge", "At the start, as a share of the capacity.", "0.8"}, "1", {0, 1}, c.charge);
  io.needed({"full_voltage", "Of the full battery, without load.", "12.6 V"}, "V", kVoltage,
            c.full_voltage);
}

void load_keys(Fields& io, Battery& c) {
  io.number({"empty_voltage",
             "Of the empty battery, without load; in between the voltage falls with the charge.",
             "9.6 V", "that of `full_voltage`"},
            "V", kVoltage, c.empty_voltage);
  io.number({"resistance", "Inside the battery.", "50 mohm"}, "ohm", {0, 1e6}, c.resistance);
  io.number({"idle_power", "Of the computer and all else that is always on.", "4 W"}, "W", kPower,
            c.idle_power);
  io.choice({"when_empty",
             "stay_up: only the gauge tells; off: radio, motors and all sensors but the gauge go "
             "off at that instant, for good.",
             "off"},
            kWhenEmpty, c.when_empty);
}

void radio_keys(Fields& io, node::devices::RadioPower& c) {
  io.number({"transmit", "While it transmits.", "1.3 W"}, "W", kPower, c.transmit);
  io.number({"receive", "While the medium is busy.", "0.9 W"}, "W", kPower, c.receive);
  io.number({"listen", "While the medium is idle.", "0.7 W"}, "W", kPower, c.listen);
  io.number({"off", "While it is off.", "0 W"}, "W", kPower, c.off);
}

}  // namespace

void keys_of(Fields& io, Battery& c) {
  name_key(io, c.mount);
  supply_keys(io, c);
  if (io.reading() != nullptr) c.empty_voltage = c.full_voltage;
  load_keys(io, c);
  if (c.empty_voltage > c.full_voltage)
    io.mistake("empty_voltage", "must not be above full_voltage");
  io.inside({"radio", "What the radio draws from the battery."},
            [&](Fields& radio) { radio_keys(radio, c.radio); });
}

}  // namespace hal::files::description
