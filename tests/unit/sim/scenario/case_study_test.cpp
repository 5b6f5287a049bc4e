#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/scenario/scenario.h"

/// The case study's values stand in the project's replica specification, sections 4, 9 and 15.
namespace sim::scenario {
namespace {

const std::string kScenarios = std::string(CONFIG_DIR) + "/scenarios/";

Scenario case_study(const std::vector<std::string>& overrides = {}) {
  return load_scenario(kScenarios + "case_study.yaml", overrides);
}

const agents::AgentConfig& agent(const Scenario& scenario, const std::string& name) {
  const auto& all = scenario.simulation.agents;
  return *std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.name == name; });
}

TEST(CaseStudy, HasTwentyFiveMotesOnAGridAndOneRobot) {
  const Scenario scenario = case_study();
  ASSERT_EQ(scenario.simulation.agents.size(), 26u);
  for (int i = 0; i < 25; ++i) {
    const auto& mote = scenario.simulation.agents[static_cast<std::size_t>(i)];
    EXPECT_EQ(mote.id.value, i + 1);
    EXPECT_EQ(mote.name, "m" + std::to_string(i));
    EXPECT_EQ(mote.pose, (hal::Pose2{125.0 * (i % 5), 125.0 * (i / 5), 0}));
    EXPECT_EQ(mote.program, "help_mote");
  }
  EXPECT_EQ(agent(scenario, "m17").pose, (hal::Pose2{250, 375, 0}));
  const auto& robot = scenario.simulation.agents[25];
  EXPECT_EQ(robot.name, "r0");
  EXPECT_EQ(robot.id.value, 26);
  EXPECT_EQ(robot.pose, (hal::Pose2{8, 8, 0}));
  EXPECT_EQ(robot.program, "help_robot");
}

TEST(CaseStudy, LetsOneMoteCallForHelp) {
  const Scenario scenario = case_study();
  for (const auto& one : scenario.simulation.agents) {
    if (one.name == "r0") continue;
    EXPECT_EQ(one.parameters.size(), one.name == "m17" ? 1u : 0u) << one.name;
  }
  const auto& help_at = agent(scenario, "m17").parameters.at(0);
  EXPECT_EQ(help_at.name, "help_at");
  EXPECT_EQ(help_at.value, "1 s");
  EXPECT_EQ(help_at.place, kScenarios + "case_study.yaml:30:47");
}

TEST(CaseStudy, HasOneWallAcrossTheWay) {
  const Scenario scenario = case_study();
  ASSERT_EQ(scenario.simulation.walls.size(), 1u);
  const auto& wall = scenario.simulation.walls[0];
  EXPECT_EQ(wall.size, (hal::Vec3{0.3, 20, 1}));
  EXPECT_EQ(wall.centre, (hal::Vec3{12.2, 12.2, 0.5}));
  EXPECT_EQ(wall.yaw, 3.14159265358979323846 / 4);
}

TEST(CaseStudy, RunsOnAlignedControlWithoutLatency) {
  const auto& simulation = case_study().simulation;
  EXPECT_EQ(simulation.controller_latency, 0ns);
  EXPECT_EQ(simulation.control_phase, agents::ControlPhase::kAligned);
  EXPECT_EQ(simulation.control_period, 100ms);
  EXPECT_EQ(simulation.world.step, 10ms);
  EXPECT_EQ(simulation.localisation.range.value, 300);
  EXPECT_EQ(profile_name(simulation.radio), "mobility_framework");
}

TEST(CaseStudy, EndsWithArrivalOrAfterAnHour) {
  const Scenario scenario = case_study();
  ASSERT_EQ(scenario.simulation.ends.size(), 2u);
  const auto& arrived = scenario.simulation.ends[0];
  EXPECT_EQ(arrived.agent, agent(scenario, "m17").id);
  EXPECT_EQ(arrived.state, "FULFILLED");
  EXPECT_EQ(arrived.after, 1s);
  EXPECT_EQ(arrived.result, "arrived");
  const auto& timeout = scenario.simulation.ends[1];
  EXPECT_EQ(timeout.agent, std::nullopt);
  EXPECT_EQ(timeout.after, 3600s);
  EXPECT_EQ(timeout.result, "timeout");
  EXPECT_EQ(scenario.expectations.size(), 2u);
}

