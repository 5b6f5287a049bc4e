#include "programs/models/sdf_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "programs/models/mesh.h"
#include "programs/models/sdf_plugins.h"

namespace programs::models {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using ignition::math::Pose3d;

Vector3d in_eigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Isometry3d in_eigen(const Pose3d& pose) {
  const ignition::math::Quaterniond& q = pose.Rot();
  Isometry3d result = Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  result.translation() = in_eigen(pose.Pos());
  return result;
}

/// The friction of a surface, which this release of libsdformat keeps as an element only.
std::optional<double> friction_of(const ::sdf::ElementPtr& collision) {
  ::sdf::ElementPtr at = collision;
  for (const char* const name : {"surface", "friction", "ode", "mu"}) {
    if (!at || !at->HasElement(name)) return std::nullopt;
    at = at->GetElement(name);
  }
  return at->Get<double>();
}

class SdfReader {
 public:
  SdfReader(const SearchPath& search, const Lines& lines, bool is_in_world, Model& model)
      : search_(search), lines_(lines), model_(model), is_in_world_(is_in_world) {}

  /// @param pose  of the model in the frame of all. @param prefix  of its names
  void add(const ::sdf::Model& model, const Isometry3d& pose, const std::string& prefix);

 private:
  void note(Line line, std::string what) { model_.notes.push_back({line, std::move(what)}); }
  void add_link(const ::sdf::Link& from, const Isometry3d& pose, const std::string& prefix);
  void add_joint(const ::sdf::Joint& from, const Isometry3d& pose, const std::string& prefix);
  void add_collision(const ::sdf::Collision& from, ModelLink& link);
  void add_sensor(const ::sdf::Sensor& from, ModelLink& link);
  std::optional<Shape> shape_of(const ::sdf::Geometry& geometry, Line line);
  Shape mesh_of(const ::sdf::Mesh& mesh, Line line) const;

