#include "hal/description/pose_section.h"

#include "hal/description/fields.h"
#include "hal/description/mount_section.h"

namespace hal::description {
namespace {

template <class Io>
void pose_keys(Io& io, devices::PoseSensor& c) {
  io.number({"position_sigma", "Standard deviation of x and of y.", "5 cm"}, "m", {0, 1000},
            c.position_sigma);
  io.number({"heading_sigma", "Standard deviation of the heading.", "2 deg"}, "rad", {0, 10},
            c.heading_sigma);
  io.duration({"period", "Between two measurements; 0 s: it measures when asked.", "1 s"}, {0, 10},
              c.period);
}

}  // namespace

void read(Mapping& in, devices::PoseSensor& pose) {
  read_name(in, pose.mount);
  FieldReader reader(in);
  pose_keys(reader, pose);
}

void write(Writer& out, const devices::PoseSensor& pose) {
  devices::PoseSensor copy = pose;
  FieldWriter writer(out);
  write_name(out, pose.mount);
  pose_keys(writer, copy);
}

}  // namespace hal::description