TEST(Robertino, IsTheRobotOfTheSpecification) {
  const Scenario scenario = case_study();
  const auto& robot = std::get<hal::node::devices::RobotDescription>(agent(scenario, "r0").body);
  ASSERT_EQ(robot.cylinders.size(), 2u);
  EXPECT_EQ(robot.cylinders[0], (hal::node::devices::BodyCylinder{0.185, 0.02, 0.21, {}, 9}));
  EXPECT_EQ(robot.cylinders[1], (hal::node::devices::BodyCylinder{0.10, 0.21, 0.42, {}, 2}));
  EXPECT_EQ(robot.acceleration, (hal::node::devices::AccelerationLimits{0.8, 1.5, 1.6, 3.14}));
  ASSERT_EQ(robot.wheels.size(), 3u);
  for (const auto& wheel : robot.wheels) {
    EXPECT_EQ(wheel.radius, 0.040);
    EXPECT_EQ(wheel.mass, 0.2);
    EXPECT_EQ(wheel.mu, 0.6);
    EXPECT_EQ(wheel.mu2, 0.02);
    EXPECT_EQ(wheel.max_torque, 1.0);
    EXPECT_EQ(wheel.max_speed, 23.56);
  }
  // 0.132 m at 60 degrees: (0.066, 0.132 * sqrt(3) / 2); 1e-15 m is some rounding errors.
  EXPECT_NEAR(robot.wheels[0].position.x, 0.066, 1e-15);
  EXPECT_NEAR(robot.wheels[0].position.y, 0.066 * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(robot.wheels[1].position.x, -0.132, 1e-15);
  EXPECT_DOUBLE_EQ(robot.wheels[2].axle_heading, 300 * 3.14159265358979323846 / 180);
}

TEST(Robertino, LooksAroundWithSixInfraredSensors) {
  const Scenario scenario = case_study();
  const auto& robot = std::get<hal::node::devices::RobotDescription>(agent(scenario, "r0").body);
  ASSERT_EQ(robot.infrared.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& sensor = robot.infrared[i];
    const double heading = static_cast<double>(i) * 3.14159265358979323846 / 3;
    EXPECT_DOUBLE_EQ(sensor.heading, heading);
    EXPECT_NEAR(sensor.position.x, 0.185 * std::cos(heading), 1e-15);  // m, at the rim
    EXPECT_NEAR(sensor.position.y, 0.185 * std::sin(heading), 1e-15);
    EXPECT_EQ(sensor.position.z, 0.04);
    EXPECT_DOUBLE_EQ(sensor.half_angle, 2.5 * 3.14159265358979323846 / 180);
    EXPECT_EQ(sensor.curve, hal::node::devices::InfraredCurve::gp2d12());
    EXPECT_EQ(sensor.hold_period, 38'300us);
    EXPECT_EQ(sensor.converter, (hal::node::devices::Converter{10, 5}));
  }
}

TEST(Mote, IsACubeOfFiveCentimetresAndFiftyGrams) {
  const Scenario scenario = case_study();
  const auto& mote = std::get<hal::node::devices::MoteDescription>(agent(scenario, "m0").body);
  EXPECT_EQ(mote.size, (hal::Vec3{0.05, 0.05, 0.05}));
  EXPECT_EQ(mote.mass, 0.05);
}

TEST(Overrides, ReachWhatUsersVary) {
  const Scenario scenario =
      case_study({"seed=7", "controller_latency=10 ms", "control_phase=uniform",
                  "agents.motes.controller.processes=5", "routing.jitter_max=50 ms",
                  "agents.robots.robot.infrared.sensor.noise_sigma=0 V",
                  "agents.robots.controller.parameters.speed=0.5 m/s"});
  EXPECT_EQ(scenario.simulation.seed, 7u);
  EXPECT_EQ(scenario.simulation.world.seed, 7u);
  EXPECT_EQ(scenario.simulation.controller_latency, 10ms);
  EXPECT_EQ(scenario.simulation.control_phase, agents::ControlPhase::kUniform);
  EXPECT_EQ(scenario.groups.at(0).processes, 5);
  EXPECT_EQ(scenario.simulation.routing.jitter_max, 50ms);
  const auto& robot = agent(scenario, "r0");
  EXPECT_EQ(std::get<hal::node::devices::RobotDescription>(robot.body).infrared[3].noise_sigma, 0);
  EXPECT_EQ(robot.parameters.at(0).value, "0.5 m/s");
  EXPECT_EQ(robot.parameters.at(0).place, "--set agents.robots.controller.parameters.speed");
}

TEST(Overrides, ExchangeTheRadioByNameOrByFile) {
  EXPECT_EQ(profile_name(case_study({"radio.profile=ideal"}).simulation.radio), "ideal");
  const auto by_file = case_study({"radio.include=../radios/disk.yaml", "radio.range=200 m"});
  EXPECT_EQ(std::get<radio::DiskConfig>(by_file.simulation.radio).range.value, 200);
}

TEST(TwoMotes, TakesTheDefaults) {
  const Scenario scenario = load_scenario(kScenarios + "two_motes.yaml");
  EXPECT_EQ(scenario.name, "two_motes");
  EXPECT_EQ(scenario.simulation.controller_latency, 10ms);
  EXPECT_EQ(scenario.simulation.control_phase, agents::ControlPhase::kUniform);
  EXPECT_EQ(scenario.simulation.command_timeout, 500ms);
  EXPECT_EQ(scenario.simulation.on_death, agents::OnDeath::kFail);
  EXPECT_EQ(scenario.reply_timeout, 10s);
  EXPECT_EQ(scenario.wait, 30s);
  ASSERT_EQ(scenario.simulation.agents.size(), 2u);
  EXPECT_EQ(scenario.simulation.agents[1].pose, (hal::Pose2{100, 0, 0}));
}

}  // namespace
}  // namespace sim::scenario
