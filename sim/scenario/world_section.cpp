#include "sim/scenario/world_section.h"

#include <fmt/format.h>

#include "sim/scenario/fields.h"
#include "sim/scenario/map_section.h"
#include "sim/scenario/material_keys.h"

namespace sim::scenario {
namespace {

using physics::StaticBox;
using physics::WorldConfig;

const Key kRange{"range", "Largest distance at which other agents are reported; none: no limit.",
                 "300 m"};

constexpr Range kBoxSize{1e-3, 1e5};  // m
constexpr Range kFriction{0, 100};
constexpr Range kRadioLoss{0, 1000};  // dB, dB/m

void physics_keys(Fields& io, WorldConfig& c) {
  io.duration({"step", "Time step of the physics engine.", "10 ms"}, {1e-4, 0.02}, c.step);
  // Without gravity wheels have no grip, so it must be requested by name.
  bool weightless = c.gravity == 0;
  io.flag({"weightless", "Whether there is no gravity; then no wheel grips.", "false"}, weightless);
  if (weightless) c.gravity = 0;
  io.only(!weightless, {}, "cannot be combined with 'weightless: true'", [&](Fields& heavy) {
    heavy.number({"gravity", "Acceleration of gravity, which points down.", "9.81 m/s^2"}, "m/s^2",
                 {0.01, 100}, c.gravity);
  });
  io.number({"erp",
             "Share of a joint's position error that is corrected in one step (ODE: error "
             "reduction parameter, ERP).",
             "0.4"},
            "1", {1e-3, 1}, c.erp);  // 0 would never close a joint that came apart
  io.number({"cfm", "Softness of constraints; 0: rigid (ODE: constraint force mixing, CFM).",
             "0.00000001"},
            "1", {0, 0.99}, c.cfm);
  io.number(
      {"surface_layer",
       "Depth to which bodies in contact may overlap before they are pushed apart.", "0.1 mm"},
      "m", {0, 0.01}, c.surface_layer);
  io.number({"max_correcting_velocity",
             "Largest speed at which overlapping bodies are pushed apart.", "0.1 m/s"},
            "m/s", {1e-3, 100}, c.max_correcting_velocity);
  io.number({"ground_friction",
             "Coefficient of friction of the ground under motes, if lower than the mote's own. "
             "Wheels have their own.",
             "0.6"},
            "1", kFriction, c.ground_friction);
  io.count({"jam_contacts",
            "Groups of touching bodies with more contacts than this are solved iteratively.", "8"},
           1, 1000, c.jam_contacts);
  io.count({"jam_robots",
            "Groups of touching bodies with more robots than this are solved iteratively.", "4"},
           1, 1000, c.jam_robots);
}

void keys_of(Fields& io, StaticBox& box, const agents::SimulationConfig& config) {
  io.text({"name", "Name of the wall or box in the results.", "north",
           "`wall` or `box` with its number"},
          box.name);
  io.needed({"size", "Lengths of the edges along its own axes; it stands on the ground.",
             "[6 m, 20 cm, 50 cm]"},
            "m", kBoxSize, box.size);
  hal::Vec2 at{box.centre.x, box.centre.y};
  io.needed({"position", "Position of its centre, world frame.", "[0 m, 3 m]"}, "m", kCoordinate,
            at);
  const double ground = config.world.ground->height(at);
  box.centre = {at.x, at.y, ground + box.size.z / 2};  // the box stands on the ground
  io.number({"yaw", "Rotation about the vertical, counter-clockwise seen from above.", "45 deg"},
            "rad", kAngle, box.yaw);
  surface_keys(io, config.materials, box);
}

/// @param kind  prefix of the names of boxes without a name; a number follows.
void boxes(Fields& io, const Key& key, std::string_view kind, agents::SimulationConfig& config) {
  std::vector<StaticBox>& all = config.walls;
  const std::size_t first = all.size();
  std::vector<StaticBox> listed;
  if (io.reading() == nullptr) listed = all;
  io.list<StaticBox>(key, listed, [&](Fields& one, StaticBox& box) {
    if (one.reading() != nullptr) box.name = fmt::format("{}{}", kind, &box - listed.data());
    keys_of(one, box, config);
  });
  if (io.reading() != nullptr)
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(first), listed.begin(), listed.end());
}

}  // namespace

void surface_keys(Fields& io, std::span<const Material> materials, StaticBox& box) {
  io.number({"friction",
             "Coefficient of friction of its surface. Where two bodies touch, the lower "
             "coefficient of the two counts.",
             "0.6"},
            "1", kFriction, box.friction);
  material_key(io, materials, box.material);
  // Defaults from Sommer et al. 2011 (kBrickWall); docs/models.md, 9, lists others.
  io.inside(
      {"radio_loss",
       "Attenuation of radio frames that pass through it; needs `obstacles: true` of the radio, "
       "and no propagation model `multi_wall`, which uses `material`."},
      [&](Fields& loss) {
        loss.quantity({"per_crossing", "Loss for each crossing, whatever the thickness.", "15 dB"},
                      "dB", kRadioLoss, box.radio_loss.per_crossing);
        loss.number({"per_metre", "Further loss for each metre of the path inside.", "0.4 dB/m"},
                    "dB/m", kRadioLoss, box.radio_loss.per_metre);
      });
}

void world_keys(Fields& io, agents::SimulationConfig& config, std::vector<WorldMap>& maps) {
  io.inside({"physics", "Parameters of the physics engine (ODE)."},
            [&](Fields& physics) { physics_keys(physics, config.world); });
  materials_key(io, config.materials);
  ceilings_key(io, config.ceilings);
  boxes(io,
        {"walls", "Boxes that never move.", "[{size: [6 m, 20 cm, 50 cm], position: [0 m, 3 m]}]"},
        "wall", config);
  if (!io.is_writing()) {  // they are written as walls
    boxes(io,
          {"boxes", "The same as `walls`; without a name they are `box` and a number.",
           "[{size: [1 m, 1 m, 50 cm], position: [2 m, 2 m]}]"},
          "box", config);
  }
  map_keys(io, maps, config);
}

void keys_of(Fields& io, agents::LocalisationConfig& config) {
  io.quantity(kRange, "m", {0, kUnlimited}, config.range);
}

}  // namespace sim::scenario
