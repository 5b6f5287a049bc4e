#include "sim/scenario/world_section.h"

#include <fmt/format.h>

#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using physics::StaticBox;
using physics::WorldConfig;

const Key kRange{"range", "Agents farther away are not reported.", "300 m"};

constexpr Range kBoxSize{1e-3, 1e5};  // m
constexpr Range kFriction{0, 100};
constexpr Range kRadioLoss{0, 1000};  // dB, dB/m

template <class Io>
void physics_keys(Io& io, WorldConfig& c) {
  io.duration({"step", "Of the physics engine.", "10 ms"}, {1e-4, 0.02}, c.step);
  // Without gravity no wheel grips: it has to be asked for by name.
  bool weightless = c.gravity == 0;
  io.flag({"weightless", "No gravity at all; then no wheel grips.", "false"}, weightless);
  if (weightless) {
    c.gravity = 0;
    io.unused("gravity", "cannot stand beside 'weightless: true'");
  } else {
    io.number({"gravity", "Downwards.", "9.81 m/s^2"}, "m/s^2", {0.01, 100}, c.gravity);
  }
  io.number(
      {"erp", "Share of a joint's error that a step corrects (ODE: error reduction parameter).",
       "0.4"},
      "1", {1e-3, 1}, c.erp);  // 0 would never close a joint that came apart
  io.number({"cfm", "Softness of constraints (ODE: constraint force mixing).", "0.00000001"}, "1",
            {0, 0.99}, c.cfm);
  io.number({"surface_layer", "How far contacts may sink in.", "0.1 mm"}, "m", {0, 0.01},
            c.surface_layer);
  io.number(
      {"max_correcting_velocity", "Largest speed at which contacts push bodies apart.", "0.1 m/s"},
      "m/s", {1e-3, 100}, c.max_correcting_velocity);
  io.number({"ground_friction", "Coefficient of the ground against motes; wheels bring their own.",
             "0.6"},
            "1", kFriction, c.ground_friction);
  io.count({"jam_contacts", "Heaps with more contacts than this get the iterative solver.", "8"}, 1,
           1000, c.jam_contacts);
  io.count({"jam_robots", "Heaps with more robots than this get the iterative solver.", "4"}, 1,
           1000, c.jam_robots);
}

/// By default those of Sommer et al. 2011 (kBrickWall); docs/models.md, 4, lists others.
template <class Io>
void loss_keys(Io& io, ObstacleLoss& c) {
  io.quantity({"per_crossing", "For having to pass at all.", "15 dB"}, "dB", kRadioLoss,
              c.per_crossing);
  io.number({"per_metre", "For each metre of the way inside.", "0.4 dB/m"}, "dB/m", kRadioLoss,
            c.per_metre);
}

StaticBox read_box(Mapping& in, const std::string& default_name) {
  StaticBox box;
  box.name = in.text(
      {"name", "Of the wall or box, in results.", "north", "`wall` or `box` with its number"},
      default_name);
  box.size =
      in.vec3({"size", "Along its own axes; it stands on the ground.", "[6 m, 20 cm, 50 cm]"}, "m",
              kBoxSize);
  const hal::Vec2 at =
      in.vec2({"position", "Of its middle, world frame.", "[0 m, 3 m]"}, "m", kCoordinate);
  box.centre = {at.x, at.y, box.size.z / 2};  // It stands on the ground.
  box.yaw = in.number({"yaw", "By which it is turned, seen from above.", "45 deg"}, "rad", kAngle,
                      box.yaw);
  box.friction =
      in.number({"friction", "Coefficient of its surface.", "0.6"}, "1", kFriction, box.friction);
  Mapping loss = in.mapping({"radio_loss",
                             "Of a frame that passes through it, with "
                             "`obstacles: true` of the radio."});
  FieldReader reader(loss);
  loss_keys(reader, box.radio_loss);
  loss.finish();
  in.finish();
  return box;
}

void write_box(Writer& out, const StaticBox& box) {
  out.open_item();
  out.text("name", box.name);
  out.numbers("size", {box.size.x, box.size.y, box.size.z}, "m");
  out.numbers("position", {box.centre.x, box.centre.y}, "m");
  out.number("yaw", box.yaw, "rad");
  out.number("friction", box.friction, "1");
  ObstacleLoss loss = box.radio_loss;
  FieldWriter writer(out);
  out.open("radio_loss");
  loss_keys(writer, loss);
  out.close();
  out.close();
}

}  // namespace

void read_world(Mapping in, agents::SimulationConfig& config) {
  Mapping physics = in.mapping({"physics", "Parameters of the physics engine (ODE)."});
  FieldReader reader(physics);
  physics_keys(reader, config.world);
  physics.finish();
  const auto read_boxes = [&](const Key& key, std::string_view kind) {
    std::vector<Mapping> boxes = in.mappings(key);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      config.walls.push_back(read_box(boxes[i], fmt::format("{}{}", kind, i)));
    }
  };
  read_boxes(
      {"walls", "Boxes that never move.", "[{size: [6 m, 20 cm, 50 cm], position: [0 m, 3 m]}]"},
      "wall");
  read_boxes({"boxes", "The same under another name.",
              "[{size: [1 m, 1 m, 50 cm], position: [2 m, 2 m]}]"},
             "box");
  in.finish();
}

void write_world(Writer& out, const agents::SimulationConfig& config) {
  WorldConfig world = config.world;
  FieldWriter writer(out);
  out.open("world");
  out.open("physics");
  physics_keys(writer, world);
  out.close();
  out.open_list("walls");
  for (const StaticBox& box : config.walls) write_box(out, box);
  out.close();
  out.close();
}

agents::LocalisationConfig read_localisation(Mapping in) {
  agents::LocalisationConfig config;
  FieldReader(in).quantity(kRange, "m", {0, kUnlimited}, config.range);
  in.finish();
  return config;
}

void write_localisation(Writer& out, const agents::LocalisationConfig& config) {
  out.open("localisation");
  FieldWriter(out).quantity(kRange, "m", {}, config.range);
  out.close();
}

}  // namespace sim::scenario
