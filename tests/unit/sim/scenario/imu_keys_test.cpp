#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"
#include "tests/support/no_pace.h"
#include "tests/support/scripted_port.h"

namespace sim::scenario {
namespace {

using namespace std::chrono_literals;
using hal::Time;

/// What the channel "imu" read, in the order of time.
class ImuReadings final : public agents::Observer {
 public:
  bool observes_readings() const override { return true; }
  bool observes(hal::AgentId, const hal::Channel& channel) const override {
    return channel.name == "imu";
  }
  void on_reading(Time, hal::AgentId, const hal::Channel&,
                  std::span<const double> values) override {
    readings.emplace_back(values.begin(), values.end());
  }

  std::vector<std::vector<double>> readings;
};

/// Of the robot of sensors.yaml, which stands, with these sigmas in its file.
std::vector<std::vector<double>> readings(const std::string& gyro,
                                          const std::string& accelerometer) {
  const std::string imu = "agents.robots.robot.sensors.1.";
  const Scenario scenario =
      load_scenario(TESTS_DIR "/e2e/sensors.yaml",
                    {imu + "gyro_sigma=" + gyro, imu + "accelerometer_sigma=" + accelerometer});
  ImuReadings seen;
  agents::Simulation simulation(scenario.simulation, {&seen});
  simulation.connect(std::make_shared<tests::ScriptedPort>(), {scenario.simulation.agents.at(0).id},
                     {});
  tests::NoPace pace;
  simulation.run(std::nullopt, pace);
  return std::move(seen.readings);
}

/// Root of the mean square of what two series differ by, in three of their values.
double deviation(const std::vector<std::vector<double>>& a,
                 const std::vector<std::vector<double>>& b, std::size_t first) {
  double squares = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t i = first; i < first + 3; ++i) {
      squares += (a[k][i] - b.at(k).at(i)) * (a[k][i] - b[k][i]);
    }
  }
  return std::sqrt(squares / (3 * static_cast<double>(a.size())));
}

// Noise moves nothing, so that what the readings of two runs differ by is the noise. Its deviation
// out of n values deviates by 1 / sqrt(2 n) of itself; allowed are four times that.
TEST(ImuKeys, AreTheDeviationsOfTheReadings) {
  const auto exact = readings("0 rad/s", "0 m/s^2");
  ASSERT_GT(exact.size(), 100u);
  const double allowed = 4 / std::sqrt(6 * static_cast<double>(exact.size()));
  const auto turns = readings("2 deg/s", "0 m/s^2");
  const double two_degrees = 2 * 3.14159265358979 / 180;
  EXPECT_NEAR(deviation(turns, exact, 0), two_degrees, allowed * two_degrees);
  EXPECT_EQ(deviation(turns, exact, 3), 0);
  const auto forces = readings("0 rad/s", "0.05 m/s^2");
  EXPECT_EQ(deviation(forces, exact, 0), 0);
  EXPECT_NEAR(deviation(forces, exact, 3), 0.05, allowed * 0.05);
}

}  // namespace
}  // namespace sim::scenario
