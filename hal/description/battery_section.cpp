#include "hal/description/battery_section.h"

#include <array>

#include "hal/description/fields.h"
#include "hal/description/mount_section.h"

namespace hal::description {
namespace {

using devices::Battery;
using devices::WhenEmpty;

constexpr std::array kWhenEmpty = {Option<WhenEmpty>{"stay_up", WhenEmpty::kStayUp},
                                   Option<WhenEmpty>{"off", WhenEmpty::kOff}};

constexpr Range kVoltage{0.1, 1e4};  // V
constexpr Range kPower{0, 1e5};      // W

template <class Io>
void supply_keys(Io& io, Battery& c) {
  io.needed({"capacity", "Energy in the full battery.", "20 Wh"}, "J", {1e-6, 1e12}, c.capacity);
  io.number({"charge", "At the start, as a share of the capacity.", "0.8"}, "1", {0, 1}, c.charge);
  io.needed({"full_voltage", "Of the full battery, without load.", "12.6 V"}, "V", kVoltage,
            c.full_voltage);
}

template <class Io>
void load_keys(Io& io, Battery& c) {
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

template <class Io>
void radio_keys(Io& io, devices::RadioPower& c) {
  io.number({"transmit", "While it transmits.", "1.3 W"}, "W", kPower, c.transmit);
  io.number({"receive", "While the medium is busy.", "0.9 W"}, "W", kPower, c.receive);
  io.number({"listen", "While the medium is idle.", "0.7 W"}, "W", kPower, c.listen);
  io.number({"off", "While it is off.", "0 W"}, "W", kPower, c.off);
}

}  // namespace

void read(Mapping& in, Battery& battery) {
  read_name(in, battery.mount);
  FieldReader reader(in);
  supply_keys(reader, battery);
  battery.empty_voltage = battery.full_voltage;
  load_keys(reader, battery);
  if (battery.empty_voltage > battery.full_voltage)
    in.mistake("empty_voltage", "must not be above full_voltage");
  Mapping radio = in.mapping({"radio", "What the radio draws from the battery."});
  FieldReader radio_reader(radio);
  radio_keys(radio_reader, battery.radio);
  radio.finish();
}

void write(Writer& out, const Battery& battery) {
  Battery copy = battery;
  FieldWriter writer(out);
  write_name(out, battery.mount);
  supply_keys(writer, copy);
  load_keys(writer, copy);
  out.open("radio");
  radio_keys(writer, copy.radio);
  out.close();
}

}  // namespace hal::description
