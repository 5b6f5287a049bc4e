#include <pybind11/numpy.h>

#include "python/bindings/agent.h"
#include "python/bindings/errors.h"
#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

py::array_t<double> array_of(std::span<const double> values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::object vec2(hal::Vec2 v) {
  static constinit ValueClass of_class("Vec2");
  return of_class(v.x, v.y);
}
py::object vec3(const hal::Vec3& v) {
  static constinit ValueClass of_class("Vec3");
  return of_class(v.x, v.y, v.z);
}
py::object pose2(const hal::Pose2& pose) {
  static constinit ValueClass of_class("Pose2");
  return of_class(pose.x, pose.y, pose.theta);
}
py::object twist2(const hal::Twist2& twist) {
  static constinit ValueClass of_class("Twist2");
  return of_class(twist.vx, twist.vy, twist.omega);
}

const char* name_of(hal::Solid::Shape shape) {
  switch (shape) {
    case hal::Solid::Shape::kArrow:
      return "arrow";
    case hal::Solid::Shape::kSphere:
      return "sphere";
    case hal::Solid::Shape::kCylinder:
      return "cylinder";
    case hal::Solid::Shape::kBox:
      break;
  }
  return "box";
}

py::object body(const RobotHandle& self) {
  static constinit ValueClass body_class("RobotBody");
  static constinit ValueClass solid_class("Solid");
  static constinit ValueClass wheel_class("BodyWheel");
  const hal::RobotBody& body = self.robot().body();
  py::list solids, wheels;
  for (const hal::Solid& one : body.solids) {
    solids.append(solid_class(name_of(one.shape), vec3(one.size), vec3(one.centre), one.yaw));
  }
  for (const hal::BodyWheel& one : body.wheels) {
    wheels.append(wheel_class(one.is_driven, vec2(one.position), one.axle_heading, one.roller_angle,
                              one.radius, one.max_speed, one.max_torque));
  }
  return body_class(body.model, solids, wheels);
}

py::object set_body_velocity(const RobotHandle& self, py::handle vx, py::handle vy,
                             py::handle omega) {
  static constinit ValueClass drive_class("Drive");
  const hal::Twist2 wanted{number_from(vx, "vx"), number_from(vy, "vy"),
                           number_from(omega, "omega")};
  const auto drive = value_of(self.robot().set_body_velocity(wanted));
  return drive_class(twist2(drive.applied), drive.saturated, drive.restricted);
}

py::list infrared(const RobotHandle& self) {
  static constinit ValueClass reading_class("InfraredReading");
  py::list all;
  for (const auto& [heading, range] : value_of(self.robot().infrared())) {
    all.append(reading_class(heading, range));
  }
  return all;
}

py::object odometry(const RobotHandle& self) {
  static constinit ValueClass odometry_class("Odometry");
  const auto odometry = value_of(self.robot().odometry());
  return odometry_class(pose2(odometry.pose), twist2(odometry.twist));
}

py::object scan(const RobotHandle& self) {
  static constinit ValueClass scan_class("Scan");
  const auto scan = value_of(self.robot().scan());
  return scan_class(array_of(scan.headings), array_of(scan.ranges));
}

py::object imu(const RobotHandle& self) {
  static constinit ValueClass imu_class("Imu");
  const auto imu = value_of(self.robot().imu());
  return imu_class(vec3(imu.angular_velocity), vec3(imu.specific_force));
}

}  // namespace

void add_robot(py::module_& module) {
  py::class_<RobotHandle, AgentHandle, std::shared_ptr<RobotHandle>>(module, "Robot",
                                                                     "An agent that can drive.")
      .def("body", body, "Shape and wheels as the robot's file describes them: a RobotBody.")
      .def("set_body_velocity", set_body_velocity, py::arg("vx") = 0.0, py::arg("vy") = 0.0,
           py::arg("omega") = 0.0,
           "Drives with this velocity of the body [m/s, m/s, rad/s] until the next command; "
           "returns a Drive.")
      .def(
          "set_wheel_speeds",
          [](const RobotHandle& self, py::handle speeds) {
            const std::vector<double> wanted = numbers_from(speeds, "speeds");
            value_of(self.robot().set_wheel_speeds(wanted));
          },
          py::arg("speeds"), "Turns the driven wheels at these speeds [rad/s].")
      .def("infrared", infrared, "Latest ranges: a list of InfraredReading.")
      .def("odometry", odometry, "Latest Odometry.")
      .def("scan", scan, "Latest Scan, arrays of its own.")
      .def("imu", imu, "Latest Imu.")
      .def(
          "bumped", [](const RobotHandle& self) { return value_of(self.robot().bumped()); },
          "Whether the body has touched anything since the previous control cycle.")
      .def(
          "pose", [](const RobotHandle& self) { return pose2(value_of(self.robot().pose())); },
          "Measured Pose2 of the body in the world.");
}

}  // namespace python::bindings
