#include "hal/description/scan_section.h"

#include "hal/description/fields.h"
#include "hal/description/mount_section.h"

namespace hal::description {
namespace {

constexpr double kFullTurn = 6.2831853071795865;  // rad

template <class Io>
void scan_keys(Io& io, devices::ScanSensor& c) {
  io.number({"field", "Angle between the first and the last ray, half to each side of the heading.",
             "270 deg", "360 deg"},
            "rad", {0, kFullTurn}, c.field);
  io.count({"rays", "In the field, evenly.", "360"}, 1, 10'000, c.rays);
  io.needed({"min_range", "What is nearer is not measured.", "12 cm"}, "m", {0, 1000}, c.min_range);
  io.needed({"max_range", "What is farther is not seen.", "3.5 m"}, "m", {1e-3, 1000}, c.max_range);
  io.number({"noise_sigma", "Standard deviation of a range.", "1 cm"}, "m", {0, 10}, c.noise_sigma);
  io.duration({"period", "Between two measurements; 0 s: it measures when asked.", "200 ms"},
              {0, 10}, c.period);
}

}  // namespace

void read(Mapping& in, devices::ScanSensor& scan) {
  scan.field = kFullTurn;
  scan.rays = 360;
  read_mount(in, scan.mount);
  FieldReader reader(in);
  scan_keys(reader, scan);
  if (scan.max_range <= scan.min_range) in.mistake("max_range", "must be above min_range");
}

void write(Writer& out, const devices::ScanSensor& scan) {
  devices::ScanSensor copy = scan;
  FieldWriter writer(out);
  write_mount(out, scan.mount);
  scan_keys(writer, copy);
}

}  // namespace hal::description
