// What robots in URDF become: every construct of docs/urdf.md is in one of the files.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/unit/programs/models/shapes.h"

namespace programs::models::test {
namespace {

TEST(Urdf, ShapesBecomeTheSmallestUprightOnesAroundThem) {
  const RobotDescription robot = loaded(with_wheels("shapes.urdf")).robot;
  const double diagonal = 0.2 * std::sqrt(2.0);
  ASSERT_EQ(robot.boxes.size(), 8U);
  expect_box(robot.boxes[0], {0.3, 0.2, 0.1}, {0, 0, 0.1}, 0.5);
  expect_box(robot.boxes[1], {0.2, 0.1, 0.3}, {0, 0, 0.3}, kQuarter);   // stands on its end
  expect_box(robot.boxes[2], {0.3, 0.1, 0.1}, {0, 0, 0.7}, -kQuarter);  // a lying cylinder
  const double leaning = (0.3 + 0.1) / std::sqrt(2.0);  // a cylinder at 45 deg: (l + 2 r) / sqrt 2
  expect_box(robot.boxes[3], {leaning, 0.1, leaning}, {0, 0, 0.9}, 0);
  expect_box(robot.boxes[4], {0.3, 0.1, 0.1}, {0, 0, 1.3}, 0);            // a lying capsule
  expect_box(robot.boxes[5], {0.2, diagonal, diagonal}, {0, 0, 1.5}, 0);  // a box on an edge
  // The outlines of the wheels.
  expect_box(robot.boxes[6], {0.03, 0.1, 0.1}, {0.05, 0.12, 0.05}, -kQuarter);
  expect_box(robot.boxes[7], {0.03, 0.1, 0.1}, {0.05, -0.12, 0.05}, -kQuarter);
  ASSERT_EQ(robot.cylinders.size(), 2U);
  expect_cylinder(robot.cylinders[0], 0.1, 0.4, 0.6);
  expect_cylinder(robot.cylinders[1], 0.08, 1.02, 1.18);  // a ball
}

TEST(Urdf, MeshesBecomeTheBoxOrTheCylinderAroundTheirConvexHull) {
  const RobotDescription robot = loaded(with_wheels("meshes.urdf")).robot;
  ASSERT_EQ(robot.boxes.size(), 4U);
  expect_box(robot.boxes[0], {0.3, 0.2, 0.1}, {0.15, 0.1, 0.15}, 0, kMesh);  // STL in mm
  // DAE in mm, moved up by 20 mm in its scene; the box of least area turned by 0.5 rad.
  expect_box(robot.boxes[1], {0.1, 0.2, 0.04}, {0, 0, 0.52}, 0.5 - kQuarter, kMesh);
  ASSERT_EQ(robot.cylinders.size(), 1U);
  expect_cylinder(robot.cylinders[0], 0.1, 0.25, 0.35, kMesh);  // OBJ of 24 corners on a circle
}

TEST(Urdf, BallsThatTouchTheGroundAreCasters) {
  const RobotDescription robot = loaded(with_wheels("left_out.urdf")).robot;
  ASSERT_EQ(robot.wheels.size(), 3U);
  EXPECT_EQ(robot.wheels[2].type, WheelType::kCaster);
  EXPECT_NEAR(robot.wheels[2].position.x, -0.2, 1e-12);
  EXPECT_NEAR(robot.wheels[2].radius, 0.03, 1e-12);
}

TEST(Urdf, CastersMayBeNamedByTheirLinks) {
  const std::string keys = "urdf: " + robots() +
                           "swivel.urdf\n"
                           "drive: {left: left_joint, right: right_joint, casters: roll}\n";
  const RobotDescription robot = loaded(keys).robot;
  ASSERT_EQ(robot.wheels.size(), 3U);
  EXPECT_NEAR(robot.wheels[2].position.x, -0.22, 1e-12);
  EXPECT_NEAR(robot.wheels[2].radius, 0.03, 1e-12);
  EXPECT_NEAR(robot.inertia.value().mass, 5.2, 1e-12);  // with fork and roll, without the wheels
}

TEST(Urdf, CastersWithoutAShapeMayBeAdded) {
  EXPECT_EQ(mistakes(with_wheels("swivel.urdf")).size(), 1U);
  const RobotDescription robot =
      loaded(with_wheels("swivel.urdf") +
             "wheels: {joints: {add: [{type: caster, position: [-20 cm, 0 m], radius: 3 cm, mass: "
             "100 g}]}}\n")
          .robot;
  ASSERT_EQ(robot.wheels.size(), 3U);
  EXPECT_EQ(robot.wheels[2].type, WheelType::kCaster);
}

TEST(Urdf, LimitsOfJointsAreThoseOfMotors) {
  const RobotDescription robot =
      loaded("urdf: " + robots() +
             "four_wheels.urdf\ndrive: {left: [front_left_joint, rear_left_joint], right: "
             "[front_right_joint, rear_right_joint]}\n")
          .robot;
  ASSERT_EQ(robot.wheels.size(), 4U);
  for (const auto& wheel : robot.wheels) {
    EXPECT_EQ(wheel.max_torque, 2);
    EXPECT_EQ(wheel.max_speed, 20);
    EXPECT_EQ(wheel.mass, 0.2);
    EXPECT_NEAR(wheel.radius, 0.05, 1e-12);
    EXPECT_NEAR(wheel.axle_heading, -kQuarter, 1e-12);  // a positive speed drives forward
  }
  EXPECT_NEAR(robot.wheels[1].position.x, -0.15, 1e-12);
  EXPECT_NEAR(robot.wheels[1].position.y, 0.2, 1e-12);
}

TEST(Urdf, KeysBesideItReplaceWhatTheFileSays) {
  const RobotDescription robot =
      loaded(with_wheels("shapes.urdf") +
             "wheels: {wheel: {limit: {effort: 7 N m}, mu: 0.5}}\nlink: {friction: 0.1}\n")
          .robot;
  EXPECT_EQ(robot.wheels[0].max_torque, 7);
  EXPECT_EQ(robot.wheels[0].max_speed, 20);
  EXPECT_EQ(robot.wheels[0].mu, 0.5);
  EXPECT_EQ(robot.friction, 0.1);
}

TEST(Urdf, OmniWheelsHaveTheAxesOfTheirJoints) {
  const RobotDescription robot =
      loaded("urdf: " + robots() + "three_omni.urdf\ndrive: {omni: [a_joint, b_joint, c_joint]}\n")
          .robot;
  ASSERT_EQ(robot.wheels.size(), 3U);
  EXPECT_EQ(robot.wheels[0].type, WheelType::kOmni);
  EXPECT_NEAR(robot.wheels[0].axle_heading, 2 * kQuarter / 3 - 2 * kQuarter, 1e-8);
  EXPECT_NEAR(robot.wheels[1].axle_heading, 0, 1e-8);
}

// As config/robots/youbot.yaml has them.
TEST(Urdf, RollersOfMecanumWheelsFormAnX) {
  const RobotDescription robot =
      loaded("urdf: " + robots() +
             "mecanum.urdf\ndrive: {mecanum: [front_left_joint, front_right_joint, "
             "rear_left_joint, rear_right_joint]}\n")
          .robot;
  ASSERT_EQ(robot.wheels.size(), 4U);
  const std::array angles{-1, 1, 1, -1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(robot.wheels[i].type, WheelType::kMecanum);
    EXPECT_NEAR(robot.wheels[i].roller_angle, angles[i] * kQuarter / 2, 1e-12);
  }
}

TEST(Urdf, WhatIsFixedToAWheelIsPartOfIt) {
  const RobotDescription robot = loaded(with_wheels("parts_on_wheels.urdf")).robot;
  EXPECT_NEAR(robot.wheels[0].mass, 0.25, 1e-12);
  EXPECT_NEAR(robot.inertia.value().mass, 5, 1e-12);
}

TEST(Urdf, SaysOnceWhatTheRobotDoesNotHave) {
  const std::string what = ":1: warning: is left out: ";
  EXPECT_EQ(left_out(loaded(with_wheels("left_out.urdf")).warnings),
            (std::vector<std::string>{
                "18" + what + "visual shapes: viewers draw those of collisions",
                "34" + what + "<dynamics> of the joint 'left_joint'",
                "52" + what + "<mimic> of the joint 'right_joint'",
                "65" + what + "the motion of the revolute joint 'shoulder': it is held at 0",
                "69" + what + "<safety_controller> of the joint 'shoulder'",
                "70" + what + "<calibration> of the joint 'shoulder'",
                "75" + what + "<transmission> 'left_transmission'", "79" + what + "<gazebo> 'base'",
                "82" + what + "<gazebo>"}));
}

TEST(Urdf, MistakesHaveTheirPlaces) {
  const std::string file = robots() + "shapes.urdf";
  const auto wrong = mistakes("urdf: " + file + "\ndrive: {left: left_joit, right: right_joint}\n");
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_NE(
      wrong[0].find("robot.yaml:2:15: drive.left: there is no joint 'left_joit'; did you mean "
                    "'left_joint'?; joints here that turn: left_joint, right_joint"),
      std::string::npos)
      << wrong[0];
  const auto unknown = mistakes("urdf: " + file + "\ndrive: {leeft: a}\n");
  ASSERT_EQ(unknown.size(), 1U);
  EXPECT_NE(unknown[0].find(":2:16: drive.leeft: is not a known key"), std::string::npos)
      << unknown[0];
  const auto none = mistakes("urdf: " + file + "\n");
  ASSERT_EQ(none.size(), 1U);
  EXPECT_NE(none[0].find("robot.yaml:1:7: drive: must name the joints of the wheels"),
            std::string::npos)
      << none[0];
}

/// A file with all occurrences of a text replaced, and what is wrong with it.
std::vector<std::string> mistakes_with(const std::string& name, const std::string& text,
                                       const std::string& by) {
  const Folder folder;
  std::ifstream stream(robots() + name);
  std::string all{std::istreambuf_iterator<char>(stream), {}};
  for (auto at = all.find(text); at != std::string::npos; at = all.find(text, at + by.size()))
    all.replace(at, text.size(), by);
  return mistakes("urdf: " + folder.write("changed.urdf", all).string() +
                  "\ndrive: {left: left_joint, right: right_joint}\n");
}

TEST(Urdf, AValueThatNoRobotCanHaveIsRefusedAtItsLine) {
  const auto wrong = mistakes_with("left_out.urdf", "velocity=\"20\"", "velocity=\"2e6\"");
  // Two: without a speed the wheels cannot drive, either.
  ASSERT_EQ(wrong.size(), 2U);
  EXPECT_NE(wrong[1].find("changed.urdf:30:1: wheels.wheel.limit.velocity: 2000000 rad/s is above "
                          "the limit of 10000 rad/s"),
            std::string::npos)
      << wrong[1];
}

TEST(Urdf, ATensorThatNoBodyHasIsRefusedAtItsLine) {
  const auto wrong = mistakes_with("left_out.urdf", "izz=\"0.07\"", "izz=\"0.17\"");
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_NE(wrong[0].find("changed.urdf:8:1: the link 'base': no body has the principal moments "
                          "0.05, 0.06 and 0.17 kg m^2"),
            std::string::npos)
      << wrong[0];
}

TEST(Urdf, AMeshThatIsNowhereIsAMistakeThatNamesWhereItWasSearched) {
  const auto wrong = mistakes("urdf: " + robots() +
                              "meshes.urdf\ndrive: {left: left_joint, right: right_joint}\n"
                              "search_path: [/nowhere]\n");
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_NE(wrong[0].find("meshes.urdf:12:1: there is no mesh 'package://some_package/meshes/"
                          "wedge.stl' in the search path: /nowhere"),
            std::string::npos)
      << wrong[0];
}

TEST(Urdf, PackagesAreSearchedForWhereRosSearches) {
  ::setenv("ROS_PACKAGE_PATH", robots().c_str(), 1);
  const auto found =
      loaded("urdf: " + robots() + "meshes.urdf\ndrive: {left: left_joint, right: right_joint}\n");
  ::unsetenv("ROS_PACKAGE_PATH");
  EXPECT_EQ(found.robot.cylinders.size(), 1U);
}

TEST(Urdf, XacroIsExpandedByTheProgramIfItIsThere) {
  const std::string keys = with_wheels("macro.urdf.xacro");
  const auto wrong = mistakes(keys);
  if (wrong.empty()) {
    EXPECT_EQ(loaded(keys).robot.wheels.size(), 3U);
    return;
  }
  EXPECT_NE(wrong[0].find("macro.urdf.xacro:19:1: has elements of xacro, and the program xacro is "
                          "not in PATH"),
            std::string::npos)
      << wrong[0];
}

// A program of that name that says what xacro would: the file without its macros, with one wheel on
// each side.
TEST(Urdf, WhatXacroPrintsIsRead) {
  const Folder folder;
  const auto program = folder.write("xacro", "#!/bin/sh\ncat " + robots() + "left_out.urdf\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", (program.parent_path().string() + ":" + path).c_str(), 1);
  const auto found = loaded(with_wheels("macro.urdf.xacro"));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(found.robot.model, "left_out");
}

}  // namespace
}  // namespace programs::models::test