  const SearchPath& search_;
  const Lines& lines_;
  Model& model_;
  bool notes_visuals_ = true;
  bool is_in_world_;  ///< Links without a mass have the one that SDF gives.
};

Shape SdfReader::mesh_of(const ::sdf::Mesh& mesh, Line line) const {
  const auto file = search_.find(mesh.Uri());
  if (!file)
    throw ModelError(line, fmt::format("there is no mesh '{}' in the search path: {}", mesh.Uri(),
                                       search_.listed()));
  try {
    return {.kind = Shape::Kind::kPoints, .points = mesh_points(*file, in_eigen(mesh.Scale()))};
  } catch (const std::exception& error) {
    throw ModelError(line, fmt::format("'{}' {}", file->string(), error.what()));
  }
}

std::optional<Shape> SdfReader::shape_of(const ::sdf::Geometry& geometry, Line line) {
  using Type = ::sdf::GeometryType;
  switch (geometry.Type()) {
    case Type::BOX:
      return Shape{.kind = Shape::Kind::kBox, .size = in_eigen(geometry.BoxShape()->Size())};
    case Type::CYLINDER:
      return Shape{.kind = Shape::Kind::kCylinder,
                   .radius = geometry.CylinderShape()->Radius(),
                   .length = geometry.CylinderShape()->Length()};
    case Type::CAPSULE:
      return Shape{.kind = Shape::Kind::kCapsule,
                   .radius = geometry.CapsuleShape()->Radius(),
                   .length = geometry.CapsuleShape()->Length()};
    case Type::SPHERE:
      return Shape{.kind = Shape::Kind::kSphere, .radius = geometry.SphereShape()->Radius()};
    case Type::ELLIPSOID:
      return Shape{.kind = Shape::Kind::kEllipsoid,
                   .size = in_eigen(geometry.EllipsoidShape()->Radii())};
    case Type::MESH:
      return mesh_of(*geometry.MeshShape(), line);
    case Type::PLANE:
      return std::nullopt;  // the ground
    default:
      note(line,
           "a collision shape that is neither box, cylinder, sphere, capsule, ellipsoid nor mesh");
      return std::nullopt;
  }
}

void SdfReader::add_collision(const ::sdf::Collision& from, ModelLink& link) {
  const Line line = lines_.of(from.Element());
  if (from.Geom() == nullptr) throw ModelError(line, "the collision has no shape");
  std::optional<Shape> shape = shape_of(*from.Geom(), line);
  if (!shape) return;
  const bool is_possible = shape->size.minCoeff() >= 0 && shape->size.allFinite() &&
                           shape->radius >= 0 && shape->length >= 0 &&
                           std::isfinite(shape->radius + shape->length);
  if (!is_possible) throw ModelError(line, "the collision's shape has a length below 0");
  link.collisions.push_back({.name = from.Name(),
                             .pose = resolved(from.SemanticPose(), "", line),
                             .shape = std::move(*shape),
                             .mu = friction_of(from.Element()),
                             .line = line});
}

void SdfReader::add_sensor(const ::sdf::Sensor& from, ModelLink& link) {
  const Line line = lines_.of(from.Element());
  Sensor sensor{.name = from.Name(),
                .pose = resolved(from.SemanticPose(), "", line),
                .rate = from.UpdateRate(),
                .line = line};
  if (const ::sdf::Lidar* const lidar = from.LidarSensor()) {
    sensor.rays = lidar->HorizontalScanSamples();
    sensor.min_angle = lidar->HorizontalScanMinAngle().Radian();
    sensor.max_angle = lidar->HorizontalScanMaxAngle().Radian();
    sensor.min_range = lidar->RangeMin();
    sensor.max_range = lidar->RangeMax();
    sensor.sigma = lidar->LidarNoise().StdDev();
    if (lidar->VerticalScanSamples() > 1)
      note(line, fmt::format("all but the horizontal plane of the scanner '{}'", from.Name()));
  } else if (const ::sdf::Imu* const imu = from.ImuSensor()) {
    sensor.kind = Sensor::Kind::kImu;
    sensor.sigma = imu->AngularVelocityXNoise().StdDev();
    sensor.accelerometer_sigma = imu->LinearAccelerationXNoise().StdDev();
  } else if (from.Type() == ::sdf::SensorType::CONTACT) {
    sensor.kind = Sensor::Kind::kBumper;
  } else {
    return note(line, fmt::format("the sensor '{}' of type {}", from.Name(), from.TypeStr()));
  }
  link.sensors.push_back(std::move(sensor));
}

std::optional<Inertial> inertial_of(const ::sdf::Link& from, const Lines& lines) {
  const ::sdf::ElementPtr element = from.Element();
  if (!element || !element->HasElement("inertial")) return std::nullopt;
  const ignition::math::Inertiald& given = from.Inertial();
  const Isometry3d pose = in_eigen(given.Pose());
  const ignition::math::Matrix3d own = given.MassMatrix().Moi();
  Eigen::Matrix3d tensor;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      tensor(row, column) = own(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
  return Inertial{given.MassMatrix().Mass(), pose.translation(),
                  pose.linear() * tensor * pose.linear().transpose(),
                  lines.of(element->GetElement("inertial"))};
}

void SdfReader::add_link(const ::sdf::Link& from, const Isometry3d& pose,
                         const std::string& prefix) {
  ModelLink link{
      .name = prefix + from.Name(),
      .pose = pose * resolved(from.SemanticPose(), "__model__", lines_.of(from.Element())),
      .inertial = inertial_of(from, lines_),
      .line = lines_.of(from.Element())};
  if (!link.inertial && !is_in_world_)
    note(link.line, fmt::format("SDF's default mass of 1 kg of the link '{}', which has no "
                                "<inertial>: it has no mass",
                                link.name));
  for (std::uint64_t i = 0; i < from.CollisionCount(); ++i)
    add_collision(*from.CollisionByIndex(i), link);
  for (std::uint64_t i = 0; i < from.SensorCount(); ++i) add_sensor(*from.SensorByIndex(i), link);
  if (from.VisualCount() > 0 && std::exchange(notes_visuals_, false))
    note(link.line, "visual shapes: viewers draw those of collisions");
  model_.links.push_back(std::move(link));
}

void SdfReader::add_joint(const ::sdf::Joint& from, const Isometry3d& pose,
                          const std::string& prefix) {
  Joint joint{.name = prefix + from.Name(),
              .type = from.Element()->Get<std::string>("type"),
              .line = lines_.of(from.Element())};
  check(from.ResolveParentLink(joint.parent), joint.line);
  check(from.ResolveChildLink(joint.child), joint.line);
  joint.parent = joint.parent == "world" ? joint.parent : prefix + joint.parent;
  joint.child = prefix + joint.child;
  joint.origin = (pose * resolved(from.SemanticPose(), "__model__", joint.line)).translation();
  if (const ::sdf::JointAxis* const axis = from.Axis(0)) {
    ignition::math::Vector3d along;
    check(axis->ResolveXyz(along, "__model__"), joint.line);
    joint.axis = pose.linear() * in_eigen(along);
    if (!(joint.axis.norm() > 1e-6)) throw ModelError(joint.line, "the axis has no direction");
    joint.axis.normalize();
    if (std::isfinite(axis->Effort()) && axis->Effort() > 0) joint.effort = axis->Effort();
    if (std::isfinite(axis->MaxVelocity()) && axis->MaxVelocity() > 0)
      joint.velocity = axis->MaxVelocity();
  }
  model_.joints.push_back(std::move(joint));
}

void SdfReader::add(const ::sdf::Model& model, const Isometry3d& pose, const std::string& prefix) {
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i)
    add_link(*model.LinkByIndex(i), pose, prefix);
  for (std::uint64_t i = 0; i < model.JointCount(); ++i)
    add_joint(*model.JointByIndex(i), pose, prefix);
  add_plugins(model.Element(), model_);
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const ::sdf::Model& inner = *model.ModelByIndex(i);
    const Line line = lines_.of(inner.Element());
    add(inner, pose * resolved(inner.SemanticPose(), "__model__", line),
        prefix + inner.Name() + "::");
  }
}

}  // namespace

void check(const ::sdf::Errors& errors, Line otherwise) {
  if (errors.empty()) return;
  std::string what = errors.front().Message();
  std::ranges::replace(what, '\n', ' ');
  throw ModelError(errors.front().LineNumber().value_or(otherwise), what);
}

Isometry3d resolved(const ::sdf::SemanticPose& semantic, const std::string& to, Line line) {
  Pose3d pose;
  check(semantic.Resolve(pose, to), line);
  if (!pose.IsFinite()) throw ModelError(line, "the pose is not finite");
  return in_eigen(pose);
}

Model model_of(const ::sdf::Model& from, const ModelPlace& place, const SearchPath& search,
               const Lines& lines) {
  Model model{.name = from.Name(),
              .links = {},
              .joints = {},
              .notes = {},
              .line = lines.of(from.Element())};
  SdfReader(search, lines, place.is_in_world, model).add(from, place.pose, "");
  return model;
}

}  // namespace programs::models
