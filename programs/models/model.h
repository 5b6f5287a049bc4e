#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace programs::models {

/// A place in the file that was given; 0: unknown.
using Line = int;

/// What is wrong with a file. @throws only; what() has no place.
class ModelError : public std::runtime_error {
 public:
  ModelError(Line line, const std::string& what) : std::runtime_error(what), line_(line) {}
  Line line() const { return line_; }

 private:
  Line line_;
};

/// Mass of a link.
struct Inertial {
  double mass = 0;         ///< kg, > 0
  Eigen::Vector3d centre;  ///< m, in the link's frame
  Eigen::Matrix3d tensor;  ///< kg m^2, about the centre of mass along the axes of the link
  Line line = 0;
};

/// A convex shape in its own frame, whose origin is its centre unless it is points.
struct Shape {
  /// kPoints: the convex hull of points. Axes of cylinders and capsules are z.
  enum class Kind : std::uint8_t { kBox, kCylinder, kSphere, kCapsule, kEllipsoid, kPoints };
  Kind kind = Kind::kBox;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: edges of a box, radii of an ellipsoid
  double radius = 0;                               ///< m
  double length = 0;                               ///< m; of a capsule, without its two half balls
  std::vector<Eigen::Vector3d> points{};
};

struct Collision {
  std::string name;
  Eigen::Isometry3d pose;  ///< in the link's frame
  Shape shape;
  std::optional<double> mu{};  ///< Coefficient of friction, if the file gives one.
  Line line = 0;
};

struct Sensor {
  enum class Kind : std::uint8_t { kScan, kImu, kBumper };
  Kind kind = Kind::kScan;
  std::string name;
  Eigen::Isometry3d pose;  ///< in the link's frame
  unsigned rays = 0;
  double min_angle = 0, max_angle = 0;  ///< rad, about z of the sensor
  double min_range = 0, max_range = 0;  ///< m
  double sigma = 0;                     ///< m of a scan, rad/s of gyroscopes
  double accelerometer_sigma = 0;       ///< m/s^2
  double rate = 0;                      ///< Hz; 0: not given
  Line line = 0;
};

struct ModelLink {
  std::string name;
  Eigen::Isometry3d pose;  ///< in the frame of the model, with all joints at 0
  std::optional<Inertial> inertial{};
  std::vector<Collision> collisions{};
  std::vector<Sensor> sensors{};
  Line line = 0;
};

struct Joint {
  std::string name;
  std::string type;  ///< As the file has it.
  std::string parent{}, child{};
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< unit vector, in the frame of the model
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, a point of the axis, likewise
  std::optional<double> effort{};                    ///< N m
  std::optional<double> velocity{};                  ///< rad/s
  Line line = 0;

  bool is_fixed() const { return type == "fixed"; }
  /// Whether a wheel may turn on it.
  bool turns() const { return type == "continuous" || type == "revolute"; }
};

/// What a plug-in for differential drives says.
struct DiffDrive {
  std::vector<std::string> left, right;  ///< Names of joints.
  std::optional<double> wheel_radius{};  ///< m
  std::optional<double> effort{};        ///< N m
  std::optional<double> speed{};         ///< m/s
  std::optional<double> acceleration{};  ///< m/s^2
  Line line = 0;
};

/// Something in the file that the simulated robot does not have.
struct Note {
  Line line = 0;
  std::string what;
};

/// What URDF and SDF have in common. Poses of links are for joints at 0.
struct Model {
  std::string name;
  std::vector<ModelLink> links;  ///< The first is the root, whose frame is that of the model.
  std::vector<Joint> joints;
  std::optional<DiffDrive> drive{};
  std::vector<Note> notes;
  Line line = 0;
};

/// @return null: there is none.
template <class Named>
const Named* named(const std::vector<Named>& all, const std::string& name) {
  for (const Named& one : all)
    if (one.name == name) return &one;
  return nullptr;
}

}  // namespace programs::models
