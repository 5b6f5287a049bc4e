#include "hal/files/description/sensor_keys.h"

namespace hal::files::description {

void keys_of(Fields& io, node::devices::PoseSensor& c) {
  name_key(io, c.mount);
  io.number({"position_sigma", "Standard deviation of x and of y.", "5 cm"}, "m", {0, 1000},
            c.position_sigma);
  io.number({"heading_sigma", "Standard deviation of the heading.", "2 deg"}, "rad", {0, 10},
            c.heading_sigma);
  io.duration({"period", "Between two measurements; 0 s: it measures when asked.", "1 s"}, {0, 10},
              c.period);
}

}  // namespace hal::files::description
