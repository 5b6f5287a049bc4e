#include "hal/files/description/sensor_keys.h"

namespace hal::files::description {

void keys_of(Fields& io, node::devices::Sonar& c) {
  keys_of(io, c.mount);
  io.needed({"half_angle", "Between the axis of the cone that the sensor sees and its surface.",
             "15 deg"},
            "rad", {1e-3, 1.5}, c.half_angle);
  io.needed({"min_range", "What is nearer is not measured.", "2 cm"}, "m", {0, 1000}, c.min_range);
  io.needed({"max_range", "What is farther is not seen.", "4 m"}, "m", {1e-3, 1000}, c.max_range);
  io.number({"resolution", "Ranges are multiples of it; 0 m: continuous.", "3 mm"}, "m", {0, 10},
            c.resolution);
  io.number({"noise_sigma", "Standard deviation of a range.", "1 cm"}, "m", {0, 10}, c.noise_sigma);
  io.duration({"period", "Between two measurements; 0 s: it measures when asked.", "60 ms"},
              {0, 10}, c.period);
  if (c.max_range <= c.min_range) io.mistake("max_range", "must be above min_range");
}

}  // namespace hal::files::description
