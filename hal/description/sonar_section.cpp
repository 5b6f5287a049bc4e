#include "hal/description/sonar_section.h"

#include "hal/description/fields.h"
#include "hal/description/mount_section.h"

namespace hal::description {
namespace {

template <class Io>
void sonar_keys(Io& io, devices::Sonar& c) {
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
}

}  // namespace

void read(Mapping& in, devices::Sonar& sonar) {
  read_mount(in, sonar.mount);
  FieldReader reader(in);
  sonar_keys(reader, sonar);
  if (sonar.max_range <= sonar.min_range) in.mistake("max_range", "must be above min_range");
}

void write(Writer& out, const devices::Sonar& sonar) {
  devices::Sonar copy = sonar;
  FieldWriter writer(out);
  write_mount(out, sonar.mount);
  sonar_keys(writer, copy);
}

}  // namespace hal::description
