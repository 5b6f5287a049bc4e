#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/robot/drivers/robotino.h"
#include "hal/robot/drivers/robotino_rest.h"
#include "hal/robot/drivers/threaded_infrared.h"
#include "hal/types/math.h"

namespace hal::robot::drivers {
namespace {

constexpr double kSpacing = 2 * math::kPi / RobotinoRest::kSensors;  // rad
constexpr double kAligned = math::kPi / 180;                         // rad
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// The sensors of the array that represent one of the robot's: the same one twice if their
/// directions agree.
struct Pair {
  std::size_t first = 0;
  std::size_t second = 0;
};

Pair pair_for(double heading, bool clockwise) {
  const double turns = (clockwise ? -heading : heading) / kSpacing;
  const double count = RobotinoRest::kSensors;
  const auto index = [&](double place) {
    const double wrapped = place - count * std::floor(place / count);
    return static_cast<std::size_t>(wrapped) % RobotinoRest::kSensors;
  };
  const double nearest = std::floor(turns + 0.5);
  if (std::abs(turns - nearest) * kSpacing <= kAligned) return {index(nearest), index(nearest)};
  return {index(std::floor(turns)), index(std::floor(turns) + 1)};
}

class RobotinoInfrared final : public InfraredDevice {
 public:
  RobotinoInfrared(const RobotinoSettings& settings, const node::devices::RobotDescription& robot)
      : settings_(settings), sensors_(robot.infrared), rest_(settings) {}

  Result<InfraredReadings> measure() override {
    const auto array = rest_.distances();
    if (!array) return tl::unexpected<Error>(array.error());
    const auto negative =
        std::find_if(array->begin(), array->end(), [](double d) { return d < 0; });
    if (negative != array->end()) {
      return fail(Errc::kProtocol, fmt::format("distancesensorarray: {} is negative", *negative));
    }
    InfraredReadings readings;
    for (const node::devices::InfraredSensor& sensor : sensors_) add(sensor, *array, readings);
    return readings;
  }

 private:
  void add(const node::devices::InfraredSensor& sensor, const std::vector<double>& array,
           InfraredReadings& readings) const {
    const Pair pair = pair_for(sensor.heading, settings_.clockwise);
    const node::devices::InfraredCurve& curve = sensor.curve;
    if (settings_.in_volts) {
      const double volts = std::max(array[pair.first], array[pair.second]);
      readings.volts.push_back(volts);
      readings.metres.push_back(curve.metres(volts));
      return;
    }
    const double metres = std::min(array[pair.first], array[pair.second]);
    readings.volts.push_back(curve.volts(metres));
    readings.metres.push_back(metres > curve.max_range() ? kNothing
                                                         : std::max(metres, curve.min_range()));
  }

  RobotinoSettings settings_;
  std::vector<node::devices::InfraredSensor> sensors_;
  RobotinoRest rest_;
};

}  // namespace

std::unique_ptr<InfraredDriver> make_robotino_infrared(const RobotinoSettings& settings,
                                                       const DrivenRobot& robot) {
  return std::make_unique<ThreadedInfrared>(
      std::make_unique<RobotinoInfrared>(settings, robot.description), settings.times);
}

}  // namespace hal::robot::drivers
