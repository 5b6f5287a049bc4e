#include "hal/files/description/infrared_section.h"

#include <stdexcept>
#include <utility>

#include "hal/files/description/mounting.h"

namespace hal::files::description {
namespace {

using node::devices::Converter;
using node::devices::CurvePoint;
using node::devices::InfraredCurve;
using node::devices::InfraredSensor;

void converter_keys(Fields& io, Converter& c) {
  io.count({"bits", "Resolution of the analog-to-digital converter; 0: continuous.", "10"}, 0, 24,
           c.bits);
  io.number({"full_scale", "Input voltage at which the converter gives its largest number.", "5 V"},
            "V", {0.1, 100}, c.full_scale);
}

enum class CurveName { kGp2d12, kGp2d120, kTable };
constexpr std::array kCurves = {Option<CurveName>{"gp2d12", CurveName::kGp2d12},
                                Option<CurveName>{"gp2d120", CurveName::kGp2d120},
                                Option<CurveName>{"table", CurveName::kTable}};

const Key kCurve{"curve",
                 "Output voltage by distance: that of a Sharp GP2D12 or GP2D120, or the `table`.",
                 "gp2d12", "gp2d12"};

void point_keys(Fields& io, CurvePoint& point) {
  io.needed({"distance", "Distance from the sensor to the object.", "10 cm"}, "m", {1e-3, 100},
            point.metres);
  io.needed({"output", "Output voltage at that distance.", "2.3 V"}, "V", {0, 100}, point.volts);
}

CurveName name_of(const InfraredCurve& curve) {
  if (curve == InfraredCurve::gp2d12()) return CurveName::kGp2d12;
  return curve == InfraredCurve::gp2d120() ? CurveName::kGp2d120 : CurveName::kTable;
}

void table_key(Fields& io, InfraredCurve& curve) {
  std::vector<CurvePoint> points(curve.points().begin(), curve.points().end());
  io.list<CurvePoint>({"table",
                       "Points of the output curve in order of increasing distance; the output "
                       "must fall from each to the next.",
                       "[{distance: 10 cm, output: 2.3 V}, {distance: 40 cm, output: 0.7 V}]"},
                      points, point_keys);
  if (io.reading() == nullptr) return;
  try {
    curve = InfraredCurve::table(std::move(points));
  } catch (const std::invalid_argument& error) {
    io.mistake("table", error.what());
  }
}

void curve_keys(Fields& io, InfraredCurve& curve) {
  CurveName name = name_of(curve);
  io.choice(kCurve, kCurves, name, [&](Fields& keys) {
    if (name == CurveName::kTable) return table_key(keys, curve);
    keys.unused("table", "needs 'curve: table'");
    curve = name == CurveName::kGp2d12 ? InfraredCurve::gp2d12() : InfraredCurve::gp2d120();
  });
}

/// All keys except those of the mounting.
void sensor_keys(Fields& io, InfraredSensor& c) {
  io.number({"height", "Height of the horizontal beam above the ground.", "4 cm"}, "m", {0, 10},
            c.position.z);
  io.number({"half_angle",
             "Half of the sensor's field of view in the horizontal plane; 0 rad: a single ray.",
             "2.5 deg"},
            "rad", {0, 1.57}, c.half_angle);
  io.number({"noise_sigma", "Standard deviation of the noise on the output voltage.", "15 mV"}, "V",
            {0, 5}, c.noise_sigma);
  io.duration({"hold_period",
               "Time between two measurements; 0 s: a new measurement at each reading.", "38.3 ms"},
              {0, 10}, c.hold_period);
  curve_keys(io, c.curve);
  io.inside({"converter", "The analog-to-digital converter that reads the sensor."},
            [&](Fields& converter) { converter_keys(converter, c.converter); });
}

void mount_keys(Fields& io, InfraredSensor& c) {
  Vec2 position{c.position.x, c.position.y};
  mounting_keys(io,
                {"heading", "Direction in which the sensor points, in the body frame.", "60 deg",
                 "the bearing of the position"},
                position, c.heading);
  c.position.x = position.x;
  c.position.y = position.y;
  sensor_keys(io, c);
}

}  // namespace

void infrared_keys(Fields& io, std::vector<InfraredSensor>& sensors) {
  InfraredSensor common;
  io.written_if(false, [&](Fields& read) {
    read.inside({"sensor", "Properties that all sensors share."},
                [&](Fields& all) { sensor_keys(all, common); });
  });
  io.list<InfraredSensor>(
      {"mounts",
       "The sensors: the mounting position of each, and the properties in which it differs from "
       "`sensor`.",
       "[{distance: 23 cm, bearing: 0 deg}, {distance: 23 cm, bearing: 60 deg}]"},
      sensors, mount_keys, common);
}

}  // namespace hal::files::description
