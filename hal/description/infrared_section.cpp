#include "hal/description/infrared_section.h"

#include <stdexcept>

#include "hal/description/fields.h"
#include "hal/types/math.h"

namespace hal::description {
namespace {

using devices::Converter;
using devices::CurvePoint;
using devices::InfraredCurve;
using devices::InfraredSensor;

template <class Io>
void sensor_keys(Io& io, InfraredSensor& c) {
  io.number({"height", "Of the horizontal beam above the ground.", "4 cm"}, "m", {0, 10},
            c.position.z);
  io.number({"half_angle", "Half the angle of the sector that the sensor sees.", "2.5 deg"}, "rad",
            {0, 1.57}, c.half_angle);
  io.number({"noise_sigma", "Standard deviation of the output.", "15 mV"}, "V", {0, 5},
            c.noise_sigma);
  io.duration({"hold_period",
               "Between two measurements of the sensor; 0 s: it measures when asked.", "38.3 ms"},
              {0, 10}, c.hold_period);
}

template <class Io>
void converter_keys(Io& io, Converter& c) {
  io.count({"bits", "Resolution of the analog-to-digital converter; 0: continuous.", "10"}, 0, 24,
           c.bits);
  io.number({"full_scale", "Voltage of the converter's largest number.", "5 V"}, "V", {0.1, 100},
            c.full_scale);
}

enum class CurveName { kGp2d12, kGp2d120, kTable };
constexpr std::array kCurves = {Option<CurveName>{"gp2d12", CurveName::kGp2d12},
                                Option<CurveName>{"gp2d120", CurveName::kGp2d120},
                                Option<CurveName>{"table", CurveName::kTable}};

InfraredCurve read_table(Mapping& in, const InfraredCurve& otherwise) {
  std::vector<CurvePoint> points;
  for (Mapping& point :
       in.mappings({"table", "Points of the curve, by distance; the output falls.",
                    "[{distance: 10 cm, output: 2.3 V}, {distance: 40 cm, output: 0.7 V}]"})) {
    points.push_back(
        {point.number({"distance", "To the object.", "10 cm"}, "m", {1e-3, 100}),
         point.number({"output", "Of the sensor at that distance.", "2.3 V"}, "V", {0, 100})});
    point.finish();
  }
  try {
    return InfraredCurve::table(std::move(points));
  } catch (const std::invalid_argument& error) {
    in.mistake("table", error.what());
    return otherwise;
  }
}

InfraredCurve read_curve(Mapping& in, const InfraredCurve& otherwise) {
  if (!in.has("curve")) return otherwise;
  const std::optional<CurveName> name = in.choice(
      {"curve", "What the sensor puts out at which distance: a Sharp sensor's, or the `table`.",
       "gp2d12", "gp2d12"},
      kCurves);
  if (name == CurveName::kGp2d12) return InfraredCurve::gp2d12();
  if (name == CurveName::kGp2d120) return InfraredCurve::gp2d120();
  return name ? read_table(in, otherwise) : otherwise;
}

void read_sensor(Mapping& in, InfraredSensor& sensor) {
  FieldReader reader(in);
  sensor_keys(reader, sensor);
  sensor.curve = read_curve(in, sensor.curve);
  Mapping converter =
      in.mapping({"converter", "The analog-to-digital converter behind the sensor."});
  FieldReader converter_reader(converter);
  converter_keys(converter_reader, sensor.converter);
  converter.finish();
}

void write_curve(Writer& out, const InfraredCurve& curve) {
  if (curve == InfraredCurve::gp2d12()) return out.text("curve", "gp2d12");
  if (curve == InfraredCurve::gp2d120()) return out.text("curve", "gp2d120");
  out.text("curve", "table");
  out.open_list("table");
  for (const CurvePoint& point : curve.points()) {
    out.open_item();
    out.number("distance", point.metres, "m");
    out.number("output", point.volts, "V");
    out.close();
  }
  out.close();
}

void write_sensor(Writer& out, InfraredSensor sensor) {
  FieldWriter writer(out);
  out.open_item();
  out.numbers("position", {sensor.position.x, sensor.position.y}, "m");
  out.number("heading", sensor.heading, "rad");
  sensor_keys(writer, sensor);
  write_curve(out, sensor.curve);
  out.open("converter");
  converter_keys(writer, sensor.converter);
  out.close();
  out.close();
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
  Mapping all = in.mapping({"sensor", "What all sensors have in common."});
  read_sensor(all, common);
  all.finish();
  std::vector<InfraredSensor> sensors;
  for (Mapping& mount :
       in.mappings({"mounts", "The sensors, each where it is and how it differs from `sensor`.",
                    "[{distance: 23 cm, bearing: 0 deg}, {distance: 23 cm, bearing: 60 deg}]"})) {
    InfraredSensor sensor = common;
    read_sensor(mount, sensor);
    const Mounting mounting =
        read_mounting(mount, {"heading", "Direction in which the sensor looks.", "60 deg",
                              "the bearing of the position"});
    sensor.position.x = mounting.position.x;
    sensor.position.y = mounting.position.y;
    sensor.heading = mounting.heading;
    sensors.push_back(sensor);
    mount.finish();
  }
  in.finish();
  return sensors;
}

void write_infrared(Writer& out, const std::vector<InfraredSensor>& sensors) {
  out.open("infrared");
  out.open_list("mounts");
  for (const InfraredSensor& sensor : sensors) write_sensor(out, sensor);
  out.close();
  out.close();
}

}  // namespace hal::description
