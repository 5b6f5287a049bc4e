#include "hal/files/description/infrared_section.h"

#include <stdexcept>

#include "hal/files/description/field_io.h"
#include "hal/types/math.h"

namespace hal::files::description {
namespace {

using node::devices::Converter;
using node::devices::CurvePoint;
using node::devices::InfraredCurve;
using node::devices::InfraredSensor;

void converter_keys(Fields& io, Converter& c) {
  io.count({"bits", "Resolution of the analog-to-digital converter; 0: continuous.", "10"}, 0, 24,
           c.bits);
  io.number({"full_scale", "Voltage of the converter's largest number.", "5 V"}, "V", {0.1, 100},
            c.full_scale);
}

enum class CurveName { kGp2d12, kGp2d120, kTable };
constexpr std::array kCurves = {Option<CurveName>{"gp2d12", CurveName::kGp2d12},
                                Option<CurveName>{"gp2d120", CurveName::kGp2d120},
                                Option<CurveName>{"table", CurveName::kTable}};

const Key kCurve{"curve",
                 "What the sensor puts out at which distance: a Sharp sensor's, or the `table`.",
                 "gp2d12", "gp2d12"};

void point_keys(Fields& io, CurvePoint& point) {
  io.needed({"distance", "To the object.", "10 cm"}, "m", {1e-3, 100}, point.metres);
  io.needed({"output", "Of the sensor at that distance.", "2.3 V"}, "V", {0, 100}, point.volts);
}

InfraredCurve read_table(Mapping& in, const InfraredCurve& otherwise) {
  std::vector<CurvePoint> points;
  FieldReader(in).list<CurvePoint>(
      {"table", "Points of the curve, by distance; the output falls.",
       "[{distance: 10 cm, output: 2.3 V}, {distance: 40 cm, output: 0.7 V}]"},
      points, point_keys);
  try {
    return InfraredCurve::table(std::move(points));
  } catch (const std::invalid_argument& error) {
    in.mistake("table", error.what());
    return otherwise;
  }
}

InfraredCurve read_curve(Mapping& in, const InfraredCurve& otherwise) {
  if (!in.has(kCurve.name)) return otherwise;
  const std::optional<CurveName> name = in.choice(kCurve, kCurves);
  if (name == CurveName::kGp2d12) return InfraredCurve::gp2d12();
  if (name == CurveName::kGp2d120) return InfraredCurve::gp2d120();
  return name ? read_table(in, otherwise) : otherwise;
}

void write_curve(Writer& out, const InfraredCurve& curve) {
  if (curve == InfraredCurve::gp2d12()) return out.text(kCurve.name, "gp2d12");
  if (curve == InfraredCurve::gp2d120()) return out.text(kCurve.name, "gp2d120");
  out.text(kCurve.name, "table");
  std::vector<CurvePoint> points(curve.points().begin(), curve.points().end());
  FieldWriter(out).list<CurvePoint>({"table", ""}, points, point_keys);
}

/// All but where it sits.
void sensor_keys(Fields& io, InfraredSensor& c) {
  io.number({"height", "Of the horizontal beam above the ground.", "4 cm"}, "m", {0, 10},
            c.position.z);
  io.number({"half_angle", "Half the angle of the sector that the sensor sees.", "2.5 deg"}, "rad",
            {0, 1.57}, c.half_angle);
  io.number({"noise_sigma", "Standard deviation of the output.", "15 mV"}, "V", {0, 5},
            c.noise_sigma);
  io.duration({"hold_period",
               "Between two measurements of the sensor; 0 s: it measures when asked.", "38.3 ms"},
              {0, 10}, c.hold_period);
  io.own(
      kCurve, [&](Mapping& in) { c.curve = read_curve(in, c.curve); },
      [&](Writer& out) { write_curve(out, c.curve); });
  io.inside({"converter", "The analog-to-digital converter behind the sensor."},
            [&](Fields& converter) { converter_keys(converter, c.converter); });
}

void write_sensor(Fields& io, InfraredSensor& sensor) {
  Vec2 position{sensor.position.x, sensor.position.y};
  io.vec2({"position", ""}, "m", kOffset, position);
  io.number({"heading", ""}, "rad", kAngle, sensor.heading);
  sensor_keys(io, sensor);
}

}  // namespace

Mounting read_mounting(Mapping& in, const config::Key& heading) {
  Mounting mounting;
  const bool polar = in.has("distance") || in.has("bearing");
  double bearing = 0;
  if (polar) {
    const double distance =
        in.number({"distance", "From the body's origin.", "13 cm"}, "m", {0, kOffset.high});
    bearing =
        in.number({"bearing", "Direction from the body's origin; x is 0, y is 90 deg.", "60 deg"},
                  "rad", kAngle);
    mounting.position = {distance * math::cos(bearing), distance * math::sin(bearing)};
    in.refuse("position", "is given twice: also by distance and bearing");
  } else {
    mounting.position =
        in.vec2({"position", "Seen from the body's origin.", "[10 cm, 5 cm]"}, "m", kOffset);
    bearing = math::atan2(mounting.position.y, mounting.position.x);
  }
  mounting.heading = in.number(heading, "rad", kAngle, bearing);
  return mounting;
}

std::vector<InfraredSensor> read_infrared(Mapping in) {
  InfraredSensor common;
  FieldReader reader(in);
  reader.inside({"sensor", "What all sensors have in common."},
                [&](Fields& all) { sensor_keys(all, common); });
  std::vector<InfraredSensor> sensors;
  reader.list<InfraredSensor>(
      {"mounts", "The sensors, each where it is and how it differs from `sensor`.",
       "[{distance: 23 cm, bearing: 0 deg}, {distance: 23 cm, bearing: 60 deg}]"},
      sensors,
      [](Fields& io, InfraredSensor& sensor) {
        sensor_keys(io, sensor);
        const Mounting mounting =
            read_mounting(*io.reading(), {"heading", "Direction in which the sensor looks.",
                                          "60 deg", "the bearing of the position"});
        sensor.position.x = mounting.position.x;
        sensor.position.y = mounting.position.y;
        sensor.heading = mounting.heading;
      },
      common);
  in.finish();
  return sensors;
}

void write_infrared(Writer& out, std::vector<InfraredSensor> sensors) {
  FieldWriter(out).inside({"infrared", ""}, [&](Fields& io) {
    io.list<InfraredSensor>({"mounts", ""}, sensors, write_sensor);
  });
}

}  // namespace hal::files::description
