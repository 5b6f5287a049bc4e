// What robots in SDF become: every construct of docs/urdf.md is in one of the files.
#include <gtest/gtest.h>

#include <chrono>

#include "tests/unit/programs/models/shapes.h"

namespace programs::models::test {
namespace {

TEST(Sdf, HasShapesOfItsOwn) {
  const Loaded all = loaded(with_wheels("shapes.sdf"));
  ASSERT_EQ(all.robot.cylinders.size(), 2U);
  expect_cylinder(all.robot.cylinders[0], 0.05, 0.15, 0.45);           // a capsule
  expect_cylinder(all.robot.cylinders[1], 0.05, 0.95, 1.05, kMesh);    // a mesh at half its width
  expect_box(all.robot.boxes.at(0), {0.1, 0.2, 0.4}, {0, 0, 0.6}, 0);  // an ellipsoid, turned
  EXPECT_EQ(
      left_out(all.warnings),
      (std::vector<std::string>{"25:1: warning: is left out: a collision shape that is neither "
                                "box, cylinder, sphere, capsule, ellipsoid nor mesh"}));
}

TEST(Sdf, DifferentialDriveOfGazeboGivesWheelsAndLimits) {
  const RobotDescription robot =
      loaded("sdf: " + robots() + "gz_drive.sdf\nwheels: {wheel: {limit: {effort: 2 N m}}}\n")
          .robot;
  ASSERT_EQ(robot.wheels.size(), 3U);
  EXPECT_EQ(robot.wheels[0].type, WheelType::kFixed);
  EXPECT_NEAR(robot.wheels[0].max_speed, 1.0 / 0.05, 1e-9);  // max_linear_velocity / wheel_radius
  EXPECT_EQ(robot.wheels[0].mu, 0.8);
  EXPECT_EQ(robot.wheels[2].type, WheelType::kCaster);  // on a ball joint
  EXPECT_EQ(robot.wheels[2].mu, 0.01);
  EXPECT_EQ(robot.acceleration.linear_up, 0.5);
  EXPECT_EQ(robot.friction, 0.4);
}

TEST(Sdf, SensorsAreTakenOverWithTheirPlaces) {
  using namespace hal::node::devices;
  const Loaded all =
      loaded("sdf: " + robots() + "gz_drive.sdf\nwheels: {wheel: {limit: {effort: 2 N m}}}\n");
  ASSERT_EQ(all.robot.sensors.size(), 3U);
  const auto& scan = std::get<ScanSensor>(all.robot.sensors[0]);
  EXPECT_EQ(scan.mount.name, "front_scan");
  expect_near(scan.mount.position, {0.1, 0, 0.2});
  EXPECT_NEAR(scan.mount.heading, 0.5 + 0.5, 1e-12);  // its yaw, and the middle of -1 .. 2 rad
  EXPECT_NEAR(scan.field, 3, 1e-12);
  EXPECT_EQ(scan.rays, 181);
  EXPECT_EQ(scan.min_range, 0.1);
  EXPECT_EQ(scan.max_range, 8);
  EXPECT_EQ(scan.noise_sigma, 0.02);
  EXPECT_EQ(scan.period, std::chrono::milliseconds(200));
  const auto& imu = std::get<ImuSensor>(all.robot.sensors[1]);
  EXPECT_EQ(imu.gyro_sigma, 0.003);
  EXPECT_EQ(imu.accelerometer_sigma, 0.04);
  EXPECT_EQ(std::get<Bumper>(all.robot.sensors[2]).mount.name, "odom_bumper");
  EXPECT_EQ(
      left_out(all.warnings),
      (std::vector<std::string>{
          "19:1: warning: is left out: all but the horizontal plane of the scanner 'front scan'",
          "69:1: warning: is left out: the sensor 'eye' of type camera"}));
}

TEST(Sdf, DifferentialDriveOfGazeboClassicGivesTorque) {
  const Loaded all = loaded("sdf: " + robots() + "classic_drive.sdf\n");
  EXPECT_EQ(all.robot.wheels[0].max_torque, 3);
  EXPECT_EQ(all.robot.wheels[0].max_speed, 15);
  EXPECT_EQ(all.robot.wheels[0].mu, 0.6);  // 100000 is none
  EXPECT_EQ(all.robot.sensors.size(), 1U);
  EXPECT_EQ(left_out(all.warnings).size(), 4U);
}

TEST(Sdf, AWheelThatTurnsAboutTheOppositeAxisDrivesBackward) {
  const RobotDescription robot = loaded(with_wheels("opposite_axes.sdf")).robot;
  EXPECT_NEAR(robot.wheels[0].axle_heading, -kQuarter, 1e-9);
  EXPECT_NEAR(robot.wheels[1].axle_heading, kQuarter, 1e-9);
  EXPECT_EQ(robot.wheels[0].max_torque, 2);
  EXPECT_EQ(robot.wheels[1].max_torque, 3);
}

TEST(Sdf, AModelIsChosenByItsName) {
  const auto wrong = mistakes(with_wheels("two_models.sdf"));
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_NE(wrong[0].find("sdf_model must name one model; models here: first, second"),
            std::string::npos)
      << wrong[0];
  const RobotDescription robot =
      loaded(with_wheels("two_models.sdf") + "sdf_model: second\n").robot;
  EXPECT_EQ(robot.model, "second");
  EXPECT_NEAR(robot.inertia.value().mass, 7.1, 1e-12);
}

}  // namespace
}  // namespace programs::models::test
