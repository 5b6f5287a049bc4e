#include "sim/scenario/movables_section.h"

#include <fmt/format.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/layouts.h"
#include "sim/scenario/placement.h"

namespace sim::scenario {
namespace {

using physics::Movable;
using physics::MovableBox;
using physics::MovableCylinder;
using physics::MovableSphere;
using MovableForm = decltype(Movable::form);

constexpr Range kSize{1e-3, 1e3};   // m
constexpr Range kMass{1e-6, 1e6};   // kg
constexpr Range kSpeed{-1e3, 1e3};  // m/s
constexpr Range kCoefficient{0, 100};
constexpr Range kLoss{0, 1000};  // dB, dB/m

const std::array kForms{
    alternative<MovableForm, MovableBox>({"box", "A box."}),
    alternative<MovableForm, MovableCylinder>({"cylinder", "A cylinder that stands upright."}),
    alternative<MovableForm, MovableSphere>({"sphere", "A sphere."})};

void form_keys(Fields& io, MovableBox& c) {
  io.needed({"size", "Lengths of the edges along its own axes.", "[40 cm, 30 cm, 20 cm]"}, "m",
            kSize, c.size);
}

void radius_key(Fields& io, double& radius) {
  io.needed({"radius", "Radius.", "15 cm"}, "m", kSize, radius);
}

void form_keys(Fields& io, MovableCylinder& c) {
  radius_key(io, c.radius);
  io.needed({"height", "Distance between its faces.", "30 cm"}, "m", kSize, c.height);
}

void form_keys(Fields& io, MovableSphere& c) { radius_key(io, c.radius); }

/// An item of the list: one movable, or several of a kind.
struct Batch {
  Movable kind;
  Placement placement = std::vector<hal::Pose2>{{}};
  int stack = 1;
};

void spot_keys(Fields& io, Placement& placement) {
  hal::Pose2& pose = std::get<std::vector<hal::Pose2>>(placement).front();
  hal::Vec2 at{pose.x, pose.y};
  io.needed(
      {"position", "Position of its centre, world frame; or one of the layouts.", "[2 m, 1 m]"},
      "m", kCoordinate, at);
  pose.x = at.x;
  pose.y = at.y;
  io.number({"yaw", "Rotation about the vertical, counter-clockwise seen from above.", "45 deg"},
            "rad", kAngle, pose.theta);
}

void place_keys(Fields& io, Batch& c) {
  const bool is_layout =
      layout_keys(io, c.placement, [&](Fields& spot) { spot_keys(spot, c.placement); });
  if (is_layout) {
    for (const char* key : {"position", "yaw"})
      io.unused(key, "cannot be combined with " + name_of(c.placement));
  }
  io.number({"elevation", "Height of its lowest point above the ground at the start.", "0 m"}, "m",
            {0, 1e4}, c.kind.elevation);
  io.written_if(false, [&](Fields& pile) {  // they are written one by one
    pile.count({"stack", "Number of them on top of each other at each place.", "3", "1"}, 1, 1000,
               c.stack);
  });
  io.vec2({"velocity", "Velocity at the start, world frame.", "[1 m/s, 0 m/s]", "[0 m/s, 0 m/s]"},
          "m/s", kSpeed, c.kind.velocity);
}

void surface_keys(Fields& io, Movable& c) {
  io.number({"friction",
             "Coefficient of friction of its surface. Where two bodies touch, the lower "
             "coefficient of the two counts; on the ground, `physics: {ground_friction}`.",
             "0.6"},
            "1", kCoefficient, c.friction);
  const bool is_box = std::holds_alternative<MovableBox>(c.form);
  io.only(!is_box, {"box", {"absent"}}, "a box does not roll", [&](Fields& rolling) {
    rolling.number({"rolling_resistance",
                    "Force that keeps it rolling on a plane, as a share of its weight; 0: it rolls "
                    "for ever.",
                    "0.01"},
                   "1", kCoefficient, c.rolling_resistance);
  });
  io.inside({"radio_loss",
             "Attenuation of radio frames that pass through it; needs `obstacles: true` of the "
             "radio. Computed at the start of a frame."},
            [&](Fields& loss) {
              loss.quantity({"per_crossing", "Loss for each crossing, whatever the thickness.",
                             "20 dB", "0 dB"},
                            "dB", kLoss, c.radio_loss.per_crossing);
              loss.number({"per_metre", "Further loss for each metre of the path inside.",
                           "10 dB/m", "0 dB/m"},
                          "dB/m", kLoss, c.radio_loss.per_metre);
            });
}

void keys_of(Fields& io, Batch& c) {
  io.text({"name",
           "Name in the results and the view: letters, digits, '_' and '-' after a letter; of "
           "several, with {} for the number, from 0.",
           "'crate{}'", "`movable`, the number in the list, `_`, and {} if there are several"},
          c.kind.name);
  const auto form = [](Fields& one, MovableForm& any) {
    std::visit([&one](auto& of) { form_keys(one, of); }, any);
  };
  if (!io.one_of(kForms, c.kind.form, form)) {
    io.mistake("", "must have either box or cylinder or sphere");
    if (io.reading() != nullptr) io.reading()->leave_rest();
    return;
  }
  io.needed({"mass", "Mass of each, evenly distributed.", "2 kg"}, "kg", kMass, c.kind.mass);
  place_keys(io, c);
  surface_keys(io, c.kind);
}

/// The movables of an item of the list: place by place, from the ground up.
std::vector<Movable> all_of(Mapping& in, const Batch& c, std::size_t number, std::uint64_t seed) {
  std::vector<std::string> places;
  const std::string stream = fmt::format("movables/{}", number);
  const std::vector<hal::Pose2> poses = poses_of(in, c.placement, seed, stream, places);
  const std::size_t count = poses.size() * static_cast<std::size_t>(c.stack);
  std::string pattern = c.kind.name;
  if (pattern.empty()) pattern = fmt::format("movable{}{}", number, count > 1 ? "_{}" : "");
  const std::vector<std::string> names = names_of(in, pattern, count);
  std::vector<Movable> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto level = i % static_cast<std::size_t>(c.stack);
    Movable& one = all.emplace_back(c.kind);
    one.name = names[i];
    one.pose = poses[i / static_cast<std::size_t>(c.stack)];
    one.elevation += static_cast<double>(level) * physics::extents(c.kind).z;
  }
  return all;
}

std::vector<Batch> batches_of(const std::vector<Movable>& movables) {
  std::vector<Batch> batches;
  batches.reserve(movables.size());
  for (const Movable& one : movables)
    batches.push_back({one, std::vector<hal::Pose2>{one.pose}, 1});
  return batches;
}

}  // namespace

void movables_key(Fields& io, Scenario& scenario) {
  agents::SimulationConfig& config = scenario.simulation;
  std::vector<Batch> batches;
  if (io.is_writing()) batches = batches_of(config.movables);
  std::set<std::string> taken;
  const Key key{"movables", "Boxes, cylinders and spheres that robots push. Sensors see them.",
                "[{box: {size: [40 cm, 40 cm, 30 cm]}, mass: 2 kg, position: [2 m, 1 m]}]"};
  io.list_if_any<Batch>(key, batches, [&](Fields& one, Batch& batch) {
    keys_of(one, batch);
    Mapping* const in = one.reading();
    if (in == nullptr || in->leaves_rest()) return;
    const auto number = static_cast<std::size_t>(&batch - batches.data());
    std::set<std::string> names;  // equal ones of this item have been reported already
    for (Movable& movable : all_of(*in, batch, number, config.seed)) {
      if (taken.contains(movable.name))
        return in->mistake("name", fmt::format("the name '{}' is taken", movable.name));
      names.insert(movable.name);
      config.movables.push_back(std::move(movable));
      scenario.movable_places.push_back(in->place());
    }
    taken.merge(names);
  });
}

}  // namespace sim::scenario
