#include "hal/files/description/sensor_keys.h"

namespace hal::files::description {

void keys_of(Fields& io, node::devices::ScanSensor& c) {
  constexpr double kFullTurn = 6.2831853071795865;  // rad
  if (!io.is_writing()) {
    c.field = kFullTurn;
    c.rays = 360;
  }
  keys_of(io, c.mount);
  io.number({"field", "Angle between the first and the last ray, half to each side of the heading.",
             "270 deg", "360 deg"},
            "rad", {0, kFullTurn}, c.field);
  io.count({"rays", "In the field, evenly.", "360"}, 1, 10'000, c.rays);
  io.needed({"min_range", "What is nearer is not measured.", "12 cm"}, "m", {0, 1000}, c.min_range);
  io.needed({"max_range", "What is farther is not seen.", "3.5 m"}, "m", {1e-3, 1000}, c.max_range);
  io.number({"noise_sigma", "Standard deviation of a range.", "1 cm"}, "m", {0, 10}, c.noise_sigma);
  io.duration({"period", "Between two measurements; 0 s: it measures when asked.", "200 ms"},
              {0, 10}, c.period);
  if (c.max_range <= c.min_range) io.mistake("max_range", "must be above min_range");
}

}  // namespace hal::files::description
