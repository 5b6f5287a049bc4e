#include "programs/models/world_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "hal/types/math.h"
#include "hal/types/overloaded.h"
#include "programs/models/merge.h"
#include "programs/models/upright.h"
#include "programs/models/yaml_text.h"

namespace programs::models {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLifted = 0.01;     ///< m of air that is worth a note
constexpr double kOffCentre = 0.01;  ///< m, likewise
constexpr double kUsualMass = 1;     ///< kg of a link without <inertial> (SDFormat 1.9, inertial)
constexpr double kMostFriction = 100;

/// What the world is made of so far.
struct Written {
  std::string walls, movables;
  std::vector<Note> notes;
  std::set<std::string> taken;
};

double yaw_of(const Upright& shape) {
  const auto* const box = std::get_if<UprightBox>(&shape);
  return box == nullptr ? 0 : box->yaw;
}

Vector2d footprint_of(const Upright& shape) {
  return std::visit(
      hal::Overloaded{[](const UprightBox& c) -> Vector2d { return c.size.head<2>(); },
                      [](const UprightCylinder& c) -> Vector2d {
                        return {2 * c.radius, 2 * c.radius};
                      }},
      shape);
}

std::optional<double> friction_of(const Collision& collision) {
  const bool is_possible = collision.mu && *collision.mu >= 0 && *collision.mu <= kMostFriction;
  return is_possible ? collision.mu : std::nullopt;
}

/// A box of `walls:`, which stands on the ground.
void add_wall(const Model& model, const ModelLink& link, const Collision& one, Written& to) {
  Upright shape = upright(one.shape, link.pose * one.pose);
  if (!cut_at_ground(shape)) return;
  const auto [low, high] = heights(shape);
  if (low > kLifted)
    to.notes.push_back({one.line, fmt::format("the {:.3f} m of air below '{}' of '{}'", low,
                                              one.name, model.name)});
  const Vector2d across = footprint_of(shape);
  Flow flow;
  flow.add("name", quoted(name_of_its_own(model.name, to.taken)));
  flow.add("size", list({across.x(), across.y(), high}, "m"));
  flow.add("position", list(Vector2d(centre_of(shape).head<2>()), "m"));
  flow.add("yaw", yaw_of(shape), "rad").add("friction", friction_of(one), "1");
  to.walls += "    - " + flow.text() + at_line(one.line);
}

/// Points whose hull is around a shape: corners, of a cylinder those of a polygon around it.
void add_corners(const Upright& shape, std::vector<Vector3d>& points) {
  const auto [low, high] = heights(shape);
  const Vector3d centre = centre_of(shape);
  const double yaw = yaw_of(shape);
  const bool is_box = std::holds_alternative<UprightBox>(shape);
  const Vector2d half = 0.5 * footprint_of(shape);
  const int corners = is_box ? 4 : 64;
  for (int i = 0; i < corners; ++i) {
    const double at = 2 * hal::math::kPi * (i + 0.5) / corners;
    const double c = hal::math::cos(at), s = hal::math::sin(at);
    const double grow = 1 / hal::math::cos(hal::math::kPi / corners);
    const Vector2d own(grow * half.x() * c, grow * half.y() * s);
    const double cy = hal::math::cos(yaw), sy = hal::math::sin(yaw);
    const Vector2d flat =
        centre.head<2>() + Vector2d(cy * own.x() - sy * own.y(), sy * own.x() + cy * own.y());
    points.emplace_back(flat.x(), flat.y(), low);
    points.emplace_back(flat.x(), flat.y(), high);
  }
}

/// The only shape of a model; of several, the smallest one around them.
struct Outline {
  Upright shape;
  std::optional<double> ball{};  ///< m, radius if it is a sphere
  const Collision* first = nullptr;
  std::size_t count = 0;
};
Outline outline_of(const Model& model) {
  Outline outline;
  Shape all{.kind = Shape::Kind::kPoints};
  for (const ModelLink& link : model.links) {
    for (const Collision& one : link.collisions) {
      outline.shape = upright(one.shape, link.pose * one.pose);
      add_corners(outline.shape, all.points);
      if (one.shape.kind == Shape::Kind::kSphere) outline.ball = one.shape.radius;
      if (outline.first == nullptr) outline.first = &one;
      ++outline.count;
    }
  }
  if (outline.count > 1) {
    outline.shape = upright(all, Eigen::Isometry3d::Identity());
    outline.ball.reset();
  }
  return outline;
}

std::vector<PlacedInertial> masses_of(const Model& model) {
  std::vector<PlacedInertial> masses;
  for (const ModelLink& link : model.links) {
    masses.push_back({link.pose, link.inertial.value_or(Inertial{kUsualMass, Vector3d::Zero(),
                                                                 Eigen::Matrix3d::Identity(), 0})});
  }
  return masses;
}

void add_form(const Outline& outline, Flow& flow) {
  const auto [low, high] = heights(outline.shape);
  const Vector2d across = footprint_of(outline.shape);
  Flow form;
  if (outline.ball) {
    flow.add("sphere", form.add("radius", outline.ball, "m").text());
  } else if (std::holds_alternative<UprightBox>(outline.shape)) {
    form.add("size", list({across.x(), across.y(), high - low}, "m"));
    flow.add("box", form.text()).add("yaw", yaw_of(outline.shape), "rad");
  } else {
    form.add("radius", across.x() / 2, "m").add("height", high - low, "m");
    flow.add("cylinder", form.text());
  }
}

/// One body of `movables:`.
void add_movable(const Model& model, Written& to) {
  const Outline outline = outline_of(model);
  const auto note = [&](std::string what) { to.notes.push_back({model.line, std::move(what)}); };
  if (outline.count == 0)
    return note(fmt::format("the model '{}', which has no collision shape", model.name));
  for (const Joint& joint : model.joints)
    if (!joint.is_fixed())
      to.notes.push_back({joint.line, fmt::format("the motion of the {} joint '{}' of '{}'",
                                                  joint.type, joint.name, model.name)});
  if (outline.count > 1)
    note(fmt::format("the {} shapes of '{}': the smallest upright shape around them is one body",
                     outline.count, model.name));
  const Inertial mass = merged(masses_of(model));
  const Vector3d centre = centre_of(outline.shape);
  if ((mass.centre - centre).norm() > kOffCentre)
    note(fmt::format("the centre of mass of '{}', {:.3f} m off the middle of its shape", model.name,
                     (mass.centre - centre).norm()));
  Flow flow;
  flow.add("name", name_of_its_own(plain_name(model.name, "movable"), to.taken));
  add_form(outline, flow);
  flow.add("mass", mass.mass, "kg").add("position", list(Vector2d(centre.head<2>()), "m"));
  flow.add("elevation", std::max(0.0, heights(outline.shape).low), "m");
  flow.add("friction", friction_of(*outline.first), "1");
  to.movables += "    - " + flow.text() + at_line(outline.first->line);
}

}  // namespace

std::string world_yaml(const WorldModels& world, const std::string& file) {
  Written to;
  to.notes = world.notes;
  for (const auto& [model, is_static] : world.models) {
    to.notes.insert(to.notes.end(), model.notes.begin(), model.notes.end());
    if (!is_static) {
      add_movable(model, to);
      continue;
    }
    for (const ModelLink& link : model.links)
      for (const Collision& one : link.collisions) add_wall(model, link, one, to);
  }
  std::string text = header(file, std::move(to.notes));
  text += to.walls.empty() ? "walls: []\n" : "walls:\n" + to.walls;
  if (!to.movables.empty()) text += "movables:\n" + to.movables;
  return text;
}

}  // namespace programs::models
