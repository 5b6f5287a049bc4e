#include "programs/models/robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hal/files/config/suggest.h"
#include "hal/types/math.h"
#include "programs/models/gentle.h"
#include "programs/models/wheel_parts.h"

namespace programs::models {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLevel = 0.02;        ///< Slope of an axle or a sensor that counts as level.
constexpr double kTouches = 3e-3;      ///< m, of a caster above or below the ground.
constexpr double kSameGround = 0.01;   ///< m, between the heights on which wheels stand.
constexpr double kLeastMass = 1e-3;    ///< kg, what a robot file accepts
constexpr double kLeastRadius = 1e-3;  ///< m, likewise

struct Chosen {
  const Joint* joint;
  std::string type;
};

/// Makes a robot file's values from a model.
class Assembly {
 public:
  Assembly(const Model& model, const DriveChoice& choice) : model_(model), choice_(choice) {}
  Robot robot();

 private:
  void note(Line line, std::string what) { robot_.notes.push_back({line, std::move(what)}); }
  void choose(const std::string& key, const std::vector<std::string>& names,
              const std::string& type);
  void choose_all();
  void assign_links();
  void add_wheel(const Chosen& chosen);
  void find_ground();
  void add_body();
  void add_caster(const ModelLink& link, const Collision& collision);
  void add_named_casters();
  void add_shape(const ModelLink& link, const Collision& collision, bool is_wheel);
  void add_sensors(const ModelLink& link);
  std::string turning_joints() const;
  const Joint* wheel_above(const std::string& link) const;

