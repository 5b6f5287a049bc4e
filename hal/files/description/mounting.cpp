#include "hal/files/description/mounting.h"

#include "hal/types/math.h"

namespace hal::files::description {
namespace {

void polar_keys(Fields& io, Vec2& position, double& bearing) {
  double distance = 0;
  io.needed({"distance", "Distance from the origin of the body frame.", "13 cm"}, "m",
            {0, kOffset.high}, distance);
  io.needed(
      {"bearing",
       "Direction seen from the origin of the body frame: 0 is the x axis, 90 deg the y axis.",
       "60 deg"},
      "rad", kAngle, bearing);
  if (io.reading() != nullptr)
    position = {distance * math::cos(bearing), distance * math::sin(bearing)};
}

}  // namespace

void mounting_keys(Fields& io, const Key& heading, Vec2& position, double& angle) {
  Mapping* const in = io.reading();
  const bool is_told = in == nullptr && !io.is_writing();
  const bool has_distance = in != nullptr && in->has("distance");
  const bool is_polar = (in != nullptr && in->has("bearing")) || has_distance;
  double bearing = 0;
  if (is_polar || is_told) {
    io.only(true, {"position", {"absent"}}, "",
            [&](Fields& polar) { polar_keys(polar, position, bearing); });
  }
  io.only(!is_polar, {"distance", {"absent"}}, "is given twice: also by distance and bearing",
          [&](Fields& cartesian) {
            cartesian.needed({"position", "Position in the body frame.", "[10 cm, 5 cm]"}, "m",
                             kOffset, position);
          });
  if (in != nullptr) angle = is_polar ? bearing : math::atan2(position.y, position.x);
  io.number(heading, "rad", kAngle, angle);
}

}  // namespace hal::files::description
