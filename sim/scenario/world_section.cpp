#include "sim/scenario/world_section.h"

#include <fmt/format.h>

#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using physics::StaticBox;
using physics::WorldConfig;

constexpr Range kBoxSize{1e-3, 1e5};  // m
constexpr Range kFriction{0, 100};

template <class Io>
void physics_keys(Io& io, WorldConfig& c) {
  io.duration("step", {1e-4, 0.02}, c.step);
  io.number("gravity", "m/s^2", {0, 100}, c.gravity);
  io.number("erp", "1", {1e-3, 1}, c.erp);  // 0 would never close a joint that came apart
  io.number("cfm", "1", {0, 0.99}, c.cfm);
  io.number("surface_layer", "m", {0, 0.01}, c.surface_layer);
  io.number("max_correcting_velocity", "m/s", {1e-3, 100}, c.max_correcting_velocity);
  io.number("ground_friction", "1", kFriction, c.ground_friction);
  io.count("jam_contacts", 1, 1000, c.jam_contacts);
  io.count("jam_robots", 1, 1000, c.jam_robots);
}

StaticBox read_box(Mapping& in, const std::string& default_name) {
  StaticBox box;
  box.name = in.text("name", default_name);
  box.size = in.vec3("size", "m", kBoxSize);
  const hal::Vec2 at = in.vec2("position", "m", kCoordinate);
  box.centre = {at.x, at.y, box.size.z / 2};  // It stands on the ground.
  box.yaw = in.number("yaw", "rad", kAngle, box.yaw);
  box.friction = in.number("friction", "1", kFriction, box.friction);
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
  out.close();
}

}  // namespace

void read_world(Mapping in, agents::SimulationConfig& config) {
  Mapping physics = in.mapping("physics");
  FieldReader reader(physics);
  physics_keys(reader, config.world);
  physics.finish();
  for (const std::string kind : {"wall", "box"}) {
    std::vector<Mapping> boxes = in.mappings(kind == "box" ? "boxes" : "walls");
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      config.walls.push_back(read_box(boxes[i], fmt::format("{}{}", kind, i)));
    }
  }
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
  FieldReader(in).quantity("range", "m", {0, kUnlimited}, config.range);
  in.finish();
  return config;
}

void write_localisation(Writer& out, const agents::LocalisationConfig& config) {
  out.open("localisation");
  FieldWriter(out).quantity("range", "m", {}, config.range);
  out.close();
}

}  // namespace sim::scenario