  const Model& model_;
  const DriveChoice& choice_;
  Robot robot_;
  std::vector<Chosen> chosen_;
  std::map<std::string, const Joint*> joint_to_;  ///< By child.
  WheelOfLink wheel_of_;
  std::set<const Collision*> casters_;
  double ground_ = 0;  ///< m, its z in the model's frame
};

std::string Assembly::turning_joints() const {
  std::string list;
  for (const Joint& joint : model_.joints)
    if (joint.turns()) list += (list.empty() ? "" : ", ") + joint.name;
  return list.empty() ? "no joint here turns" : "joints here that turn: " + list;
}

void Assembly::choose(const std::string& key, const std::vector<std::string>& names,
                      const std::string& type) {
  for (const std::string& name : names) {
    const Joint* const joint = named(model_.joints, name);
    if (joint == nullptr) {
      std::vector<std::string> known;
      for (const Joint& one : model_.joints) known.push_back(one.name);
      throw DriveError(key,
                       fmt::format("there is no joint '{}'{}; {}", name,
                                   hal::files::config::suggestion(name, known), turning_joints()));
    }
    if (!joint->turns())
      throw DriveError(
          key, fmt::format("the joint '{}' is {}; {}", name, joint->type, turning_joints()));
    for (const Chosen& other : chosen_)
      if (other.joint == joint)
        throw DriveError(key, fmt::format("the joint '{}' is named twice", name));
    chosen_.push_back({joint, type});
  }
}

void Assembly::choose_all() {
  if (choice_.names_wheels()) {
    choose("drive.left", choice_.left, "fixed");
    choose("drive.right", choice_.right, "fixed");
    choose("drive.omni", choice_.omni, "omni");
    choose("drive.mecanum", choice_.mecanum, "mecanum");
  } else if (model_.drive) {
    choose("drive", model_.drive->left, "fixed");
    choose("drive", model_.drive->right, "fixed");
  }
  if (chosen_.empty())
    throw DriveError(
        "drive",
        "must name the joints of the wheels, e.g. {left: NAME, right: NAME}; " + turning_joints());
}

/// The wheel that a link turns with, if it does.
const Joint* Assembly::wheel_above(const std::string& link) const {
  std::string at = link;
  for (std::size_t steps = 0; steps <= model_.joints.size(); ++steps) {
    const auto found = joint_to_.find(at);
    if (found == joint_to_.end()) return nullptr;
    const Joint* const joint = found->second;
    for (const Chosen& one : chosen_)
      if (one.joint == joint) return joint;
    at = joint->parent;
  }
  throw ModelError(model_.line, fmt::format("the link '{}' is in a circle of joints", link));
}

void Assembly::assign_links() {
  for (const Joint& joint : model_.joints) {
    if (!joint_to_.emplace(joint.child, &joint).second)
      throw ModelError(joint.line,
                       fmt::format("the link '{}' is the child of two joints", joint.child));
  }
  for (const ModelLink& link : model_.links) {
    if (link.inertial) check_solid(*link.inertial, link.name);
    if (const Joint* const wheel = wheel_above(link.name)) wheel_of_[link.name] = wheel;
    const bool is_joined = &link == &model_.links.front() || joint_to_.contains(link.name);
    if (!is_joined)
      throw ModelError(link.line, fmt::format("no joint connects the link '{}' with '{}'",
                                              link.name, model_.links.front().name));
  }
  for (const Joint& joint : model_.joints) {
    const bool is_wheel =
        std::ranges::any_of(chosen_, [&](const Chosen& one) { return one.joint == &joint; });
    if (joint.is_fixed() || is_wheel || joint.type == "ball") continue;
    note(joint.line,
         fmt::format("the motion of the {} joint '{}': it is held at 0", joint.type, joint.name));
  }
}

void Assembly::add_wheel(const Chosen& chosen) {
  const Joint& joint = *chosen.joint;
  if (std::abs(joint.axis.z()) > kLevel)
    throw ModelError(joint.line,
                     fmt::format("the axis of the wheel's joint '{}' is not level: {:.3f}, "
                                 "{:.3f}, {:.3f}",
                                 joint.name, joint.axis.x(), joint.axis.y(), joint.axis.z()));
  RobotWheel wheel{.type = chosen.type, .position = joint.origin.head<2>(), .line = joint.line};
  const WheelParts parts = parts_of_wheel(model_, wheel_of_, joint, robot_.notes);
  wheel.mass = parts.mass;
  wheel.radius = parts.radius;
  wheel.mu = parts.mu;
  const bool has_plugin = model_.drive.has_value();
  if (wheel.radius == 0 && has_plugin) wheel.radius = model_.drive->wheel_radius.value_or(0);
  if (wheel.radius == 0)
    throw ModelError(joint.line,
                     fmt::format("the wheel of '{}' has no collision shape, of which its "
                                 "radius would be taken",
                                 joint.name));
  const Vector3d& centre = parts.centre;
  wheel.position = centre.head<2>();
  // It rolls towards axis x z, and a robot file's wheel towards its own axis + 90 degrees.
  wheel.axis = hal::math::atan2(-joint.axis.y(), -joint.axis.x());
  wheel.effort = joint.effort;
  wheel.velocity = joint.velocity;
  if (has_plugin && !wheel.effort) wheel.effort = model_.drive->effort;
  if (has_plugin && !wheel.velocity && model_.drive->speed)
    wheel.velocity = *model_.drive->speed / wheel.radius;
  if (chosen.type == "mecanum")
    wheel.roller_angle = (centre.x() * centre.y() > 0 ? -1 : 1) * choice_.roller_angle;
  robot_.wheels.push_back(wheel);
  const double below = centre.z() - wheel.radius;
  if (robot_.wheels.size() == 1) ground_ = below;
  if (std::abs(below - ground_) > kSameGround)
    throw ModelError(joint.line,
                     fmt::format("the wheel of '{}' stands {:.3f} m above or below the first",
                                 joint.name, std::abs(below - ground_)));
  ground_ = std::min(ground_, below);
}

void Assembly::add_caster(const ModelLink& link, const Collision& collision) {
  const Upright shape = upright(collision.shape, link.pose * collision.pose);
  const Heights z = heights(shape);
  RobotWheel caster{
      .type = "caster", .position = centre_of(shape).head<2>(), .line = collision.line};
  caster.radius = std::max(kLeastRadius, (z.low + z.high) / 2 - ground_);
  // A ball that is one of a link's shapes has no mass of its own.
  const bool is_own = link.inertial && link.collisions.size() == 1;
  caster.mass = std::max(kLeastMass, is_own ? link.inertial->mass : 0);
  if (collision.mu && *collision.mu <= kHighestFriction) caster.mu = collision.mu;
  robot_.wheels.push_back(caster);
  casters_.insert(&collision);
}

void Assembly::add_named_casters() {
  for (const std::string& name : choice_.casters) {
    const ModelLink* const link = named(model_.links, name);
    if (link == nullptr) {
      std::vector<std::string> known;
      for (const ModelLink& one : model_.links) known.push_back(one.name);
      throw DriveError("drive.casters", fmt::format("there is no link '{}'{}", name,
                                                    hal::files::config::suggestion(name, known)));
    }
    if (link->collisions.empty())
      throw DriveError("drive.casters", fmt::format("the link '{}' has no collision shape", name));
    const auto low = [&](const Collision& one) {
      return heights(upright(one.shape, link->pose * one.pose)).low;
    };
    add_caster(*link, *std::ranges::min_element(link->collisions, {}, low));
    for (const Collision& one : link->collisions) casters_.insert(&one);
  }
}

void Assembly::add_shape(const ModelLink& link, const Collision& collision, bool is_wheel) {
  Isometry3d pose = link.pose * collision.pose;
  pose.translation().z() -= ground_;
  Upright shape = upright(collision.shape, pose);
  const double below = -heights(shape).low;
  if (!cut_at_ground(shape))
    return note(collision.line, fmt::format("'{}', which is below the ground", collision.name));
  if (below > kTouches && !is_wheel)
    note(collision.line,
         fmt::format("what of '{}' is below the ground: {:.3f} m", collision.name, below));
  if (!is_wheel && collision.mu)
    robot_.friction = std::min(robot_.friction.value_or(*collision.mu), *collision.mu);
  robot_.shapes.push_back({shape, collision.line});
}

void Assembly::add_sensors(const ModelLink& link) {
  for (const Sensor& one : link.sensors) {
    if (wheel_of_.contains(link.name)) {
      note(one.line, fmt::format("the sensor '{}', which is on a wheel", one.name));
      continue;
    }
    const Isometry3d pose = link.pose * one.pose;
    if (one.kind == Sensor::Kind::kScan && pose.linear()(2, 2) < 1 - kLevel)
      note(one.line, fmt::format("the tilt of the scanner '{}': it scans level", one.name));
    const Vector3d x = pose.linear().col(0);
    robot_.sensors.push_back(
        {one, pose.translation() - Vector3d(0, 0, ground_), hal::math::atan2(x.y(), x.x())});
  }
}

void Assembly::add_body() {
  std::vector<PlacedInertial> parts;
  for (const ModelLink& link : model_.links) {
    const bool is_wheel = wheel_of_.contains(link.name);
    if (link.inertial && !is_wheel) parts.push_back({link.pose, *link.inertial});
    for (const Collision& one : link.collisions) {
      const bool is_ball = one.shape.kind == Shape::Kind::kSphere;
      const double low = heights(upright(one.shape, link.pose * one.pose)).low;
      const bool touches = std::abs(low - ground_) < kTouches;
      if (!is_wheel && is_ball && touches && choice_.casters.empty()) add_caster(link, one);
      if (!casters_.contains(&one)) add_shape(link, one, is_wheel);
    }
    add_sensors(link);
  }
  if (parts.empty()) throw ModelError(model_.line, "no link of the body has a mass");
  robot_.inertia = merged(parts);
  robot_.inertia.centre.z() -= ground_;
}

Robot Assembly::robot() {
  choose_all();
  robot_.model = model_.name;
  robot_.line = model_.line;
  robot_.notes = model_.notes;
  assign_links();
  for (const Chosen& one : chosen_) add_wheel(one);
  add_named_casters();
  add_body();
  if (model_.drive) robot_.acceleration = model_.drive->acceleration;
  const auto gentle = gentle_acceleration(robot_);
  if (gentle) robot_.acceleration = std::min(*gentle, robot_.acceleration.value_or(*gentle));
  std::ranges::stable_sort(robot_.notes, {}, &Note::line);
  return std::move(robot_);
}

}  // namespace

Robot robot_of(const Model& model, const DriveChoice& choice) {
  return Assembly(model, choice).robot();
}

}  // namespace programs::models
